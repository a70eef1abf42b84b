#include "azulejo/io/stl_write.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/write_chunks.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;  ///< faces that are put into bytes at once
constexpr std::size_t kTriangle = 50;

struct Triangle {
  std::array<glm::vec3, 3> corners;
  glm::vec3 normal;
  std::uint16_t attribute;
};

glm::vec3 unit_normal(const std::array<glm::vec3, 3>& corners) {
  const glm::dvec3 u = glm::dvec3(corners[1]) - glm::dvec3(corners[0]);
  const glm::dvec3 v = glm::dvec3(corners[2]) - glm::dvec3(corners[0]);
  const glm::dvec3 wound(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
  const double length = std::sqrt(wound.x * wound.x + wound.y * wound.y + wound.z * wound.z);
  return length > 0 && std::isfinite(length) ? glm::vec3(wound / length) : glm::vec3(0, 0, 0);
}

/// The face's colour in 15 bits, blue lowest, and bit 15 that says that there is one.
std::uint16_t attribute_of(const Attribute* colors, std::size_t face) {
  if (colors == nullptr) return 0;
  const std::uint8_t* const color =
      &(*colors->get<std::uint8_t>())[face * static_cast<std::size_t>(colors->components)];
  const auto five = [](unsigned value) { return (value * 31 + 127) / 255; };
  return static_cast<std::uint16_t>(1U << 15 | five(color[0]) << 10 | five(color[1]) << 5 | five(color[2]));
}

const Attribute* face_colors(const Mesh& mesh) {
  for (const Attribute& each : mesh.attributes) {
    if (each.name == "COLOR_0" && each.domain == Domain::Face && each.components >= 3 &&
        each.get<std::uint8_t>() != nullptr) {
      return &each;
    }
  }
  return nullptr;
}

/// visit(triangle) for what the faces [begin, end) fall into.
template <class Visit>
void visit_triangles(const Mesh& mesh, const Attribute* colors, std::size_t begin, std::size_t end, Visit visit) {
  for (std::size_t face = begin; face < end; ++face) {
    const std::size_t first = mesh.face_begin(face);
    for (std::size_t corner = first + 1; corner + 1 < mesh.face_end(face); ++corner) {
      Triangle triangle;
      triangle.corners = {mesh.positions[mesh.corners[first]], mesh.positions[mesh.corners[corner]],
                          mesh.positions[mesh.corners[corner + 1]]};
      triangle.normal = unit_normal(triangle.corners);
      triangle.attribute = attribute_of(colors, face);
      visit(triangle);
    }
  }
}

void append_binary(std::string& text, const Triangle& triangle) {
  std::array<std::byte, kTriangle> bytes;
  std::byte* next = bytes.data();
  const auto put = [&](const glm::vec3& vector) {
    for (int axis = 0; axis < 3; ++axis, next += 4) store_number(next, vector[axis], std::endian::little);
  };
  put(triangle.normal);
  for (const glm::vec3& corner : triangle.corners) put(corner);
  store_number(next, triangle.attribute, std::endian::little);
  text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void append_vector(std::string& text, const char* before, const glm::vec3& vector) {
  text += before;
  for (int axis = 0; axis < 3; ++axis) {
    text += ' ';
    append_number(text, vector[axis]);
  }
  text += '\n';
}

void append_text(std::string& text, const Triangle& triangle) {
  append_vector(text, "  facet normal", triangle.normal);
  text += "    outer loop\n";
  for (const glm::vec3& corner : triangle.corners) append_vector(text, "      vertex", corner);
  text += "    endloop\n  endfacet\n";
}

/// A solid's name is one line.
std::string line(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  return name;
}

std::string binary_header(std::size_t triangles) {
  std::string header = "azulejo";  // whatever the mesh's name: a header must not begin with "solid"
  header.resize(84, '\0');
  store_number(reinterpret_cast<std::byte*>(&header[80]), static_cast<std::uint32_t>(triangles), std::endian::little);
  return header;
}

void write_faces(Output& output, const Mesh& mesh, bool ascii, const Run& run) {
  const Attribute* const colors = face_colors(mesh);
  write_in_chunks(output, mesh.face_count(), kChunk, run, [&](std::string& text, std::size_t begin, std::size_t end) {
    visit_triangles(mesh, colors, begin, end, [&](const Triangle& triangle) {
      ascii ? append_text(text, triangle) : append_binary(text, triangle);
    });
  });
}

void warn_of_losses(Output& output, const Mesh& mesh, const Run& run) {
  std::size_t thin = 0;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    thin += mesh.face_end(face) - mesh.face_begin(face) < 3 ? 1U : 0U;
  }
  if (thin > 0) warn(run, fmt::format("{}: {} faces of fewer than three corners are left out", output.name(), thin));
  if (!mesh.lines.empty())
    warn(run, fmt::format("{}: STL holds no lines; {} are left out", output.name(), mesh.lines.size() / 2));
}

}  // namespace

void write_stl(Output& output, const Mesh& mesh, const ModelWriteOptions& options, const Run& run) {
  const std::size_t triangles = mesh.triangle_count();
  if (triangles > 0xFFFFFFFE) {
    throw Error(Error::Argument, fmt::format("{}: {} triangles, STL holds {}", output.name(), triangles, 0xFFFFFFFE));
  }
  warn_of_losses(output, mesh, run);
  const std::string name = line(mesh.name);
  write_text(output, options.ascii ? fmt::format("solid {}\n", name) : binary_header(triangles));
  write_faces(output, mesh, options.ascii, run);
  if (options.ascii) write_text(output, fmt::format("endsolid {}\n", name));
}

}  // namespace azulejo
