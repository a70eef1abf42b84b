#pragma once

#include <array>

#include "azulejo/data/view.h"
#include "azulejo/imaging/pseudo_color.h"

namespace azulejo {

/// From values to colors, made ready: the options of pseudo_color with the range that they mean.
struct ColorMapping {
  static constexpr std::size_t kMostSegments = 51;

  ColorMapping(const PseudoColorOptions& options, float first, float last);
  /// The definition: sRGB, 0–1, of an intensity.
  std::array<float, 3> at(float value) const;

  float low;
  float scale;   ///< 1 ÷ (high − low), or 0
  int levels;    ///< 0: all
  int segments;  ///< between two colors of the map, in which channels are start + slope · rest
  std::array<float, 3> nan;
  float start[3][kMostSegments] = {};
  float slope[3][kMostSegments] = {};
};

namespace kernels {

/// The colors of a tile of 1 channel, or of 2 with alpha.
void pseudo_color(const ConstAnyView& source, const AnyView& result, const ColorMapping& mapping);

}  // namespace kernels
}  // namespace azulejo
