#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/modelling/collinear.h"
#include "azulejo/modelling/ear_clipping.h"
#include "azulejo/modelling/hole_patch.h"

namespace azulejo {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr std::size_t kWhole = 64;  ///< edges of a loop that is looked at as a whole: its cost is cubic

/// What is to be least: the first that differs decides.
struct Cost {
  std::uint32_t joined = 0;  ///< edges that there are already
  std::uint32_t flat = 0;    ///< triangles on a line
  double bend = 0;           ///< largest 1 − cosine between neighbors
  double area = 0;

  friend bool operator<(const Cost& a, const Cost& b) {
    return std::tie(a.joined, a.flat, a.bend, a.area) < std::tie(b.joined, b.flat, b.bend, b.area);
  }
};

/// The best triangulation of a loop, by the best ones of its parts.
class LoopTriangulator {
 public:
  LoopTriangulator(const HoleRim& rim, std::vector<std::uint32_t> loop) : rim_(rim), loop_(std::move(loop)) {}

  /// Of the edge that closes the loop and of the others: the normal beyond; 0: not known.
  void triangulate(const std::vector<glm::dvec3>& beyond, Triangles& out) {
    const std::size_t n = loop_.size();
    costs_.assign(n * n, {});
    middles_.assign(n * n, 0);
    normals_.assign(n * n, glm::dvec3(0));
    for (std::size_t i = 0; i + 1 < n; ++i) normals_[i * n + i + 1] = beyond[i];
    for (std::size_t span = 2; span < n; ++span) {
      for (std::size_t i = 0; i + span < n; ++i) look(i, i + span, span + 1 == n ? beyond[n - 1] : glm::dvec3(0));
    }
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, n - 1}};
    while (!parts.empty()) {
      const auto [i, k] = parts.back();
      parts.pop_back();
      if (k < i + 2) continue;
      const std::size_t m = middles_[i * n + k];
      out.push_back({loop_[i], loop_[m], loop_[k]});
      parts.emplace_back(i, m);
      parts.emplace_back(m, k);
    }
  }

 private:
  static double bend(const glm::dvec3& a, const glm::dvec3& b) {
    return a == glm::dvec3(0) || b == glm::dvec3(0) ? 0 : 1 - glm::dot(a, b);
  }
  bool is_rim(std::size_t i, std::size_t k) const {
    const auto n = static_cast<std::uint32_t>(rim_.size());
    return loop_[k] == (loop_[i] + 1) % n || loop_[i] == (loop_[k] + 1) % n;
  }

  void look(std::size_t i, std::size_t k, const glm::dvec3& across) {
    const std::size_t n = loop_.size();
    Cost best{std::numeric_limits<std::uint32_t>::max(), 0, 0, 0};
    const glm::dvec3 a = rim_.points[loop_[i]];
    const glm::dvec3 c = rim_.points[loop_[k]];
    const bool joined = !(i == 0 && k + 1 == n) && !is_rim(i, k) && rim_.joined(loop_[i], loop_[k]);
    for (std::size_t m = i + 1; m < k; ++m) {
      const Cost& left = costs_[i * n + m];
      const Cost& right = costs_[m * n + k];
      Cost cost{left.joined + right.joined + (joined ? 1U : 0U), left.flat + right.flat, 0, 0};
      if (cost.joined > best.joined) continue;
      const glm::dvec3 twice = glm::cross(rim_.points[loop_[m]] - a, c - a);
      const double length = glm::length(twice);
      const double longest =
          std::max(glm::dot(c - a, c - a), glm::dot(rim_.points[loop_[m]] - a, rim_.points[loop_[m]] - a));
      const bool flat = !(length > 1e-9 * longest);
      cost.flat += flat ? 1U : 0U;
      const glm::dvec3 normal = flat ? glm::dvec3(0) : twice / length;
      cost.bend = std::max({left.bend, right.bend, bend(normal, normals_[i * n + m]), bend(normal, normals_[m * n + k]),
                            bend(normal, across)});
      cost.area = left.area + right.area + 0.5 * length;
      if (!(cost < best)) continue;
      best = cost;
      middles_[i * n + k] = m;
      normals_[i * n + k] = normal;
    }
    costs_[i * n + k] = best;
  }

  const HoleRim& rim_;
  std::vector<std::uint32_t> loop_;
  std::vector<Cost> costs_;
  std::vector<std::size_t> middles_;
  std::vector<glm::dvec3> normals_;  ///< of the triangle at each edge
};

/// Newell's: twice the area.
glm::dvec3 normal_of(const HoleRim& rim) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin = rim.points[0];
  for (std::size_t i = 0; i < rim.size(); ++i) {
    sum += glm::cross(rim.points[i] - origin, rim.points[(i + 1) % rim.size()] - origin);
  }
  return sum;
}

/// By its ears, seen along its normal; false if triangles would overlap there.
bool triangulate_flat(const HoleRim& rim, Triangles& out) {
  const glm::dvec3 normal = normal_of(rim);
  const double length = glm::length(normal);
  if (!(length > 0)) return false;
  const glm::dvec3 axis = normal / length;
  const glm::dvec3 size = glm::abs(axis);
  glm::dvec3 aside(0);
  aside[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
  const glm::dvec3 across = glm::normalize(glm::cross(aside, axis));
  const glm::dvec3 up = glm::cross(axis, across);
  std::vector<PlanePoint> points;
  for (const glm::dvec3& p : rim.points) {
    points.push_back({glm::dot(p - rim.points[0], across), glm::dot(p - rim.points[0], up)});
  }
  Triangles found(rim.size() - 2);
  EarClipping().cut(points, found.front().data());
  const bool sound = std::all_of(found.begin(), found.end(), [&](const auto& t) {
    return orient2d({points[t[0]].u, points[t[0]].v}, {points[t[1]].u, points[t[1]].v},
                    {points[t[2]].u, points[t[2]].v}) >= 0;
  });
  if (sound) out.insert(out.end(), found.begin(), found.end());
  return sound;
}

/// A loop of points spread over a longer one, then what is between each two of them, and so on.
void triangulate_pieces(const HoleRim& rim, Triangles& out) {
  struct Piece {
    std::vector<std::uint32_t> loop;
    glm::dvec3 beyond;  ///< across the edge that closes it
  };
  std::vector<std::uint32_t> all(rim.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<Piece> waiting{{all, rim.normals.back()}};
  while (!waiting.empty()) {
    const Piece piece = std::move(waiting.back());
    waiting.pop_back();
    const std::size_t n = piece.loop.size();
    const std::size_t picks = std::min(n, kWhole);
    std::vector<std::uint32_t> coarse;
    std::vector<glm::dvec3> beyond(picks, glm::dvec3(0));
    for (std::size_t i = 0; i < picks; ++i) {
      const std::size_t begin = i * (n - 1) / (picks - 1);
      coarse.push_back(piece.loop[begin]);
      if (i + 1 == picks) break;
      const std::size_t end = (i + 1) * (n - 1) / (picks - 1);
      if (end == begin + 1) {
        beyond[i] =
            (piece.loop[begin] + 1) % rim.size() == piece.loop[end] ? rim.normals[piece.loop[begin]] : glm::dvec3(0);
        continue;
      }
      const auto from = piece.loop.begin();
      waiting.push_back(
          {{from + static_cast<std::ptrdiff_t>(begin), from + static_cast<std::ptrdiff_t>(end) + 1}, glm::dvec3(0)});
    }
    beyond.back() = piece.beyond;
    LoopTriangulator(rim, std::move(coarse)).triangulate(beyond, out);
  }
}

/// Edges between points of the rim that there are already get a point in their middle.
void part_joined_edges(const HoleRim& rim, HolePatch& patch) {
  const auto n = static_cast<std::uint32_t>(rim.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) -> std::uint32_t {
    if (a >= n || b >= n || (a + 1) % n == b || (b + 1) % n == a || !rim.joined(a, b)) return 0;
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), n + static_cast<std::uint32_t>(patch.points.size()));
    if (is_new) {
      patch.points.push_back(0.5 * (rim.points[a] + rim.points[b]));
      patch.parents.push_back({a, b, a});
    }
    return at->second;
  };
  Triangles parted;
  for (const auto& t : patch.triangles) {
    std::vector<std::uint32_t> polygon;
    std::size_t first = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      polygon.push_back(t[i]);
      if (const std::uint32_t m = middle(t[i], t[(i + 1) % 3]); m != 0) {
        first = polygon.size();
        polygon.push_back(m);
      }
    }
    const std::size_t count = polygon.size();
    for (std::size_t i = 1; i + 1 < count; ++i) {
      parted.push_back({polygon[first], polygon[(first + i) % count], polygon[(first + i + 1) % count]});
    }
  }
  patch.triangles = std::move(parted);
}

}  // namespace

HolePatch triangulate_hole(const HoleRim& rim) {
  HolePatch patch;
  if (rim.size() <= kWhole) {
    std::vector<std::uint32_t> loop(rim.size());
    for (std::uint32_t i = 0; i < loop.size(); ++i) loop[i] = i;
    LoopTriangulator(rim, std::move(loop)).triangulate(rim.normals, patch.triangles);
  } else if (!triangulate_flat(rim, patch.triangles)) {
    triangulate_pieces(rim, patch.triangles);
  }
  part_joined_edges(rim, patch);
  return patch;
}

}  // namespace azulejo
