#include "azulejo/modelling/weld_vertices.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "azulejo/io/weld.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15;
  return hash ^ hash >> 29;
}

std::uint64_t cell_hash(const glm::dvec3& cell, std::uint32_t of_class) {
  std::uint64_t hash = mixed(0, of_class);
  for (int axis = 0; axis < 3; ++axis) hash = mixed(hash, std::bit_cast<std::uint64_t>(cell[axis] + 0.0));  // -0 to 0
  return hash ^ hash >> 32;
}

/// The positions that stay, by cells.
class Cells {
 public:
  explicit Cells(std::size_t count)
      : mask_(std::bit_ceil(count + count / 2 + 1) - 1), first_(mask_ + 1, kNone), next_(count) {}

  void add(std::uint64_t hash, std::uint32_t position) {
    std::uint32_t& first = first_[hash & mask_];
    next_[position] = first;
    first = position;
  }
  /// Calls f for each position of the cell, and maybe for some of others.
  template <class F>
  void visit(std::uint64_t hash, F f) const {
    for (std::uint32_t each = first_[hash & mask_]; each != kNone; each = next_[each]) f(each);
  }

 private:
  std::uint64_t mask_;
  Array<std::uint32_t> first_;
  Array<std::uint32_t> next_;
};

class Welder {
 public:
  Welder(std::span<const glm::vec3> positions, std::span<const std::uint32_t> classes, double tolerance)
      : positions_(positions), classes_(classes), tolerance_(tolerance), cells_(positions.size()) {}

  /// Those that stay are more than the tolerance apart: a cell of four of them holds few, and most queries meet one
  /// or two cells.
  void weld_near(Array<std::uint32_t>& first) {
    const double cell = 4 * tolerance_;
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (first[v] != v) continue;
      const glm::dvec3 at(positions_[v]);
      if (!std::isfinite(at.x + at.y + at.z)) continue;
      const glm::dvec3 low = glm::floor((at - tolerance_) / cell);
      const glm::dvec3 high = glm::floor((at + tolerance_) / cell);
      const std::uint32_t nearest = nearest_around(v, low, high);
      if (nearest == kNone) {
        cells_.add(cell_hash(glm::floor(at / cell), class_of(v)), v);
      } else {
        first[v] = nearest;
      }
    }
  }

  void weld_cells(Array<std::uint32_t>& first) {
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (first[v] != v || !std::isfinite(positions_[v].x + positions_[v].y + positions_[v].z)) continue;
      const glm::dvec3 cell = cell_of(v);
      const std::uint64_t hash = cell_hash(cell, class_of(v));
      std::uint32_t found = kNone;
      cells_.visit(hash, [&](std::uint32_t other) {
        if (class_of(other) == class_of(v) && cell_of(other) == cell) found = other;
      });
      if (found == kNone) {
        cells_.add(hash, v);
      } else {
        first[v] = found;
      }
    }
  }

 private:
  std::uint32_t class_of(std::uint32_t v) const { return classes_.empty() ? 0 : classes_[v]; }
  glm::dvec3 cell_of(std::uint32_t v) const { return glm::roundEven(glm::dvec3(positions_[v]) / tolerance_); }

  /// Of the cells between two corners, which are neighbors or the same along each axis.
  std::uint32_t nearest_around(std::uint32_t v, const glm::dvec3& low, const glm::dvec3& high) const {
    const glm::dvec3 at(positions_[v]);
    std::uint32_t nearest = kNone;
    double least = tolerance_ * tolerance_;
    for (int i = 0; i < 8; ++i) {
      glm::dvec3 cell = low;
      bool again = false;
      for (int axis = 0; axis < 3; ++axis) {
        if ((i >> axis & 1) == 0) continue;
        again = again || high[axis] == low[axis];
        cell[axis] = high[axis];
      }
      if (again) continue;
      cells_.visit(cell_hash(cell, class_of(v)), [&](std::uint32_t other) {
        if (class_of(other) != class_of(v)) return;
        const glm::dvec3 way = glm::dvec3(positions_[other]) - at;
        const double squared = glm::dot(way, way);
        if (squared < least || (squared == least && other < nearest)) {
          least = squared;
          nearest = other;
        }
      });
    }
    return nearest;
  }

  std::span<const glm::vec3> positions_;
  std::span<const std::uint32_t> classes_;
  double tolerance_;
  Cells cells_;
};

bool is_nan(const glm::vec3& p) { return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z); }

/// Of each, the first at the same place and of the same class.
Array<std::uint32_t> weld_equal(std::span<const glm::vec3> positions, std::span<const std::uint32_t> classes,
                                const Run& run) {
  const Welded welded = weld_exactly(positions, run);
  Array<std::uint32_t> first_at(welded.positions.size(), kNone);
  Array<std::uint32_t> first(positions.size());
  if (classes.empty()) {
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      std::uint32_t& earlier = first_at[welded.corners[v]];
      if (earlier == kNone) earlier = v;
      first[v] = earlier;
    }
    return first;
  }
  Cells cells(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    first[v] = v;
    if (is_nan(positions[v])) continue;
    const std::uint64_t hash = mixed(mixed(0, welded.corners[v]), classes[v]);
    cells.visit(hash, [&](std::uint32_t other) {
      if (welded.corners[other] == welded.corners[v] && classes[other] == classes[v]) first[v] = other;
    });
    if (first[v] == v) cells.add(hash, v);
  }
  return first;
}

}  // namespace

Array<std::uint32_t> weld_vertices(std::span<const glm::vec3> positions, std::span<const std::uint32_t> classes,
                                   WeldMethod method, double tolerance, const Run& run) {
  Array<std::uint32_t> first = weld_equal(positions, classes, run);
  if (!(tolerance > 0)) return first;
  Welder welder(positions, classes, tolerance);
  if (method == WeldMethod::Grid) {
    welder.weld_cells(first);
  } else {
    welder.weld_near(first);
  }
  // What was equal to a vertex goes where that one went.
  for (std::uint32_t v = 0; v < positions.size(); ++v) first[v] = first[first[v]];
  return first;
}

}  // namespace azulejo
