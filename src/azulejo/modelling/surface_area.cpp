#include "azulejo/modelling/surface_area.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 13;

}  // namespace

CornerShares even_shares(double a, double b) {
  const double root = std::sqrt(a);
  return {1 - root, root * (1 - b), root * b};
}

SurfaceArea::SurfaceArea(const Mesh& mesh, const Run& run)
    : mesh_(mesh), parts_(triangulate(mesh, run)), ends_(parts_.face.size()) {
  parallel_for(ends_.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto corner = positions(t);
      ends_[t] = finite(t) ? glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])) / 2 : 0;
    }
  });
  double sum = 0;
  for (double& each : ends_) each = sum += each;
}

std::size_t SurfaceArea::at(double number) const {
  const auto found = std::upper_bound(ends_.begin(), ends_.end(), number);
  if (found != ends_.end()) return static_cast<std::size_t>(found - ends_.begin());
  // The end itself: the first that reaches it.
  return static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), total()) - ends_.begin());
}

std::size_t SurfaceArea::at(double number, std::size_t earlier) const {
  std::size_t triangle = earlier;
  while (triangle < ends_.size() && ends_[triangle] <= number) {
    if (++triangle - earlier > 64) return at(number);
  }
  return triangle < ends_.size() ? triangle : at(number);
}

std::array<glm::dvec3, 3> SurfaceArea::positions(std::size_t triangle) const {
  const auto corner = corners(triangle);
  return {glm::dvec3(mesh_.positions[mesh_.corners[corner[0]]]), glm::dvec3(mesh_.positions[mesh_.corners[corner[1]]]),
          glm::dvec3(mesh_.positions[mesh_.corners[corner[2]]])};
}

bool SurfaceArea::finite(std::size_t triangle) const {
  double sum = 0;
  for (const glm::dvec3& corner : positions(triangle)) sum += (corner.x + corner.y) + corner.z;
  return std::isfinite(sum);
}

}  // namespace azulejo
