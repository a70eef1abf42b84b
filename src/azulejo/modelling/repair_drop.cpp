#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/repair_work.h"
#include "azulejo/modelling/weld_vertices.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Corners of one face that make sense: no vertex twice in turn, no way there and back at once, no round twice.
class FaceCleaner {
 public:
  explicit FaceCleaner(const Mesh& mesh) : mesh_(mesh) {}

  /// Empty if it is no face. Corners in their order.
  const std::vector<std::size_t>& cleaned(std::size_t begin, std::size_t end) {
    kept_.clear();
    for (std::size_t c = begin; c < end; ++c) {
      if (!kept_.empty() && vertex(kept_.back()) == vertex(c)) continue;
      if (kept_.size() >= 2 && vertex(kept_[kept_.size() - 2]) == vertex(c)) {
        kept_.pop_back();
        continue;
      }
      kept_.push_back(c);
    }
    std::size_t first = 0;
    while (kept_.size() - first >= 2) {
      const std::size_t size = kept_.size();
      if (vertex(kept_[first]) == vertex(kept_.back())) {
        kept_.pop_back();
      } else if (vertex(kept_[first]) == vertex(kept_[size - 2])) {
        kept_.resize(size - 2);  // the last is a spike, the one before is the first again
        if (kept_.size() == first) break;
      } else if (size - first >= 2 && vertex(kept_[first + 1]) == vertex(kept_.back())) {
        ++first;  // the first is one
        kept_.pop_back();
      } else {
        break;
      }
    }
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(first));
    if (kept_.size() < 3) kept_.clear();
    if (kept_.size() > 3) take_one_round();
    return kept_;
  }

 private:
  std::uint32_t vertex(std::size_t corner) const { return mesh_.corners[corner]; }

  void take_one_round() {
    const std::size_t n = kept_.size();
    for (std::size_t period = 3; period <= n / 2; ++period) {
      if (vertex(kept_[period]) != vertex(kept_[0]) || n % period != 0) continue;
      bool repeats = true;
      for (std::size_t i = period; i < n && repeats; ++i) repeats = vertex(kept_[i]) == vertex(kept_[i - period]);
      if (!repeats) continue;
      kept_.resize(period);
      return;
    }
  }

  const Mesh& mesh_;
  std::vector<std::size_t> kept_;
};

bool is_sound_triangle(const Mesh& mesh, std::size_t face) {
  const std::uint32_t* const v = &mesh.corners[3 * face];
  return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

void drop_degenerate_triangles(RepairWork& work) {
  std::vector<bool> kept;
  for (std::size_t f = 0; f < work.mesh.face_count(); ++f) {
    if (is_sound_triangle(work.mesh, f)) continue;
    if (kept.empty()) kept.assign(work.mesh.face_count(), true);
    kept[f] = false;
    work.note(RepairAction::DegenerateFace, work.middle_of_face(f));
  }
  if (!kept.empty()) work.keep_faces(kept);
}

/// The vertices of a face, rising.
std::vector<std::uint32_t> sorted_vertices(const Mesh& mesh, std::size_t face) {
  std::vector<std::uint32_t> list(mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_begin(face)),
                                  mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_end(face)));
  std::sort(list.begin(), list.end());
  return list;
}

/// Whether a face of a group of the same vertices stays: where other faces leave an odd number of uses at most of its
/// edges, or there are none.
bool one_stays(const RepairWork& work, const EdgeUses& uses, std::size_t face, std::size_t group) {
  std::size_t odd = 0;
  std::size_t even = 0;
  std::size_t alone = 0;
  for (std::size_t c = work.mesh.face_begin(face); c < work.mesh.face_end(face); ++c) {
    if (uses.of_corner[c] == kNone) continue;
    const std::size_t all = uses.uses_of(uses.of_corner[c]).size();
    const std::size_t others = all - std::min(all, group);
    ++(others == 0 ? alone : others % 2 == 1 ? odd : even);
  }
  return odd + alone >= even;
}

/// Faces that may have a twin: no edge is used by them alone, and it isn't that the other face there is another one.
std::vector<std::uint32_t> twin_candidates(const RepairWork& work, const EdgeUses& uses,
                                           const Array<std::uint32_t>& faces) {
  std::vector<std::uint32_t> candidates;
  const Mesh& mesh = work.mesh;
  const auto opposite = [&](std::uint32_t use) {
    const std::uint32_t face = faces[use];
    return mesh.corners[work.next(work.next(use, face), face)];
  };
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::size_t begin = mesh.face_begin(f);
    const std::uint32_t edge = uses.of_corner[begin];
    if (edge == kNone) continue;
    const auto corners = uses.uses_of(edge);
    if (corners.size() < 2) continue;
    if (corners.size() == 2 && mesh.all_triangles() && opposite(corners[0]) != opposite(corners[1])) continue;
    candidates.push_back(f);
  }
  return candidates;
}

}  // namespace

void drop_not_finite(RepairWork& work) {
  Mesh& mesh = work.mesh;
  std::vector<bool> bad(mesh.vertex_count(), false);
  bool any = false;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (is_finite(mesh.positions[v])) continue;
    bad[v] = any = true;
  }
  if (!any) return;
  std::vector<bool> kept(mesh.face_count(), true);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
      if (bad[mesh.corners[c]]) kept[f] = false;
    }
    if (!kept[f]) work.note(RepairAction::NotFiniteFace, work.middle_of_face(f));
  }
  work.keep_faces(kept);
  std::size_t line = 0;
  for (std::size_t i = 0; i + 1 < mesh.lines.size(); i += 2) {
    if (bad[mesh.lines[i]] || bad[mesh.lines[i + 1]]) continue;
    mesh.lines[line++] = mesh.lines[i];
    mesh.lines[line++] = mesh.lines[i + 1];
  }
  mesh.lines.resize(line);
}

void drop_degenerate(RepairWork& work) {
  if (work.mesh.all_triangles()) return drop_degenerate_triangles(work);
  Mesh& mesh = work.mesh;
  FaceCleaner cleaner(mesh);
  std::vector<bool> kept(mesh.face_count(), true);
  bool any_dropped = false;
  std::size_t to = 0;
  std::size_t begin = 0;
  for (std::size_t f = 0; f < kept.size(); ++f) {
    const std::size_t end = mesh.face_end(f);
    const std::vector<std::size_t>& corners = cleaner.cleaned(begin, end);
    if (corners.size() != end - begin) work.note(RepairAction::DegenerateFace, work.middle_of_face(f));
    if (corners.empty()) kept[f] = !(any_dropped = true);
    // A face that goes keeps no corners; those that stay move down, never past what is still read.
    for (const std::size_t c : corners) {
      mesh.corners[to] = mesh.corners[c];
      work.corner_of[to++] = work.corner_of[c];
    }
    mesh.face_offsets[f + 1] = static_cast<std::uint32_t>(to);
    begin = end;
  }
  if (to != mesh.corner_count()) work.touch();
  mesh.corners.resize(to);
  work.corner_of.resize(to);
  if (any_dropped) work.keep_faces(kept);
}

void weld_borders(RepairWork& work) {
  const auto edges = work.edges();
  const EdgeUses& uses = *edges;
  std::vector<bool> at_border(work.mesh.vertex_count(), false);
  for (std::size_t e = 0; e < uses.size(); ++e) {
    if (uses.uses_of(e).size() != 1) continue;
    for (const std::uint32_t v : uses.vertices[e]) at_border[v] = true;
  }
  std::vector<std::uint32_t> vertices;
  Array<glm::vec3> places;
  for (std::uint32_t v = 0; v < at_border.size(); ++v) {
    if (!at_border[v]) continue;
    vertices.push_back(v);
    places.push_back(work.mesh.positions[v]);
  }
  const Box3 box = bounds(work.mesh);
  const double diagonal = box.empty() ? 0 : glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
  const double tolerance = std::max(static_cast<double>(work.options.tolerance),
                                    static_cast<double>(work.options.relative_tolerance) * diagonal);
  const Array<std::uint32_t> first = weld_vertices(places, {}, WeldMethod::Distance, tolerance, work.run);
  Array<std::uint32_t> becomes(work.mesh.vertex_count());
  std::iota(becomes.begin(), becomes.end(), 0U);
  bool any = false;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (first[i] == i) continue;
    becomes[vertices[i]] = vertices[first[i]];
    any = true;
    work.note(RepairAction::WeldedVertex, places[i]);
  }
  if (any) work.renumber_vertices(becomes);
}

void drop_duplicates(RepairWork& work) {
  const auto edges = work.edges();
  const EdgeUses& uses = *edges;
  const auto faces = work.faces();
  struct Candidate {
    std::vector<std::uint32_t> vertices;
    std::uint32_t face;
  };
  std::vector<Candidate> list;
  for (const std::uint32_t f : twin_candidates(work, uses, *faces)) list.push_back({sorted_vertices(work.mesh, f), f});
  std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.face < b.face;
  });
  std::vector<bool> kept(work.mesh.face_count(), true);
  std::vector<std::uint32_t> dropped;
  for (std::size_t i = 0; i < list.size();) {
    std::size_t end = i + 1;
    while (end < list.size() && list[end].vertices == list[i].vertices) ++end;
    if (end - i > 1) {
      const bool keep_first = one_stays(work, uses, list[i].face, end - i);
      for (std::size_t k = keep_first ? i + 1 : i; k < end; ++k) dropped.push_back(list[k].face);
    }
    i = end;
  }
  if (dropped.empty()) return;
  std::sort(dropped.begin(), dropped.end());
  for (const std::uint32_t f : dropped) {
    kept[f] = false;
    work.note(RepairAction::DuplicateFace, work.middle_of_face(f));
  }
  work.keep_faces(kept);
}

void drop_unused_vertices(RepairWork& work) {
  std::vector<bool> used(work.mesh.vertex_count(), false);
  for (const std::uint32_t v : work.mesh.corners) used[v] = true;
  for (const std::uint32_t v : work.mesh.lines) used[v] = true;
  Array<std::uint32_t> becomes(work.mesh.vertex_count());
  bool any = false;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    becomes[v] = used[v] ? v : kNone;
    if (used[v]) continue;
    any = true;
    // What drops with faces that went is told with those.
    if (work.vertex_of[v] < work.source.vertex_count()) work.note(RepairAction::UnusedVertex, work.mesh.positions[v]);
  }
  if (any) work.renumber_vertices(becomes);
}

}  // namespace azulejo
