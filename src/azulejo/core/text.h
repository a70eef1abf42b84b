#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// The candidate that a misspelt name most likely means, or "" if none is near: at most a third of its letters
/// inserted, removed, replaced or swapped with the next. Cost O(letters²) a candidate.
AZULEJO_EXPORT std::string closest(std::string_view name, std::span<const std::string> candidates);

/// " (did you mean gaussian?)", or "" if nothing is near.
AZULEJO_EXPORT std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

}  // namespace azulejo
