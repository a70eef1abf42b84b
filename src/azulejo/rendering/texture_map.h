#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// A texture ready to be looked up: linear, four channels of 16 bits, with all its mipmaps (each half the size of the
/// last, rounded down, averaged in linear light by area).
class TextureMap {
 public:
  /// srgb   the image's colours are sRGB-encoded and become linear; its opacity never is
  /// Cost   O(pixels), on all threads
  TextureMap(const Texture& texture, bool srgb, const Run& run);

  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }
  int levels() const { return static_cast<int>(levels_.size()); }
  /// False: every texel has full opacity.
  bool has_alpha() const { return has_alpha_; }

  /// The value at `uv` ((0, 0) is the image's top left, (1, 1) its bottom right) in 0–1. `lod` is log2 of the texels
  /// that a pixel covers. The texture's own filters and wrapping apply. Coordinates that are not finite count as 0.
  glm::vec4 sample(glm::vec2 uv, float lod) const;
  /// A texel of a level, in 0–1.
  glm::vec4 texel(int level, int x, int y) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    Array<std::uint16_t> texels;
  };
  glm::vec4 bilinear(const Level& level, glm::vec2 uv) const;
  glm::vec4 nearest(const Level& level, glm::vec2 uv) const;
  void make_levels(const Run& run);

  std::vector<Level> levels_;
  TextureWrap wrap_u_;
  TextureWrap wrap_v_;
  TextureFilter magnification_;
  TextureFilter minification_;
  MipFilter mipmaps_;
  bool has_alpha_ = false;
};

}  // namespace azulejo
