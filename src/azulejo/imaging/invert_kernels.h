#pragma once

#include <algorithm>
#include <type_traits>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

/// The definition, for one value: `whole` is the full range, or the alpha of premultiplied color.
template <class T>
T inverted(T value, T whole) {
  if constexpr (std::is_same_v<T, float>) {
    return whole - value;
  } else {
    return static_cast<T>(whole - std::min(value, whole));
  }
}

/// The same for a tile.
void invert(const ConstAnyView& source, const AnyView& result);

}  // namespace azulejo::kernels
