#pragma once

#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/subdivision_level.h"

namespace azulejo::subdivision {

/// Values that are weighed on their way through the levels: an attribute, or the differences of a morph target.
struct Weighed {
  std::string name;
  int components = 1;
  bool bytes = false;  ///< it was, and will be, u8
  Array<float> values;

  Weighed(const Attribute& attribute);
  Weighed(const MorphTarget& target);
  Attribute attribute(Domain domain) &&;
  void into(MorphTarget& target) &&;
};

/// Numbers that are handed on, not weighed: an attribute of type u32.
struct Inherited {
  std::string name;
  int components = 1;
  Array<std::uint32_t> values;

  Inherited(const Attribute& attribute);
  Attribute attribute(Domain domain) &&;
};

/// Values of the corners of the level below, of triangles in four or faces into quads: linear within each face.
void split_corners(const Level& level, bool quads, Weighed& of_corners, const Run& run);
/// That of the nearest corner of the face.
void split_corners(const Level& level, bool quads, Inherited& of_corners, const Run& run);
/// That of the older vertex of an edge, of the first corner of a face.
void split_vertices(const Level& level, bool quads, Inherited& of_vertices, const Run& run);

}  // namespace azulejo::subdivision
