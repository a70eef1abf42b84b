#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/modelling/closed_surface.h"

namespace azulejo {

/// The cells of a grid that no triangle's box comes into, and a number that is the same all over such a cell; outside of
/// the grid it is 0.
class FreeCells {
 public:
  /// points   about as many as will be looked for: the grid has no more cells, and at most 2²¹
  /// number   of a point; asked once for cells in a row along x
  FreeCells(std::array<std::span<const SurfaceTriangle>, 2> triangles, std::size_t points,
            const std::function<int(const glm::vec3&)>& number, const Run& run);

  /// The number at a finite point; none where a triangle may be near.
  std::optional<int> find(const glm::vec3& point) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] < box_.lower[axis] || point[axis] > box_.upper[axis]) return 0;
    }
    const std::int32_t here = cells_[at(cell(point))];
    if (here == kBusy) return std::nullopt;
    return here;
  }

 private:
  static constexpr std::int32_t kBusy = std::numeric_limits<std::int32_t>::min();
  using Cell = std::array<std::uint32_t, 3>;
  /// Never falls as coordinates rise: what is between two points is in cells between theirs.
  Cell cell(const glm::vec3& point) const {
    Cell result;
    for (int axis = 0; axis < 3; ++axis) {
      const double place = (double{point[axis]} - box_.lower[axis]) * per_unit_[axis];
      result[static_cast<std::size_t>(axis)] = std::min(static_cast<std::uint32_t>(place), count_ - 1);
    }
    return result;
  }
  std::size_t at(const Cell& c) const { return (std::size_t{c[2]} * count_ + c[1]) * count_ + c[0]; }
  void choose_count(std::span<const Box3> boxes, std::size_t points);
  void set_count(std::uint32_t count);
  void number_row(std::uint32_t row, const std::function<int(const glm::vec3&)>& number);

  Box3 box_;
  glm::dvec3 per_unit_{0, 0, 0};
  std::uint32_t count_ = 1;  ///< along each axis
  std::vector<std::int32_t> cells_;
};

}  // namespace azulejo
