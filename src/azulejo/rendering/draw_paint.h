#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "azulejo/data/drawing.h"
#include "azulejo/rendering/coverage_scan.h"

namespace azulejo {

/// A color between two stops of a gradient, ready to be mixed.
struct GradientStep {
  float offset;
  float scale;       ///< 1 ÷ the distance to the next stop; 0: there is none, the color jumps
  glm::vec4 change;  ///< straight: what comes to the color from this stop to the next
};

/// Where in a gradient a pixel is, told from the picture.
struct GradientField {
  bool radial = false;
  GradientSpread spread = GradientSpread::Pad;
  // Linear: the offset at a point of the picture is along.x x + along.y y + along.z. Radial: so are both coordinates
  // from the center of the first circle, and the unit is the larger of what the circles measure.
  std::array<double, 3> across{};
  std::array<double, 3> along{};
  float distance_x = 0;  ///< radial: of the second center from the first
  float distance_y = 0;
  float radius = 0;    ///< of the first circle
  float growth = 0;    ///< of the radius, to the second one
  glm::vec4 first{0};  ///< straight, of the first stop
  std::vector<GradientStep> steps;
  bool linear = false;  ///< colors become linear light after mixing
};

/// A pattern as it lies in the picture.
class DrawPaint {
 public:
  /// tint     of the style: with stored colors, straight; alpha with its opacity
  /// linear   the picture is composed in linear light
  /// exact    parts of pixels count; false: what is at their centers
  DrawPaint(const PaintPattern& pattern, const glm::vec4& tint, const glm::mat3x2& picture_from_path, bool linear,
            bool exact);

  /// Premultiplied colors by blocks, as in a LayerRow, of blocks [first, last) of row y.
  void colors(int first, int last, int y, float* result) const;

  /// One color is all there is: premultiplied; without alpha: nothing is painted.
  const std::optional<glm::vec4>& plain() const { return plain_; }

 private:
  void prepare(const Gradient& gradient, const glm::vec4& tint, const glm::mat3x2& picture_from_path);
  void prepare(const Hatch& hatch, const glm::mat3x2& picture_from_path);
  float hatch_part(double x, double y) const;

  /// Lines at all whole numbers of a coordinate that changes by x and y from pixel to pixel.
  struct Lines {
    double x, y, start;
    double width;
    double covered(double at, bool exact) const;
  };

  bool linear_;
  bool exact_;
  std::optional<glm::vec4> plain_;
  glm::vec4 color_{0};  ///< premultiplied
  std::optional<GradientField> gradient_;
  std::vector<Lines> lines_;
  std::optional<Stipple> stipple_;
};

/// Premultiplied, in linear light if the picture is composed there.
glm::vec4 premultiplied(const glm::vec4& straight, bool linear);

namespace kernels {
void gradient_colors(const GradientField& field, int first, int last, int y, float* result);
}

}  // namespace azulejo
