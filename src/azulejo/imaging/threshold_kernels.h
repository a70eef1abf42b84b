#pragma once

#include "azulejo/data/view.h"
#include "azulejo/imaging/threshold.h"

namespace azulejo::kernels {

/// The definition, for one value.
template <class T>
struct ThresholdPoint {
  explicit ThresholdPoint(const ThresholdOptions& options) {
    const float top = full_range(kPixelTypeOf<T>);
    level = static_cast<T>(options.level * top);  // of integers v > x is v > floor(x)
    above = static_cast<T>(options.invert ? 0.0F : top);
    below = static_cast<T>(options.invert ? top : 0.0F);
  }
  T operator()(T value) const { return value > level ? above : below; }

  T level;
  T above;
  T below;
};

/// The same for a tile.
void threshold(const ConstAnyView& source, const AnyView& result, const ThresholdOptions& options);

}  // namespace azulejo::kernels
