#pragma once

// For tests only: the definition of what unsharp_mask, high_boost and high_pass do.

#include <cmath>
#include <vector>

#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"

namespace azulejo {

/// A value of an image without alpha as an intensity.
inline double intensity(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)) / full_range(image.type()); });
}

/// The image smoothed by a Gaussian cut at 4 sigma, mirrored at the borders, in double precision.
inline double smooth(const Image& image, int x, int y, int c, double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  double sum = 0;
  double weights = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const double weight = std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma));
      sum += weight * intensity(image, border_index(x + dx, image.width(), Border::Mirror),
                                border_index(y + dy, image.height(), Border::Mirror), c);
      weights += weight;
    }
  }
  return sum / weights;
}

/// How far `gaussian` may be from that before rounding, as an intensity.
inline double smooth_error(PixelType type, double sigma) {
  const double radius = std::ceil(4 * sigma);
  return type == PixelType::U8 ? (radius + 4) / 128 / 255 : (radius + 4) / 4194304;
}

}  // namespace azulejo
