#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "azulejo/data/array.h"
#include "azulejo/rendering/coverage_scan.h"

namespace azulejo {

/// A row of a layer. Pixels are premultiplied f32, by blocks: kBlock reds, greens, blues and alphas. A block of one color
/// is kept as that color, its pixels are undefined.
struct LayerRow {
  float* pixels;
  glm::vec4* colors;    ///< of each block
  std::uint8_t* plain;  ///< of each block: 1 where it has one color
};

/// The floats of a block.
inline constexpr int kBlockFloats = 4 * kBlock;

/// What is painted in some rows of a picture, before it is seen.
class DrawLayer {
 public:
  DrawLayer(int blocks, int rows) : blocks_(blocks) {
    const std::size_t count = static_cast<std::size_t>(blocks) * static_cast<std::size_t>(rows);
    pixels_.resize(count * kBlockFloats);
    colors_.resize(count);
    plain_.resize(count);
  }

  LayerRow row(int y) {
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_);
    return {pixels_.data() + first * kBlockFloats, colors_.data() + first, plain_.data() + first};
  }
  /// Bytes of a block and its share of the rest.
  static constexpr std::size_t kBlockBytes = kBlockFloats * sizeof(float) + sizeof(glm::vec4) + 1;

 private:
  int blocks_;
  Array<float> pixels_;
  Array<glm::vec4> colors_;
  Array<std::uint8_t> plain_;
};

/// What part of each pixel of a run of blocks something covers.
struct RunCoverage {
  int first;            ///< block
  int last;             ///< behind the last
  const float* values;  ///< of the row, from its first pixel; null: all `value`
  float value = 1;
};

namespace kernels {

/// Paints over a row, source-over: row = row (1 − coverage · alpha) + coverage · color. The same bytes on all vector
/// targets, and whether a block is kept as one color or not.
/// color  premultiplied
void cover_with_color(const LayerRow& row, const RunCoverage& run, const glm::vec4& color);
/// colors  premultiplied, by blocks, from block run.first on
void cover_with_colors(const LayerRow& row, const RunCoverage& run, const float* colors);
/// A layer painted over another one.
void cover_with_layer(const LayerRow& row, const LayerRow& top, int first, int last, float opacity);
/// Multiplies a layer by the alpha of a mask.
void keep_inside(const LayerRow& row, const LayerRow& mask, int first, int last);
/// Straight 8-bit colors of `width` pixels; encoded to sRGB where they are linear light.
void store_row(const LayerRow& row, int width, bool linear, std::uint8_t* rgba);

}  // namespace kernels
}  // namespace azulejo
