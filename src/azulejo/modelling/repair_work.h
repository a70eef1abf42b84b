#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/element_rows.h"
#include "azulejo/modelling/repair.h"

namespace azulejo {

/// A mesh under repair: its places and faces, and where each element comes from.
struct RepairWork {
  RepairWork(const Mesh& from, const RepairOptions& with, const Run& context);

  const Mesh& source;
  const RepairOptions& options;
  const Run& run;
  Mesh mesh;                            ///< positions, corners, face_offsets and lines only
  Array<std::uint32_t> vertex_of;       ///< rows of `rows`
  Array<std::uint32_t> corner_of;       ///< rows of `rows`
  Array<std::uint32_t> face_of;         ///< faces of the source
  std::vector<bool> turned;             ///< of each face, whether a step turned it
  Array<std::uint32_t> patch_of;        ///< of each face, the patch; kNoPatch
  std::vector<glm::vec3> patch_places;  ///< of each patch, its hole's middle
  static constexpr std::uint32_t kNoPatch = 0xFFFFFFFF;
  ElementRows rows;
  RepairedMesh result;

  void note(RepairAction action, const glm::vec3& place);
  std::uint32_t vertex(std::size_t corner) const { return mesh.corners[corner]; }
  glm::dvec3 position(std::uint32_t v) const { return glm::dvec3(mesh.positions[v]); }
  glm::vec3 middle_of_face(std::size_t face) const;
  /// As long as twice its area.
  glm::dvec3 normal_of_face(std::size_t face) const;
  /// The corner after one, around its face.
  std::size_t next(std::size_t corner, std::size_t face) const {
    return corner + 1 == mesh.face_end(face) ? mesh.face_begin(face) : corner + 1;
  }

  /// Leaves out faces.
  void keep_faces(const std::vector<bool>& kept);
  /// Gives corners and lines other vertices, then leaves out those that are not `kept`.
  void renumber_vertices(const Array<std::uint32_t>& becomes);
  std::uint32_t add_vertex(const glm::vec3& position, std::uint32_t row);
  void add_triangle(const std::array<std::uint32_t, 3>& vertices, const std::array<std::uint32_t, 3>& corner_rows,
                    std::uint32_t face_row, std::uint32_t patch);
  /// The edges of the faces, and the face of each corner, as they are; kept until `touch`.
  std::shared_ptr<const EdgeUses> edges();
  std::shared_ptr<const Array<std::uint32_t>> faces();
  /// To be called after a change of corners or faces that none of the functions here made.
  void touch() {
    edges_.reset();
    faces_.reset();
  }
  /// Turns a face inside out; its first corner stays.
  void turn(std::size_t face);
  /// Where those of patches begin: they are the last.
  std::size_t first_patch_face() const;
  /// The mesh with attributes and all.
  Mesh done() const;

 private:
  std::shared_ptr<const EdgeUses> edges_;
  std::shared_ptr<const Array<std::uint32_t>> faces_;
};

/// The steps, in their order.
void drop_not_finite(RepairWork& work);
void drop_degenerate(RepairWork& work);
void weld_borders(RepairWork& work);
void drop_duplicates(RepairWork& work);
void orient_and_split(RepairWork& work);
void remove_flat_faces(RepairWork& work);
void fill_holes(RepairWork& work);
void sort_shells(RepairWork& work);
void drop_unused_vertices(RepairWork& work);

/// At how many pairs of faces to look for those that meet faces of patches, so many: some twenty are usual for each, but
/// where all lie on each other there are as many as their square.
inline std::size_t most_looks(std::size_t faces) { return 1'000'000 + 64 * faces; }

/// The edge between two vertices; EdgeUses::kNone if there is none.
std::uint32_t find_edge(const EdgeUses& uses, std::uint32_t a, std::uint32_t b);

}  // namespace azulejo
