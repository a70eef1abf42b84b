#include "azulejo/modelling/curve.h"

#include <algorithm>
#include <cmath>

#include "azulejo/engine/operation.h"
#include "azulejo/modelling/curve_outline.h"

namespace azulejo {
namespace {

constexpr double kFarthest = 1e6;

glm::vec4 straight(const Color& color) { return {color.r, color.g, color.b, color.a}; }

DrawingStyle style_of(const CurveOptions& options) {
  DrawingStyle style;
  style.fill.reset();
  if (options.fill) style.fill = Paint(straight(*options.fill));
  style.stroke = Paint(straight(options.color));
  style.stroke_width = options.width;
  style.dash = options.dash;
  style.cap = options.cap;
  style.join = options.join;
  return style;
}

DrawingStyle style_of_controls() {
  const Paint blue(glm::vec4{0.16F, 0.44F, 0.78F, 1});
  DrawingStyle style;
  style.fill.reset();
  style.stroke = blue;
  style.stroke_width = 1;
  style.fixed_stroke = true;
  style.points = blue;
  style.point_size = 7;
  return style;
}

Path polygon_of_controls(const CurveOptions& options) {
  Path path;
  for (const glm::dvec2& point : control_points(options)) {
    path.commands.empty() ? path.move_to(point) : path.line_to(point);
  }
  if (options.closed) path.close();
  return path;
}

/// Moves all of it to the page's middle.
void fit_page(Drawing& drawing, float margin) {
  const Box2 box = bounds(drawing);
  if (box.empty()) return;
  drawing.width = std::ceil(box.upper.x - box.lower.x + 2 * margin);
  drawing.height = std::ceil(box.upper.y - box.lower.y + 2 * margin);
  const glm::vec2 shift = 0.5F * (glm::vec2(drawing.width, drawing.height) - box.lower - box.upper);
  drawing.groups[1].parent_from_group = {1, 0, 0, 1, shift.x, shift.y};
}

std::vector<Value> run_curve(std::span<const Value>, const CurveOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(curve(options, run));
  return results;
}

}  // namespace

extern const Operation kCurve = with_examples(
    value_operation<CurveOptions>(
        "curve", "Draws a curve: Bézier, B-spline, NURBS, Catmull–Rom, arcs, polygons, a star, a spiral.", {},
        {{"drawing", "the curve, as a path", ValueKind::Drawing}},
        {field("kind", &CurveOptions::kind, "which curve"),
         field("points", &CurveOptions::points, {-kFarthest, kFarthest}, "px", "x and y of each, y down"),
         field("weights", &CurveOptions::weights, {1e-3, 1e3}, "", "of nurbs, one a point; none: 1"),
         field("knots", &CurveOptions::knots, {-kFarthest, kFarthest}, "",
               "of bspline and nurbs; none: even, from the first to the last point"),
         field("degree", &CurveOptions::degree, {1, 16}, "", "of bspline and nurbs"),
         field("timing", &CurveOptions::timing, "of catmull_rom: how distances count"),
         field("closed", &CurveOptions::closed, "back to where it began"),
         field("center", &CurveOptions::center, {-kFarthest, kFarthest}, "px", "of what has no points"),
         field("radii", &CurveOptions::radii, {1e-3, kFarthest}, "px",
               "of arc and ellipse, half the sides of the rectangle; the first of circle, polygon, star and spiral"),
         field("rotation_deg", &CurveOptions::rotation_deg, {-36000, 36000}, "deg", "counter-clockwise as seen"),
         field("first_deg", &CurveOptions::first_deg, {-36000, 36000}, "deg",
               "where the arc begins; 0 is to the right"),
         field("sweep_deg", &CurveOptions::sweep_deg, {-36000, 36000}, "deg", "how far the arc turns"),
         field("corners", &CurveOptions::corners, {3, 10000}, "", "of polygon and star"),
         field("inner", &CurveOptions::inner, {0, 0.999}, "", "inner radius of star and spiral, of the outer one"),
         field("turns", &CurveOptions::turns, {0.01, 1000}, "", "of the spiral"),
         field("tolerance", &CurveOptions::tolerance, {1e-4, 1000}, "px", "of what isn't made of cubics itself"),
         field("color", &CurveOptions::color, "of the line"),
         field("width", &CurveOptions::width, {0, 10000}, "px", "of the line"),
         field("fill", &CurveOptions::fill, "of the inside; auto: none"),
         field("dash", &CurveOptions::dash, {0, kFarthest}, "px", "dashes and gaps by turns; none: a solid line"),
         field("cap", &CurveOptions::cap, "how the line ends"),
         field("join", &CurveOptions::join, "how it turns at corners"),
         field("controls", &CurveOptions::controls, "shows the points, and the lines between them"),
         field("page", &CurveOptions::page, {0, kFarthest}, "px", "its size; auto: as large as what is drawn")},
        run_curve),
    {{"curve:controls=true draw", "A Bézier curve of four points, and its points."},
     {"curve:kind=bspline,points=20,40,100,10,190,60,160,160,60,150,closed=true,fill=gold,controls=true draw",
      "A closed B-spline."},
     {"curve:kind=star,corners=7,inner=0.5,fill=gold draw", "A star."}});

Drawing curve(const CurveOptions& options, const Run&) {
  kCurve.check(&options);
  Drawing drawing;
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 0, 0});
  const bool controls = options.controls && has_points(options.kind);
  if (controls) {
    drawing.add_path(polygon_of_controls(options), drawing.add_style(style_of_controls()), "controls", group);
  }
  drawing.add_path(curve_outline(options), drawing.add_style(style_of(options)), "curve", group);
  if (options.page) {
    drawing.width = options.page->x;
    drawing.height = options.page->y;
  } else {
    constexpr float kMargin = 8;
    fit_page(drawing, kMargin + 0.5F * options.width);
  }
  return drawing;
}

}  // namespace azulejo
