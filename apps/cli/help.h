#pragma once

#include <string>

#include "azulejo/core/json.h"
#include "azulejo/engine/operation.h"

// Everything here is made from the list of operations and the list of shared options.
namespace azulejo::cli {

std::string help();
std::string operation_help(const Operation& operation);
/// Of `turntable`, which has the options of `render`.
std::string turntable_help();
std::string operation_list();
Json operation_json(const Operation& operation);
/// A completion script for "bash" or "zsh". Throws Error(Argument) for another shell.
std::string completion(const std::string& shell);
/// The manual page in troff.
std::string manual();

}  // namespace azulejo::cli
