#include "azulejo/modelling/clip_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/flatten_path.h"
#include "azulejo/modelling/path_polygon.h"
#include "azulejo/modelling/window_clipping.h"

namespace azulejo {
namespace {

Box2 window_of(const Drawing& drawing, const ClipOptions& options) {
  const glm::vec4 window = options.window.value_or(glm::vec4(0, 0, drawing.width, drawing.height));
  if (options.window && !(window.x < window.z && window.y < window.w)) {
    throw Error(Error::Argument, fmt::format("window is {},{},{},{}, expected left < right and top < bottom", window.x,
                                             window.y, window.z, window.w));
  }
  return {{window.x, window.y}, {window.z, window.w}};
}

/// Lines in the window as paths: a new one wherever a line leaves it.
class LineClipper {
 public:
  LineClipper(const Box2& window, const DrawingStyle& style, const std::string& id, Drawing& result)
      : window_(window), style_(style), id_(id), result_(result) {}

  void add(std::span<const glm::vec2> points, bool closed) {
    double along = 0;
    const std::size_t count = points.size();
    for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
      const LineSegment2 segment{points[i], points[i + 1 == count ? 0 : i + 1]};
      const std::optional<LineSegment2> part = clip(segment, window_);
      if (!part) {
        finish();
      } else {
        if (path_.points.empty() || path_.points.back() != part->from) {
          finish();
          begins_ = along + glm::length(glm::dvec2(part->from) - glm::dvec2(segment.from));
          path_.move_to(part->from);
        }
        path_.line_to(part->to);
        whole_ = whole_ && *part == segment;
      }
      whole_ = whole_ && part.has_value();
      along += glm::length(glm::dvec2(segment.to) - glm::dvec2(segment.from));
    }
    if (closed && whole_ && count > 1) {  // its last line is the closing one
      path_.commands.back() = PathCommand::Close;
      path_.points.pop_back();
    }
    finish();
    whole_ = true;
  }

 private:
  void finish() {
    if (path_.commands.size() > 1) {
      DrawingStyle style = style_;
      if (!style.dash.empty()) style.dash_offset += static_cast<float>(begins_);
      result_.add_path(path_, result_.add_style(style), id_);
    }
    path_ = Path();
  }

  Box2 window_;
  const DrawingStyle& style_;
  const std::string& id_;
  Drawing& result_;
  Path path_;
  double begins_ = 0;
  bool whole_ = true;
};

DrawingStyle line_style(const DrawingStyle& style, const glm::mat3x2& matrix) {
  DrawingStyle line = style;
  line.fill.reset();
  line.points.reset();
  if (style.fixed_stroke) return line;
  const float scale = std::sqrt(std::abs(matrix[0].x * matrix[1].y - matrix[0].y * matrix[1].x));
  const auto scaled = [&](float length) { return std::isfinite(length * scale) ? length * scale : 0.0F; };
  line.stroke_width = scaled(line.stroke_width);
  line.dash_offset = scaled(line.dash_offset);
  for (float& each : line.dash) each = scaled(each);
  return line;
}

std::vector<Value> run_clip(std::span<const Value> inputs, const ClipOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(clip(*inputs[0].drawing(), options, run));
  return results;
}

}  // namespace

extern const Operation kClip = with_examples(
    value_operation<ClipOptions>(
        "clip", "Keeps what of a drawing is in a window.", {{"source", "the drawing", ValueKind::Drawing}},
        {{"drawing", "what is in the window", ValueKind::Drawing}},
        {field("window", &ClipOptions::window, {-1e30, 1e30}, "", "left, top, right, bottom; auto: the page"),
         field("tolerance", &ClipOptions::tolerance, {1e-6, 1e6}, "", "how far lines may be from curves")},
        run_clip),
    {{"star.svg clip:window=40,100,200,190 draw", "A part of the page: the tips are cut off."}});

Drawing clip(const Drawing& drawing, const ClipOptions& options, const Run& run) {
  kClip.check(&options);
  const Box2 window = window_of(drawing, options);
  warn_of_clips(drawing, run);
  Drawing result;
  result.width = drawing.width;
  result.height = drawing.height;
  result.unit = drawing.unit;
  result.patterns = drawing.patterns;
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    const DrawingStyle style = placed_style(drawing, placed, result);
    if (style.fill) {
      const Polygon polygon = polygon_of(drawing.view(path), placed.page_from_path, options.tolerance);
      const Polygon kept = simplified(clip(polygon, window), style.fill_rule, run);
      DrawingStyle fill = style;
      fill.stroke.reset();
      fill.points.reset();
      if (kept.ring_count() > 0) result.add_path(path_of(kept), result.add_style(fill), path.id);
    }
    if (style.stroke) {
      const DrawingStyle line = line_style(style, placed.page_from_path);
      LineClipper clipper(window, line, path.id, result);
      FlatPath flat;
      flatten_path(drawing.view(path), placed.page_from_path, {.tolerance = options.tolerance}, flat);
      for (std::size_t c = 0; c < flat.contour_count(); ++c) clipper.add(flat.contour(c), flat.closed[c] != 0);
    }
  }
  return result;
}

}  // namespace azulejo
