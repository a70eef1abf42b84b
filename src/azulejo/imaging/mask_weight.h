#pragma once

#include <algorithm>

#include "azulejo/data/view.h"

namespace azulejo {

inline constexpr int kFullWeight = 65535;

/// The weight that a pixel of a mask stands for, 0–65535: the mean of its colors times alpha; NaN is 0.
template <class T>
int mask_weight(const T* pixel, const ImageInfo& info) {
  if (info.channels == 1 && sizeof(T) == 1) return static_cast<int>(*pixel) * 257;
  if (info.channels == 1 && sizeof(T) == 2) return static_cast<int>(*pixel);
  const int colors = info.color_channels();
  const double top = full_range(info.type);
  double sum = 0;
  for (int c = 0; c < colors; ++c) sum += static_cast<double>(pixel[c]);
  double weight = sum / colors / top;
  if (info.alpha == AlphaState::Straight) weight *= static_cast<double>(pixel[colors]) / top;
  return weight > 0 ? static_cast<int>(std::min(weight, 1.0) * kFullWeight + 0.5) : 0;
}

}  // namespace azulejo
