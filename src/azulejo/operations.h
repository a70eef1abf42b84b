#pragma once

#include <span>
#include <string>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/engine/operation.h"

namespace azulejo {

/// Every operation there is, in the order of their names.
AZULEJO_EXPORT std::span<const Operation* const> operations();

/// The operation of that name, or null.
AZULEJO_EXPORT const Operation* find_operation(std::string_view name);

}  // namespace azulejo
