#pragma once

// Which elements of an OBJ file become one mesh.

#include <string_view>
#include <vector>

#include "azulejo/io/obj_parse.h"

namespace azulejo {

struct ObjRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

struct ObjObject {
  std::string_view name;  ///< of its event
  ObjRange vertices;      ///< that stand below it
  ObjRange faces;
  ObjRange line_ends;
  ObjRange points;
  bool has_elements() const { return faces.size() + line_ends.size() + points.size() > 0; }
};

/// The objects that become meshes, in the order of the file: those with elements; where none has any, those with
/// vertices, which are point clouds. One at least.
std::vector<ObjObject> obj_objects(const ObjData& data);

}  // namespace azulejo
