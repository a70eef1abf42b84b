#include "azulejo/rendering/viewport_rect.h"

#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {

Rect viewport_rect(const std::optional<std::array<float, 4>>& viewport, int width, int height) {
  if (!viewport) return {0, 0, width, height};
  int numbers[4] = {};
  for (std::size_t i = 0; i < 4; ++i) {
    const float number = (*viewport)[i];
    if (!(std::abs(number) <= 1e6F) || std::floor(number) != number) {
      throw Error(Error::Argument, fmt::format("viewport: {}, expected whole numbers of pixels", number));
    }
    numbers[i] = static_cast<int>(number);
  }
  const Rect rect{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (rect.empty() || !Rect{0, 0, width, height}.contains(rect)) {
    throw Error(Error::Argument, fmt::format("viewport: {},{},{},{}, expected x,y,width,height of a part of the {}×{} "
                                             "pixels of the picture",
                                             rect.x, rect.y, rect.width, rect.height, width, height));
  }
  return rect;
}

}  // namespace azulejo
