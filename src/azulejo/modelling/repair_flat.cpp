#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <queue>
#include <set>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/collinear.h"
#include "azulejo/modelling/repair_work.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// A corner of a face that is edited.
struct Corner {
  std::uint32_t vertex;
  std::uint32_t row;
};
using Corners = std::vector<Corner>;

/// Faces of a mesh that can be changed, and found by their edges.
class EditedFaces {
 public:
  explicit EditedFaces(RepairWork& work)
      : work_(work),
        edges_(work.edges()),
        faces_of_corners_(work.faces()),
        uses_(*edges_),
        faces_(*faces_of_corners_) {}

  Corners corners(std::uint32_t face) const {
    if (const auto found = edited_.find(face); found != edited_.end()) return found->second;
    Corners list;
    for (std::size_t c = work_.mesh.face_begin(face); c < work_.mesh.face_end(face); ++c) {
      list.push_back({work_.mesh.corners[c], work_.corner_of[c]});
    }
    return list;
  }
  /// The face that runs from a to b; kNone.
  std::uint32_t running(std::uint32_t a, std::uint32_t b) const {
    if (const auto found = runs_.find(key(a, b)); found != runs_.end()) return found->second;
    const std::uint32_t edge = find_edge(uses_, a, b);
    if (edge == kNone) return kNone;
    for (const std::uint32_t use : uses_.uses_of(edge)) {
      if (work_.mesh.corners[use] == a && edited_.count(faces_[use]) == 0) return faces_[use];
    }
    return kNone;
  }
  bool joined(std::uint32_t a, std::uint32_t b) const { return running(a, b) != kNone || running(b, a) != kNone; }

  /// Replaces a face; an empty one goes. A face beyond the last is new.
  void set(std::uint32_t face, Corners corners) {
    for_edges(this->corners(face), [&](std::uint32_t a, std::uint32_t b) { runs_[key(a, b)] = kNone; });
    replace(face, std::move(corners));
  }
  /// Replaces two at once, so that an edge may go from one to the other.
  void set(std::uint32_t face, Corners corners, std::uint32_t other, Corners others) {
    for (const std::uint32_t each : {face, other}) {
      for_edges(this->corners(each), [&](std::uint32_t a, std::uint32_t b) { runs_[key(a, b)] = kNone; });
    }
    replace(face, std::move(corners));
    replace(other, std::move(others));
  }

  /// Puts the changes into the mesh.
  void apply() {
    if (edited_.empty()) return;
    work_.touch();
    Mesh after;
    after.positions = std::move(work_.mesh.positions);
    after.lines = std::move(work_.mesh.lines);
    if (!work_.mesh.all_triangles()) after.face_offsets = {0};
    Array<std::uint32_t> corner_of;
    Array<std::uint32_t> face_of;
    std::vector<bool> turned;
    Array<std::uint32_t> patch_of;
    for (std::uint32_t f = 0; f < work_.mesh.face_count(); ++f) {
      const Corners list = corners(f);
      if (list.empty()) continue;
      for (const Corner& each : list) {
        after.corners.push_back(each.vertex);
        corner_of.push_back(each.row);
      }
      face_of.push_back(work_.face_of[f]);
      turned.push_back(work_.turned[f]);
      patch_of.push_back(work_.patch_of[f]);
      if (!after.face_offsets.empty()) after.face_offsets.push_back(static_cast<std::uint32_t>(after.corners.size()));
    }
    work_.mesh = std::move(after);
    work_.corner_of = std::move(corner_of);
    work_.face_of = std::move(face_of);
    work_.turned = std::move(turned);
    work_.patch_of = std::move(patch_of);
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }
  template <class F>
  static void for_edges(const Corners& corners, F f) {
    for (std::size_t i = 0; i < corners.size(); ++i) f(corners[i].vertex, corners[(i + 1) % corners.size()].vertex);
  }
  void replace(std::uint32_t face, Corners corners) {
    for_edges(corners, [&](std::uint32_t a, std::uint32_t b) { runs_[key(a, b)] = face; });
    edited_[face] = std::move(corners);
  }

  RepairWork& work_;
  std::shared_ptr<const EdgeUses> edges_;
  std::shared_ptr<const Array<std::uint32_t>> faces_of_corners_;
  const EdgeUses& uses_;
  const Array<std::uint32_t>& faces_;
  std::unordered_map<std::uint32_t, Corners> edited_;
  std::unordered_map<std::uint64_t, std::uint32_t> runs_;  ///< of edges that were edited
};

class Flattener {
 public:
  explicit Flattener(RepairWork& work) : work_(work), faces_(work) {}

  void remove(const std::vector<std::uint32_t>& flat) {
    for (const std::uint32_t face : flat) push(face);
    std::size_t left = 64 * flat.size() + 1024;  // flips of flat faces into each other end; this makes it sure
    while (!waiting_.empty() && left-- > 0) {
      const std::uint32_t face = waiting_.top().second;
      waiting_.pop();
      const Corners corners = faces_.corners(face);
      if (corners.empty() || !is_flat(corners)) continue;
      const bool gone = corners.size() == 3 && (collapse(face, corners) || give_away(face, corners));
      if (gone) {
        work_.note(RepairAction::FlatFace, work_.mesh.positions[corners[0].vertex]);
      } else {
        stubborn_.push_back(face);
      }
    }
    for (; !waiting_.empty(); waiting_.pop()) stubborn_.push_back(waiting_.top().second);
    for (const std::uint32_t face : stubborn_) {
      const Corners corners = faces_.corners(face);
      if (!corners.empty() && is_flat(corners)) bend(face, corners);
    }
    faces_.apply();
  }

 private:
  glm::dvec3 at(const Corner& corner) const { return work_.position(corner.vertex); }
  bool is_flat(const Corners& corners) const {
    // Corners at the place of the first tell nothing.
    std::size_t second = 1;
    while (second < corners.size() && at(corners[second]) == at(corners[0])) ++second;
    for (std::size_t i = second + 1; i < corners.size(); ++i) {
      if (!collinear(at(corners[0]), at(corners[second]), at(corners[i]))) return false;
    }
    return true;
  }
  void push(std::uint32_t face) {
    const Corners corners = faces_.corners(face);
    double longest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      longest = std::max(longest, glm::distance(at(corners[i]), at(corners[(i + 1) % corners.size()])));
    }
    waiting_.emplace(longest, face);
  }
  void push_if_flat(std::uint32_t face) {
    if (is_flat(faces_.corners(face))) push(face);
  }

  /// The faces around a vertex, from one on, if they close; else none.
  std::vector<std::uint32_t> fan(std::uint32_t face, std::uint32_t vertex) const {
    std::vector<std::uint32_t> list;
    std::uint32_t each = face;
    do {
      const Corners corners = faces_.corners(each);
      const auto here =
          std::find_if(corners.begin(), corners.end(), [&](const Corner& c) { return c.vertex == vertex; });
      if (here == corners.end() || list.size() > 4096) return {};
      list.push_back(each);
      const Corner& before = here == corners.begin() ? corners.back() : *(here - 1);
      each = faces_.running(vertex, before.vertex);
      if (each == kNone) return {};
    } while (each != face);
    return list;
  }

  /// Two corners at one place become one, if nothing else hangs on it.
  bool collapse(std::uint32_t face, const Corners& corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t keep = corners[i].vertex;
      const std::uint32_t go = corners[(i + 1) % 3].vertex;
      if (at(corners[i]) == at(corners[(i + 1) % 3]) && collapse_edge(face, keep, go)) return true;
    }
    return false;
  }
  bool collapse_edge(std::uint32_t face, std::uint32_t keep, std::uint32_t go) {
    const std::vector<std::uint32_t> around_keep = fan(face, keep);
    const std::vector<std::uint32_t> around_go = fan(face, go);
    if (around_keep.empty() || around_go.empty()) return false;
    const auto neighbors = [&](const std::vector<std::uint32_t>& faces) {
      std::set<std::uint32_t> set;
      for (const std::uint32_t each : faces) {
        for (const Corner& corner : faces_.corners(each)) set.insert(corner.vertex);
      }
      return set;
    };
    const std::set<std::uint32_t> of_keep = neighbors(around_keep);
    const std::set<std::uint32_t> of_go = neighbors(around_go);
    std::size_t common = 0;
    for (const std::uint32_t v : of_keep) common += of_go.count(v);
    // Both ends and the two opposite corners; a tetrahedron has no room.
    if (common != 4 || around_keep.size() + around_go.size() <= 6) return false;
    for (const std::uint32_t each : around_go) {
      Corners list = faces_.corners(each);
      const bool has_both = std::any_of(list.begin(), list.end(), [&](const Corner& c) { return c.vertex == keep; });
      if (has_both && list.size() != 3) return false;
    }
    std::vector<std::pair<std::uint32_t, Corners>> changed;
    for (const std::uint32_t each : around_go) {
      Corners list = faces_.corners(each);
      const bool has_both = std::any_of(list.begin(), list.end(), [&](const Corner& c) { return c.vertex == keep; });
      for (Corner& c : list) c.vertex = c.vertex == go ? keep : c.vertex;
      changed.emplace_back(each, has_both ? Corners() : std::move(list));
    }
    for (const auto& [each, list] : changed) faces_.set(each, {});
    for (const auto& [each, list] : changed) {
      if (list.empty()) continue;
      faces_.set(each, list);
      push_if_flat(each);
    }
    return true;
  }

  /// The corner between the others goes into the neighbor's edge beside it.
  bool give_away(std::uint32_t face, const Corners& corners) {
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = glm::distance(at(corners[i]), at(corners[(i + 1) % 3]));
      if (length > most) {
        most = length;
        longest = i;
      }
    }
    const Corner from = corners[longest];
    const Corner to = corners[(longest + 1) % 3];
    const Corner between = corners[(longest + 2) % 3];
    const std::uint32_t neighbor = faces_.running(to.vertex, from.vertex);
    if (neighbor == kNone) {
      if (faces_.running(from.vertex, to.vertex) != face) return false;
      faces_.set(face, {});
      return true;
    }
    Corners list = faces_.corners(neighbor);
    const auto is_between = [&](const Corner& c) { return c.vertex == between.vertex; };
    if (std::any_of(list.begin(), list.end(), is_between)) return false;
    std::size_t start = 0;
    while (list[start].vertex != to.vertex) ++start;
    std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(start), list.end());
    const double length = std::max(most, std::numeric_limits<double>::min());
    const double share = std::clamp(glm::distance(at(to), at(between)) / length, 0.0, 1.0);
    const std::array<std::uint32_t, 2> rows{list[0].row, list[1].row};
    const std::array<double, 2> weights{1 - share, share};
    if (list.size() > 3) {
      list.insert(list.begin() + 1, {between.vertex, work_.rows.mix_corners(rows, weights)});
      faces_.set(face, {}, neighbor, list);
      push_if_flat(neighbor);
      return true;
    }
    if (faces_.joined(between.vertex, list[2].vertex)) return false;
    const Corner inserted{between.vertex, work_.rows.mix_corners(rows, weights)};
    faces_.set(face, {list[0], inserted, list[2]}, neighbor, {inserted, list[1], list[2]});
    // The face now is a part of its neighbor.
    work_.face_of[face] = work_.face_of[neighbor];
    push_if_flat(face);
    push_if_flat(neighbor);
    return true;
  }

  /// Moves a corner by as little as makes a triangle with an area of each face around it.
  void bend(std::uint32_t face, const Corners& corners) {
    for (const Corner& corner : corners) {
      std::vector<std::uint32_t> around = fan(face, corner.vertex);
      if (around.empty()) around = {face};
      glm::vec3& place = work_.mesh.positions[corner.vertex];
      const glm::vec3 before = place;
      const float size = std::max({std::abs(before.x), std::abs(before.y), std::abs(before.z), 1e-30F});
      for (float step = size * 0x1p-22F; step < size * 0x1p-8F; step *= 4) {
        for (int direction = 0; direction < 6; ++direction) {
          place = before;
          place[direction / 2] += direction % 2 == 0 ? step : -step;
          const bool sound = std::none_of(around.begin(), around.end(),
                                          [&](std::uint32_t each) { return is_flat(faces_.corners(each)); });
          if (!sound) continue;
          work_.note(RepairAction::MovedVertex, before);
          return;
        }
      }
      place = before;
    }
  }

  RepairWork& work_;
  EditedFaces faces_;
  std::priority_queue<std::pair<double, std::uint32_t>> waiting_;  ///< those with the longest edges first
  std::vector<std::uint32_t> stubborn_;
};

bool is_flat_face(const RepairWork& work, std::size_t face) {
  const std::size_t begin = work.mesh.face_begin(face);
  const glm::dvec3 a = work.position(work.vertex(begin));
  const glm::dvec3 b = work.position(work.vertex(begin + 1));
  for (std::size_t c = begin + 2; c < work.mesh.face_end(face); ++c) {
    if (!collinear(a, b, work.position(work.vertex(c)))) return false;
  }
  return true;
}

}  // namespace

void remove_flat_faces(RepairWork& work) {
  constexpr std::size_t kChunk = 8192;
  std::vector<std::vector<std::uint32_t>> parts(work.mesh.face_count() / kChunk + 1);
  parallel_for(work.mesh.face_count(), kChunk, work.run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (is_flat_face(work, f)) parts[begin / kChunk].push_back(static_cast<std::uint32_t>(f));
    }
  });
  std::vector<std::uint32_t> flat;
  for (const auto& part : parts) flat.insert(flat.end(), part.begin(), part.end());
  if (!flat.empty()) Flattener(work).remove(flat);
}

}  // namespace azulejo
