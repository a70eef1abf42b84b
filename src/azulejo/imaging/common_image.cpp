#include "azulejo/imaging/common_image.h"

#include <fmt/format.h>

#include <algorithm>

#include "azulejo/core/error.h"
#include "azulejo/data/image.h"

namespace azulejo {

ImageInfo common_image(const ImageInfo& source, const ImageInfo& other) {
  const int source_colors = source.color_channels();
  const int other_colors = other.color_channels();
  if (source.rect() != other.rect() || source.type != other.type || source.color != other.color) {
    throw Error(Error::Argument, fmt::format("other: {}, expected size, pixel type and color state of source: {}",
                                             describe(other), describe(source)));
  }
  if (source_colors != other_colors && source_colors != 1 && other_colors != 1) {
    throw Error(Error::Argument, fmt::format("other: {}, expected the color channels of source or gray: {}",
                                             describe(other), describe(source)));
  }
  ImageInfo info = source;
  if (info.alpha == AlphaState::None) info.alpha = other.alpha;
  info.channels = std::max(source_colors, other_colors) + (info.alpha == AlphaState::None ? 0 : 1);
  if (info.alpha != AlphaState::None && info.channels % 2 != 0) {
    throw Error(Error::Argument, fmt::format("other: {} and source: {}, expected 1 or 3 channels beside alpha",
                                             describe(other), describe(source)));
  }
  return info;
}

}  // namespace azulejo
