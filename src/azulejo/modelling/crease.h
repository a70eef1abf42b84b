#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace azulejo {

/// The faces around a vertex, by their corners there.
struct Fan {
  std::vector<std::uint32_t> corners;
  std::vector<glm::vec3> normals;  ///< unit, or 0
  std::vector<float> weights;

  std::size_t size() const { return corners.size(); }
  void clear() {
    corners.clear();
    normals.clear();
    weights.clear();
  }
  void add(std::uint32_t corner, const glm::vec3& normal, float weight) {
    corners.push_back(corner);
    normals.push_back(normal);
    weights.push_back(weight);
  }
};

/// A weighted sum of unit normals.
struct NormalSum {
  glm::dvec3 sum{0};
  double weight = 0;

  void add(const glm::vec3& normal, float with) {
    sum += glm::dvec3(normal * with);
    weight += static_cast<double>(with);
  }
  void add(const NormalSum& other) {
    sum += other.sum;
    weight += other.weight;
  }
  /// At unit length; `other` where all cancels but for rounding.
  glm::vec3 unit_or(const glm::vec3& other) const;
};

/// Which faces around a vertex are smoothed together.
class Crease {
 public:
  explicit Crease(float angle);  ///< 0–π

  /// Whether two of the faces meet at more than the angle. `smooth`: the weighted mean, which settles it mostly.
  bool splits(const Fan& fan, const glm::vec3& smooth) const;
  /// The normal of each corner. A face without a normal takes that of all.
  void normals(const Fan& fan, std::vector<glm::vec3>& result) const;

 private:
  void each_with_each(const Fan& fan, std::vector<glm::vec3>& result) const;
  void by_direction(const Fan& fan, std::vector<glm::vec3>& result) const;

  float cosine_;       ///< of the angle
  float half_cosine_;  ///< of half of it, and a little more than its rounding
};

}  // namespace azulejo
