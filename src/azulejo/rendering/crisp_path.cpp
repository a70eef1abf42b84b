#include "azulejo/rendering/crisp_path.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <span>

#include "azulejo/modelling/flatten_path.h"
#include "azulejo/rendering/dash.h"

namespace azulejo {
namespace {

constexpr double kFarthest = 268435456;  // 2²⁸

glm::ivec2 pixel_of(const glm::dvec2& point) {
  return {static_cast<int>(std::floor(point.x)), static_cast<int>(std::floor(point.y))};
}

bool is_near(const glm::vec2& point) { return std::max(std::abs(point.x), std::abs(point.y)) < kFarthest; }

/// The part of a segment that is not too far away.
bool shorten(glm::dvec2& from, glm::dvec2& to) {
  const glm::dvec2 origin = from;
  const glm::dvec2 along = to - from;
  double begin = 0;
  double end = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) {
      if (std::abs(origin[axis]) >= kFarthest) return false;
      continue;
    }
    const double a = (-kFarthest - origin[axis]) / along[axis];
    const double b = (kFarthest - origin[axis]) / along[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(begin <= end)) return false;
  const glm::dvec2 limit(kFarthest - 1);
  from = glm::clamp(origin + begin * along, -limit, limit);
  to = glm::clamp(origin + end * along, -limit, limit);
  return true;
}

class CrispPen {
 public:
  CrispPen(const DashPattern* pattern, const Rect& window, Array<CrispLine>& result)
      : window_(window), result_(result) {
    if (pattern != nullptr) dash_.emplace(*pattern);
  }

  void contour(std::span<const glm::vec2> points, bool closed) {
    if (dash_) dash_->restart();
    const std::size_t segments = points.size() - (closed ? 0 : 1);
    const std::size_t before = drawn_;
    for (std::size_t i = 0; i < segments; ++i) {
      segment(points[i], points[i + 1 == points.size() ? 0 : i + 1], i + 1 == segments && !closed);
    }
    if (drawn_ == before && is_near(points[0])) line(pixel_of(points[0]), pixel_of(points[0]), true);
  }

 private:
  void segment(const glm::dvec2& from, const glm::dvec2& to, bool with_end) {
    if (is_near(from) && is_near(to)) return line(pixel_of(from), pixel_of(to), with_end);
    const glm::dvec2 limit(1e12);
    glm::dvec2 begin = glm::clamp(from, -limit, limit);
    glm::dvec2 end = glm::clamp(to, -limit, limit);
    if (shorten(begin, end)) line(pixel_of(begin), pixel_of(end), with_end);
  }

  void line(const glm::ivec2& from, const glm::ivec2& to, bool with_end) {
    const int steps = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
    const int count = steps + (with_end ? 1 : 0);
    if (count == 0) return;
    ++drawn_;
    CrispLine whole{from.x, from.y, to.x, to.y, 0, count - 1};
    if (clip(whole, window_)) dash_ ? dashes(whole) : result_.push_back(whole);
    if (dash_) dash_->skip(steps);
  }

  void dashes(const CrispLine& line) {
    DashPosition dash = *dash_;
    dash.skip(line.first + 0.5);
    CrispLine part = line;
    while (part.first <= line.last) {
      if (dash.left() <= 0) {
        dash.turn();
        continue;
      }
      const double rest = line.last - part.first + 1;
      const auto count = static_cast<std::int32_t>(std::min(std::ceil(dash.left()), rest));
      part.last = part.first + count - 1;
      if (dash.on()) result_.push_back(part);
      part.first += count;
      dash.skip(count);
    }
  }

  Rect window_;
  Array<CrispLine>& result_;
  std::optional<DashPosition> dash_;
  std::size_t drawn_ = 0;
};

}  // namespace

void crisp_path(const PathView& path, const DrawingStyle& style, const glm::mat3x2& picture_from_path,
                const CrispOptions& options, FlatPath& scratch, Array<CrispLine>& result) {
  const glm::vec2 x = picture_from_path[0];
  const glm::vec2 y = picture_from_path[1];
  const float scale = style.fixed_stroke ? 1 : std::sqrt(std::abs(x.x * y.y - x.y * y.x));
  const std::optional<DashPattern> pattern = DashPattern::of(style, scale);
  scratch.clear();
  const Box2 seen{{static_cast<float>(options.window.x), static_cast<float>(options.window.y)},
                  {static_cast<float>(options.window.right()), static_cast<float>(options.window.bottom())}};
  flatten_path(path, picture_from_path, {options.tolerance, seen}, scratch);
  CrispPen pen(pattern ? &*pattern : nullptr, options.window, result);
  for (std::size_t c = 0; c < scratch.contour_count(); ++c) pen.contour(scratch.contour(c), scratch.closed[c] != 0);
}

}  // namespace azulejo
