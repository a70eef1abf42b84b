#pragma once

// A piece of an OBJ file, parsed on its own: counts of what came before are not known yet.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/io/obj_parse.h"

namespace azulejo {

/// Indices of a piece: 0 and above count from the file's first element; below 0 stands kObjRelative less than an index
/// that counts from the piece's first element and may be negative; kObjNone is none. Files with 2^30 elements of a kind
/// are beyond this.
inline constexpr std::int32_t kObjRelative = std::int32_t{1} << 30;
inline constexpr std::int32_t kObjNone = std::numeric_limits<std::int32_t>::min();

struct ObjPiece {
  Array<glm::vec3> positions;
  Array<glm::vec3> colors;  ///< empty or one a position
  Array<glm::vec2> texcoords;
  Array<glm::vec3> normals;
  Array<std::int32_t> corners;
  Array<std::int32_t> corner_texcoords;  ///< empty or one a corner
  Array<std::int32_t> corner_normals;    ///< empty or one a corner
  Array<std::uint32_t> face_sizes;
  Array<std::int32_t> lines;  ///< pairs
  Array<std::int32_t> points;
  std::vector<ObjEvent> events;  ///< with counts from the piece's first element
  bool triangles = true;         ///< all faces are

  std::vector<std::string> unknown;  ///< the first few kinds of statements that are none, as messages quote them
  std::uint64_t unknown_at = 0;      ///< the first one's byte in the file
  std::size_t curves = 0;            ///< statements of free-form geometry
  std::size_t small_faces = 0;       ///< left out
  std::size_t odd_numbers = 0;       ///< of which only the beginning was a number
  std::string odd_number;            ///< the first, as messages quote it
  std::uint64_t odd_number_at = 0;   ///< its byte in the file

  ObjCounts counts() const;
};

/// Where the text of a piece stands.
struct ObjPlace {
  const ObjText& file;
  std::uint64_t offset;  ///< of its first byte in the file
  std::string_view text;
};

/// Parses whole lines. With `before` and `total`, counts of what comes before the piece and of the whole file, indices
/// are checked too.
/// Throws Error(Data) naming the file and the line.
void parse_obj_piece(const ObjPlace& place, ObjPiece& piece, const ObjCounts* before = nullptr,
                     const ObjCounts* total = nullptr);

}  // namespace azulejo
