#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "azulejo/math/predicates.h"
#include "azulejo/modelling/repair_work.h"
#include "azulejo/modelling/triangle_tree.h"
#include "azulejo/modelling/union_find.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr double kSheet = 1e-6;  ///< volume ÷ area^1.5 of what encloses nothing; of a plate, its thickness ÷ 3 sides

struct Shell {
  std::uint32_t first = 0;  ///< face
  bool closed = true;
  bool disagreed = false;  ///< some of its faces were turned
  double volume = 0;
  double area = 0;

  bool encloses() const { return closed && std::abs(volume) > kSheet * area * std::sqrt(area); }
};

/// Finds which shells a point is in. Faces count as the triangles from their first corner: for polygons of any shape
/// these are passed an odd number of times where the polygon is.
class Nesting {
 public:
  Nesting(const Mesh& mesh, const std::vector<std::uint32_t>& shell_of_face, const Run& run)
      : mesh_(mesh), shell_of_face_(shell_of_face), triangles_(fans(mesh)), tree_(boxes(), run) {
    right_ = bounds(mesh).upper.x;
  }

  /// In how many shells a face is, beside its own: an odd number of their faces are to its right.
  std::size_t depth(std::size_t face, std::uint32_t shell) const {
    const std::size_t begin = mesh_.face_begin(face);
    const std::size_t end = mesh_.face_end(face);
    glm::dvec3 point(0);  // sums of floats: in whichever order
    for (std::size_t c = begin; c < end; ++c) point += glm::dvec3(mesh_.positions[mesh_.corners[c]]);
    point /= static_cast<double>(end - begin);
    const glm::vec3 low(point - 1e-6 * glm::abs(point));
    const glm::vec3 high(point + 1e-6 * glm::abs(point));
    std::vector<std::uint32_t> hit;
    tree_.visit({low, {right_, high.y, high.z}}, [&](std::uint32_t triangle) {
      const std::uint32_t other = shell_of_face_[triangles_[triangle].face];
      if (other != shell && is_right(triangle, point)) hit.push_back(other);
    });
    std::sort(hit.begin(), hit.end());
    std::size_t depth = 0;
    for (std::size_t i = 0; i < hit.size();) {
      std::size_t after = i;
      while (after < hit.size() && hit[after] == hit[i]) ++after;
      depth += (after - i) % 2;
      i = after;
    }
    return depth;
  }

 private:
  struct Triangle {
    std::array<std::uint32_t, 3> vertices;
    std::uint32_t face;
  };
  static std::vector<Triangle> fans(const Mesh& mesh) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangle_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      const std::size_t begin = mesh.face_begin(f);
      for (std::size_t c = begin + 1; c + 1 < mesh.face_end(f); ++c) {
        triangles.push_back({{mesh.corners[begin], mesh.corners[c], mesh.corners[c + 1]}, f});
      }
    }
    return triangles;
  }
  std::vector<Box3> boxes() const {
    std::vector<Box3> boxes(triangles_.size());
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      for (const std::uint32_t v : triangles_[t].vertices) boxes[t] = united(boxes[t], mesh_.positions[v]);
    }
    return boxes;
  }
  /// Whether an edge's shadow along x is beyond the point in z, where it passes it in y. The same for both faces.
  static bool crosses(glm::dvec3 a, glm::dvec3 b, const glm::dvec3& p) {
    if ((a.y > p.y) == (b.y > p.y)) return false;
    if (a.y > b.y) std::swap(a, b);
    return orient2d({a.y, a.z}, {b.y, b.z}, {p.y, p.z}) < 0;
  }
  bool is_right(std::uint32_t triangle, const glm::dvec3& p) const {
    glm::dvec3 t[3];
    for (std::size_t i = 0; i < 3; ++i) t[i] = glm::dvec3(mesh_.positions[triangles_[triangle].vertices[i]]);
    const bool hit = crosses(t[0], t[1], p) != (crosses(t[1], t[2], p) != crosses(t[2], t[0], p));
    if (!hit) return false;
    // The determinant falls along x as fast as the shadow's area says.
    const double side = orient3d(t[0], t[1], t[2], p);
    const double facing = orient2d({t[0].y, t[0].z}, {t[1].y, t[1].z}, {t[2].y, t[2].z});
    return side != 0 && (side > 0) == (facing > 0);
  }

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& shell_of_face_;
  std::vector<Triangle> triangles_;
  TriangleTree tree_;
  float right_ = 0;
};

class ShellSorter {
 public:
  explicit ShellSorter(RepairWork& work) : work_(work) { find(); }

  /// Without any volume nothing is filled; else what has none goes.
  void drop_sheets() {
    const bool any = std::any_of(shells_.begin(), shells_.end(), [](const Shell& s) { return s.encloses(); });
    std::vector<bool> kept(work_.mesh.face_count(), true);
    if (any) {
      drop_shells(RepairAction::Sheet, kept, [](const Shell& s, std::uint32_t) { return s.closed && !s.encloses(); });
    } else {
      for (std::size_t f = 0; f < kept.size(); ++f) {
        if (work_.patch_of[f] == RepairWork::kNoPatch || !shells_[shell_of_face_[f]].closed) continue;
        kept[f] = false;
        opened_.push_back(work_.patch_of[f]);
      }
    }
    keep(kept);
  }

  void turn_outward() {
    const auto doubtful = [](const Shell& s) { return s.encloses() && (s.volume < 0 || s.disagreed); };
    std::vector<bool> turn(shells_.size(), false);
    if (shells_.size() > 1 && std::any_of(shells_.begin(), shells_.end(), doubtful)) {
      const Nesting nesting(work_.mesh, shell_of_face_, work_.run);
      for (std::uint32_t s = 0; s < shells_.size(); ++s) {
        const Shell& shell = shells_[s];
        if (!doubtful(shell)) continue;
        const std::size_t depth = nesting.depth(shell.first, s);
        // What agreed and lies within another stays as it is: a cavity, or a body in one.
        if (depth == 0 || shell.disagreed) turn[s] = (shell.volume < 0) != (depth % 2 == 1);
      }
    } else if (shells_.size() == 1) {
      turn[0] = shells_[0].encloses() && shells_[0].volume < 0;
    }
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      if (turn[s]) work_.note(RepairAction::TurnedShell, work_.middle_of_face(shells_[s].first));
    }
    for (std::uint32_t f = 0; f < work_.mesh.face_count(); ++f) {
      if (turn[shell_of_face_[f]]) work_.turn(f);
    }
  }

  void drop_inside() {
    if (shells_.size() < 2) return;
    std::vector<bool> kept(work_.mesh.face_count(), true);
    const Nesting nesting(work_.mesh, shell_of_face_, work_.run);
    drop_shells(RepairAction::InsideShell, kept,
                [&](const Shell& shell, std::uint32_t s) { return nesting.depth(shell.first, s) > 0; });
    keep(kept);
  }

  /// Tells of the patches that stayed, and of those that were taken out.
  void note_holes() {
    std::vector<std::uint8_t> kinds(work_.patch_places.size(), 0);
    for (const std::uint32_t patch : work_.patch_of) {
      if (patch != RepairWork::kNoPatch) kinds[patch] = 1;
    }
    for (const std::uint32_t patch : opened_) kinds[patch] = 2;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (kinds[i] == 0) continue;
      work_.note(kinds[i] == 1 ? RepairAction::FilledHole : RepairAction::OpenHole, work_.patch_places[i]);
    }
  }

  bool all_enclose() const {
    return !shells_.empty() && std::all_of(shells_.begin(), shells_.end(), [](const Shell& s) { return s.encloses(); });
  }

 private:
  void find() {
    const auto edges = work_.edges();
    const auto faces_of_corners = work_.faces();
    const EdgeUses& uses = *edges;
    const Array<std::uint32_t>& faces = *faces_of_corners;
    const std::size_t count = work_.mesh.face_count();
    UnionFind joined(count);
    for (std::uint32_t e = 0; e < uses.size(); ++e) {
      const auto corners = uses.uses_of(e);
      for (std::size_t i = 1; i < corners.size(); ++i) joined.unite(faces[corners[0]], faces[corners[i]]);
    }
    shells_.clear();
    shell_of_face_.assign(count, kNone);
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::uint32_t root = joined.root(f);  // the lowest
      if (root == f) {
        shell_of_face_[f] = static_cast<std::uint32_t>(shells_.size());
        shells_.push_back({f, true, false, 0, 0});
      } else {
        shell_of_face_[f] = shell_of_face_[root];
      }
      measure(f, shells_[shell_of_face_[f]]);
    }
    for (std::uint32_t e = 0; e < uses.size(); ++e) {
      const auto corners = uses.uses_of(e);
      const bool sound = corners.size() == 2 && work_.vertex(corners[0]) != work_.vertex(corners[1]);
      if (!sound) shells_[shell_of_face_[faces[corners[0]]]].closed = false;
    }
  }

  void measure(std::uint32_t f, Shell& shell) const {
    const glm::dvec3 origin = work_.position(work_.vertex(work_.mesh.face_begin(shell.first)));
    const std::size_t begin = work_.mesh.face_begin(f);
    const std::size_t end = work_.mesh.face_end(f);
    const glm::dvec3 a = work_.position(work_.vertex(begin)) - origin;
    glm::dvec3 normal(0);
    for (std::size_t c = begin + 1; c + 1 < end; ++c) {
      normal +=
          glm::cross(work_.position(work_.vertex(c)) - origin - a, work_.position(work_.vertex(c + 1)) - origin - a);
    }
    shell.area += 0.5 * glm::length(normal);
    shell.volume += glm::dot(a, normal) / 6;
    shell.disagreed = shell.disagreed || work_.turned[f];
  }

  template <class Goes>
  void drop_shells(RepairAction action, std::vector<bool>& kept, Goes goes) {
    std::vector<bool> gone(shells_.size(), false);
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      gone[s] = goes(shells_[s], s);
      if (gone[s]) work_.note(action, work_.middle_of_face(shells_[s].first));
    }
    for (std::size_t f = 0; f < kept.size(); ++f) kept[f] = !gone[shell_of_face_[f]];
  }

  void keep(const std::vector<bool>& kept) {
    if (std::find(kept.begin(), kept.end(), false) == kept.end()) return;
    work_.keep_faces(kept);
    find();
  }

  RepairWork& work_;
  std::vector<Shell> shells_;
  std::vector<std::uint32_t> shell_of_face_;
  std::vector<std::uint32_t> opened_;  ///< patches that were taken out
};

}  // namespace

void sort_shells(RepairWork& work) {
  ShellSorter sorter(work);
  if (work.options.drop) sorter.drop_sheets();
  if (work.options.orient) sorter.turn_outward();
  if (work.options.remove_inside) sorter.drop_inside();
  sorter.note_holes();
  work.result.solid = sorter.all_enclose();
}

}  // namespace azulejo
