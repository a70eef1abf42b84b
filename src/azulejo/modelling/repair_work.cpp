#include "azulejo/modelling/repair_work.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "azulejo/modelling/picked_mesh.h"

namespace azulejo {

RepairWork::RepairWork(const Mesh& from, const RepairOptions& with, const Run& context)
    : source(from),
      options(with),
      run(context),
      vertex_of(from.vertex_count()),
      corner_of(from.corner_count()),
      face_of(from.face_count()),
      turned(from.face_count(), false),
      patch_of(from.face_count(), kNoPatch),
      rows(from) {
  mesh.positions = from.positions;
  mesh.corners = from.corners;
  mesh.face_offsets = from.face_offsets;
  mesh.lines = from.lines;
  std::iota(vertex_of.begin(), vertex_of.end(), 0U);
  std::iota(corner_of.begin(), corner_of.end(), 0U);
  std::iota(face_of.begin(), face_of.end(), 0U);
}

void RepairWork::note(RepairAction action, const glm::vec3& place) {
  RepairCount& count = result.actions[static_cast<std::size_t>(action)];
  if (count.count++ < static_cast<std::size_t>(options.listed)) count.places.push_back(place);
}

glm::vec3 RepairWork::middle_of_face(std::size_t face) const {
  glm::dvec3 sum(0);
  const std::size_t begin = mesh.face_begin(face);
  const std::size_t end = mesh.face_end(face);
  for (std::size_t c = begin; c < end; ++c) sum += position(vertex(c));
  return glm::vec3(sum / static_cast<double>(std::max<std::size_t>(end - begin, 1)));
}

glm::dvec3 RepairWork::normal_of_face(std::size_t face) const {
  const std::size_t begin = mesh.face_begin(face);
  const std::size_t end = mesh.face_end(face);
  const glm::dvec3 a = position(vertex(begin));
  glm::dvec3 sum(0);
  for (std::size_t c = begin + 1; c + 1 < end; ++c) {
    sum += glm::cross(position(vertex(c)) - a, position(vertex(c + 1)) - a);
  }
  return sum;
}

void RepairWork::keep_faces(const std::vector<bool>& kept) {
  touch();
  std::size_t corner = 0;
  std::size_t face = 0;
  const bool triangles = mesh.all_triangles();
  const std::size_t before = mesh.face_count();
  std::size_t begin = 0;
  for (std::size_t f = 0; f < before; ++f) {
    const std::size_t end = mesh.face_end(f);
    if (kept[f]) {
      for (std::size_t c = begin; c < end; ++c, ++corner) {
        mesh.corners[corner] = mesh.corners[c];
        corner_of[corner] = corner_of[c];
      }
      face_of[face] = face_of[f];
      turned[face] = turned[f];
      patch_of[face] = patch_of[f];
      ++face;
      if (!triangles) mesh.face_offsets[face] = static_cast<std::uint32_t>(corner);
    }
    begin = end;
  }
  mesh.corners.resize(corner);
  corner_of.resize(corner);
  face_of.resize(face);
  turned.resize(face);
  patch_of.resize(face);
  if (!triangles) mesh.face_offsets.resize(face + 1);
}

void RepairWork::renumber_vertices(const Array<std::uint32_t>& becomes) {
  touch();
  std::vector<bool> stays(mesh.vertex_count(), false);
  for (std::uint32_t v = 0; v < becomes.size(); ++v) {
    if (becomes[v] == v) stays[v] = true;
  }
  Array<std::uint32_t> number(mesh.vertex_count());
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < becomes.size(); ++v) {
    number[v] = next;
    if (!stays[v]) continue;
    mesh.positions[next] = mesh.positions[v];
    vertex_of[next] = vertex_of[v];
    ++next;
  }
  for (std::uint32_t& v : mesh.corners) v = number[becomes[v]];
  for (std::uint32_t& v : mesh.lines) v = number[becomes[v]];
  mesh.positions.resize(next);
  vertex_of.resize(next);
}

std::uint32_t RepairWork::add_vertex(const glm::vec3& position, std::uint32_t row) {
  mesh.positions.push_back(position);
  vertex_of.push_back(row);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void RepairWork::add_triangle(const std::array<std::uint32_t, 3>& vertices,
                              const std::array<std::uint32_t, 3>& corner_rows, std::uint32_t face_row,
                              std::uint32_t patch) {
  touch();
  mesh.corners.insert(mesh.corners.end(), vertices.begin(), vertices.end());
  corner_of.insert(corner_of.end(), corner_rows.begin(), corner_rows.end());
  face_of.push_back(face_row);
  turned.push_back(false);
  patch_of.push_back(patch);
  if (!mesh.face_offsets.empty()) mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

std::size_t RepairWork::first_patch_face() const {
  const auto found = std::find_if(patch_of.begin(), patch_of.end(), [](std::uint32_t p) { return p != kNoPatch; });
  return static_cast<std::size_t>(found - patch_of.begin());
}

Mesh RepairWork::done() const {
  Mesh done = mesh.clone();
  done.name = source.name;
  done.space = source.space;
  Array<std::uint32_t> rows_of_vertices(mesh.corner_count());
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) rows_of_vertices[c] = vertex_of[vertex(c)];
  for (std::size_t a = 0; a < source.attributes.size(); ++a) {
    const Domain domain = source.attributes[a].domain;
    if (domain == Domain::Vertex && rows.differs(a, corner_of, rows_of_vertices)) {
      done.attributes.push_back(rows.picked_at_corners(a, corner_of));
    } else {
      done.attributes.push_back(rows.picked(a, domain == Domain::Vertex   ? vertex_of
                                               : domain == Domain::Corner ? corner_of
                                                                          : face_of));
    }
  }
  for (std::size_t i = 0; i < source.morph_targets.size(); ++i) {
    done.morph_targets.push_back(rows.picked(source.morph_targets[i], i, vertex_of));
  }
  if (!source.material.empty()) {
    done.material.resize(face_of.size());
    for (std::size_t f = 0; f < face_of.size(); ++f) done.material[f] = source.material[face_of[f]];
  }
  return done;
}

std::shared_ptr<const EdgeUses> RepairWork::edges() {
  if (!edges_) edges_ = std::make_shared<const EdgeUses>(edge_uses(mesh, {}, run));
  return edges_;
}

std::shared_ptr<const Array<std::uint32_t>> RepairWork::faces() {
  if (faces_) return faces_;
  auto list = std::make_shared<Array<std::uint32_t>>(mesh.corner_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) (*list)[c] = f;
  }
  faces_ = std::move(list);
  return faces_;
}

void RepairWork::turn(std::size_t face) {
  touch();
  const auto begin = static_cast<std::ptrdiff_t>(mesh.face_begin(face));
  const auto end = static_cast<std::ptrdiff_t>(mesh.face_end(face));
  std::reverse(mesh.corners.begin() + begin + 1, mesh.corners.begin() + end);
  std::reverse(corner_of.begin() + begin + 1, corner_of.begin() + end);
}

std::uint32_t find_edge(const EdgeUses& uses, std::uint32_t a, std::uint32_t b) {
  const std::array<std::uint32_t, 2> wanted{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(uses.vertices.begin(), uses.vertices.end(), wanted);
  if (found == uses.vertices.end() || *found != wanted) return EdgeUses::kNone;
  return static_cast<std::uint32_t>(found - uses.vertices.begin());
}

}  // namespace azulejo
