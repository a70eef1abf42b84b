#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "azulejo/engine/operation.h"

// How help, the manual and the reference pages put into words what an operation says of itself.
namespace azulejo::cli {

/// "azulejo blend SOURCE OTHER -o OUTPUT [options]"
std::string usage(const Operation& operation);
/// As it would be typed.
std::string default_of(const Operation& operation, const Field& field);
/// "mesh|scene": of a port of an operation and of its variants, each kind once.
std::string kinds_of(const Operation& operation, std::vector<Port> Operation::*ports, std::size_t index);
/// Whether the operation, or a variant of it, can be kept within an area.
bool takes_within(const Operation& operation);
/// What holds an input or output outside of a chain; of an output that is made on request only, how it is asked for.
std::string file_of(const Operation& operation, const Port& port);

}  // namespace azulejo::cli
