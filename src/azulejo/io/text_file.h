#pragma once

#include <string>
#include <string_view>

#include "azulejo/core/export.h"

namespace azulejo {

/// Writes text beside `path` and renames: never half a file. "-" is standard output. Throws Error(Io).
AZULEJO_EXPORT void write_text_file(const std::string& path, std::string_view text);

}  // namespace azulejo
