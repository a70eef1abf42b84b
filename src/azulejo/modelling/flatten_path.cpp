#include "azulejo/modelling/flatten_path.h"

#include <glm/common.hpp>

#include "azulejo/modelling/curve_points.h"
#include "azulejo/modelling/path_segments.h"

namespace azulejo {
namespace {

class Flattener {
 public:
  Flattener(const FlattenOptions& options, FlatPath& result) : options_(options), result_(result) {}

  void begin(const glm::vec2& point, bool /*closes*/) {
    result_.begin();
    result_.points.push_back(point);
  }

  void lines(const glm::vec2* points, std::size_t count) {
    result_.points.insert(result_.points.end(), points, points + count);
  }

  void curve(const CurveSegment& curve) {
    const int pieces = is_seen(curve, options_.window) ? pieces_of_curve(curve, options_.tolerance) : 1;
    const CurvePolynomial polynomial(curve);
    const std::size_t first = result_.points.size();
    result_.points.resize(first + static_cast<std::size_t>(pieces));
    glm::vec2* const points = result_.points.data() + first;
    const float step = 1.0F / static_cast<float>(pieces);
    for (int i = 1; i < pieces; ++i) points[i - 1] = polynomial.at(static_cast<float>(i) * step);
    points[pieces - 1] = curve.points[curve.order];
  }

  void end(bool closed) {
    if (!closed) return;
    result_.closed.back() = 1;
    // Closing says it: the first point isn't said twice.
    if (result_.points.size() > result_.starts.back() + 1) result_.points.pop_back();
  }

 private:
  const FlattenOptions& options_;
  FlatPath& result_;
};

}  // namespace

void flatten_path(const PathView& path, const glm::mat3x2& picture_from_path, const FlattenOptions& options,
                  FlatPath& result) {
  Flattener flattener(options, result);
  walk_segments(path, picture_from_path, flattener);
}

}  // namespace azulejo
