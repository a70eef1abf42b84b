#pragma once

#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/io/ply_header.h"
#include "azulejo/io/ply_rows.h"

namespace azulejo {

/// What the properties of a PLY file mean: makes room in a mesh for them before the rows are read, and faces of the
/// lists afterwards.
///
/// vertex     x y z positions; nx ny nz NORMAL; red green blue [alpha] COLOR_0, u8 where they are integers, else f32;
///            s t, u v, texture_u texture_v TEXCOORD_0 (v is upwards in the file and turned)
/// face       vertex_indices or vertex_index; red green blue [alpha] COLOR_0; texcoord TEXCOORD_0 of corners
/// tristrips  vertex_indices: strips ended by -1, every other triangle turned; those of no area in them are left out
/// edge       vertex1 vertex2: lines
/// Other scalars of vertices and faces are attributes under their own names: uchar u8, ushort and uint u32, others f32.
class PlyMesh {
 public:
  /// Throws Error(Data) where vertices have no positions.
  PlyMesh(const PlyHeader& header, const std::string& name);

  std::vector<PlyRows>& rows() { return rows_; }
  /// Once the rows are read. Warns of what was lost.
  Mesh finish(const Run& run);

 private:
  void plan_vertices(const PlyElement& element, PlyRows& rows);
  void plan_faces(const PlyElement& element, PlyRows& rows);
  void plan_colors(const PlyElement& element, Domain domain, PlyRows& rows);
  void plan_edges(const PlyElement& element, PlyRows& rows);
  void plan_others(const PlyElement& element, Domain domain, PlyRows& rows);
  void add_faces(const Run& run);
  void add_strips(const Run& run);
  void add_corner_texcoords(const Run& run);
  void warn_of_losses(const Run& run) const;

  std::string name_;
  Mesh mesh_;
  std::vector<PlyRows> rows_;        ///< one an element
  const PlyRows* faces_ = nullptr;   ///< null: none
  const PlyRows* strips_ = nullptr;  ///< null: none
  bool faces_have_attributes_ = false;
};

}  // namespace azulejo
