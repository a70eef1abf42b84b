#pragma once

#include <string>

#include "azulejo/engine/operation.h"

// How help, the manual and the reference pages put into words what an operation says of itself.
namespace azulejo::cli {

/// "azulejo blend SOURCE OTHER -o OUTPUT [options]"
std::string usage(const Operation& operation);
/// As it would be typed.
std::string default_of(const Operation& operation, const Field& field);
/// What holds an input or output outside of a chain; of an output that is made on request only, how it is asked for.
std::string file_of(const Operation& operation, const Port& port);

}  // namespace azulejo::cli
