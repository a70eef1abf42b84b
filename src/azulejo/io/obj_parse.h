#pragma once

// The statements of an OBJ file as arrays, before objects and materials are made of them.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/io/obj_text.h"

namespace azulejo {

/// An index that a corner doesn't give.
inline constexpr std::uint32_t kObjAbsent = 0xFFFFFFFF;

/// How many of each kind there are, or were before a place.
struct ObjCounts {
  std::size_t vertices = 0;
  std::size_t texcoords = 0;
  std::size_t normals = 0;
  std::size_t corners = 0;
  std::size_t faces = 0;
  std::size_t line_ends = 0;
  std::size_t points = 0;

  ObjCounts& operator+=(const ObjCounts& other);
};

/// A statement that holds for what follows it.
struct ObjEvent {
  enum class Kind : std::uint8_t { Object, Material, Library, Smoothing };
  Kind kind = Kind::Object;
  std::uint32_t smoothing = 0;  ///< group; 0: hard
  std::size_t vertices = 0;     ///< that came before
  std::size_t faces = 0;
  std::size_t line_ends = 0;
  std::size_t points = 0;
  std::string text;  ///< the name
};

/// All that an OBJ file says. Indices are checked, and count from 0.
struct ObjData {
  Array<glm::vec3> positions;
  Array<glm::vec3> colors;     ///< as they stand in the file; empty: none
  Array<glm::vec2> texcoords;  ///< as they stand in the file
  Array<glm::vec3> normals;    ///< as they stand in the file
  Array<std::uint32_t> corners;
  Array<std::uint32_t> corner_texcoords;  ///< or kObjAbsent; empty: no corner has any
  Array<std::uint32_t> corner_normals;    ///< or kObjAbsent; empty: no corner has any
  Array<std::uint32_t> face_offsets;      ///< empty: all are triangles
  Array<std::uint32_t> lines;             ///< pairs
  Array<std::uint32_t> points;
  std::vector<ObjEvent> events;
  std::size_t faces = 0;
};

/// Parses a file, in pieces on all threads. Throws Error(Data) naming the file and the line.
/// Cost and memory in proportion to the file.
ObjData parse_obj(const ObjText& text, const Run& run);

}  // namespace azulejo
