#include "azulejo/modelling/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace azulejo {

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
  return {glm::dot(from, axes_.right) + kCells / 2, glm::dot(from, axes_.up) + kCells / 2,
          glm::dot(from, axes_.to_eye)};
}

void Sight::cover(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const std::array<glm::vec3, 3> p{a, b, c};
  const auto [x0, x1] = std::minmax({a.x, b.x, c.x});
  const auto [y0, y1] = std::minmax({a.y, b.y, c.y});
  if (!(x0 > -1 && y0 > -1 && x1 < kCells + 1 && y1 < kCells + 1)) return;  // NaN too
  // Middles of cells.
  const int column0 = std::max(0, static_cast<int>(std::ceil(x0 - 0.5F)));
  const int column1 = std::min(kCells - 1, static_cast<int>(std::floor(x1 - 0.5F)));
  const int row0 = std::max(0, static_cast<int>(std::ceil(y0 - 0.5F)));
  const int row1 = std::min(kCells - 1, static_cast<int>(std::floor(y1 - 0.5F)));
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (area == 0) return;
  for (int row = row0; row <= row1; ++row) {
    for (int column = column0; column <= column1; ++column) {
      const float x = static_cast<float>(column) + 0.5F;
      const float y = static_cast<float>(row) + 0.5F;
      std::array<float, 3> share{};
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3& u = p[(i + 1) % 3];
        const glm::vec3& v = p[(i + 2) % 3];
        share[i] = ((u.x - x) * (v.y - y) - (v.x - x) * (u.y - y)) / area;
      }
      if (!(share[0] >= 0 && share[1] >= 0 && share[2] >= 0)) continue;
      const float z = share[0] * a.z + share[1] * b.z + share[2] * c.z;
      auto& range = range_[static_cast<std::size_t>(row) * kCells + static_cast<std::size_t>(column)];
      range = {std::min(range[0], z), std::max(range[1], z)};
    }
  }
}

bool Sight::sees(const glm::vec3& cell, bool from_behind, float slack) const {
  if (!(cell.x >= 0 && cell.y >= 0 && cell.x < kCells && cell.y < kCells)) return true;
  const auto index = static_cast<std::size_t>(cell.y) * kCells + static_cast<std::size_t>(cell.x);
  return from_behind ? !(range_[index][0] < cell.z - slack) : !(range_[index][1] > cell.z + slack);
}

}  // namespace azulejo
