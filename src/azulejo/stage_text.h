#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// A stage as it is written: `gaussian:sigma=2,border=wrap`.
struct StageText {
  std::string name;
  std::vector<std::pair<std::string, std::string>> arguments;  ///< a bare word gets the value "true"
};

/// Takes a stage apart. A comma starts a new argument only if `name=` follows; single or double quotes protect
/// commas and are taken off. Throws Error(Argument).
AZULEJO_EXPORT StageText parse_stage(std::string_view text);

/// Letters, digits, _ and -, a letter or _ first.
bool is_name(std::string_view text);
/// `name=` at the start of `text`: the name's length, else 0.
std::size_t leading_name(std::string_view text);

}  // namespace azulejo
