#include "azulejo/modelling/triangulate.h"

#include <array>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/ear_clipping.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = 4096;  // faces

using Triangle = std::array<std::uint32_t, 3>;

std::size_t triangles_of(std::size_t corners) { return corners >= 3 ? corners - 2 : 0; }

/// The triangles of one face after the other; keeps its memory.
class FaceCutter {
 public:
  explicit FaceCutter(const Mesh& mesh) : mesh_(mesh) {}

  /// Of a face of at least three corners.
  void cut(std::size_t face, std::uint32_t* out) {
    first_ = static_cast<std::uint32_t>(mesh_.face_begin(face));
    count_ = static_cast<std::uint32_t>(mesh_.face_end(face)) - first_;
    if (count_ == 3) {
      write({0, 1, 2}, out);
    } else if (count_ == 4) {
      cut_quad(out);
    } else if (!project() || convex()) {
      cut_fan(out);
    } else {
      ears_.cut(points_, out);
      for (std::size_t i = 0; i < 3 * std::size_t{count_ - 2}; ++i) out[i] += first_;
    }
  }

 private:
  glm::dvec3 point(std::uint32_t corner) const { return mesh_.positions[mesh_.corners[first_ + corner]]; }

  void write(const Triangle& triangle, std::uint32_t* out) const {
    for (std::size_t i = 0; i < 3; ++i) out[i] = first_ + triangle[i];
  }

  void cut_fan(std::uint32_t* out) const {
    for (std::uint32_t i = 1; i + 1 < count_; ++i, out += 3) write({0, i, i + 1}, out);
  }

  void cut_quad(std::uint32_t* out) const {
    const std::array<glm::dvec3, 4> p = {point(0), point(1), point(2), point(3)};
    const glm::dvec3 diagonal_02 = p[2] - p[0];
    const glm::dvec3 diagonal_13 = p[3] - p[1];
    const bool fits_02 = glm::dot(glm::cross(p[1] - p[0], diagonal_02), glm::cross(diagonal_02, p[3] - p[0])) > 0;
    const bool fits_13 = glm::dot(glm::cross(p[2] - p[1], diagonal_13), glm::cross(diagonal_13, p[0] - p[1])) > 0;
    const bool shorter_13 = glm::dot(diagonal_13, diagonal_13) < glm::dot(diagonal_02, diagonal_02);
    const bool cut_13 = fits_02 == fits_13 ? shorter_13 : fits_13;
    write(cut_13 ? Triangle{0, 1, 3} : Triangle{0, 1, 2}, out);
    write(cut_13 ? Triangle{1, 2, 3} : Triangle{0, 2, 3}, out + 3);
  }

  /// The face as seen along the largest axis of its normal, counter-clockwise: coordinates stay as they are. False if
  /// it has no normal.
  bool project() {
    glm::dvec3 normal(0);
    const glm::dvec3 origin = point(0);
    glm::dvec3 before = point(count_ - 1) - origin;
    for (std::uint32_t i = 0; i < count_; ++i) {
      const glm::dvec3 here = point(i) - origin;
      normal += glm::cross(before, here);
      before = here;
    }
    const glm::dvec3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (!(size[axis] > 0) || !std::isfinite(size.x + size.y + size.z)) return false;
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    points_.resize(count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      const glm::dvec3 here = point(i);
      points_[i] = {here[u], here[v]};
    }
    return true;
  }

  /// Turns left at every corner, and around once.
  bool convex() const {
    const auto forward = [&](std::size_t i) {
      const PlanePoint& a = points_[i];
      const PlanePoint& b = points_[i + 1 == points_.size() ? 0 : i + 1];
      return b.u > a.u || (b.u == a.u && b.v > a.v);
    };
    const std::size_t n = points_.size();
    int reversals = 0;
    bool direction = forward(n - 1);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(turn(points_[i == 0 ? n - 1 : i - 1], points_[i], points_[i + 1 == n ? 0 : i + 1]) > 0)) return false;
      if (forward(i) != direction) {
        direction = !direction;
        ++reversals;
      }
    }
    return reversals == 2;
  }

  const Mesh& mesh_;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
  std::vector<PlanePoint> points_;
  EarClipping ears_;
};

Triangulation of_triangles(const Mesh& mesh, const Run& run) {
  Triangulation result;
  result.corners.resize(mesh.corner_count());
  result.face.resize(mesh.face_count());
  parallel_for(mesh.face_count(), 16 * kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) result.corners[i] = static_cast<std::uint32_t>(i);
    for (std::size_t i = begin; i < end; ++i) result.face[i] = static_cast<std::uint32_t>(i);
  });
  return result;
}

/// The first triangle of each chunk of faces, and the number of all.
std::vector<std::size_t> chunk_begins(const Mesh& mesh, const Run& run) {
  const std::size_t faces = mesh.face_count();
  std::vector<std::size_t> begins((faces + kChunk - 1) / kChunk + 1, 0);
  parallel_for(faces, kChunk, run, [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t f = begin; f < end; ++f) count += triangles_of(mesh.face_end(f) - mesh.face_begin(f));
    begins[begin / kChunk + 1] = count;
  });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  return begins;
}

}  // namespace

Triangulation triangulate(const Mesh& mesh, const Run& run) {
  if (mesh.all_triangles()) return of_triangles(mesh, run);
  const std::vector<std::size_t> begins = chunk_begins(mesh, run);
  Triangulation result;
  result.corners.resize(3 * begins.back());
  result.face.resize(begins.back());
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    FaceCutter cutter(mesh);
    std::size_t at = begins[begin / kChunk];
    for (std::size_t f = begin; f < end; ++f) {
      const std::size_t count = triangles_of(mesh.face_end(f) - mesh.face_begin(f));
      if (count == 0) continue;
      cutter.cut(f, result.corners.data() + 3 * at);
      std::fill_n(result.face.begin() + static_cast<std::ptrdiff_t>(at), count, static_cast<std::uint32_t>(f));
      at += count;
    }
  });
  return result;
}

}  // namespace azulejo
