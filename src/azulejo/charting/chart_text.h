#pragma once

#include <string>
#include <string_view>

#include "azulejo/charting/text.h"

namespace azulejo {

/// Text that is as wide as there is room: cut, with "…" at its end, where it is wider.
std::string fitted_text(std::string_view text, const TextOptions& options, float width);

/// A run that passes on the first warning of each kind of text only: a chart has many labels.
Run warning_once(const Run& run);

}  // namespace azulejo
