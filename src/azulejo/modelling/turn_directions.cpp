#include "azulejo/modelling/turn_directions.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/math/transform3d.h"

namespace azulejo {
namespace {

void turn_vectors(const glm::dmat3& matrix, std::size_t elements, int components, float* out, const Run& run) {
  constexpr std::size_t kChunk = std::size_t{1} << 14;
  parallel_for(elements, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      float* const v = out + e * static_cast<std::size_t>(components);
      const glm::dvec3 turned = matrix * glm::dvec3(v[0], v[1], v[2]);
      const double square = glm::dot(turned, turned);
      const double scale = square > 0 ? 1 / std::sqrt(square) : 0;
      for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(turned[k] * scale);
    }
  });
}

}  // namespace

void turn_directions(std::string_view attribute, int components, const glm::dmat3& linear, float* values,
                     std::size_t elements, const Run& run) {
  if (components < 3) return;
  if (attribute == "NORMAL") {
    turn_vectors(normal_matrix(linear), elements, components, values, run);
  } else if (attribute == "TANGENT") {
    turn_vectors(linear, elements, components, values, run);
    // What is across, w · N × T, is to turn with the surface too.
    if (components == 4 && glm::determinant(linear) < 0) {
      for (std::size_t e = 0; e < elements; ++e) values[4 * e + 3] = -values[4 * e + 3];
    }
  }
}

}  // namespace azulejo
