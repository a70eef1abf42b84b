#pragma once

#include <cstdint>

#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// The attribute with the values of these elements, in this order; 0xFFFFFFFF picks zeros.
Attribute picked(const Attribute& attribute, const Array<std::uint32_t>& elements);
/// The same of vertices.
MorphTarget picked(const MorphTarget& target, const Array<std::uint32_t>& vertices);

}  // namespace azulejo
