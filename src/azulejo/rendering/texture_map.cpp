#include "azulejo/rendering/texture_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "azulejo/core/parallel.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr float kFull = 65535.0F;

std::uint16_t to_u16(float value) { return static_cast<std::uint16_t>(std::clamp(value, 0.0F, 1.0F) * kFull + 0.5F); }

/// u8 to linear u16, for colours and for data.
const std::array<std::uint16_t, 256>& table(bool srgb) {
  static const auto make = [](bool encoded) {
    std::array<std::uint16_t, 256> values{};
    for (std::size_t i = 0; i < 256; ++i) {
      const float value = static_cast<float>(i) / 255.0F;
      values[i] = to_u16(encoded ? srgb_to_linear(value) : value);
    }
    return values;
  };
  static const std::array<std::uint16_t, 256> encoded = make(true);
  static const std::array<std::uint16_t, 256> plain = make(false);
  return srgb ? encoded : plain;
}

/// One row of an image of any kind as RGBA.
template <class T>
void convert_row(const ImageView<const T>& view, const ImageInfo& info, int y, bool srgb, std::uint16_t* to) {
  const int colors = info.color_channels();
  const bool alpha = info.alpha != AlphaState::None;
  const float full = full_range(info.type);
  const bool encoded = srgb && info.color != ColorState::Linear;
  const auto linear = [&](T value, bool color) {
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      return table(encoded && color)[value];
    } else {
      const float unit = static_cast<float>(value) / full;
      return to_u16(encoded && color ? srgb_to_linear(unit) : unit);
    }
  };
  const T* from = view.row(y);
  for (int x = 0; x < view.width; ++x, from += view.channels, to += 4) {
    for (int c = 0; c < 3; ++c) to[c] = linear(from[colors >= 3 ? c : 0], true);
    if (colors == 2) to[1] = linear(from[1], true);
    to[3] = alpha ? linear(from[view.channels - 1], false) : std::uint16_t{65535};
  }
}

/// The texel that a whole coordinate means.
int wrapped(int at, int size, TextureWrap wrap) {
  if (static_cast<unsigned>(at) < static_cast<unsigned>(size)) return at;
  switch (wrap) {
    case TextureWrap::Clamp: return at < 0 ? 0 : size - 1;
    case TextureWrap::Repeat: {
      const int rest = at % size;
      return rest < 0 ? rest + size : rest;
    }
    case TextureWrap::Mirror: {
      int rest = at % (2 * size);
      if (rest < 0) rest += 2 * size;
      return rest < size ? rest : 2 * size - 1 - rest;
    }
  }
  return 0;
}

/// The coordinate near the image: what whole texels are computed from stays in range of an int.
float tamed(float t, TextureWrap wrap) {
  if (!std::isfinite(t)) return 0;
  if (wrap == TextureWrap::Clamp) return std::clamp(t, -1.0F, 2.0F);
  return t - 2.0F * std::floor(t * 0.5F);
}

/// A texel in 0–65535.
glm::vec4 load(const std::uint16_t* texel) {
  return {static_cast<float>(texel[0]), static_cast<float>(texel[1]), static_cast<float>(texel[2]),
          static_cast<float>(texel[3])};
}

}  // namespace

TextureMap::TextureMap(const Texture& texture, bool srgb, const Run& run)
    : wrap_u_(texture.wrap_u),
      wrap_v_(texture.wrap_v),
      magnification_(texture.magnification),
      minification_(texture.minification),
      mipmaps_(texture.mipmaps) {
  const Image& image = *texture.image;
  Level level{image.width(), image.height(), {}};
  level.texels.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4);
  visit(image.any(), [&](auto view) {
    parallel_for(static_cast<std::size_t>(level.height), 64, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        convert_row(view, image.info(), static_cast<int>(y), srgb,
                    level.texels.data() + y * static_cast<std::size_t>(level.width) * 4);
      }
    });
  });
  if (image.info().alpha != AlphaState::None) {
    for (std::size_t i = 3; i < level.texels.size() && !has_alpha_; i += 4) has_alpha_ = level.texels[i] != 65535;
  }
  levels_.push_back(std::move(level));
  if (mipmaps_ != MipFilter::None) make_levels(run);
}

/// Each texel is the mean of the part of the level above that it covers: 2×2 texels, or 3 along an odd side, weighted.
void TextureMap::make_levels(const Run& run) {
  struct Taps {
    int first;
    int count;
    float weight[3];
  };
  const auto taps_of = [](int at, int from, int to) {
    if (from % 2 == 0 || from == 1) return Taps{at * from / to, from / to, {0.5F, 0.5F, 0}};
    const auto size = static_cast<float>(from);
    const auto x = static_cast<float>(at);
    return Taps{2 * at, 3, {(static_cast<float>(to) - x) / size, static_cast<float>(to) / size, (x + 1) / size}};
  };
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& above = levels_.back();
    Level level{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
    level.texels.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4);
    parallel_for(static_cast<std::size_t>(level.height), 32, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        const Taps rows = taps_of(static_cast<int>(y), above.height, level.height);
        for (int x = 0; x < level.width; ++x) {
          const Taps columns = taps_of(x, above.width, level.width);
          glm::vec4 sum(0.5F);
          for (int j = 0; j < rows.count; ++j) {
            const float row_weight = rows.count == 1 ? 1.0F : rows.weight[j];
            for (int i = 0; i < columns.count; ++i) {
              const float weight = row_weight * (columns.count == 1 ? 1.0F : columns.weight[i]);
              const std::size_t at = (static_cast<std::size_t>(rows.first + j) * static_cast<std::size_t>(above.width) +
                                      static_cast<std::size_t>(columns.first + i)) *
                                     4;
              sum += load(above.texels.data() + at) * weight;
            }
          }
          const std::size_t to = (y * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x)) * 4;
          for (int c = 0; c < 4; ++c) {
            level.texels[to + static_cast<std::size_t>(c)] = static_cast<std::uint16_t>(std::min(sum[c], kFull));
          }
        }
      }
    });
    levels_.push_back(std::move(level));
  }
}

glm::vec4 TextureMap::texel(int level, int x, int y) const {
  const Level& from = levels_[static_cast<std::size_t>(level)];
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width) + static_cast<std::size_t>(x)) * 4;
  return load(from.texels.data() + at) * (1.0F / kFull);
}

glm::vec4 TextureMap::nearest(const Level& level, glm::vec2 uv) const {
  const int x = wrapped(static_cast<int>(std::floor(uv.x * static_cast<float>(level.width))), level.width, wrap_u_);
  const int y = wrapped(static_cast<int>(std::floor(uv.y * static_cast<float>(level.height))), level.height, wrap_v_);
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x)) * 4;
  return load(level.texels.data() + at) * (1.0F / kFull);
}

glm::vec4 TextureMap::bilinear(const Level& level, glm::vec2 uv) const {
  const float across = uv.x * static_cast<float>(level.width) - 0.5F;
  const float down = uv.y * static_cast<float>(level.height) - 0.5F;
  const float left = std::floor(across);
  const float top = std::floor(down);
  const int x0 = wrapped(static_cast<int>(left), level.width, wrap_u_);
  const int x1 = wrapped(static_cast<int>(left) + 1, level.width, wrap_u_);
  const int y0 = wrapped(static_cast<int>(top), level.height, wrap_v_);
  const int y1 = wrapped(static_cast<int>(top) + 1, level.height, wrap_v_);
  const std::uint16_t* const upper =
      level.texels.data() + static_cast<std::size_t>(y0) * static_cast<std::size_t>(level.width) * 4;
  const std::uint16_t* const lower =
      level.texels.data() + static_cast<std::size_t>(y1) * static_cast<std::size_t>(level.width) * 4;
  const float fx = across - left;
  const float fy = down - top;
  const auto blend = [](const glm::vec4& a, const glm::vec4& b, float t) { return a + (b - a) * t; };
  const glm::vec4 above = blend(load(upper + std::ptrdiff_t{4} * x0), load(upper + std::ptrdiff_t{4} * x1), fx);
  const glm::vec4 below = blend(load(lower + std::ptrdiff_t{4} * x0), load(lower + std::ptrdiff_t{4} * x1), fx);
  return blend(above, below, fy) * (1.0F / kFull);
}

glm::vec4 TextureMap::sample(glm::vec2 uv, float lod) const {
  uv = {tamed(uv.x, wrap_u_), tamed(uv.y, wrap_v_)};
  const auto at = [&](int level, TextureFilter filter) {
    const Level& from = levels_[static_cast<std::size_t>(level)];
    return filter == TextureFilter::Nearest ? nearest(from, uv) : bilinear(from, uv);
  };
  if (!(lod > 0)) return at(0, magnification_);
  const int last = levels() - 1;
  if (mipmaps_ == MipFilter::None || last == 0) return at(0, minification_);
  const float level = std::min(lod, static_cast<float>(last));
  if (mipmaps_ == MipFilter::Nearest) return at(static_cast<int>(level + 0.5F), minification_);
  const int lower = static_cast<int>(level);
  const float t = level - static_cast<float>(lower);
  const glm::vec4 fine = at(lower, minification_);
  return t > 0 && lower < last ? fine + (at(lower + 1, minification_) - fine) * t : fine;
}

}  // namespace azulejo
