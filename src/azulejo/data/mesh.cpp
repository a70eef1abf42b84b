#include "azulejo/data/mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Error broken(std::string_view what, const std::string& why) {
  return Error(Error::Data, fmt::format("{}: {}", what, why));
}

void check_faces(const Mesh& mesh, std::string_view what) {
  const Array<std::uint32_t>& offsets = mesh.face_offsets;
  if (offsets.empty()) {
    if (mesh.corners.size() % 3 != 0) {
      throw broken(what, fmt::format("{} corners, expected three a triangle", mesh.corners.size()));
    }
    return;
  }
  if (offsets.front() != 0 || offsets.back() != mesh.corners.size() ||
      !std::is_sorted(offsets.begin(), offsets.end())) {
    throw broken(what, fmt::format("face offsets don't divide the {} corners", mesh.corners.size()));
  }
}

void check_indices(const Array<std::uint32_t>& indices, std::size_t vertices, std::string_view what, const char* kind) {
  const auto largest = std::max_element(indices.begin(), indices.end());
  if (largest != indices.end() && *largest >= vertices) {
    throw broken(what, fmt::format("{} {} names vertex {}, of {} vertices", kind, largest - indices.begin(), *largest,
                                   vertices));
  }
}

void check_attribute(const Mesh& mesh, const Attribute& attribute, std::string_view what) {
  const std::size_t wanted = mesh.size_of(attribute.domain);
  const std::size_t values = std::visit([](const auto& array) { return array.size(); }, attribute.values);
  if (attribute.components < 1 || attribute.components > 4 ||
      values != wanted * static_cast<std::size_t>(attribute.components)) {
    throw broken(what, fmt::format("attribute {} has {} values of {} components, expected one for each of {} ({})",
                                   attribute.name, values, attribute.components, wanted, to_string(attribute.domain)));
  }
}

bool finite(const glm::vec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

}  // namespace

std::size_t Mesh::triangle_count() const {
  if (face_offsets.empty()) return corners.size() / 3;
  std::size_t count = 0;
  for (std::size_t f = 0; f + 1 < face_offsets.size(); ++f) {
    const std::size_t size = face_offsets[f + 1] - face_offsets[f];
    if (size >= 3) count += size - 2;
  }
  return count;
}

const Attribute* Mesh::find(std::string_view attribute) const {
  for (const Attribute& each : attributes) {
    if (each.name == attribute) return &each;
  }
  return nullptr;
}

void Mesh::check(std::string_view what) const {
  constexpr std::size_t kMost = 0xFFFFFFFE;
  if (positions.size() > kMost || corners.size() > kMost) {
    throw broken(
        what, fmt::format("{} vertices, {} corners, expected fewer than 2^32 - 1", positions.size(), corners.size()));
  }
  check_faces(*this, what);
  check_indices(corners, positions.size(), what, "corner");
  check_indices(lines, positions.size(), what, "line end");
  if (lines.size() % 2 != 0) throw broken(what, "lines have an odd number of ends");
  if (!material.empty() && material.size() != face_count()) {
    throw broken(what, fmt::format("{} faces have {} materials", face_count(), material.size()));
  }
  for (const Attribute& each : attributes) check_attribute(*this, each, what);
  for (const MorphTarget& target : morph_targets) {
    if ((!target.positions.empty() && target.positions.size() != positions.size()) ||
        (!target.normals.empty() && target.normals.size() != positions.size())) {
      throw broken(what, fmt::format("morph target {} has another number of vertices", target.name));
    }
  }
}

Box3 united(const Box3& a, const Box3& b) { return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)}; }
Box3 united(const Box3& box, const glm::vec3& point) {
  return {glm::min(box.lower, point), glm::max(box.upper, point)};
}

Box3 bounds(const Mesh& mesh) {
  Box3 box;
  for (const glm::vec3& point : mesh.positions) {
    if (finite(point)) box = united(box, point);
  }
  return box;
}

const char* to_string(Domain domain) {
  switch (domain) {
    case Domain::Vertex: return "vertex";
    case Domain::Corner: return "corner";
    case Domain::Face: return "face";
  }
  return "unknown";
}

const char* to_string(UpAxis axis) { return axis == UpAxis::Z ? "z" : "y"; }

}  // namespace azulejo
