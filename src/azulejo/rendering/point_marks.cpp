#include "azulejo/rendering/point_marks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "azulejo/math/turns.h"
#include "azulejo/modelling/curve_points.h"
#include "azulejo/modelling/path_segments.h"

namespace azulejo {
namespace {

/// Around (0, 0).
std::vector<glm::vec2> outline_of(PointShape shape, float radius, float tolerance) {
  constexpr float kBar = 0.25F;
  const float bar = kBar * radius;
  std::vector<glm::vec2> points;
  switch (shape) {
    case PointShape::Circle: {
      // Sides leave the circle by radius · (1 − cos(π / sides)), at most radius · 5 / sides².
      const float sides = std::sqrt(5 * radius / tolerance);
      const int count = std::clamp(static_cast<int>(std::ceil(std::min(sides, 1000.0F))), 12, 1000);
      for (int i = 0; i < count; ++i) {
        const Turn turn = turn_of(i, count);
        points.push_back(glm::dvec2(turn.cosine, turn.sine) * static_cast<double>(radius));
      }
      break;
    }
    case PointShape::Square:
      points = {{-radius, -radius}, {radius, -radius}, {radius, radius}, {-radius, radius}};
      break;
    case PointShape::Diamond: points = {{0, -radius}, {radius, 0}, {0, radius}, {-radius, 0}}; break;
    case PointShape::Triangle: points = {{0, -radius}, {radius, radius}, {-radius, radius}}; break;
    case PointShape::Plus:
    case PointShape::Cross:
      points = {{bar, -radius}, {bar, -bar}, {radius, -bar}, {radius, bar}, {bar, bar}, {bar, radius}};
      for (std::size_t i = 0; i < 6; ++i) points.push_back(-points[i]);
      if (shape == PointShape::Cross) {
        // Turned, its corners are (radius + bar) / √2 from the middle.
        for (glm::vec2& point : points)
          point = glm::vec2(point.x - point.y, point.x + point.y) * (radius / (radius + bar));
      }
      break;
  }
  return points;
}

class Marker {
 public:
  Marker(std::vector<glm::vec2> outline, float radius, const Box2& window, FlatPath& result)
      : outline_(std::move(outline)), seen_{window.lower - radius, window.upper + radius}, result_(result) {}

  void begin(const glm::vec2& point, bool /*closes*/) {
    mark(point);
    start_ = point;
    points_ = 1;
  }
  void lines(const glm::vec2* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) mark(points[i]);
    points_ += count;
    last_ = points[count - 1];
  }
  void curve(const CurveSegment& curve) { lines(&curve.points[curve.order], 1); }
  void end(bool closed) {
    // The point where it closes is marked at its beginning.
    if (closed && points_ > 1 && last_ == start_ && meets(seen_, last_, last_)) drop();
  }

 private:
  void mark(const glm::vec2& point) {
    if (!meets(seen_, point, point)) return;
    result_.begin();
    result_.closed.back() = 1;
    result_.summed.back() = 1;
    for (const glm::vec2& each : outline_) result_.points.push_back(point + each);
  }
  void drop() {
    result_.points.resize(result_.starts.back());
    result_.starts.pop_back();
    result_.closed.pop_back();
    result_.summed.pop_back();
  }

  std::vector<glm::vec2> outline_;
  Box2 seen_;
  FlatPath& result_;
  glm::vec2 start_{0};
  glm::vec2 last_{0};
  std::size_t points_ = 0;
};

}  // namespace

void point_marks(const PathView& path, const DrawingStyle& style, const glm::mat3x2& picture_from_path, float tolerance,
                 const Box2& window, FlatPath& result) {
  const float radius = 0.5F * style.point_size;
  if (!(radius > 0)) return;
  Marker marker(outline_of(style.point_shape, radius, tolerance), radius, window, result);
  walk_segments(path, picture_from_path, marker);
}

}  // namespace azulejo
