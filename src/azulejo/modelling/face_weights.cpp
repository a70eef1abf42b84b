#include "azulejo/modelling/face_weights.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/math/arctangent.h"
#include "azulejo/modelling/cotangents.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = 4096;  // faces

/// Between 0 and π. Of any size: what goes into the arctangent is at most 1.
float angle_of(double across, double along) {
  const double size = across + std::abs(along);
  if (!(size > 0)) return 0;
  return atan2_deterministic(static_cast<float>(across / size), static_cast<float>(along / size));
}

/// Computed in double: products of four coordinates don't overflow there, nor vanish.
class FaceMeasure {
 public:
  FaceMeasure(const Mesh& mesh, NormalWeight weight) : mesh_(mesh), weight_(weight) {
    const glm::vec3 size = weight == NormalWeight::Area ? bounds(mesh).size() : glm::vec3(1);
    const double extent = std::max({size.x, size.y, size.z});
    area_scale_ = extent > 0 ? 1 / (extent * extent) : 1;
  }

  glm::vec3 normal(std::size_t face) {
    begin_ = mesh_.face_begin(face);
    count_ = mesh_.face_end(face) - begin_;
    area_vector_ = count_ == 3 ? triangle() : polygon();
    length_ = std::sqrt(glm::dot(area_vector_, area_vector_));
    has_normal_ = length_ > 0 && std::isfinite(length_);
    return has_normal_ ? glm::vec3(area_vector_ * (1 / length_)) : glm::vec3(0);
  }

  /// Of the face whose normal was asked for last. Of a triangle weighted by angle: its cotangents.
  void corner_weights(float* out) const {
    if (!has_normal_) {
      std::fill_n(out, count_, 0.0F);
    } else if (weight_ != NormalWeight::Angle) {
      std::fill_n(out, count_, weight_ == NormalWeight::Area ? static_cast<float>(length_ * area_scale_) : 1.0F);
    } else if (count_ == 3) {
      cotangents(out);
    } else {
      polygon_angles(out);
    }
  }

 private:
  glm::dvec3 point(std::size_t corner) const { return mesh_.positions[mesh_.corners[begin_ + corner]]; }

  glm::dvec3 triangle() {
    const glm::dvec3 a = point(0);
    const glm::dvec3 b = point(1);
    const glm::dvec3 c = point(2);
    edges_[0] = b - a;
    edges_[1] = c - b;
    edges_[2] = a - c;
    return glm::cross(edges_[0], edges_[1]);
  }

  glm::dvec3 polygon() const {
    glm::dvec3 sum(0);
    if (count_ < 3) return sum;
    const glm::dvec3 origin = point(0);
    glm::dvec3 before = point(1) - origin;
    for (std::size_t i = 2; i < count_; ++i) {
      const glm::dvec3 here = point(i) - origin;
      sum += glm::cross(before, here);
      before = here;
    }
    return sum;
  }

  /// Of an angle: along ÷ across, which is as long for all three.
  void cotangents(float* out) const {
    const double scale = -1 / length_;
    constexpr double kFlat = 1e30;
    for (int i = 0; i < 3; ++i) {
      const double cotangent = glm::dot(edges_[i], edges_[i == 0 ? 2 : i - 1]) * scale;
      out[i] = static_cast<float>(std::clamp(cotangent, -kFlat, kFlat));
    }
  }

  void polygon_angles(float* out) const {
    glm::dvec3 back = point(count_ - 1) - point(0);
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::dvec3 forth = point(i + 1 == count_ ? 0 : i + 1) - point(i);
      const glm::dvec3 across = glm::cross(forth, back);
      const float angle = angle_of(std::sqrt(glm::dot(across, across)), glm::dot(forth, back));
      out[i] = glm::dot(across, area_vector_) < 0 ? 6.28318531F - angle : angle;
      back = -forth;
    }
  }

  const Mesh& mesh_;
  NormalWeight weight_;
  double area_scale_ = 1;
  std::size_t begin_ = 0;
  std::size_t count_ = 0;
  glm::dvec3 edges_[3] = {};   ///< of a triangle
  glm::dvec3 area_vector_{0};  ///< twice the area long
  double length_ = 0;
  bool has_normal_ = false;
};

}  // namespace

FaceWeights face_weights(const Mesh& mesh, NormalWeight weight, const Run& run) {
  FaceWeights result;
  result.normals.resize(mesh.face_count());
  result.corners.resize(mesh.corner_count());
  const FaceMeasure prepared(mesh, weight);
  const bool triangles = weight == NormalWeight::Angle && mesh.all_triangles();
  const bool mixed = weight == NormalWeight::Angle && !mesh.all_triangles();
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    FaceMeasure measure = prepared;
    for (std::size_t f = begin; f < end; ++f) {
      result.normals[f] = measure.normal(f);
      float* const corners = result.corners.data() + mesh.face_begin(f);
      measure.corner_weights(corners);
      if (mixed && mesh.face_end(f) - mesh.face_begin(f) == 3) kernels::angles_of_cotangents(corners, 3);
    }
    if (triangles) kernels::angles_of_cotangents(result.corners.data() + 3 * begin, 3 * (end - begin));
  });
  return result;
}

Array<glm::vec3> face_normals(const Mesh& mesh, const Run& run) {
  Array<glm::vec3> normals(mesh.face_count());
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    FaceMeasure measure(mesh, NormalWeight::Uniform);
    for (std::size_t f = begin; f < end; ++f) normals[f] = measure.normal(f);
  });
  return normals;
}

}  // namespace azulejo
