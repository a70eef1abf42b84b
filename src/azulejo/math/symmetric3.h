#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <utility>

namespace azulejo {

/// Eigenvalues, rising, and unit eigenvectors of a symmetric matrix. The vectors are a right-handed frame; of the first
/// two the component that is largest in magnitude is positive.
struct Symmetric3 {
  glm::dvec3 values{0, 0, 0};
  std::array<glm::dvec3, 3> vectors{glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// By Jacobi's rotations: exact to rounding, also where eigenvalues are equal. Only finite matrices.
/// Source: Golub, Van Loan, Matrix Computations, 4th ed., 8.5
inline Symmetric3 eigen_of_symmetric(glm::dmat3 a) {
  glm::dmat3 turned(1);
  for (int sweep = 0; sweep < 30; ++sweep) {
    if (a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0) break;
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = std::isfinite(theta * theta)
                           ? (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1))
                           : 0.5 / theta;
      const double c = 1 / std::sqrt(t * t + 1);
      glm::dmat3 rotation(1);
      rotation[p][p] = rotation[q][q] = c;
      rotation[q][p] = t * c;
      rotation[p][q] = -t * c;
      a = glm::transpose(rotation) * a * rotation;
      a[p][q] = a[q][p] = 0;
      turned = turned * rotation;
    }
  }
  std::array<int, 3> order{0, 1, 2};
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
    int& first = order[static_cast<std::size_t>(i)];
    int& second = order[static_cast<std::size_t>(j)];
    if (a[second][second] < a[first][first]) std::swap(first, second);
  }
  Symmetric3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.values[static_cast<int>(i)] = a[order[i]][order[i]];
    glm::dvec3 axis = turned[order[i]];
    int largest = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::abs(axis[k]) > std::abs(axis[largest])) largest = k;
    }
    result.vectors[i] = axis[largest] < 0 ? -axis : axis;
  }
  result.vectors[2] = glm::cross(result.vectors[0], result.vectors[1]);
  return result;
}

}  // namespace azulejo
