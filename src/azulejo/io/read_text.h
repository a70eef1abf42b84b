#pragma once

#include <string_view>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// A whole file of text in memory, as UTF-8.
struct Text {
  Array<char> bytes;
  std::size_t begin = 0;  ///< behind the mark that may stand first
  /// Two line feeds stand behind it, so that what reads lines needs no other end. They are part of it.
  std::string_view view() const { return std::string_view(bytes.data(), bytes.size()).substr(begin); }
};

/// Reads text; UTF-16 with its mark (FE FF, FF FE) is converted, what isn't a letter there becomes U+FFFD.
/// Throws Error(Io), Error(Resource) above run.limits.memory_bytes.
Text read_text(const Input& input, const Run& run);

}  // namespace azulejo
