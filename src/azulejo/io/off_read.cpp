#include "azulejo/io/off_read.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Puts 1, 3 or 4 values of a colour where four have room.
void put_color(float* place, const float* values, std::size_t count, bool real, OffColorKinds& kinds) {
  kinds.indexed |= count == 1;
  if (count < 3) return;
  kinds.some = true;
  kinds.real |= real;
  kinds.alpha |= count >= 4;
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) {
    place[i] = values[i];
    kinds.most = std::max(kinds.most, values[i]);
  }
}

void join_faces(OffRows& rows, Mesh& mesh, const std::string& name, const Run& run) {
  std::size_t faces = 0;
  std::size_t corners = 0;
  bool triangles = true;
  OffColorKinds kinds;
  for (const OffFaces& each : rows.faces) {
    faces += each.counts.size();
    corners += each.corners.size();
    triangles = triangles && std::all_of(each.counts.begin(), each.counts.end(), [](auto count) { return count == 3; });
    kinds |= each.kinds;
  }
  constexpr std::size_t kMost = 0xFFFFFFFE;
  if (corners > kMost) {
    throw Error(Error::Unsupported, fmt::format("{}: {} corners of faces, at most {} are read", name, corners, kMost));
  }
  mesh.corners.reserve(corners);
  if (!triangles) mesh.face_offsets.reserve(faces + 1);
  Array<float> colors;
  if (kinds.some) colors.reserve(faces * 4);
  std::uint32_t place = 0;
  for (OffFaces& each : rows.faces) {
    mesh.corners.insert(mesh.corners.end(), each.corners.begin(), each.corners.end());
    for (std::size_t face = 0; !triangles && face < each.counts.size(); ++face) {
      mesh.face_offsets.push_back(std::exchange(place, place + each.counts[face]));
    }
    if (!kinds.some) continue;
    each.colors.resize(each.counts.size() * 4, kNone);
    colors.insert(colors.end(), each.colors.begin(), each.colors.end());
  }
  if (!triangles) mesh.face_offsets.push_back(place);
  if (auto color = off_colors(colors, kinds, Domain::Face, name, run)) mesh.attributes.push_back(std::move(*color));
}

}  // namespace

void OffFaces::add_color(const float* values, std::size_t count, bool real) {
  colors.resize(counts.size() * 4, kNone);
  put_color(&colors[(counts.size() - 1) * 4], values, count, real, kinds);
}

OffRows::OffRows(const OffHeader& header) : positions(static_cast<std::size_t>(header.vertices)) {
  if (header.normals) normals.assign(positions.size() * 3, 0.0F);
  if (header.colors) vertex_colors.assign(positions.size() * 4, kNone);
  if (header.texcoords) texcoords.assign(positions.size() * 2, 0.0F);
}

void OffRows::set_vertex(std::size_t vertex, const float* values, std::size_t count, unsigned reals,
                         OffColorKinds& kinds) {
  const float* const end = values + count;
  if (!normals.empty() && end - values >= 3) {
    std::copy_n(values, 3, &normals[vertex * 3]);
    values += 3;
    reals >>= 3;
  }
  const bool has_texcoord = !texcoords.empty() && end - values >= 2;
  const std::ptrdiff_t color = end - values - (has_texcoord ? 2 : 0);
  if (!vertex_colors.empty()) {
    const bool real = (reals & ((1U << color) - 1)) != 0;
    put_color(&vertex_colors[vertex * 4], values, static_cast<std::size_t>(color), real, kinds);
  }
  if (has_texcoord) {
    texcoords[vertex * 2] = end[-2];
    texcoords[vertex * 2 + 1] = 1 - end[-1];
  }
}

Mesh read_off(const std::shared_ptr<const Input>& input, const Run& run) {
  const OffHeader header = read_off_header(*input);
  constexpr std::uint64_t kVertexBytes = 12 + 12 + 16 + 8;
  constexpr std::uint64_t kFaceBytes = 16 + 16;
  const std::uint64_t bytes =
      header.vertices * kVertexBytes + header.faces * kFaceBytes;  // counts fit the file: checked
  if (header.vertices > 0xFFFFFFFE || bytes > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
    throw Error(Error::Resource,
                fmt::format("{}: {} vertices and {} faces, more than the limit of memory, {} bytes, holds",
                            input->name(), header.vertices, header.faces, run.limits.memory_bytes));
  }
  OffRows rows(header);
  if (header.binary) {
    read_off_binary(input, header, rows);
  } else {
    read_off_text(input, header, rows, run);
  }
  Mesh mesh;
  mesh.positions = std::move(rows.positions);
  if (header.normals) mesh.attributes.push_back({"NORMAL", Domain::Vertex, 3, std::move(rows.normals)});
  if (header.texcoords) mesh.attributes.push_back({"TEXCOORD_0", Domain::Vertex, 2, std::move(rows.texcoords)});
  if (auto color = off_colors(rows.vertex_colors, rows.vertex_kinds, Domain::Vertex, input->name(), run)) {
    mesh.attributes.push_back(std::move(*color));
  }
  join_faces(rows, mesh, input->name(), run);
  mesh.check(input->name());  // indices are as the file gives them until here
  return mesh;
}

}  // namespace azulejo
