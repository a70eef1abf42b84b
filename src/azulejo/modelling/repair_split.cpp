#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/modelling/repair_work.h"
#include "azulejo/modelling/union_find.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr std::array<double, 2> kHalves{0.5, 0.5};

/// A face at an edge with more than two.
struct AroundEdge {
  std::uint32_t corner;
  bool forward;  ///< runs from the lower vertex to the higher
  double angle;  ///< 0–4, rising with the angle around the edge
};

/// Rises with the angle of (x, y), from 0 to 4.
double turn_of(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0)) return 0;
  const double slope = y / sum;
  return x < 0 ? 2 - slope : slope < 0 ? 4 + slope : slope;
}

class Splitter {
 public:
  explicit Splitter(RepairWork& work) : work_(work) { look(); }

  void orient() {
    UnionFind patches(work_.mesh.face_count());
    std::vector<std::uint32_t> torn;
    for (std::uint32_t e = 0; e < edges_->size(); ++e) {
      const auto corners = edges_->uses_of(e);
      if (corners.size() != 2) continue;
      if (!patches.join(face_of(corners[0]), face_of(corners[1]), same_way(corners))) torn.push_back(e);
    }
    const std::vector<bool> turn = minorities(patches);
    bool any = false;
    for (std::uint32_t f = 0; f < turn.size(); ++f) {
      if (!turn[f]) continue;
      any = true;
      turn_face(f);
    }
    if (any) look();
  }

  /// Gives each fan of faces at a vertex a vertex of its own, where faces are connected across the edges of two and as
  /// paired around the others; then joins fans again that lie along one border.
  void split() {
    partner_.assign(work_.mesh.corner_count(), kNone);
    std::vector<AroundEdge> around;
    singular_.assign(work_.mesh.vertex_count(), false);
    for (std::uint32_t e = 0; e < edges_->size(); ++e) {
      const auto corners = edges_->uses_of(e);
      if (corners.size() < 2) continue;
      if (corners.size() == 2) {
        if (work_.options.orient && same_way(corners)) {
          note_split_edge(e);
        } else {
          pair(corners[0], corners[1]);
        }
        continue;
      }
      note_split_edge(e);
      pair_around(e, around);
    }
    number_fans();
    if (added_ > 0) join_along_borders();
    if (work_.result.count(RepairAction::SplitEdge) > 0) part_edges();
  }

 private:
  void look() {
    edges_ = work_.edges();
    faces_of_corners_ = work_.faces();
  }
  std::uint32_t vertex(std::size_t corner) const { return work_.mesh.corners[corner]; }
  std::uint32_t face_of(std::size_t corner) const { return (*faces_of_corners_)[corner]; }
  std::uint32_t next(std::uint32_t corner) const {
    return static_cast<std::uint32_t>(work_.next(corner, face_of(corner)));
  }
  bool same_way(std::span<const std::uint32_t> corners) const { return vertex(corners[0]) == vertex(corners[1]); }
  void pair(std::uint32_t a, std::uint32_t b) {
    partner_[a] = b;
    partner_[b] = a;
  }
  void note_split_edge(std::uint32_t e) {
    const auto& ends = edges_->vertices[e];
    for (const std::uint32_t v : ends) singular_[v] = true;
    work_.note(RepairAction::SplitEdge, 0.5F * work_.mesh.positions[ends[0]] + 0.5F * work_.mesh.positions[ends[1]]);
  }

  /// Of each patch, the faces that are turned against most of it.
  std::vector<bool> minorities(UnionFind& patches) const {
    const std::size_t count = work_.mesh.face_count();
    std::vector<std::uint32_t> total(count, 0);
    std::vector<std::uint32_t> odd(count, 0);
    std::vector<bool> turn(count);
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::uint32_t root = patches.root(f);
      turn[f] = patches.odd(f);
      ++total[root];
      if (turn[f]) ++odd[root];
    }
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::uint32_t root = patches.root(f);
      if (2 * odd[root] > total[root]) turn[f] = !turn[f];
    }
    return turn;
  }

  void turn_face(std::uint32_t f) {
    work_.turn(f);
    work_.turned[f] = true;
    work_.note(RepairAction::TurnedFace, work_.middle_of_face(f));
  }

  /// Going around the edge counter-clockwise, seen against its direction from the lower vertex to the higher, a face
  /// that runs backward is where the solid begins, and one that runs forward is where it ends: like brackets.
  void pair_around(std::uint32_t e, std::vector<AroundEdge>& around) {
    const glm::dvec3 axis = work_.position(edges_->vertices[e][1]) - work_.position(edges_->vertices[e][0]);
    const glm::dvec3 size = glm::abs(axis);
    glm::dvec3 aside(0);
    aside[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
    const glm::dvec3 across = glm::cross(axis, aside);
    const glm::dvec3 up = glm::cross(axis, across) / std::max(glm::length(axis), 1e-300);
    around.clear();
    for (const std::uint32_t corner : edges_->uses_of(e)) {
      const bool forward = vertex(corner) == edges_->vertices[e][0];
      const glm::dvec3 inward = glm::cross(work_.normal_of_face(face_of(corner)), forward ? axis : -axis);
      around.push_back({corner, forward, turn_of(glm::dot(inward, across), glm::dot(inward, up))});
    }
    std::stable_sort(around.begin(), around.end(),
                     [](const AroundEdge& a, const AroundEdge& b) { return a.angle < b.angle; });
    // Twice around: brackets that are opened before the start are closed after it.
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < 2 * around.size(); ++i) {
      const AroundEdge& each = around[i % around.size()];
      if (partner_[each.corner] != kNone) continue;
      if (!each.forward) {
        if (i < around.size()) open.push_back(each.corner);
        continue;
      }
      if (open.empty()) continue;
      pair(each.corner, open.back());
      open.pop_back();
    }
  }

  void number_fans() {
    const std::size_t count = work_.mesh.corner_count();
    UnionFind fans(count);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t other = partner_[c];
      if (other == kNone || other < c) continue;
      const bool opposite = vertex(c) != vertex(other);
      fans.unite(c, opposite ? next(other) : other);
      fans.unite(next(c), opposite ? other : next(other));
    }
    // Roots are the lowest corners: the first fan of a vertex keeps it.
    first_vertices_ = work_.mesh.vertex_count();
    std::vector<bool> taken(first_vertices_, false);
    Array<std::uint32_t> vertex_of_fan(count);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t root = fans.root(c);
      const std::uint32_t v = vertex(c);
      if (root == c) {
        if (!taken[v]) {
          taken[v] = true;
          vertex_of_fan[c] = v;
        } else {
          vertex_of_fan[c] = static_cast<std::uint32_t>(first_vertices_ + added_++);
          original_.push_back(v);
        }
      }
    }
    if (added_ == 0) return;
    for (std::uint32_t c = 0; c < count; ++c) work_.mesh.corners[c] = vertex_of_fan[fans.root(c)];
    work_.touch();
    for (const std::uint32_t v : original_) work_.add_vertex(work_.mesh.positions[v], work_.vertex_of[v]);
  }

  std::uint32_t original(std::uint32_t v) const { return v < first_vertices_ ? v : original_[v - first_vertices_]; }

  /// Walks along each border and, where it comes by the same place again, cuts off the loop between: there fans lie
  /// beside each other around one vertex, with holes between them.
  void join_along_borders() {
    Array<std::uint32_t> use_into(work_.mesh.vertex_count(), kNone);
    for (std::uint32_t c = 0; c < partner_.size(); ++c) {
      if (partner_[c] == kNone) use_into[vertex(next(c))] = c;
    }
    Array<std::uint32_t> becomes(work_.mesh.vertex_count());
    std::iota(becomes.begin(), becomes.end(), 0U);
    std::vector<bool> walked(work_.mesh.corner_count(), false);
    std::vector<std::uint32_t> place(first_vertices_, kNone);  // of an original on the stack
    std::vector<std::uint32_t> stack;
    for (std::uint32_t c = 0; c < partner_.size(); ++c) {
      if (partner_[c] != kNone || walked[c]) continue;
      stack.clear();
      for (std::uint32_t use = c; use != kNone && !walked[use]; use = use_into[vertex(use)]) {
        walked[use] = true;
        const std::uint32_t v = vertex(next(use));
        const std::uint32_t from = original(v);
        if (place[from] == kNone || singular_[from]) {
          place[from] = static_cast<std::uint32_t>(stack.size());
          stack.push_back(v);
          continue;
        }
        const std::uint32_t earlier = stack[place[from]];
        while (stack.size() > place[from] + 1) {
          place[original(stack.back())] = kNone;
          stack.pop_back();
        }
        const auto [low, high] = std::minmax({root_of(becomes, earlier), root_of(becomes, v)});
        becomes[high] = low;
      }
      for (const std::uint32_t v : stack) place[original(v)] = kNone;
    }
    for (std::uint32_t v = 0; v < becomes.size(); ++v) becomes[v] = root_of(becomes, v);
    for (std::size_t v = first_vertices_; v < becomes.size(); ++v) {
      if (becomes[v] == v) work_.note(RepairAction::SplitVertex, work_.mesh.positions[v]);
    }
    work_.renumber_vertices(becomes);
  }

  /// Pairs that still have both vertices in common, as their fans hang together elsewhere, get a vertex of their own in
  /// the middle of their edge.
  void part_edges() {
    look();
    std::map<std::uint32_t, std::uint32_t> after;  // of a corner, the vertex that follows it
    const std::size_t count = edges_->size();
    for (std::uint32_t e = 0; e < count; ++e) {
      const auto corners = edges_->uses_of(e);
      if (corners.size() < 2) continue;
      for (const std::uint32_t c : corners) {
        const std::uint32_t other = partner_[c];
        if (c == corners[0] || other == corners[0] || other < c) continue;
        const std::array<std::uint32_t, 2> ends{vertex(c), vertex(next(c))};
        const std::array<std::uint32_t, 2> rows{work_.vertex_of[ends[0]], work_.vertex_of[ends[1]]};
        const glm::vec3 middle = 0.5F * work_.mesh.positions[ends[0]] + 0.5F * work_.mesh.positions[ends[1]];
        after[c] = work_.add_vertex(middle, work_.rows.mix_vertices(rows, kHalves));
        if (other != kNone) after[other] = after[c];
        work_.note(RepairAction::SplitVertex, middle);
      }
    }
    if (!after.empty()) insert_vertices(after);
  }

  struct NewCorner {
    std::uint32_t vertex;
    std::uint32_t row;
  };

  void insert_vertices(const std::map<std::uint32_t, std::uint32_t>& after) {
    work_.touch();
    const Mesh before = std::exchange(work_.mesh, Mesh());
    work_.mesh.positions = before.positions;
    work_.mesh.lines = before.lines;
    if (!before.all_triangles()) work_.mesh.face_offsets = {0};
    const Array<std::uint32_t> corner_of = std::exchange(work_.corner_of, {});
    const Array<std::uint32_t> face_of = std::exchange(work_.face_of, {});
    const std::vector<bool> turned = std::exchange(work_.turned, {});
    work_.patch_of.clear();
    std::vector<NewCorner> face;
    for (std::uint32_t f = 0; f < before.face_count(); ++f) {
      face.clear();
      std::size_t first = 0;
      for (auto c = static_cast<std::uint32_t>(before.face_begin(f)); c < before.face_end(f); ++c) {
        face.push_back({before.corners[c], corner_of[c]});
        const auto found = after.find(c);
        if (found == after.end()) continue;
        const std::size_t after_c = c + 1 == before.face_end(f) ? before.face_begin(f) : c + 1;
        const std::array<std::uint32_t, 2> rows{corner_of[c], corner_of[after_c]};
        first = face.size();
        face.push_back({found->second, work_.rows.mix_corners(rows, kHalves)});
      }
      const std::size_t size = face.size();
      const std::size_t parts = before.all_triangles() ? size - 2 : 1;
      for (std::size_t i = 1; i <= parts; ++i) {
        const auto add = [&](const NewCorner& corner) {
          work_.mesh.corners.push_back(corner.vertex);
          work_.corner_of.push_back(corner.row);
        };
        if (parts == 1) {
          std::for_each(face.begin(), face.end(), add);
        } else {
          for (const std::size_t k : {first, first + i, first + i + 1}) add(face[k % size]);
        }
        work_.face_of.push_back(face_of[f]);
        work_.turned.push_back(turned[f]);
        work_.patch_of.push_back(RepairWork::kNoPatch);
        if (!before.all_triangles()) {
          work_.mesh.face_offsets.push_back(static_cast<std::uint32_t>(work_.mesh.corners.size()));
        }
      }
    }
  }

  static std::uint32_t root_of(const Array<std::uint32_t>& becomes, std::uint32_t v) {
    while (becomes[v] != v) v = becomes[v];
    return v;
  }

  RepairWork& work_;
  std::shared_ptr<const EdgeUses> edges_;
  std::shared_ptr<const Array<std::uint32_t>> faces_of_corners_;
  std::vector<std::uint32_t> partner_;  ///< of each corner, the other use of its edge in the same surface
  std::vector<bool> singular_;          ///< vertices of edges that are cut
  std::size_t first_vertices_ = 0;
  std::size_t added_ = 0;
  std::vector<std::uint32_t> original_;  ///< of each added vertex
};

}  // namespace

void orient_and_split(RepairWork& work) {
  Splitter splitter(work);
  if (work.options.orient) splitter.orient();
  if (work.options.split) splitter.split();
}

}  // namespace azulejo
