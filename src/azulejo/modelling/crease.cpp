#include "azulejo/modelling/crease.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace azulejo {
namespace {

constexpr std::size_t kLargeFan = 512;  // faces: beyond, each with each takes too long
constexpr int kCellsPerAxis = 16;       // of the cube around all directions

bool has_normal(const glm::vec3& normal) { return normal != glm::vec3(0); }

/// Faces of a large fan that look the same way.
struct Direction {
  glm::dvec3 mean{0};  ///< of the normals
  NormalSum sum;
};

std::size_t cell_of(const glm::vec3& normal) {
  std::size_t cell = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int at = std::clamp(static_cast<int>((normal[axis] + 1) * (0.5F * kCellsPerAxis)), 0, kCellsPerAxis - 1);
    cell = cell * kCellsPerAxis + static_cast<std::size_t>(at);
  }
  return cell;
}

}  // namespace

glm::vec3 NormalSum::unit_or(const glm::vec3& other) const {
  const double length = std::sqrt(glm::dot(sum, sum));
  return length > 1e-6 * weight ? glm::vec3(sum * (1 / length)) : other;
}

Crease::Crease(float angle) : cosine_(std::cos(angle) - 1e-6F), half_cosine_(std::cos(angle / 2) + 2e-6F) {}

bool Crease::normals(const std::vector<FaceAround>& fan, std::vector<glm::vec3>& result) const {
  result.resize(fan.size());
  if (fan.size() <= kLargeFan) return each_with_each(fan, result);
  by_direction(fan, result);
  return true;
}

bool Crease::each_with_each(const std::vector<FaceAround>& fan, std::vector<glm::vec3>& result) const {
  bool split = false;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::vec3 own = fan[i].normal;
    NormalSum sum;
    for (const FaceAround& other : fan) {
      if (!has_normal(own) || glm::dot(own, other.normal) >= cosine_) {
        sum.add(other.normal, other.weight);
      } else {
        split = split || has_normal(other.normal);
      }
    }
    result[i] = sum.unit_or(own);
  }
  return split;
}

void Crease::by_direction(const std::vector<FaceAround>& fan, std::vector<glm::vec3>& result) const {
  constexpr std::size_t kCells = std::size_t{kCellsPerAxis} * kCellsPerAxis * kCellsPerAxis;
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> direction_of_cell(kCells, kNone);
  std::vector<Direction> directions;
  NormalSum all;
  for (const FaceAround& each : fan) {
    const glm::vec3 normal = each.normal;
    if (!has_normal(normal)) continue;
    std::uint32_t& index = direction_of_cell[cell_of(normal)];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(directions.size());
      directions.emplace_back();
    }
    directions[index].mean += glm::dvec3(normal);
    directions[index].sum.add(normal, each.weight);
    all.add(normal, each.weight);
  }
  for (Direction& each : directions) each.mean = glm::normalize(each.mean);
  std::vector<NormalSum> sums(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (const Direction& other : directions) {
      if (glm::dot(directions[i].mean, other.mean) >= static_cast<double>(cosine_)) sums[i].add(other.sum);
    }
  }
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::vec3 own = fan[i].normal;
    result[i] = (has_normal(own) ? sums[direction_of_cell[cell_of(own)]] : all).unit_or(own);
  }
}

}  // namespace azulejo
