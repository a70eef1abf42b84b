#pragma once

// For tests only.

#include <cmath>
#include <cstdint>
#include <random>
#include <type_traits>

#include "azulejo/data/image.h"

namespace azulejo {

/// Every value of its type as likely as any other; f32 in [0, 1).
inline Image random_image(const ImageInfo& info, unsigned seed) {
  Image image(info);
  std::mt19937 random(seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        view.row(y)[i] = std::is_same_v<T, float> ? static_cast<T>(std::ldexp(static_cast<double>(random() >> 8), -24))
                                                  : static_cast<T>(random());
      }
    }
  });
  return image;
}

}  // namespace azulejo
