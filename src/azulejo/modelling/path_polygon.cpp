#include "azulejo/modelling/path_polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace azulejo {
namespace {

constexpr double kMostSteps = 4096;  // of a curve

/// Steps with which a curve stays within the tolerance of its chords: these are off by an eighth of the second
/// derivative at most, times the square of a step.
int steps_for(double second_derivative, double tolerance) {
  const double steps = std::ceil(std::sqrt(second_derivative / (8 * tolerance)));
  return static_cast<int>(steps >= 1 ? std::min(steps, kMostSteps) : 1);  // 1 also where it isn't a number
}

/// Walks along a path and gives each subpath as points.
class Flattener {
 public:
  using Take = std::function<void(std::span<const glm::vec2> points, bool closed)>;
  Flattener(const glm::mat3x2& matrix, double tolerance, const Take& take)
      : matrix_(matrix), tolerance_(tolerance), take_(take) {}

  void walk(const PathView& path) {
    const glm::vec2* next = path.points.data();
    for (const PathCommand command : path.commands) {
      switch (command) {
        case PathCommand::Move: begin(placed(next[0]), false); break;
        case PathCommand::Line: line(placed(next[0])); break;
        case PathCommand::Quadratic: quadratic(placed(next[0]), placed(next[1])); break;
        case PathCommand::Cubic: cubic(placed(next[0]), placed(next[1]), placed(next[2])); break;
        case PathCommand::Close: begin(start_, true); break;
      }
      next += points_of(command);
    }
    begin(start_, false);
  }

 private:
  glm::dvec2 placed(const glm::vec2& point) const {
    const glm::dmat3x2 m(matrix_);
    return m[0] * double{point.x} + m[1] * double{point.y} + m[2];
  }
  /// Gives away the subpath that ends here.
  void begin(const glm::dvec2& point, bool closed) {
    if (points_.size() > 1) take_(points_, closed);
    points_.clear();
    start_ = point;
    line(point);
  }
  void line(const glm::dvec2& point) {
    points_.emplace_back(point);
    at_ = point;
  }
  void quadratic(const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 a = at_;
    const int steps = steps_for(2 * glm::length(a - 2.0 * b + c), tolerance_);
    for (int i = 1; i < steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const double s = 1 - t;
      line(s * s * a + 2 * s * t * b + t * t * c);
    }
    line(c);
  }
  void cubic(const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const glm::dvec2 a = at_;
    const double bend = std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d));
    const int steps = steps_for(6 * bend, tolerance_);
    for (int i = 1; i < steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const double s = 1 - t;
      line(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
    }
    line(d);
  }

  glm::mat3x2 matrix_;
  double tolerance_;
  const Take& take_;
  std::vector<glm::vec2> points_;
  glm::dvec2 start_{0, 0};
  glm::dvec2 at_{0, 0};
};

}  // namespace

Polygon polygon_of(const PathView& path, const glm::mat3x2& page_from_path, double tolerance) {
  Polygon polygon;
  for_each_line(path, page_from_path, tolerance, [&](std::span<const glm::vec2> points, bool) {
    if (points.size() >= 3) polygon.add_ring(points);
  });
  return polygon;
}

void for_each_line(const PathView& path, const glm::mat3x2& page_from_path, double tolerance,
                   const std::function<void(std::span<const glm::vec2> points, bool closed)>& take) {
  Flattener(page_from_path, tolerance, take).walk(path);
}

Path path_of(const Polygon& polygon) {
  Path path;
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) {
    const auto ring = polygon.ring(r);
    for (std::size_t i = 0; i < ring.size(); ++i) i == 0 ? path.move_to(ring[i]) : path.line_to(ring[i]);
    path.close();
  }
  return path;
}

Polygon filled_area(const Drawing& drawing, double tolerance, const Run& run) {
  warn_of_unfilled(drawing, run);
  Polygon area;
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    const DrawingStyle& style = drawing.styles[path.style];
    if (!style.fill) continue;
    Polygon polygon = polygon_of(drawing.view(path), placed.page_from_path, tolerance);
    // Of one direction, so that paths don't take away from each other.
    polygon = simplified(polygon, style.fill_rule, run);
    for (std::size_t r = 0; r < polygon.ring_count(); ++r) area.add_ring(polygon.ring(r));
  }
  return area;
}

DrawingStyle style_of_lowest_fill(const Drawing& drawing) {
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingStyle& style = drawing.styles[drawing.paths[placed.path].style];
    if (style.fill) return style;
  }
  return {};
}

void warn_of_unfilled(const Drawing& drawing, const Run& run) {
  const bool strokes = std::any_of(drawing.styles.begin(), drawing.styles.end(),
                                   [](const DrawingStyle& style) { return style.stroke.has_value(); });
  if (strokes) warn(run, "drawing: lines are left out, only fills are taken");
  warn_of_clips(drawing, run);
}

void warn_of_clips(const Drawing& drawing, const Run& run) {
  const bool clips = std::any_of(drawing.groups.begin(), drawing.groups.end(),
                                 [](const DrawingGroup& group) { return group.clip.has_value(); });
  if (clips) warn(run, "drawing: clips are left out");
}

}  // namespace azulejo
