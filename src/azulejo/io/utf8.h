#pragma once

#include <string>
#include <string_view>

namespace azulejo {

/// Whether all of it is UTF-8: no byte astray, no letter written longer than it must be, no half of a pair.
bool is_utf8(std::string_view text);

/// Latin-1 as UTF-8.
std::string utf8_from_latin1(std::string_view text);

}  // namespace azulejo
