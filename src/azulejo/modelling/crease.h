#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace azulejo {

/// A face at a vertex.
struct FaceAround {
  std::uint32_t corner;
  float weight;
  glm::vec3 normal;  ///< unit, or 0
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

  /// Whether the face is so near the mean of all that, if all are, no two of them meet at more than the angle.
  bool near_mean(const glm::vec3& normal, const glm::vec3& mean) const {
    return normal == glm::vec3(0) || normal.x * mean.x + normal.y * mean.y + normal.z * mean.z >= half_cosine_;
  }
  /// The normal of each corner; whether any two are told apart. A face without a normal takes that of all.
  bool normals(const std::vector<FaceAround>& fan, std::vector<glm::vec3>& result) const;

 private:
  bool each_with_each(const std::vector<FaceAround>& fan, std::vector<glm::vec3>& result) const;
  void by_direction(const std::vector<FaceAround>& fan, std::vector<glm::vec3>& result) const;

  float cosine_;       ///< of the angle
  float half_cosine_;  ///< of half of it, and a little more than its rounding
};

}  // namespace azulejo
