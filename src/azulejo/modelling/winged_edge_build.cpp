#include "azulejo/modelling/winged_edge_build.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/winged_edge_parts.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;
using Half = WingedEdge::Half;

/// A face along an edge, as one sees it who looks from the edge's lower to its higher vertex.
struct Leaf {
  std::uint32_t corner = 0;
  bool backward = false;  ///< the face runs from the higher to the lower
  double angle = 0;       ///< of its middle around the edge
};

/// The faces along an edge by pairs of corners that are joined; kNoElement: alone.
using Pairs = std::vector<std::array<std::uint32_t, 2>>;

class EdgePairing {
 public:
  EdgePairing(const Mesh& mesh, const EdgeUses& uses) : mesh_(mesh), uses_(uses) {}

  bool is_regular(std::size_t edge) const {
    const auto corners = uses_.uses_of(edge);
    return corners.size() == 1 || (corners.size() == 2 && backward(edge, corners[0]) != backward(edge, corners[1]));
  }

  /// A forward face has its outside on the side of growing angles, a backward one on that of falling ones: what follows a
  /// backward one is the other skin of the same solid, if it is forward.
  Pairs pairs(std::size_t edge) const {
    std::vector<Leaf> leaves;
    for (const std::uint32_t corner : uses_.uses_of(edge)) leaves.push_back(leaf(edge, corner));
    std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
    std::vector<std::size_t> open;
    std::vector<bool> joined(leaves.size(), false);
    Pairs result;
    for (std::size_t turn = 0; turn < 2 * leaves.size(); ++turn) {
      const std::size_t i = turn % leaves.size();
      if (joined[i]) continue;
      if (leaves[i].backward) {
        if (turn < leaves.size()) open.push_back(i);
      } else if (!open.empty()) {
        result.push_back({leaves[open.back()].corner, leaves[i].corner});
        joined[open.back()] = joined[i] = true;
        open.pop_back();
      }
    }
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (!joined[i]) result.push_back({leaves[i].corner, kNoElement});
    }
    return result;
  }

 private:
  bool backward(std::size_t edge, std::uint32_t corner) const {
    return mesh_.corners[corner] != uses_.vertices[edge][0];
  }

  Leaf leaf(std::size_t edge, std::uint32_t corner) const {
    const glm::dvec3 origin(mesh_.positions[uses_.vertices[edge][0]]);
    const glm::dvec3 along = glm::dvec3(mesh_.positions[uses_.vertices[edge][1]]) - origin;
    const glm::dvec3 axis = glm::dot(along, along) > 0 ? glm::normalize(along) : glm::dvec3(0, 0, 1);
    const glm::dvec3 helper = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, helper));
    const glm::dvec3 v = glm::cross(axis, u);
    // The first corner of the face that is off the edge's line tells where it lies.
    glm::dvec3 aside(0);
    for (std::uint32_t c = uses_.next[corner]; c != corner; c = uses_.next[c]) {
      const glm::dvec3 offset = glm::dvec3(mesh_.positions[mesh_.corners[c]]) - origin;
      const glm::dvec3 across = offset - glm::dot(offset, axis) * axis;
      if (glm::dot(across, across) > glm::dot(aside, aside)) aside = across;
    }
    const double angle = std::atan2(glm::dot(aside, v), glm::dot(aside, u));
    return {corner, backward(edge, corner), std::isfinite(angle) ? angle : 0.0};
  }

  const Mesh& mesh_;
  const EdgeUses& uses_;
};

}  // namespace

class WingedEdgeBuilder {
 public:
  WingedEdgeBuilder(const Mesh& mesh, const Run& run) : mesh_(mesh), run_(run), uses_(edge_uses(mesh, {}, run)) {}

  WingedEdgeOfMesh build() {
    if (uses_.uses.size() >= kDeadVertex / 2) throw Error(Error::Unsupported, "winged_edge: more than 2^31 edges");
    add_vertices();
    add_edges();
    add_faces();
    parallel_for(mesh_.corner_count(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t corner = begin; corner < end; ++corner) {
        if (uses_.next[corner] != EdgeUses::kNone) solid_.link(half_[corner], half_[uses_.next[corner]]);
      }
    });
    link_borders();
    split_vertices();
    return {std::move(solid_), std::move(changes_)};
  }

 private:
  void add_vertices() {
    solid_.vertices_.resize(mesh_.vertex_count());
    parallel_for(mesh_.vertex_count(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        solid_.vertices_[v] = {mesh_.positions[v], kDeadVertex, static_cast<std::uint32_t>(v)};
      }
    });
  }

  void add_edges() {
    const EdgePairing pairing(mesh_, uses_);
    half_.resize(mesh_.corner_count());
    const std::size_t count = uses_.size();
    solid_.edges_.resize(count);
    std::vector<std::vector<std::uint32_t>> singular((count + kChunk - 1) / kChunk);
    parallel_for(count, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        if (pairing.is_regular(e)) {
          const auto corners = uses_.uses_of(e);
          set_edge(static_cast<std::uint32_t>(e), corners[0], corners.size() == 2 ? corners[1] : kNoElement);
        } else {
          singular[begin / kChunk].push_back(static_cast<std::uint32_t>(e));
        }
      }
    });
    for (const auto& part : singular) {
      for (const std::uint32_t e : part) {
        changes_.split_edges.push_back(uses_.vertices[e]);
        std::uint32_t slot = e;
        for (const auto& pair : pairing.pairs(e)) {
          set_edge(slot, pair[0], pair[1]);
          slot = static_cast<std::uint32_t>(solid_.edges_.size());
          solid_.edges_.emplace_back();
        }
        solid_.edges_.pop_back();
      }
    }
  }

  /// An edge that runs as the face of `corner` does, which lies to its left; the face of `other` lies to the right.
  void set_edge(std::uint32_t edge, std::uint32_t corner, std::uint32_t other) {
    solid_.edges_[edge].vertex = {mesh_.corners[corner], mesh_.corners[uses_.next[corner]]};
    half_[corner] = edge << 1;
    if (other != kNoElement) half_[other] = edge << 1 | 1U;
  }

  void add_faces() {
    const std::size_t faces = mesh_.face_count();
    solid_.faces_.resize(faces);
    solid_.loops_.resize(faces);
    std::vector<std::vector<std::uint32_t>> dropped((faces + kChunk - 1) / kChunk);
    parallel_for(faces, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const auto face = static_cast<std::uint32_t>(f);
        std::uint32_t first = EdgeUses::kNone;
        for (std::size_t c = mesh_.face_end(f); c-- > mesh_.face_begin(f);) {
          if (uses_.next[c] == EdgeUses::kNone) continue;
          first = static_cast<std::uint32_t>(c);
          solid_.set_left(half_[c], face);
        }
        if (first == EdgeUses::kNone) {
          dropped[begin / kChunk].push_back(face);
          continue;
        }
        solid_.faces_[f] = {face, face};
        solid_.loops_[f] = {half_[first], kNoElement, face, kNoElement};
      }
    });
    for (const auto& part : dropped) {
      for (const std::uint32_t face : part) {
        changes_.dropped_faces.push_back(face);
        solid_.free_face(face);
        solid_.free_loop(face);
      }
    }
  }

  /// Along a border the way goes on with the border edge that is next around the vertex.
  void link_borders() {
    for (std::uint32_t edge = 0; edge < solid_.edges_.size(); ++edge) {
      if (solid_.edges_[edge].face[1] != kNoElement) continue;
      Half half = edge << 1;
      while (solid_.left(half) != kNoElement) half = solid_.around(half);
      solid_.link(edge << 1 | 1U, half);
    }
  }

  /// The first fan of faces at a vertex keeps it; each further one gets a vertex of its own.
  void split_vertices() {
    std::vector<std::uint8_t> seen(2 * solid_.edges_.size(), 0);
    std::vector<Half> fan;
    for (Half half = 0; half < seen.size(); ++half) {
      if (seen[half] != 0) continue;
      const std::uint32_t vertex = solid_.from(half);
      const bool first = solid_.vertices_[vertex].edge == kDeadVertex;
      fan.clear();
      for (Half each = half; seen[each] == 0; each = solid_.around(each)) {
        seen[each] = 1;
        if (!first) fan.push_back(each);
      }
      if (first) {
        solid_.point_at(vertex, half);
        continue;
      }
      changes_.split_vertices.push_back(vertex);
      const auto added = static_cast<std::uint32_t>(solid_.vertices_.size());
      solid_.vertices_.push_back({solid_.vertices_[vertex].position, half >> 1, vertex});
      for (const Half each : fan) solid_.edges_[each >> 1].vertex[each & 1] = added;
    }
    for (std::uint32_t v = 0; v < solid_.vertices_.size(); ++v) {
      if (solid_.vertices_[v].edge == kDeadVertex) solid_.free_vertices_.push_back(v);
    }
  }

  const Mesh& mesh_;
  const Run& run_;
  EdgeUses uses_;
  Array<Half> half_;  ///< of each corner
  WingedEdge solid_;
  WingedEdgeChanges changes_;
};

WingedEdgeOfMesh winged_edge(const Mesh& mesh, const Run& run) { return WingedEdgeBuilder(mesh, run).build(); }

}  // namespace azulejo
