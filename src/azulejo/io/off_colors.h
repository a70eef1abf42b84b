#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// What is seen in the colours of an OFF file. They may be integers 0–255 or reals 0–1, with alpha or without, or one
/// number in a table of colours; a row may have none.
struct OffColorKinds {
  bool some = false;     ///< three or four values
  bool real = false;     ///< with a point or an exponent
  bool alpha = false;    ///< four values
  bool indexed = false;  ///< one value
  float most = 0;        ///< of all values

  OffColorKinds& operator|=(const OffColorKinds& other);
};

/// Makes COLOR_0 of four values for each element, NaN where it has none: such a colour is white, an alpha opaque.
/// Integers that never exceed 1 are taken for reals: they would all be black. Nothing if no element has a colour.
std::optional<Attribute> off_colors(const Array<float>& values, const OffColorKinds& kinds, Domain domain,
                                    const std::string& name, const Run& run);

}  // namespace azulejo
