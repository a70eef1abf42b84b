#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/math/predicates.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/winged_edge_build.h"

namespace azulejo {
namespace {

using Ring = std::vector<std::uint32_t>;  ///< vertices in turn

/// Joins the loops of a face into one, by doubled edges that cross none of the others.
class Bridging {
 public:
  Bridging(const WingedEdge& solid, std::uint32_t face) : solid_(solid) {
    for (const std::uint32_t loop : solid.loops_of(face)) {
      Ring& ring = rings_.emplace_back();
      if (solid.loop(loop).half == kNoElement) ring.push_back(solid.loop(loop).vertex);
      for (const WingedEdge::Half half : solid.halves_of(loop)) ring.push_back(solid.from(half));
    }
    choose_plane();
  }

  Ring joined() {
    while (rings_.size() > 1) join_nearest();
    return std::move(rings_[0]);
  }

 private:
  struct Bridge {
    double length = std::numeric_limits<double>::infinity();
    std::size_t ring = 1;
    std::size_t from = 0;  ///< place in the outer ring
    std::size_t to = 0;    ///< place in the other ring
  };

  /// The face is seen along the largest axis of its Newell normal.
  void choose_plane() {
    glm::dvec3 normal(0);
    const Ring& outer = rings_[0];
    for (std::size_t i = 0; i < outer.size(); ++i) {
      normal += glm::cross(place(outer[i]), place(outer[(i + 1) % outer.size()]));
    }
    for (int axis = 1; axis < 3; ++axis) {
      if (std::abs(normal[axis]) > std::abs(normal[dropped_])) dropped_ = axis;
    }
  }
  glm::dvec3 place(std::uint32_t vertex) const { return glm::dvec3(solid_.vertex(vertex).position); }
  glm::dvec2 seen(std::uint32_t vertex) const {
    const glm::dvec3 at = place(vertex);
    return {at[(dropped_ + 1) % 3], at[(dropped_ + 2) % 3]};
  }

  /// Whether the inside of a segment meets an edge of the face that doesn't end where it does.
  bool is_blocked(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec2 p = seen(a);
    const glm::dvec2 q = seen(b);
    for (const Ring& ring : rings_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t c = ring[i];
        const std::uint32_t d = ring[(i + 1) % ring.size()];
        if (c == a || c == b || d == a || d == b) continue;
        const double sides = orient2d(p, q, seen(c)) * orient2d(p, q, seen(d));
        const double ends = orient2d(seen(c), seen(d), p) * orient2d(seen(c), seen(d), q);
        if (sides <= 0 && ends <= 0) return true;
      }
    }
    return false;
  }

  /// Of all ways from the outer ring to another, the shortest that is free; the shortest at all if none is.
  void join_nearest() {
    std::vector<Bridge> bridges;
    for (std::size_t r = 1; r < rings_.size(); ++r) {
      for (std::size_t i = 0; i < rings_[0].size(); ++i) {
        for (std::size_t j = 0; j < rings_[r].size(); ++j) {
          const glm::dvec2 way = seen(rings_[0][i]) - seen(rings_[r][j]);
          bridges.push_back({glm::dot(way, way), r, i, j});
        }
      }
    }
    std::stable_sort(bridges.begin(), bridges.end(),
                     [](const Bridge& a, const Bridge& b) { return a.length < b.length; });
    const auto is_free = [&](const Bridge& each) {
      return !is_blocked(rings_[0][each.from], rings_[each.ring][each.to]);
    };
    const auto found = std::find_if(bridges.begin(), bridges.end(), is_free);
    build(found != bridges.end() ? *found : bridges.front());
  }

  void build(const Bridge& bridge) {
    Ring& hole = rings_[bridge.ring];
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(bridge.to), hole.end());
    if (hole.size() > 1) hole.push_back(hole.front());
    hole.push_back(rings_[0][bridge.from]);
    Ring& outer = rings_[0];
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(bridge.from) + 1, hole.begin(), hole.end());
    rings_.erase(rings_.begin() + static_cast<std::ptrdiff_t>(bridge.ring));
  }

  const WingedEdge& solid_;
  std::vector<Ring> rings_;
  int dropped_ = 0;
};

/// Where the elements of the new mesh come from in its source.
struct Sources {
  Array<std::uint32_t> vertices;
  Array<std::uint32_t> corners;
  Array<std::uint32_t> faces;
  const Array<std::uint32_t>& of(Domain domain) const {
    return domain == Domain::Vertex ? vertices : domain == Domain::Corner ? corners : faces;
  }
};

/// The corner of a face at a vertex, the next one from `hint` on around the face; moves `hint` behind it.
std::uint32_t corner_at(const Mesh& mesh, std::uint32_t face, std::uint32_t vertex, std::size_t& hint) {
  if (face >= mesh.face_count()) return kNoElement;
  const std::size_t begin = mesh.face_begin(face);
  const std::size_t count = mesh.face_end(face) - begin;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t corner = begin + (hint + i) % count;
    if (mesh.corners[corner] != vertex) continue;
    hint = (hint + i + 1) % count;
    return static_cast<std::uint32_t>(corner);
  }
  return kNoElement;
}

}  // namespace

Mesh mesh_of(const WingedEdge& solid, const Mesh* source) {
  Mesh mesh;
  Sources sources;
  Array<std::uint32_t> number(solid.vertex_slots());
  for (std::uint32_t v = 0; v < solid.vertex_slots(); ++v) {
    if (!solid.vertex_alive(v)) continue;
    number[v] = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(solid.vertex(v).position);
    sources.vertices.push_back(solid.vertex(v).source);
  }
  mesh.face_offsets.push_back(0);
  bool triangles = true;
  for (std::uint32_t f = 0; f < solid.face_slots(); ++f) {
    if (!solid.face_alive(f)) continue;
    const std::uint32_t loop = solid.face(f).loop;
    const std::size_t first = mesh.corners.size();
    std::size_t hint = 0;
    const auto add = [&](std::uint32_t vertex) {
      mesh.corners.push_back(number[vertex]);
      if (source != nullptr) {
        sources.corners.push_back(corner_at(*source, solid.face(f).source, solid.vertex(vertex).source, hint));
      }
    };
    if (solid.loop(loop).next == kNoElement) {
      for (const WingedEdge::Half half : solid.halves_of(loop)) add(solid.from(half));
    } else {
      for (const std::uint32_t vertex : Bridging(solid, f).joined()) add(vertex);
    }
    triangles = triangles && mesh.corners.size() - first == 3;
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    sources.faces.push_back(solid.face(f).source);
  }
  if (triangles) mesh.face_offsets.clear();
  if (source == nullptr) return mesh;
  mesh.name = source->name;
  mesh.space = source->space;
  for (const Attribute& each : source->attributes) mesh.attributes.push_back(picked(each, sources.of(each.domain)));
  for (const MorphTarget& each : source->morph_targets) mesh.morph_targets.push_back(picked(each, sources.vertices));
  if (!source->material.empty()) {
    for (const std::uint32_t face : sources.faces) {
      mesh.material.push_back(face == kNoElement ? 0 : source->material[face]);
    }
  }
  return mesh;
}

}  // namespace azulejo
