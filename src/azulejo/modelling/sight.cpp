#include "azulejo/modelling/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace azulejo {
namespace {

/// Those whose middles lie in the box around a triangle.
struct Cells {
  int column0 = 0;
  int column1 = -1;
  int row0 = 0;
  int row1 = -1;

  Cells(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto [x0, x1] = std::minmax({a.x, b.x, c.x});
    const auto [y0, y1] = std::minmax({a.y, b.y, c.y});
    constexpr int kLast = Sight::kCells - 1;
    if (!(x0 > -1 && y0 > -1 && x1 <= kLast + 2 && y1 <= kLast + 2)) return;  // NaN too
    column0 = std::max(0, static_cast<int>(std::ceil(x0 - 0.5F)));
    column1 = std::min(kLast, static_cast<int>(std::floor(x1 - 0.5F)));
    row0 = std::max(0, static_cast<int>(std::ceil(y0 - 0.5F)));
    row1 = std::min(kLast, static_cast<int>(std::floor(y1 - 0.5F)));
  }
  std::size_t count() const {
    return column1 < column0 || row1 < row0
               ? 0
               : static_cast<std::size_t>(column1 - column0 + 1) * static_cast<std::size_t>(row1 - row0 + 1);
  }
};

}  // namespace

SightAxes sight_axes(const glm::dvec3& to_eye, const glm::dvec3& up) {
  SightAxes axes;
  axes.to_eye = to_eye;
  const glm::dvec3 other = std::abs(up.x) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const bool above = glm::length(glm::cross(up, to_eye)) < 0.1;
  axes.right = glm::normalize(above ? other - glm::dot(other, to_eye) * to_eye : glm::cross(up, to_eye));
  axes.up = glm::cross(to_eye, axes.right);
  return axes;
}

std::vector<glm::dvec3> sight_directions(const glm::dvec3& front, const glm::dvec3& up) {
  const glm::dvec3 right = glm::cross(up, front);
  // Cosine and sine of 20°, then of 30°.
  std::vector<glm::dvec3> directions{0.93969262078590838 * (0.86602540378443865 * front + 0.5 * right) +
                                     0.34202014332566873 * up};
  constexpr int kHalf[13][3] = {{0, 0, 1}, {1, 0, 0},  {0, 1, 0}, {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1},
                                {1, 1, 0}, {1, -1, 0}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
  for (const auto& [x, y, z] : kHalf) {
    const glm::dvec3 direction =
        glm::normalize(static_cast<double>(x) * right + static_cast<double>(y) * up + static_cast<double>(z) * front);
    directions.push_back(direction);
    directions.push_back(-direction);
  }
  return directions;
}

Sight::Sight(const glm::dvec3& center, double radius, const SightAxes& axes)
    : center_(center),
      cells_per_unit_(kCells / (2 * radius)),
      axes_(axes),
      range_(std::size_t{kCells} * kCells,
             {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {}

glm::vec3 Sight::cell(const glm::dvec3& place) const {
  const glm::dvec3 from = (place - center_) * cells_per_unit_;
  return {glm::dot(from, axes_.right) + 0.5 * kCells, glm::dot(from, axes_.up) + 0.5 * kCells,
          glm::dot(from, axes_.to_eye)};
}

std::size_t Sight::extent(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) { return Cells(a, b, c).count(); }

void Sight::cover(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const Cells cells(a, b, c);
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (cells.count() == 0 || area == 0) return;
  // Shares of b and c, and the depth, at the middle of a row's first cell; and steps to the next cell.
  const float inverse = 1 / area;
  const float step_b = (c.y - a.y) * inverse;
  const float step_c = -(b.y - a.y) * inverse;
  const float step_z = step_b * (b.z - a.z) + step_c * (c.z - a.z);
  const float x = static_cast<float>(cells.column0) + 0.5F - a.x;
  for (int row = cells.row0; row <= cells.row1; ++row) {
    const float y = static_cast<float>(row) + 0.5F - a.y;
    const float first_b = step_b * x - (c.x - a.x) * inverse * y;
    const float first_c = step_c * x + (b.x - a.x) * inverse * y;
    const float first_z = a.z + first_b * (b.z - a.z) + first_c * (c.z - a.z);
    auto* const range = range_.data() + static_cast<std::size_t>(row) * kCells;
    for (int column = cells.column0; column <= cells.column1; ++column) {
      const auto i = static_cast<float>(column - cells.column0);
      const float share_b = first_b + i * step_b;
      const float share_c = first_c + i * step_c;
      if (!(share_b >= 0 && share_c >= 0 && share_b + share_c <= 1)) continue;
      const float z = first_z + i * step_z;
      range[column] = {std::min(range[column][0], z), std::max(range[column][1], z)};
    }
  }
}

bool Sight::sees(const glm::vec3& cell, bool from_behind, float slack) const {
  if (!(cell.x >= 0 && cell.y >= 0 && cell.x < kCells && cell.y < kCells)) return true;
  const auto index = static_cast<std::size_t>(cell.y) * kCells + static_cast<std::size_t>(cell.x);
  return from_behind ? !(range_[index][0] < cell.z - slack) : !(range_[index][1] > cell.z + slack);
}

}  // namespace azulejo
