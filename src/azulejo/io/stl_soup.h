#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// What an STL file holds. Memory that it has is used again.
struct StlSoup {
  std::string name;                 ///< of the first solid
  Array<glm::vec3> corners;         ///< three a triangle
  Array<std::uint16_t> attributes;  ///< of each triangle; binary only, else empty
  std::string header;               ///< the 80 bytes of a binary file
  std::size_t opposed = 0;          ///< triangles whose stored normal points against their winding
};

/// Whether an STL file is text: it begins with "solid", and what is seen of it has no bytes that text doesn't have.
/// Many binary files begin with "solid" too: `size`, the file's, tells where it fits their count of triangles.
bool is_stl_text(std::span<const std::byte> head, std::uint64_t size);
/// Whether `size` is that of a binary file with as many triangles as it says in `head`.
bool fits_stl_binary(std::span<const std::byte> head, std::uint64_t size);

void read_stl_text(const std::shared_ptr<const Input>& input, StlSoup& soup, const Run& run);
void read_stl_binary(const Input& input, StlSoup& soup, const Run& run);

/// Throws Error(Resource) where so many triangles don't fit a mesh or run.limits.memory_bytes.
void check_stl_size(const std::string& name, std::uint64_t triangles, const Run& run);

/// Whether a stored normal points more than 120° away from the side from which the corners are counter-clockwise:
/// less may come of rounding in thin triangles.
inline bool opposes(const glm::vec3& normal, const glm::vec3* corner) {
  const glm::vec3 u = corner[1] - corner[0];
  const glm::vec3 v = corner[2] - corner[0];
  const glm::vec3 wound(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
  const auto dot = [](const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const float along = dot(wound, normal);
  return along < 0 && along * along > 0.25F * dot(wound, wound) * dot(normal, normal);
}

}  // namespace azulejo
