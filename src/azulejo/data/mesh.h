#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/data/array.h"

namespace azulejo {

/// What an attribute has one value of.
enum class Domain : std::uint8_t { Vertex, Corner, Face };

/// Values on the elements of a mesh. Names are glTF's where glTF has one: NORMAL (3, length 1; 0: none), TANGENT (4),
/// TEXCOORD_n (2; (0, 0) is the top left of the image), COLOR_n (3 or 4, linear in 0–1 where f32; sRGB 0–255 where u8),
/// JOINTS_n (4, u32), WEIGHTS_n (4). Others keep the name that the file gives them.
struct Attribute {
  using Values = std::variant<Array<float>, Array<std::uint8_t>, Array<std::uint32_t>>;

  std::string name;
  Domain domain = Domain::Vertex;
  int components = 1;  ///< 1–4
  Values values;       ///< components of the first element, of the second, …

  /// The values as T (float, std::uint8_t, std::uint32_t); null if they are of another type.
  template <class T>
  const Array<T>* get() const {
    return std::get_if<Array<T>>(&values);
  }
  std::size_t size() const {  ///< elements
    return std::visit([](const auto& array) { return array.size(); }, values) / static_cast<std::size_t>(components);
  }
};

/// What the coordinates of a model mean.
enum class UpAxis : std::uint8_t { Y, Z };
struct Space {
  UpAxis up = UpAxis::Y;
  float metres_per_unit = 0;  ///< 0: unknown
  friend bool operator==(const Space&, const Space&) = default;
};

/// A shape that a morph weight of 1 adds to a mesh: differences, one a vertex.
struct MorphTarget {
  std::string name;
  Array<glm::vec3> positions;  ///< empty: none
  Array<glm::vec3> normals;    ///< empty: none
};

/// A polygonal surface: faces whose corners name vertices, counter-clockwise seen from outside. Without faces it is a
/// point cloud. Moved, not copied: `clone()` says a copy aloud.
///
/// Invariants (`check` of a reader's result): every corner names a vertex; face_offsets, if not empty, begins with 0,
/// never falls, and ends with the number of corners; attributes and `material` have as many elements as their domain.
/// Coordinates may be any floats, NaN too.
struct AZULEJO_EXPORT Mesh {
  std::string name;
  Array<glm::vec3> positions;
  Array<std::uint32_t> corners;  ///< the vertex of each corner, face by face
  Array<std::uint32_t>
      face_offsets;            ///< first corner of each face, and the number of corners; empty: all are triangles
  Array<std::uint32_t> lines;  ///< segments without faces: pairs of vertices
  std::vector<Attribute> attributes;
  Array<std::uint32_t> material;  ///< of each face, an index into the Scene's materials; empty: no material
  std::vector<MorphTarget> morph_targets;
  Space space;

  Mesh() = default;
  Mesh(Mesh&&) noexcept = default;
  Mesh& operator=(Mesh&&) noexcept = default;
  ~Mesh() = default;
  Mesh clone() const { return Mesh(*this); }

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t corner_count() const { return corners.size(); }
  std::size_t face_count() const { return face_offsets.empty() ? corners.size() / 3 : face_offsets.size() - 1; }
  bool all_triangles() const { return face_offsets.empty(); }
  /// First corner of a face, and of the next.
  std::size_t face_begin(std::size_t face) const { return face_offsets.empty() ? face * 3 : face_offsets[face]; }
  std::size_t face_end(std::size_t face) const { return face_begin(face + 1); }
  /// Triangles that the faces fall into: an n-gon into n − 2, fewer than three corners into none.
  std::size_t triangle_count() const;
  std::size_t size_of(Domain domain) const {
    return domain == Domain::Vertex ? vertex_count() : domain == Domain::Corner ? corner_count() : face_count();
  }
  /// Null if there is none of that name.
  const Attribute* find(std::string_view attribute) const;

  /// Throws Error(Data), beginning with `what`, where an invariant doesn't hold. Cost O(corners).
  void check(std::string_view what) const;

 private:
  Mesh(const Mesh&) = default;
  Mesh& operator=(const Mesh&) = default;
};

/// An axis-parallel box; empty where a lower exceeds the upper.
struct Box3 {
  glm::vec3 lower{3.4e38F, 3.4e38F, 3.4e38F};
  glm::vec3 upper{-3.4e38F, -3.4e38F, -3.4e38F};
  bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  glm::vec3 center() const { return 0.5F * lower + 0.5F * upper; }
  glm::vec3 size() const { return upper - lower; }
  friend bool operator==(const Box3&, const Box3&) = default;
};

AZULEJO_EXPORT Box3 united(const Box3& a, const Box3& b);
AZULEJO_EXPORT Box3 united(const Box3& box, const glm::vec3& point);
/// Of all vertices, used or not; coordinates that are not finite are left out, with their whole vertex.
AZULEJO_EXPORT Box3 bounds(const Mesh& mesh);

AZULEJO_EXPORT const char* to_string(Domain domain);  ///< "vertex", "corner", "face"
AZULEJO_EXPORT const char* to_string(UpAxis axis);    ///< "y", "z"

}  // namespace azulejo
