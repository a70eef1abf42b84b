#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/math/catmull_rom.h"
#include "azulejo/math/color.h"

namespace azulejo {

enum class CurveKind : std::uint8_t {
  Polyline,
  Bezier,      ///< one, of as many points as there are less one
  BSpline,     ///< near the points
  Nurbs,       ///< a B-spline with weights
  CatmullRom,  ///< through the points
  Arc,         ///< of an ellipse, from first_deg on by sweep_deg
  Circle,
  Ellipse,
  Rectangle,
  Polygon,  ///< regular
  Star,
  Spiral,  ///< Archimedes', from the center out
};
constexpr std::array<std::string_view, 12> enum_names(CurveKind) {
  return {"polyline", "bezier",  "bspline",   "nurbs",   "catmull_rom", "arc",
          "circle",   "ellipse", "rectangle", "polygon", "star",        "spiral"};
}

struct CurveOptions {
  CurveKind kind = CurveKind::Bezier;
  /// x and y of each, page units, y down.
  std::vector<float> points = {20, 170, 60, 10, 140, 250, 240, 30};
  std::vector<float> weights = {};                  ///< of nurbs, one a point; empty: 1
  std::vector<float> knots = {};                    ///< of bspline and nurbs; empty: even, to the first and last point
  int degree = 3;                                   ///< of bspline and nurbs
  SplineTiming timing = SplineTiming::Centripetal;  ///< of catmull_rom
  bool closed = false;                              ///< of what has points
  glm::vec2 center{100, 100};                       ///< of what has none
  glm::vec2 radii{80, 50};  ///< of arc and ellipse; half the sides of the rectangle; others take the first
  float rotation_deg = 0;
  float first_deg = 0;      ///< of the arc: 0 is to the right, counter-clockwise as seen
  float sweep_deg = 270;    ///< of the arc; ± 360 and beyond: all around
  int corners = 5;          ///< of polygon and star
  float inner = 0.382F;     ///< of star and spiral: the inner radius, a share of the outer; 0.382: a pentagram
  float turns = 3;          ///< of the spiral
  float tolerance = 0.01F;  ///< page units, of what isn't a cubic itself
  Color color{0, 0, 0, 1};
  float width = 2;
  std::optional<Color> fill = std::nullopt;  ///< auto: none
  std::vector<float> dash = {};
  LineCap cap = LineCap::Butt;
  LineJoin join = LineJoin::Miter;
  bool controls = false;                         ///< shows the points, and the lines between them
  std::optional<glm::vec2> page = std::nullopt;  ///< auto: as large as what is drawn, which is moved there
};

/// A drawing of one curve: a path with the id "curve", above its "controls" where they are shown.
///
/// exact     lines, Bézier curves and B-splines of degree 1 to 3 with equal weights, catmull_rom
/// within    tolerance: all others, as cubics; an upper bound up to 2¹⁶ cubics a piece, 64 an ellipse
/// closed    a B-spline goes around its points (even knots); others end where they began
/// Throws    Error(Argument) for points that aren't pairs, fewer or more than the kind takes (a Bézier curve up to 65),
///           weights or knots that don't fit, and options out of range
/// Source    the curves: math/bezier.h, bspline.h, rational_curve.h, catmull_rom.h, arc.h
AZULEJO_EXPORT Drawing curve(const CurveOptions& options = {}, const Run& run = {});

}  // namespace azulejo
