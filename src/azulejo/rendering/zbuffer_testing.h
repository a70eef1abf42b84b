#pragma once

// For tests only: views, small meshes, pictures, and what a ray through a pixel meets, in double precision.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "azulejo/rendering/lens.h"
#include "azulejo/rendering/zbuffer.h"

namespace azulejo {

struct TestView {
  glm::dvec3 eye{0, 0, 4};
  glm::dvec3 center{0, 0, 0};
  Lens lens = {.fov_y = 0.7, .height = 3, .near = 0.05, .far = 100};
  int width = 96;
  int height = 80;
  Rect viewport = {};  ///< empty: all of it
};

inline View view_of(TestView wanted) {
  CameraBasis basis = basis_looking(wanted.eye - wanted.center, {0, 1, 0});
  basis.eye = wanted.eye;
  if (wanted.viewport.empty()) wanted.viewport = {0, 0, wanted.width, wanted.height};
  wanted.lens.aspect = wanted.viewport.width / (1.0 * wanted.viewport.height);
  return view_through(wanted.lens, basis, {wanted.width, wanted.height}, wanted.viewport);
}

template <class V>
Attribute attribute_of(const char* name, const std::vector<V>& values, Domain domain = Domain::Vertex) {
  Array<float> floats;
  for (const V& value : values) {
    for (int c = 0; c < V::length(); ++c) floats.push_back(value[c]);
  }
  return {name, domain, V::length(), std::move(floats)};
}

/// Triangles of their own three vertices.
inline Mesh soup_of(const std::vector<glm::vec3>& corners) {
  Mesh mesh;
  mesh.positions.assign(corners.begin(), corners.end());
  for (std::uint32_t i = 0; i < corners.size(); ++i) mesh.corners.push_back(i);
  return mesh;
}

/// A square in z = `z`, seen from +z, with TEXCOORD_0: the image's top left is at (−half, half).
inline Mesh square_mesh(float half, float z = 0) {
  Mesh mesh = soup_of({{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
  mesh.corners = {0, 1, 2, 0, 2, 3};
  mesh.attributes.push_back(attribute_of<glm::vec2>("TEXCOORD_0", {{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
  return mesh;
}

/// A closed sphere of radius 1 with its normals, `rings` from pole to pole and twice as many around; quads unless
/// `triangles`.
inline Mesh sphere_mesh(std::uint32_t rings, bool triangles = true) {
  Mesh mesh;
  std::vector<glm::vec3> normals;
  const std::uint32_t around = 2 * rings;
  const auto add = [&](double polar, double azimuth) {
    const glm::vec3 p(
        glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), -std::sin(polar) * std::sin(azimuth)));
    mesh.positions.push_back(p);
    normals.push_back(p);
  };
  const double pi = std::acos(-1.0);
  add(0, 0);
  for (std::uint32_t r = 1; r < rings; ++r) {
    for (std::uint32_t a = 0; a < around; ++a) add(pi * r / rings, 2 * pi * a / around);
  }
  add(pi, 0);
  mesh.face_offsets = {0};
  const auto face = [&](std::initializer_list<std::uint32_t> corners) {
    mesh.corners.insert(mesh.corners.end(), corners);
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  const auto at = [&](std::uint32_t r, std::uint32_t a) { return 1 + (r - 1) * around + a % around; };
  const std::uint32_t last = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
  for (std::uint32_t a = 0; a < around; ++a) {
    face({0, at(1, a), at(1, a + 1)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      if (triangles) {
        face({at(r, a), at(r + 1, a), at(r + 1, a + 1)});
        face({at(r, a), at(r + 1, a + 1), at(r, a + 1)});
      } else {
        face({at(r, a), at(r + 1, a), at(r + 1, a + 1), at(r, a + 1)});
      }
    }
    face({at(rings - 1, a), last, at(rings - 1, a + 1)});
  }
  if (triangles) mesh.face_offsets.clear();
  mesh.attributes.push_back(attribute_of("NORMAL", normals));
  return mesh;
}

/// The mesh with one material for all its faces.
inline Scene scene_with(Mesh mesh, const Material& material) {
  mesh.material.assign(mesh.face_count(), 0);
  Scene scene = scene_of(Mesh());
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  scene.materials.push_back(material);
  return scene;
}

inline Material unlit(const glm::vec4& color, bool double_sided = true) {
  Material material;
  material.model = MaterialModel::Unlit;
  material.base_color = color;
  material.double_sided = double_sided;
  return material;
}

/// A pixel of a layer of floats.
inline glm::dvec4 pixel_at(const Frame& frame, const char* layer, int x, int y) {
  const Image& image = *frame.find(layer);
  const auto view = image.view<float>();
  glm::dvec4 pixel(0);
  for (int c = 0; c < image.channels(); ++c) pixel[c] = view(x, y, c);
  return pixel;
}

inline bool same_pixels(const Frame& a, const Frame& b) {
  if (a.layers.size() != b.layers.size()) return false;
  for (std::size_t i = 0; i < a.layers.size(); ++i) {
    const Image& one = a.layers[i].image;
    const Image& other = b.layers[i].image;
    if (one.info() != other.info()) return false;
    for (int y = 0; y < one.height(); ++y) {
      const auto bytes = static_cast<std::size_t>(one.info().row_bytes());
      if (std::memcmp(one.any().row(y), other.any().row(y), bytes) != 0) return false;
    }
  }
  return true;
}

/// A triangle of a scene in the world.
struct RayTriangle {
  glm::dvec3 corner[3];
  const Mesh* mesh = nullptr;
  std::uint32_t face = 0;
  std::uint32_t node = 0;
  std::uint32_t material = 0;
  glm::mat4 world_from_object{1.0F};
  bool double_sided = true;
  glm::dvec3 normal{0, 0, 0};  ///< as long as twice the area
  bool mirrored = false;
  /// Edges as lines of the picture: with (x, y, 1) the distance in pixels, positive inside. In homogeneous coordinates,
  /// so that they are right for corners behind the camera too.
  glm::dvec3 line[3];
};

struct RayHit {
  const RayTriangle* triangle = nullptr;
  double weight[3] = {};
  double along = 0;  ///< on the way from the near plane: 0 there
  bool front = true;
  glm::dvec3 place{0, 0, 0};
};

/// The meshes of a scene, all of triangles, for rays.
class RayScene {
 public:
  RayScene(const Scene& scene, const View& view)
      : view_(view),
        world_from_clip_(glm::inverse(glm::dmat4(view.clip_from_view) * glm::dmat4(view.view_from_world))) {
    for (const PlacedNode& placed : walk(scene)) {
      const Node& node = scene.nodes[placed.node.index];
      if (!placed.visible || !node.mesh) continue;
      const Mesh& mesh = *scene.meshes[node.mesh.index];
      for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        RayTriangle triangle;
        triangle.mesh = &mesh;
        triangle.face = f;
        triangle.node = placed.node.index;
        triangle.world_from_object = placed.world_from_node;
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec4 corner(glm::dvec3(mesh.positions[mesh.corners[std::size_t{3} * f + k]]), 1.0);
          triangle.corner[k] = glm::dvec3(glm::dmat4(placed.world_from_node) * corner);
        }
        triangle.material = static_cast<std::uint32_t>(scene.materials.size());
        if (!mesh.material.empty() && mesh.material[f] != MaterialId::kNone) triangle.material = mesh.material[f];
        if (triangle.material < scene.materials.size()) {
          triangle.double_sided = scene.materials[triangle.material].double_sided;
        }
        prepare(triangle);
        triangles_.push_back(triangle);
      }
    }
  }

  /// The plane of a triangle under a point of the picture, in the triangle or not.
  RayHit meet(const RayTriangle& triangle, double x, double y) const {
    const glm::dvec3 from = world(x, y, 1);
    const glm::dvec3 way = world(x, y, 0.5) - from;
    const glm::dvec3 a = triangle.corner[1] - triangle.corner[0];
    const glm::dvec3 b = triangle.corner[2] - triangle.corner[0];
    const glm::dvec3& normal = triangle.normal;
    RayHit hit;
    hit.along = glm::dot(triangle.corner[0] - from, normal) / glm::dot(way, normal);
    hit.place = from + way * hit.along;
    const glm::dvec3 p = hit.place - triangle.corner[0];
    const double area = glm::dot(normal, normal);
    hit.weight[1] = glm::dot(glm::cross(p, b), normal) / area;
    hit.weight[2] = glm::dot(glm::cross(a, p), normal) / area;
    hit.weight[0] = 1 - hit.weight[1] - hit.weight[2];
    hit.front = (glm::dot(way, normal) < 0) != triangle.mirrored;
    hit.triangle = &triangle;
    return hit;
  }

  /// How far what lies under a point moves along the way when the point moves by `margin` pixels.
  double steepness(const RayHit& hit, double x, double y, double margin) const {
    return std::fabs(meet(*hit.triangle, x + margin, y).along - hit.along) +
           std::fabs(meet(*hit.triangle, x, y + margin).along - hit.along);
  }

  /// The nearest triangle, a hit without one where there is none, or nothing if the picture may differ there: within
  /// `margin` pixels of an edge, or where the order of two triangles would be another that far away.
  std::optional<RayHit> trace(double x, double y, double margin) const {
    std::vector<RayHit> hits;
    for (const RayTriangle& triangle : triangles_) {
      double inside = std::numeric_limits<double>::infinity();
      for (const glm::dvec3& line : triangle.line) inside = std::min(inside, line.x * x + line.y * y + line.z);
      if (inside < -margin) continue;
      const RayHit hit = meet(triangle, x, y);
      if (!std::isfinite(hit.along) || (!hit.front && !triangle.double_sided)) continue;
      if (hit.along > -1e-6 && inside < margin) return std::nullopt;
      const double slack = 1e-5 + steepness(hit, x, y, margin);
      if (std::fabs(hit.along) < slack) return std::nullopt;
      if (hit.along > 0) hits.push_back(hit);
    }
    if (hits.empty()) return RayHit{};
    const auto nearer = [](const RayHit& a, const RayHit& b) { return a.along < b.along; };
    std::sort(hits.begin(), hits.end(), nearer);
    const double slack = 1e-5 * hits[0].along + steepness(hits[0], x, y, margin);
    for (std::size_t i = 1; i < hits.size(); ++i) {
      if (hits[i].along - hits[0].along < slack + steepness(hits[i], x, y, margin)) return std::nullopt;
    }
    return hits[0];
  }

  const std::vector<RayTriangle>& triangles() const { return triangles_; }

 private:
  glm::dvec3 world(double x, double y, double depth) const {
    const double ndc_x = 2 * (x - view_.viewport.x) / view_.viewport.width - 1;
    const double ndc_y = 1 - 2 * (y - view_.viewport.y) / view_.viewport.height;
    const glm::dvec4 place = world_from_clip_ * glm::dvec4(ndc_x, ndc_y, depth, 1);
    return glm::dvec3(place) / place.w;
  }

  void prepare(RayTriangle& triangle) const {
    triangle.normal = glm::cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[0]);
    triangle.mirrored = glm::determinant(glm::dmat3(triangle.world_from_object)) < 0;
    glm::dvec3 corner[3];
    for (int k = 0; k < 3; ++k) {
      const glm::dvec4 clip =
          glm::dmat4(view_.clip_from_view) * (glm::dmat4(view_.view_from_world) * glm::dvec4(triangle.corner[k], 1));
      corner[k] = {(view_.viewport.x + 0.5 * view_.viewport.width) * clip.w + 0.5 * view_.viewport.width * clip.x,
                   (view_.viewport.y + 0.5 * view_.viewport.height) * clip.w - 0.5 * view_.viewport.height * clip.y,
                   clip.w};
    }
    const double sign = glm::dot(corner[0], glm::cross(corner[1], corner[2])) < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 line = glm::cross(corner[(k + 1) % 3], corner[(k + 2) % 3]);
      triangle.line[k] = line * (sign / std::hypot(line.x, line.y));
    }
  }

  View view_;
  glm::dmat4 world_from_clip_;
  std::vector<RayTriangle> triangles_;
};

}  // namespace azulejo
