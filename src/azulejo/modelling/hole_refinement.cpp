#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/modelling/hole_patch.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr int kPasses = 24;          ///< a pass divides a triangle in three
constexpr double kDensity = 1.4142;  ///< Liepa's: larger gives more points
constexpr std::size_t kFlips = 16;   ///< of an edge and pass, on average, before it is good enough

std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// Triangles that know their neighbors.
class Refiner {
 public:
  Refiner(const HoleRim& rim, HolePatch& patch, std::size_t most_points)
      : rim_(rim), patch_(patch), most_points_(most_points), scale_(rim.scale) {
    for (const auto& parents : patch.parents) scale_.push_back(mean_scale(parents));
    link();
    limit_scale();
  }

  void refine() {
    relax_all();
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::size_t before = patch_.points.size();
      const std::size_t count = patch_.triangles.size();
      for (std::uint32_t t = 0; t < count && patch_.points.size() < most_points_; ++t) {
        if (is_coarse(t)) divide(t);
      }
      relax_all();
      if (patch_.points.size() == before) break;
    }
  }

 private:
  const glm::dvec3& at(std::uint32_t v) const {
    return v < rim_.size() ? rim_.points[v] : patch_.points[v - rim_.size()];
  }
  double mean_scale(const std::array<std::uint32_t, 3>& t) const {
    return (scale_[t[0]] + scale_[t[1]] + scale_[t[2]]) / 3;
  }

  void link() {
    struct Side {
      std::uint64_t edge;
      std::uint32_t triangle;
      std::uint32_t side;
    };
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        sides.push_back({key(patch_.triangles[t][i], patch_.triangles[t][(i + 1) % 3]), t, i});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
    });
    beyond_.assign(patch_.triangles.size(), {kNone, kNone, kNone});
    for (std::size_t i = 0; i < sides.size(); ++i) {
      edges_.insert(sides[i].edge);
      if (i + 1 == sides.size() || sides[i + 1].edge != sides[i].edge) continue;
      beyond_[sides[i].triangle][sides[i].side] = sides[i + 1].triangle;
      beyond_[sides[i + 1].triangle][sides[i + 1].side] = sides[i].triangle;
      ++i;
    }
  }

  /// Where the density of the rim would take too many points, triangles grow inwards.
  void limit_scale() {
    double area = 0;
    for (const auto& t : patch_.triangles)
      area += 0.5 * glm::length(glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])));
    double mean = 0;
    for (std::size_t i = 0; i < rim_.size(); ++i) mean += rim_.scale[i];
    mean /= static_cast<double>(rim_.size());
    // A point takes the area of two triangles with edges of this length.
    const double wanted = mean > 0 ? area / (0.866 * mean * mean) : 0;
    const double room = static_cast<double>(most_points_) / 2;
    if (wanted > room) {
      growth_ = 1.3;
      most_scale_ = mean * std::sqrt(wanted / std::max(room, 1.0));
    }
  }

  bool is_coarse(std::uint32_t t) const {
    const auto& v = patch_.triangles[t];
    const glm::dvec3 middle = (at(v[0]) + at(v[1]) + at(v[2])) / 3.0;
    const double scale = mean_scale(v);
    if (!(scale > 0)) return false;
    return std::all_of(v.begin(), v.end(), [&](std::uint32_t each) {
      const double reach = kDensity * glm::distance(at(each), middle);
      return reach > scale && reach > scale_[each];
    });
  }

  std::uint32_t side_towards(std::uint32_t t, std::uint32_t neighbor) const {
    const auto& sides = beyond_[t];
    return static_cast<std::uint32_t>(std::find(sides.begin(), sides.end(), neighbor) - sides.begin());
  }
  void relink(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    if (t != kNone) beyond_[t][side_towards(t, from)] = to;
  }

  void divide(std::uint32_t t) {
    const auto v = patch_.triangles[t];
    const auto sides = beyond_[t];
    const auto middle = static_cast<std::uint32_t>(rim_.size() + patch_.points.size());
    patch_.points.push_back((at(v[0]) + at(v[1]) + at(v[2])) / 3.0);
    patch_.parents.push_back(v);
    const double scale = mean_scale(v);
    scale_.push_back(growth_ > 1 ? std::max(scale, std::min(growth_ * scale, most_scale_)) : scale);
    const auto second = static_cast<std::uint32_t>(patch_.triangles.size());
    const std::uint32_t third = second + 1;
    patch_.triangles[t] = {v[0], v[1], middle};
    patch_.triangles.push_back({v[1], v[2], middle});
    patch_.triangles.push_back({v[2], v[0], middle});
    beyond_[t] = {sides[0], second, third};
    beyond_.push_back({sides[1], third, t});
    beyond_.push_back({sides[2], t, second});
    relink(sides[1], t, second);
    relink(sides[2], t, third);
    for (const std::uint32_t each : v) edges_.insert(key(each, middle));
    for (std::uint32_t each : {t, second, third}) waiting_.push_back(each);
  }

  /// The cotangent of the angle at c over the edge from a to b.
  double cotangent(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const glm::dvec3 p = at(a) - at(c);
    const glm::dvec3 q = at(b) - at(c);
    const double across = glm::length(glm::cross(p, q));
    return glm::dot(p, q) / std::max(across, 1e-12 * (glm::dot(p, p) + glm::dot(q, q)));
  }

  /// Flips the edge of a triangle, if its opposite angles are more than π together and there is no such edge yet.
  bool flip(std::uint32_t t, std::uint32_t side) {
    const std::uint32_t u = beyond_[t][side];
    if (u == kNone || u == t) return false;
    const std::uint32_t a = patch_.triangles[t][side];
    const std::uint32_t b = patch_.triangles[t][(side + 1) % 3];
    const std::uint32_t c = patch_.triangles[t][(side + 2) % 3];
    const std::uint32_t other = side_towards(u, t);
    const std::uint32_t d = patch_.triangles[u][(other + 2) % 3];
    if (!(cotangent(a, b, c) + cotangent(a, b, d) < -1e-9) || c == d) return false;
    if (edges_.count(key(c, d)) != 0) return false;
    if (c < rim_.size() && d < rim_.size() && rim_.joined(c, d)) return false;
    const std::uint32_t beyond_bc = beyond_[t][(side + 1) % 3];
    const std::uint32_t beyond_ca = beyond_[t][(side + 2) % 3];
    const std::uint32_t beyond_ad = beyond_[u][(other + 1) % 3];
    const std::uint32_t beyond_db = beyond_[u][(other + 2) % 3];
    relink(beyond_bc, t, u);
    relink(beyond_ad, u, t);
    patch_.triangles[t] = {c, a, d};
    beyond_[t] = {beyond_ca, beyond_ad, u};
    patch_.triangles[u] = {d, b, c};
    beyond_[u] = {beyond_db, beyond_bc, t};
    edges_.erase(key(a, b));
    edges_.insert(key(c, d));
    waiting_.push_back(t);
    waiting_.push_back(u);
    return true;
  }

  void relax_all() {
    if (waiting_.empty()) {
      for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t) waiting_.push_back(t);
    }
    std::size_t left = kFlips * patch_.triangles.size();
    while (!waiting_.empty() && left > 0) {
      const std::uint32_t t = waiting_.back();
      waiting_.pop_back();
      for (std::uint32_t side = 0; side < 3; ++side) {
        if (!flip(t, side)) continue;
        --left;
        break;
      }
    }
    waiting_.clear();
  }

  const HoleRim& rim_;
  HolePatch& patch_;
  std::size_t most_points_;
  std::vector<double> scale_;
  double growth_ = 1;
  double most_scale_ = 0;
  std::vector<std::array<std::uint32_t, 3>> beyond_;  ///< the neighbors across the edge from each corner to the next
  std::unordered_set<std::uint64_t> edges_;
  std::vector<std::uint32_t> waiting_;
};

}  // namespace

void refine_patch(const HoleRim& rim, HolePatch& patch, std::size_t most_points) {
  Refiner(rim, patch, most_points).refine();
}

}  // namespace azulejo
