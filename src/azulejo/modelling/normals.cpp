#include "azulejo/modelling/normals.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/crease.h"
#include "azulejo/modelling/face_weights.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = 4096;  // vertices

/// What the faces at each vertex give to it.
class Surroundings {
 public:
  Surroundings(const Mesh& mesh, NormalWeight weight, const Run& run)
      : weights_(face_weights(mesh, weight, run)),
        around_(corners_of_vertices(mesh, run)),
        faces_(faces_of_corners(mesh, run)) {}

  void load(std::size_t vertex, std::vector<FaceAround>& fan) const {
    fan.resize(around_.first[vertex + 1] - around_.first[vertex]);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const std::uint32_t corner = around_.corners[around_.first[vertex] + i];
      fan[i] = {corner, weights_.corners[corner], weights_.normals[face_of(corner)]};
    }
  }

  /// Whether all faces are near their mean.
  bool all_near(std::size_t vertex, const Crease& crease, const glm::vec3& mean) const {
    for (std::uint32_t i = around_.first[vertex]; i < around_.first[vertex + 1]; ++i) {
      if (!crease.near_mean(weights_.normals[face_of(around_.corners[i])], mean)) return false;
    }
    return true;
  }

  glm::vec3 smooth(std::size_t vertex) const {
    NormalSum sum;
    glm::vec3 first(0);
    for (std::uint32_t i = around_.first[vertex]; i < around_.first[vertex + 1]; ++i) {
      const std::uint32_t corner = around_.corners[i];
      const glm::vec3 normal = weights_.normals[face_of(corner)];
      if (first == glm::vec3(0)) first = normal;
      sum.add(normal, weights_.corners[corner]);
    }
    return sum.unit_or(first);
  }

 private:
  std::size_t face_of(std::uint32_t corner) const { return faces_.empty() ? corner / 3 : faces_[corner]; }

  FaceWeights weights_;
  VertexCorners around_;
  Array<std::uint32_t> faces_;
};

Attribute attribute_of(Domain domain, std::size_t elements) {
  Attribute attribute;
  attribute.name = "NORMAL";
  attribute.domain = domain;
  attribute.components = 3;
  attribute.values = Array<float>(3 * elements);
  return attribute;
}

void store(float* out, const glm::vec3& normal) {
  for (int i = 0; i < 3; ++i) out[i] = normal[i];
}

/// Vertices whose faces are not all near their mean.
std::vector<std::uint8_t> find_sharp(const Surroundings& around, const Crease& crease, const Attribute& smooth,
                                     const Run& run) {
  const Array<float>& normals = *smooth.get<float>();
  std::vector<std::uint8_t> sharp(smooth.size());
  parallel_for(sharp.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const glm::vec3 mean(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
      sharp[v] = around.all_near(v, crease, mean) ? 0 : 1;
    }
  });
  return sharp;
}

/// The normals of corners; nothing where no vertex turns out to be split.
std::optional<Attribute> split_normals(const Mesh& mesh, const Surroundings& around, const Crease& crease,
                                       const Attribute& smooth, const std::vector<std::uint8_t>& sharp,
                                       const Run& run) {
  Attribute result = attribute_of(Domain::Corner, mesh.corner_count());
  float* const out = std::get<Array<float>>(result.values).data();
  const float* const from = smooth.get<float>()->data();
  parallel_for(mesh.corner_count(), 4 * kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) std::copy_n(from + 3 * std::size_t{mesh.corners[c]}, 3, out + 3 * c);
  });
  const auto split_chunk = [&](std::size_t begin, std::size_t end) {
    std::vector<FaceAround> fan;
    std::vector<glm::vec3> normals;
    bool any = false;
    for (std::size_t v = begin; v < end; ++v) {
      if (sharp[v] == 0) continue;
      around.load(v, fan);
      if (!crease.normals(fan, normals)) continue;
      any = true;
      for (std::size_t i = 0; i < fan.size(); ++i) store(out + 3 * std::size_t{fan[i].corner}, normals[i]);
    }
    return static_cast<int>(any);
  };
  const int any = parallel_reduce(mesh.vertex_count(), kChunk, run, 0, split_chunk, std::bit_or<int>());
  if (any == 0) return std::nullopt;
  return result;
}

}  // namespace

Attribute vertex_normals(const Mesh& mesh, const NormalsOptions& options, const Run& run) {
  if (options.crease_angle && !(*options.crease_angle >= 0 && *options.crease_angle <= std::numbers::pi_v<float>)) {
    throw Error(Error::Argument,
                fmt::format("normals: crease_angle is {}, expected 0 to pi radians", *options.crease_angle));
  }
  const std::size_t vertices = mesh.vertex_count();
  const Surroundings around(mesh, options.weight, run);
  Attribute smooth = attribute_of(Domain::Vertex, vertices);
  float* const out = std::get<Array<float>>(smooth.values).data();
  parallel_for(vertices, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) store(out + 3 * v, around.smooth(v));
  });
  if (!options.crease_angle) return smooth;
  const Crease crease(*options.crease_angle);
  const std::vector<std::uint8_t> sharp = find_sharp(around, crease, smooth, run);
  if (std::find(sharp.begin(), sharp.end(), std::uint8_t{1}) == sharp.end()) return smooth;
  std::optional<Attribute> split = split_normals(mesh, around, crease, smooth, sharp, run);
  return split ? std::move(*split) : std::move(smooth);
}

}  // namespace azulejo
