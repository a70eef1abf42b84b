#include "azulejo/modelling/topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/collinear.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/self_intersections.h"
#include "azulejo/modelling/union_find.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 13;

/// Elements that are found by tasks, in the order of their numbers.
class Finds {
 public:
  Finds(std::size_t elements, std::size_t listed) : parts_(elements / kChunk + 1), listed_(listed) {}
  void add(std::size_t element, const MeshFault& fault) {
    MeshFaults& part = parts_[element / kChunk];
    if (part.count++ < listed_) part.listed.push_back(fault);
  }
  MeshFaults all() && {
    MeshFaults all;
    for (const MeshFaults& part : parts_) {
      all.count += part.count;
      const std::size_t room = listed_ - std::min(listed_, all.listed.size());
      all.listed.insert(all.listed.end(), part.listed.begin(),
                        part.listed.begin() + static_cast<std::ptrdiff_t>(std::min(room, part.listed.size())));
    }
    return all;
  }

 private:
  std::vector<MeshFaults> parts_;
  std::size_t listed_;
};

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

class Survey {
 public:
  Survey(const Mesh& mesh, const TopologyOptions& options, const Run& run)
      : mesh_(mesh), options_(options), run_(run), listed_(static_cast<std::size_t>(options.listed)) {
    welded_ = weld_exactly(mesh.positions, run);
    uses_ = edge_uses(
        mesh, options.by_position ? std::span<const std::uint32_t>(welded_.corners) : std::span<const std::uint32_t>(),
        run);
    faces_of_corners_ = faces_of_corners(mesh, run);
    count_vertices_ = options.by_position ? welded_.positions.size() : mesh.vertex_count();
    first_at_.resize(welded_.positions.size());
    for (std::size_t v = mesh.vertex_count(); v-- > 0;) first_at_[welded_.corners[v]] = static_cast<std::uint32_t>(v);
  }

  Topology done() {
    previous_.assign(mesh_.corner_count(), EdgeUses::kNone);
    for (std::size_t c = 0; c < uses_.next.size(); ++c) {
      if (uses_.next[c] != EdgeUses::kNone) previous_[uses_.next[c]] = static_cast<std::uint32_t>(c);
    }
    look_at_vertices();
    look_at_edges();
    look_at_faces();
    look_at_fans();
    find_shells();
    find_holes();
    count_handles();
    if (options_.self_intersections) find_intersections();
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t kNone = EdgeUses::kNone;

  std::uint32_t vertex(std::size_t corner) const {
    return options_.by_position ? welded_.corners[mesh_.corners[corner]] : mesh_.corners[corner];
  }
  /// The first vertex of the mesh that is this one.
  std::uint32_t name_of(std::uint32_t v) const { return options_.by_position ? first_at_[v] : v; }
  const glm::vec3& position(std::uint32_t v) const {
    return options_.by_position ? welded_.positions[v] : mesh_.positions[v];
  }
  std::uint32_t face_of(std::uint32_t corner) const {
    return faces_of_corners_.empty() ? corner / 3 : faces_of_corners_[corner];
  }
  /// A face has edges.
  std::uint32_t first_corner(std::size_t face) const {
    for (std::size_t c = mesh_.face_begin(face); c < mesh_.face_end(face); ++c) {
      if (uses_.next[c] != kNone) return static_cast<std::uint32_t>(c);
    }
    return kNone;
  }
  bool same_way(std::uint32_t edge) const {
    const auto corners = uses_.uses_of(edge);
    return vertex(corners[0]) == vertex(corners[1]);
  }
  glm::vec3 middle_of_edge(std::size_t edge) const {
    return 0.5F * position(uses_.vertices[edge][0]) + 0.5F * position(uses_.vertices[edge][1]);
  }
  glm::vec3 middle_of_face(std::size_t face) const {
    glm::dvec3 sum(0);
    const std::size_t begin = mesh_.face_begin(face);
    const std::size_t end = mesh_.face_end(face);
    for (std::size_t c = begin; c < end; ++c) sum += glm::dvec3(mesh_.positions[mesh_.corners[c]]);
    return glm::vec3(sum / static_cast<double>(std::max<std::size_t>(end - begin, 1)));
  }
  MeshFaults& faults(MeshFaultKind kind) { return result_.faults[static_cast<std::size_t>(kind)]; }
  MeshFault edge_fault(std::size_t edge) const {
    return {name_of(uses_.vertices[edge][0]), name_of(uses_.vertices[edge][1]), middle_of_edge(edge)};
  }
  MeshFault face_fault(std::size_t face, std::uint32_t other = kNone) const {
    return {static_cast<std::uint32_t>(face), other, middle_of_face(face)};
  }

  void look_at_vertices() {
    corners_at_.assign(count_vertices_, 0);
    for (std::size_t c = 0; c < mesh_.corner_count(); ++c) corners_at_[vertex(c)] += uses_.next[c] != kNone ? 1 : 0;
    Finds unused(count_vertices_, listed_);
    Finds not_finite(count_vertices_, listed_);
    for (std::uint32_t v = 0; v < count_vertices_; ++v) {
      if (corners_at_[v] == 0) unused.add(v, {name_of(v), kNone, position(v)});
      if (!is_finite(position(v))) not_finite.add(v, {name_of(v), kNone, position(v)});
      result_.vertices += corners_at_[v] != 0 ? 1 : 0;
    }
    faults(MeshFaultKind::UnusedVertex) = std::move(unused).all();
    faults(MeshFaultKind::NotFiniteVertex) = std::move(not_finite).all();
    if (options_.by_position) return;
    Finds doubled(mesh_.vertex_count(), listed_);
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      const std::uint32_t first = first_at_[welded_.corners[v]];
      if (first != v) doubled.add(v, {v, first, mesh_.positions[v]});
    }
    faults(MeshFaultKind::DoubledVertex) = std::move(doubled).all();
  }

  void look_at_edges() {
    const std::size_t count = uses_.size();
    Finds border(count, listed_);
    Finds singular(count, listed_);
    Finds turned(count, listed_);
    parallel_for(count, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        const std::size_t uses = uses_.uses_of(e).size();
        if (uses == 1) border.add(e, edge_fault(e));
        if (uses > 2) singular.add(e, edge_fault(e));
        if (uses == 2 && same_way(static_cast<std::uint32_t>(e))) turned.add(e, edge_fault(e));
      }
    });
    result_.edges = count;
    faults(MeshFaultKind::BorderEdge) = std::move(border).all();
    faults(MeshFaultKind::SingularEdge) = std::move(singular).all();
    faults(MeshFaultKind::TurnedEdge) = std::move(turned).all();
    result_.regular_edges =
        count - result_.count(MeshFaultKind::BorderEdge) - result_.count(MeshFaultKind::SingularEdge);
    Finds loose(mesh_.lines.size() / 2, listed_);
    for (std::size_t i = 0; i + 1 < mesh_.lines.size(); i += 2) {
      const auto [a, b] = std::minmax(mesh_.lines[i], mesh_.lines[i + 1]);
      loose.add(i / 2, {a, b, 0.5F * mesh_.positions[a] + 0.5F * mesh_.positions[b]});
    }
    faults(MeshFaultKind::LooseEdge) = std::move(loose).all();
  }

  /// All corners of a face on one line.
  bool is_flat(std::size_t face) const {
    const std::uint32_t first = first_corner(face);
    const auto at = [&](std::uint32_t corner) { return glm::dvec3(mesh_.positions[mesh_.corners[corner]]); };
    const glm::dvec3 a = at(first);
    std::uint32_t second = uses_.next[first];
    while (second != first && at(second) == a) second = uses_.next[second];
    if (second == first) return true;
    for (std::uint32_t c = uses_.next[second]; c != first; c = uses_.next[c]) {
      if (!collinear(a, at(second), at(c))) return false;
    }
    return true;
  }

  /// The vertices of a face, rising.
  void vertices_of(std::uint32_t first, std::vector<std::uint32_t>& list) const {
    list.clear();
    std::uint32_t corner = first;
    do {
      list.push_back(vertex(corner));
      corner = uses_.next[corner];
    } while (corner != first);
    std::sort(list.begin(), list.end());
  }

  /// The corner of a face whose edge has the fewest faces.
  std::uint32_t rarest_edge(std::uint32_t first) const {
    std::uint32_t best = first;
    for (std::uint32_t c = uses_.next[first]; c != first; c = uses_.next[c]) {
      if (uses_.uses_of(uses_.of_corner[c]).size() < uses_.uses_of(uses_.of_corner[best]).size()) best = c;
    }
    return best;
  }

  /// The earliest face before this one that has the same vertices, of those along the edge of a corner; kNone.
  std::uint32_t earlier_twin(std::uint32_t face, std::uint32_t corner, std::vector<std::uint32_t>& mine,
                             std::vector<std::uint32_t>& others) const {
    mine.clear();
    for (const std::uint32_t use : uses_.uses_of(uses_.of_corner[corner])) {
      const std::uint32_t other = face_of(use);
      if (other >= face) break;
      if (mine.empty()) vertices_of(corner, mine);
      vertices_of(use, others);
      if (mine == others) return other;
    }
    return kNone;
  }

  /// The same for many faces, rising, that share all their edges with many: what has the same vertices is sorted to one
  /// place.
  void find_twins(const std::vector<std::uint32_t>& faces, std::vector<std::uint32_t>& twin_of) const {
    std::vector<std::uint32_t> mine;
    std::vector<std::uint32_t> others;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
    sorted.reserve(faces.size());
    for (const std::uint32_t face : faces) {
      vertices_of(first_corner(face), mine);
      std::uint64_t hash = mine.size();
      for (const std::uint32_t v : mine) hash = (hash ^ v) * 0x9E3779B97F4A7C15U + (hash >> 29);
      sorted.emplace_back(hash, face);
    }
    parallel_sort(sorted.begin(), sorted.end(), run_);
    for (std::size_t i = 0, group = 0; i < sorted.size(); ++i) {
      if (sorted[i].first != sorted[group].first) group = i;
      vertices_of(first_corner(sorted[i].second), mine);
      // Of one hash, nearly always of one set of vertices: the first is a twin, or has none itself.
      for (std::size_t j = group; j < i && twin_of[sorted[i].second] == kNone; ++j) {
        if (twin_of[sorted[j].second] != kNone) continue;
        vertices_of(first_corner(sorted[j].second), others);
        if (mine == others) twin_of[sorted[i].second] = sorted[j].second;
      }
    }
  }

  void look_at_faces() {
    constexpr std::size_t kFewFaces = 16;  // along an edge
    const std::size_t count = mesh_.face_count();
    Finds degenerate(count, listed_);
    Finds flat(count, listed_);
    std::vector<std::uint32_t> twin_of(count, kNone);
    std::vector<std::uint8_t> is_crowded(count, 0);
    parallel_for(count, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> mine;
      std::vector<std::uint32_t> others;
      for (std::size_t f = begin; f < end; ++f) {
        const std::uint32_t first = first_corner(f);
        if (first == kNone) {
          degenerate.add(f, face_fault(f));
          continue;
        }
        if (is_flat(f)) flat.add(f, face_fault(f));
        const std::uint32_t corner = rarest_edge(first);
        is_crowded[f] = uses_.uses_of(uses_.of_corner[corner]).size() > kFewFaces ? 1 : 0;
        if (is_crowded[f] == 0) twin_of[f] = earlier_twin(static_cast<std::uint32_t>(f), corner, mine, others);
      }
    });
    std::vector<std::uint32_t> crowded;
    for (std::uint32_t f = 0; f < count; ++f) {
      if (is_crowded[f] != 0) crowded.push_back(f);
    }
    find_twins(crowded, twin_of);
    Finds duplicate(count, listed_);
    for (std::size_t f = 0; f < count; ++f) {
      if (twin_of[f] != kNone) duplicate.add(f, face_fault(f, twin_of[f]));
    }
    is_duplicate_ = std::move(is_crowded);
    for (std::size_t f = 0; f < count; ++f) is_duplicate_[f] = twin_of[f] != kNone ? 1 : 0;
    faults(MeshFaultKind::DegenerateFace) = std::move(degenerate).all();
    faults(MeshFaultKind::FlatFace) = std::move(flat).all();
    faults(MeshFaultKind::DuplicateFace) = std::move(duplicate).all();
    result_.faces = count - result_.count(MeshFaultKind::DegenerateFace);
    result_.loops = result_.faces;
  }

  /// Corners that are passed, from one on, by going around its vertex over edges with two faces: first over the edge
  /// that leaves the corner, then, if that came to an end, over the one that arrives.
  std::uint32_t fan_size(std::uint32_t first) const {
    std::uint32_t passed = 1;
    for (const bool leaving_first : {true, false}) {
      std::uint32_t corner = first;
      bool leaving = leaving_first;
      for (;;) {
        const std::uint32_t along = leaving ? corner : previous_[corner];
        const auto uses = uses_.uses_of(uses_.of_corner[along]);
        if (uses.size() != 2) break;
        const std::uint32_t other = uses[0] == along ? uses[1] : uses[0];
        const bool same = vertex(other) == vertex(along);
        // The neighbor's corner at the vertex, and which of its two edges was not the one just passed.
        const bool other_leaves = same == leaving;
        corner = other_leaves ? other : uses_.next[other];
        leaving = !other_leaves;
        if (corner == first) return passed;
        if (++passed > corners_at_[vertex(first)]) return passed;
      }
    }
    return passed;
  }

  void look_at_fans() {
    // Each vertex begins at the first corner that it has.
    Array<std::uint32_t> first(count_vertices_);
    std::fill(first.begin(), first.end(), kNone);
    for (std::size_t c = mesh_.corner_count(); c-- > 0;) {
      if (uses_.next[c] != kNone) first[vertex(c)] = static_cast<std::uint32_t>(c);
    }
    at_singular_edge_.assign(count_vertices_, 0);
    for (std::size_t e = 0; e < uses_.size(); ++e) {
      if (uses_.uses_of(e).size() <= 2) continue;
      for (const std::uint32_t v : uses_.vertices[e]) at_singular_edge_[v] = 1;
    }
    singular_.assign(count_vertices_, 0);
    Finds singular(count_vertices_, listed_);
    parallel_for(count_vertices_, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        if (first[v] == kNone || at_singular_edge_[v] != 0 || fan_size(first[v]) == corners_at_[v]) continue;
        singular_[v] = 1;
        const auto index = static_cast<std::uint32_t>(v);
        singular.add(v, {name_of(index), kNone, position(index)});
      }
    });
    faults(MeshFaultKind::SingularVertex) = std::move(singular).all();
    for (std::size_t v = 0; v < count_vertices_; ++v) {
      result_.regular_vertices += corners_at_[v] != 0 && singular_[v] == 0 && at_singular_edge_[v] == 0 ? 1 : 0;
    }
  }

  void find_shells() {
    const std::size_t faces = mesh_.face_count();
    UnionFind by_edges(faces);
    // Of each face, whether it is turned against the one that stands for its shell.
    for (std::uint32_t e = 0; e < uses_.size(); ++e) {
      const auto corners = uses_.uses_of(e);
      for (std::size_t i = 1; i < corners.size(); ++i) {
        const bool turned = corners.size() == 2 && same_way(e);
        if (!by_edges.join(face_of(corners[0]), face_of(corners[i]), turned))
          unorientable_.push_back(face_of(corners[0]));
      }
    }
    shell_.assign(faces, kNone);
    std::vector<std::uint32_t> number(faces, kNone);
    for (std::uint32_t f = 0; f < faces; ++f) {
      if (first_corner(f) == kNone) continue;
      std::uint32_t& of_root = number[by_edges.root(f)];
      if (of_root == kNone) {
        of_root = static_cast<std::uint32_t>(result_.shells.size());
        result_.shells.emplace_back();
      }
      shell_[f] = of_root;
    }
    for (const std::uint32_t face : unorientable_) result_.shells[shell_[face]].orientable = false;
    for (std::uint32_t e = 0; e < uses_.size(); ++e) {
      const auto corners = uses_.uses_of(e);
      MeshShell& shell = result_.shells[shell_[face_of(corners[0])]];
      ++shell.edges;
      if (corners.size() == 1) shell.closed = false;
      if (corners.size() > 2) shell.manifold = shell.oriented = false;
      if (corners.size() == 2 && same_way(e)) shell.oriented = false;
    }
    measure_shells();
    count_shell_vertices();
  }

  void measure_shells() {
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      if (shell_[f] == kNone) continue;
      MeshShell& shell = result_.shells[shell_[f]];
      ++shell.faces;
      const std::uint32_t first = first_corner(f);
      const auto at = [&](std::uint32_t corner) { return glm::dvec3(mesh_.positions[mesh_.corners[corner]]); };
      const glm::dvec3 a = at(first);
      glm::dvec3 normal(0);
      std::uint32_t b = uses_.next[first];
      for (std::uint32_t c = uses_.next[b]; c != first; b = c, c = uses_.next[c]) {
        normal += glm::cross(at(b) - a, at(c) - a);
      }
      shell.area += 0.5 * glm::length(normal);
      shell.volume += glm::dot(a, normal) / 6;
    }
    for (std::size_t f = 0; f < is_duplicate_.size(); ++f) {
      if (is_duplicate_[f] != 0) result_.shells[shell_[f]].manifold = false;
    }
    for (MeshShell& shell : result_.shells) {
      if (!shell.closed || !shell.oriented) shell.volume = 0;
    }
  }

  /// A vertex counts in each shell that has it; those that are singular or join shells belong to no manifold.
  void count_shell_vertices() {
    UnionFind by_vertices(count_vertices_);
    std::vector<std::uint32_t> last(count_vertices_, kNone);
    for (std::uint32_t c = 0; c < mesh_.corner_count(); ++c) {
      if (uses_.next[c] == kNone) continue;
      const std::uint32_t v = vertex(c);
      by_vertices.join(v, vertex(uses_.next[c]), false);
      const std::uint32_t shell = shell_[face_of(c)];
      if (singular_[v] != 0) result_.shells[shell].manifold = false;
      if (last[v] == shell) continue;
      // Where shells take turns at a vertex it is singular: then the count is of no use, and not used.
      last[v] = shell;
      ++result_.shells[shell].vertices;
    }
    for (std::uint32_t v = 0; v < count_vertices_; ++v) {
      result_.components += corners_at_[v] != 0 && by_vertices.root(v) == v ? 1 : 0;
    }
  }

  /// Border edges that follow each other, where at each vertex two of them meet.
  void find_holes() {
    std::vector<std::uint32_t> first_edge(count_vertices_, kNone);
    hole_of_edge_.assign(uses_.size(), kNone);
    UnionFind joined(uses_.size());
    std::vector<std::uint32_t> border;
    for (std::uint32_t e = 0; e < uses_.size(); ++e) {
      if (uses_.uses_of(e).size() != 1) continue;
      border.push_back(e);
      for (const std::uint32_t v : uses_.vertices[e]) {
        if (singular_[v] != 0 || at_singular_edge_[v] != 0) continue;
        if (first_edge[v] == kNone) {
          first_edge[v] = e;
        } else {
          joined.join(first_edge[v], e, false);
        }
      }
    }
    std::vector<std::uint32_t> number(uses_.size(), kNone);
    for (const std::uint32_t e : border) {
      const std::uint32_t shell = shell_[face_of(uses_.uses_of(e)[0])];
      if (!result_.shells[shell].manifold) continue;
      std::uint32_t& hole = number[joined.root(e)];
      if (hole == kNone) {
        hole = static_cast<std::uint32_t>(result_.holes.size());
        result_.holes.push_back({name_of(uses_.vertices[e][0]), 0, 0, glm::vec3(0)});
        ++result_.shells[shell].holes;
      }
      hole_of_edge_[e] = hole;
      MeshHole& found = result_.holes[hole];
      found.vertex = std::min(found.vertex, name_of(uses_.vertices[e][0]));
      found.length +=
          static_cast<double>(glm::distance(position(uses_.vertices[e][0]), position(uses_.vertices[e][1])));
      // A running mean of the edges' middles.
      ++found.edges;
      found.place += (middle_of_edge(e) - found.place) / static_cast<float>(found.edges);
    }
  }

  /// Tree and cotree: edges that join vertices make a tree, of the others those that join faces (and holes) another one.
  /// What is left goes around a handle, two for each; of a surface that can't be oriented, one for each cross-cap.
  void count_handles() {
    UnionFind vertices(count_vertices_);
    UnionFind faces(mesh_.face_count() + result_.holes.size());
    std::vector<std::size_t> left(result_.shells.size(), 0);
    for (std::uint32_t e = 0; e < uses_.size(); ++e) {
      const auto corners = uses_.uses_of(e);
      const std::uint32_t shell = shell_[face_of(corners[0])];
      if (!result_.shells[shell].manifold || vertices.unite(uses_.vertices[e][0], uses_.vertices[e][1])) continue;
      const std::uint32_t other =
          corners.size() == 2 ? face_of(corners[1]) : static_cast<std::uint32_t>(mesh_.face_count()) + hole_of_edge_[e];
      left[shell] += faces.unite(face_of(corners[0]), other) ? 0 : 1;
    }
    for (std::size_t s = 0; s < left.size(); ++s) {
      MeshShell& shell = result_.shells[s];
      if (shell.manifold) shell.genus = shell.orientable ? left[s] / 2 : left[s];
    }
  }

  void find_intersections() {
    result_.self_intersections_looked_for = true;
    const std::vector<std::array<std::uint32_t, 2>> pairs = self_intersections(mesh_, welded_.corners, run_);
    MeshFaults& found = faults(MeshFaultKind::IntersectingFace);
    found.count = pairs.size();
    for (std::size_t i = 0; i < std::min(listed_, pairs.size()); ++i) {
      found.listed.push_back(face_fault(pairs[i][0], pairs[i][1]));
    }
  }

  const Mesh& mesh_;
  const TopologyOptions& options_;
  const Run& run_;
  std::size_t listed_;
  std::size_t count_vertices_ = 0;
  Welded welded_;
  Array<std::uint32_t> first_at_;  ///< of each position, the first vertex
  EdgeUses uses_;
  Array<std::uint32_t> faces_of_corners_;
  Array<std::uint32_t> previous_;
  Array<std::uint32_t> corners_at_;  ///< of faces with edges, by vertex
  std::vector<std::uint8_t> singular_;
  std::vector<std::uint8_t> at_singular_edge_;
  std::vector<std::uint8_t> is_duplicate_;  ///< of each face
  std::vector<std::uint32_t> shell_;        ///< of each face
  std::vector<std::uint32_t> unorientable_;
  std::vector<std::uint32_t> hole_of_edge_;
  Topology result_;
};

}  // namespace

bool Topology::manifold() const {
  for (const MeshFaultKind kind : {MeshFaultKind::SingularEdge, MeshFaultKind::SingularVertex,
                                   MeshFaultKind::DegenerateFace, MeshFaultKind::DuplicateFace}) {
    if (count(kind) > 0) return false;
  }
  return faces > 0;
}

bool Topology::closed() const { return manifold() && count(MeshFaultKind::BorderEdge) == 0; }

bool Topology::oriented() const {
  if (count(MeshFaultKind::TurnedEdge) > 0) return false;
  return std::all_of(shells.begin(), shells.end(), [](const MeshShell& shell) { return shell.orientable; });
}

bool Topology::printable() const {
  if (!closed() || !oriented() || count(MeshFaultKind::NotFiniteVertex) > 0) return false;
  if (count(MeshFaultKind::FlatFace) > 0 || count(MeshFaultKind::IntersectingFace) > 0) return false;
  const double volume = std::accumulate(shells.begin(), shells.end(), 0.0,
                                        [](double sum, const MeshShell& shell) { return sum + shell.volume; });
  return volume > 0;
}

std::optional<std::size_t> Topology::genus() const {
  std::size_t sum = 0;
  for (const MeshShell& shell : shells) {
    if (!shell.genus || !shell.orientable) return std::nullopt;
    sum += *shell.genus;
  }
  return sum;
}

std::optional<long> Topology::euler_poincare() const {
  const std::optional<std::size_t> handles = genus();
  if (!handles) return std::nullopt;
  const auto capped = static_cast<long>(holes.size());
  const long loops_without_faces = static_cast<long>(loops) - static_cast<long>(faces);
  return euler() + capped - loops_without_faces - 2 * (static_cast<long>(shells.size()) - static_cast<long>(*handles));
}

std::vector<std::string> Topology::euler_preconditions() const {
  std::vector<std::string> failing;
  if (!manifold()) failing.emplace_back("it is no manifold");
  if (count(MeshFaultKind::BorderEdge) > 0) failing.emplace_back("it is open");
  if (std::any_of(shells.begin(), shells.end(), [](const MeshShell& shell) { return !shell.orientable; })) {
    failing.emplace_back("it can't be oriented");
  }
  if (shells.size() > 1) failing.emplace_back("it has several shells");
  if (genus().value_or(0) > 0) failing.emplace_back("it has through-holes");
  return failing;
}

Topology topology(const Mesh& mesh, const TopologyOptions& options, const Run& run) {
  return Survey(mesh, options, run).done();
}

}  // namespace azulejo
