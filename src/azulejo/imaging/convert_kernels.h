#pragma once

#include "azulejo/data/view.h"

namespace azulejo {

/// What `convert` does to a value: the range from `low` on, times `scale`, in the result's type.
struct Stretch {
  float low = 0;
  float scale = 1;
  bool any = false;  ///< false: values keep their intensity
};

/// A stored value, as f32, in stored units of another type, not rounded.
struct Rescale {
  Rescale(PixelType from, PixelType to)
      : from_full(full_range(from)), to_full(full_range(to)), to_float(to == PixelType::F32) {
    factor = to_full / from_full;
  }
  /// Of integers as f32 the nearest quotient; else a product.
  float operator()(float value) const { return to_float ? value / from_full : value * factor; }

  float from_full;
  float to_full;
  float factor;
  bool to_float;
};

/// The definition of color; `alpha` is the source's where that is premultiplied.
inline float stretched(const Stretch& stretch, const Rescale& rescale, float value, const float* alpha) {
  if (!stretch.any) return rescale(value);
  if (alpha != nullptr && *alpha == 0) return 0;
  const float intensity = value / (alpha != nullptr ? *alpha : rescale.from_full);
  const float result = (intensity - stretch.low) * stretch.scale;
  return result * (alpha != nullptr ? rescale(*alpha) : rescale.to_full);
}

namespace kernels {

/// A tile in another pixel type.
void convert(const ConstAnyView& source, const AnyView& result, const Stretch& stretch);

}  // namespace kernels
}  // namespace azulejo
