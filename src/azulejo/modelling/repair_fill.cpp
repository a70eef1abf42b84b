#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/hole_patch.h"
#include "azulejo/modelling/repair_work.h"
#include "azulejo/modelling/self_intersections.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr std::size_t kMostPoints = 50'000;  ///< new ones of a patch: its fairing takes half a second
constexpr std::size_t kPointsOfEdge = 20;    ///< and for each edge of the hole

/// How a patch is laid: the next one is flatter.
enum class Lay : std::uint8_t { Fair, Taut, Plain };

struct Hole {
  std::vector<std::uint32_t> uses;      ///< corners whose edges it is along, in the direction of its patch
  std::vector<std::uint32_t> vertices;  ///< of its rim: the second vertex of each of these
  HoleRim rim;
  HolePatch patch;
  Lay lay = Lay::Fair;
  bool pliable = false;   ///< it has points that can be laid otherwise
  std::size_t meets = 0;  ///< pairs of its faces and others that meet
};

class Filler {
 public:
  explicit Filler(RepairWork& work)
      : work_(work),
        edges_(work.edges()),
        faces_of_corners_(work.faces()),
        uses_(*edges_),
        faces_(*faces_of_corners_) {}

  void fill() {
    find_holes();
    if (holes_.empty()) return;
    measure_rims();
    parallel_for(holes_.size(), 1, work_.run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t h = begin; h < end; ++h) lay(holes_[h], work_.options.fair ? Lay::Fair : Lay::Plain);
    });
    for (Hole& hole : holes_) hole.pliable = work_.options.fair && !hole.patch.points.empty();
    lay_flatter_what_meets();
    for (const Hole& hole : holes_) add(hole);
  }

 private:
  std::uint32_t vertex(std::size_t corner) const { return work_.mesh.corners[corner]; }
  std::uint32_t next(std::uint32_t corner) const {
    return static_cast<std::uint32_t>(work_.next(corner, faces_[corner]));
  }
  std::uint32_t previous(std::uint32_t corner) const {
    const std::uint32_t face = faces_[corner];
    return static_cast<std::uint32_t>(corner == work_.mesh.face_begin(face) ? work_.mesh.face_end(face) - 1
                                                                            : corner - 1);
  }
  bool is_border(std::uint32_t corner) const {
    return uses_.of_corner[corner] != kNone && uses_.uses_of(uses_.of_corner[corner]).size() == 1;
  }

  /// The use of a border that arrives where this one leaves, in the same fan of faces; kNone where it is no fan.
  std::uint32_t next_along(std::uint32_t use) const {
    std::uint32_t corner = use;
    for (std::size_t step = 0; step < work_.mesh.corner_count(); ++step) {
      const std::uint32_t before = previous(corner);
      if (uses_.of_corner[before] == kNone) return kNone;
      const auto both = uses_.uses_of(uses_.of_corner[before]);
      if (both.size() == 1) return before;
      if (both.size() > 2) return kNone;
      const std::uint32_t other = both[0] == before ? both[1] : both[0];
      if (vertex(other) != vertex(corner)) return kNone;  // turned
      corner = other;
    }
    return kNone;
  }

  void find_holes() {
    std::vector<bool> walked(work_.mesh.corner_count(), false);
    Array<std::uint32_t> place(work_.mesh.vertex_count(), kNone);  // of a vertex on the stack
    std::vector<std::uint32_t> stack;
    for (std::uint32_t c = 0; c < walked.size(); ++c) {
      if (walked[c] || !is_border(c)) continue;
      stack.clear();
      std::uint32_t use = c;
      for (; use != kNone && !walked[use]; use = next_along(use)) {
        walked[use] = true;
        const std::uint32_t v = vertex(next(use));
        if (place[v] != kNone) {
          // Back at a vertex: what is between is a hole of its own.
          take_hole({stack.begin() + place[v], stack.end()});
          while (stack.size() > place[v] + 1) {
            place[vertex(next(stack.back()))] = kNone;
            stack.pop_back();
          }
          stack.back() = use;
          continue;
        }
        place[v] = static_cast<std::uint32_t>(stack.size());
        stack.push_back(use);
      }
      for (const std::uint32_t each : stack) place[vertex(next(each))] = kNone;
      if (use == c) {
        take_hole(stack);
      } else if (!stack.empty()) {
        work_.note(RepairAction::OpenHole, work_.mesh.positions[vertex(stack[0])]);
      }
    }
  }

  void take_hole(std::vector<std::uint32_t> uses) {
    const int most = work_.options.max_hole_edges.value_or(0);
    const bool too_large = work_.options.max_hole_edges && uses.size() > static_cast<std::size_t>(most);
    if (uses.size() < 3 || too_large) {
      work_.note(RepairAction::OpenHole, work_.mesh.positions[vertex(uses[0])]);
      return;
    }
    Hole& hole = holes_.emplace_back();
    hole.uses = std::move(uses);
    for (const std::uint32_t use : hole.uses) hole.vertices.push_back(vertex(next(use)));
  }

  void measure_rims() {
    struct Around {
      glm::dvec3 sum{0};
      double length = 0;
      std::uint32_t count = 0;
    };
    Array<std::uint32_t> number(work_.mesh.vertex_count(), kNone);
    std::uint32_t count = 0;
    for (const Hole& hole : holes_) {
      for (const std::uint32_t v : hole.vertices) number[v] = number[v] == kNone ? count++ : number[v];
    }
    std::vector<Around> around(count);
    for (const auto& [a, b] : uses_.vertices) {
      for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
        if (number[v] == kNone) continue;
        Around& at = around[number[v]];
        at.sum += work_.position(other);
        at.length += glm::distance(work_.position(a), work_.position(b));
        ++at.count;
      }
    }
    for (Hole& hole : holes_) {
      const std::size_t n = hole.vertices.size();
      for (std::size_t i = 0; i < n; ++i) {
        const Around& at = around[number[hole.vertices[i]]];
        const glm::dvec3 along =
            work_.position(hole.vertices[(i + 1) % n]) + work_.position(hole.vertices[(i + n - 1) % n]);
        hole.rim.points.push_back(work_.position(hole.vertices[i]));
        // Long edges beyond a finely divided rim tell nothing of what is wanted between.
        const double beside =
            glm::distance(work_.position(hole.vertices[i]), work_.position(hole.vertices[(i + 1) % n])) +
            glm::distance(work_.position(hole.vertices[i]), work_.position(hole.vertices[(i + n - 1) % n]));
        hole.rim.scale.push_back(std::min(at.length / at.count, beside));
        hole.rim.outside.push_back(at.sum - along);
        hole.rim.neighbors.push_back(at.count - 2);
        const glm::dvec3 normal = work_.normal_of_face(faces_[hole.uses[i]]);
        const double length = glm::length(normal);
        hole.rim.normals.push_back(length > 0 ? normal / length : glm::dvec3(0));
      }
    }
    for (Hole& hole : holes_) {
      hole.rim.joined = [this, &hole](std::uint32_t a, std::uint32_t b) {
        return find_edge(uses_, hole.vertices[a], hole.vertices[b]) != kNone || shared(hole, a, b);
      };
    }
    find_shared();
  }

  /// Vertices that several holes have: an edge between two of them may be made by one hole only.
  void find_shared() {
    std::map<std::uint32_t, std::size_t> first;
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      for (const std::uint32_t v : holes_[h].vertices) {
        if (!first.try_emplace(v, h).second) shared_.push_back(v);
      }
    }
    std::sort(shared_.begin(), shared_.end());
  }
  bool shared(const Hole& hole, std::uint32_t a, std::uint32_t b) const {
    return !shared_.empty() && std::binary_search(shared_.begin(), shared_.end(), hole.vertices[a]) &&
           std::binary_search(shared_.begin(), shared_.end(), hole.vertices[b]);
  }

  void lay(Hole& hole, Lay how) const {
    hole.lay = how;
    hole.patch = triangulate_hole(hole.rim);
    if (how == Lay::Plain) return;
    const Fairing fairing = how == Lay::Taut ? Fairing::Area : fairing_of(hole.rim, hole.patch);
    refine_patch(hole.rim, hole.patch, std::min(kMostPoints, kPointsOfEdge * hole.rim.size()));
    fair_patch(hole.rim, hole.patch, fairing);
  }

  /// Counts, for each hole that can be laid flatter, the pairs of its faces and others that meet.
  void count_meetings() {
    Mesh all = work_.mesh.clone();
    all.lines.clear();
    for (const Hole& hole : holes_) {
      if (!hole.pliable) add_faces(hole, all);
    }
    const auto from = static_cast<std::uint32_t>(all.face_count());
    std::vector<std::uint32_t> hole_of_face;
    for (std::uint32_t h = 0; h < holes_.size(); ++h) {
      if (!holes_[h].pliable) continue;
      add_faces(holes_[h], all);
      hole_of_face.resize(all.face_count() - from, h);
      holes_[h].meets = 0;
    }
    if (hole_of_face.empty()) return;
    const Welded welded = weld_exactly(all.positions, work_.run);
    const auto pairs = self_intersections_from(from, most_looks(hole_of_face.size()), all, welded.corners, work_.run);
    if (!pairs) return;
    for (const auto& pair : *pairs) {
      for (const std::uint32_t face : pair) {
        if (face >= from) ++holes_[hole_of_face[face - from]].meets;
      }
    }
  }

  static void add_faces(const Hole& hole, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    const auto rim = static_cast<std::uint32_t>(hole.rim.size());
    for (const glm::dvec3& p : hole.patch.points) mesh.positions.emplace_back(p);
    for (const auto& t : hole.patch.triangles) {
      for (const std::uint32_t v : t) mesh.corners.push_back(v < rim ? hole.vertices[v] : first + v - rim);
      if (!mesh.face_offsets.empty()) mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  }

  void lay_flatter_what_meets() {
    count_meetings();
    struct Laid {
      std::size_t hole;
      Lay lay;
      std::size_t meets;
    };
    std::vector<Laid> best;
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      if (holes_[h].meets > 0) best.push_back({h, Lay::Fair, holes_[h].meets});
    }
    if (best.empty()) return;
    for (const Lay how : {Lay::Taut, Lay::Plain}) {
      for (const Laid& each : best) {
        if (each.meets > 0) lay(holes_[each.hole], how);
      }
      count_meetings();
      for (Laid& each : best) {
        if (holes_[each.hole].lay == how && holes_[each.hole].meets < each.meets) {
          each.lay = how;
          each.meets = holes_[each.hole].meets;
        }
      }
    }
    for (const Laid& each : best) {
      if (holes_[each.hole].lay != each.lay) lay(holes_[each.hole], each.lay);
    }
  }

  /// The face beside the hole that stands for those with the most common material there.
  std::uint32_t model_face(const Hole& hole) const {
    std::map<std::uint32_t, std::size_t> counts;
    const auto material = [&](std::uint32_t use) {
      return work_.source.material.empty() ? 0 : work_.source.material[work_.face_of[faces_[use]]];
    };
    for (const std::uint32_t use : hole.uses) ++counts[material(use)];
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto found = std::find_if(hole.uses.begin(), hole.uses.end(),
                                    [&](std::uint32_t use) { return material(use) == most->first; });
    return work_.face_of[faces_[*found]];
  }

  void add(const Hole& hole) {
    const std::size_t n = hole.rim.size();
    std::vector<std::uint32_t> vertices = hole.vertices;
    std::vector<std::uint32_t> vertex_rows;
    std::vector<std::uint32_t> corner_rows;
    glm::dvec3 middle(0);
    for (std::size_t i = 0; i < n; ++i) {
      vertex_rows.push_back(work_.vertex_of[vertices[i]]);
      corner_rows.push_back(work_.corner_of[next(hole.uses[i])]);
      middle += hole.rim.points[i] / static_cast<double>(n);
    }
    const std::array<double, 3> third{1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (std::size_t i = 0; i < hole.patch.points.size(); ++i) {
      std::array<std::uint32_t, 3> rows{};
      const auto& parents = hole.patch.parents[i];
      for (std::size_t k = 0; k < 3; ++k) rows[k] = vertex_rows[parents[k]];
      vertex_rows.push_back(work_.rows.mix_vertices(rows, third));
      for (std::size_t k = 0; k < 3; ++k) rows[k] = corner_rows[parents[k]];
      corner_rows.push_back(work_.rows.mix_corners(rows, third));
      vertices.push_back(work_.add_vertex(glm::vec3(hole.patch.points[i]), vertex_rows.back()));
    }
    set_normals(hole, vertex_rows, corner_rows);
    const std::uint32_t face_row = model_face(hole);
    const auto patch = static_cast<std::uint32_t>(work_.patch_places.size());
    for (const auto& t : hole.patch.triangles) {
      work_.add_triangle({vertices[t[0]], vertices[t[1]], vertices[t[2]]},
                         {corner_rows[t[0]], corner_rows[t[1]], corner_rows[t[2]]}, face_row, patch);
    }
    work_.patch_places.emplace_back(middle);
  }

  /// Of new points, from the faces around them.
  void set_normals(const Hole& hole, const std::vector<std::uint32_t>& vertex_rows,
                   const std::vector<std::uint32_t>& corner_rows) {
    const std::size_t n = hole.rim.size();
    const auto at = [&](std::uint32_t v) { return v < n ? hole.rim.points[v] : hole.patch.points[v - n]; };
    std::vector<glm::dvec3> sums(hole.patch.points.size(), glm::dvec3(0));
    for (const auto& t : hole.patch.triangles) {
      const glm::dvec3 normal = glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
      for (const std::uint32_t v : t) {
        if (v >= n) sums[v - n] += normal;
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double length = glm::length(sums[i]);
      const glm::vec3 normal = length > 0 ? glm::vec3(sums[i] / length) : glm::vec3(0);
      work_.rows.set_vertex_normal(vertex_rows[n + i], normal);
      work_.rows.set_corner_normal(corner_rows[n + i], normal);
    }
  }

  RepairWork& work_;
  std::shared_ptr<const EdgeUses> edges_;
  std::shared_ptr<const Array<std::uint32_t>> faces_of_corners_;
  const EdgeUses& uses_;
  const Array<std::uint32_t>& faces_;
  std::vector<Hole> holes_;
  std::vector<std::uint32_t> shared_;
};

}  // namespace

void fill_holes(RepairWork& work) { Filler(work).fill(); }

}  // namespace azulejo
