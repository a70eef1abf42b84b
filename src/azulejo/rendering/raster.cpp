#include "azulejo/rendering/raster.h"

#include <algorithm>

namespace azulejo {

void VisibilityBuffer::prepare() {
  constexpr std::size_t kPadding = 64;
  const std::size_t values = pixels() * samples.size();
  depth.resize(values + kPadding);
  triangle.resize(values + kPadding);
  std::fill(depth.begin(), depth.end(), 0.0F);
  std::fill(triangle.begin(), triangle.end(), kNoTriangle);
}

}  // namespace azulejo
