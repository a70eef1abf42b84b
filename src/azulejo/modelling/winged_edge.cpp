#include "azulejo/modelling/winged_edge.h"

#include <algorithm>

#include <fmt/format.h>

#include "azulejo/modelling/winged_edge_parts.h"

namespace azulejo {

bool WingedEdge::vertex_alive(std::uint32_t vertex) const { return vertices_[vertex].edge != kDeadVertex; }

std::vector<std::uint32_t> WingedEdge::vertices_of(std::uint32_t face) const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t loop = faces_[face].loop; loop != kNoElement; loop = loops_[loop].next) {
    if (loops_[loop].half == kNoElement) result.push_back(loops_[loop].vertex);
    for (const Half half : halves_of(loop)) result.push_back(from(half));
  }
  return result;
}

std::vector<std::uint32_t> WingedEdge::faces_of(std::uint32_t vertex) const {
  std::vector<std::uint32_t> result;
  for (const Half half : edges_of(vertex)) {
    if (left(half) != kNoElement) result.push_back(left(half));
  }
  return result;
}

std::vector<std::uint32_t> WingedEdge::loops_of(std::uint32_t face) const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t loop = faces_[face].loop; loop != kNoElement; loop = loops_[loop].next) result.push_back(loop);
  return result;
}

std::uint32_t WingedEdge::loop_with(Half half) const {
  const std::uint32_t face = left(half);
  if (face == kNoElement) return kNoElement;
  const std::uint32_t first = faces_[face].loop;
  if (loops_[first].next == kNoElement) return first;
  for (const Half each : loop_of(half)) {
    for (std::uint32_t loop = first; loop != kNoElement; loop = loops_[loop].next) {
      if (loops_[loop].half == each) return loop;
    }
  }
  return kNoElement;
}

std::size_t WingedEdge::degree(std::uint32_t vertex) const {
  const auto ring = edges_of(vertex);
  return static_cast<std::size_t>(std::distance(ring.begin(), ring.end()));
}

WingedEdge::Half WingedEdge::find(std::uint32_t from_vertex, std::uint32_t to_vertex) const {
  for (const Half half : edges_of(from_vertex)) {
    if (to(half) == to_vertex) return half;
  }
  return kNoElement;
}

void WingedEdge::link(Half before, Half after) {
  edges_[before >> 1].wing[(before & 1) == 0 ? 2 : 1] = after >> 1;
  edges_[after >> 1].wing[(after & 1) == 0 ? 0 : 3] = before >> 1;
}

/// Adds a loop to a face, behind its others.
void WingedEdge::hang(std::uint32_t face, std::uint32_t loop) {
  std::uint32_t* place = &faces_[face].loop;
  while (*place != kNoElement) place = &loops_[*place].next;
  *place = loop;
  loops_[loop].face = face;
  loops_[loop].next = kNoElement;
}

void WingedEdge::unhang(std::uint32_t loop) {
  std::uint32_t* place = &faces_[loops_[loop].face].loop;
  while (*place != loop) place = &loops_[*place].next;
  *place = loops_[loop].next;
}

namespace {

/// A place for a new element: that of the last killed one, or a new one behind all others.
template <class T>
std::uint32_t new_slot(Array<T>& elements, std::vector<std::uint32_t>& free) {
  if (free.empty()) {
    elements.emplace_back();
    return static_cast<std::uint32_t>(elements.size() - 1);
  }
  const std::uint32_t slot = free.back();
  free.pop_back();
  elements[slot] = T();
  return slot;
}

}  // namespace

std::uint32_t WingedEdge::new_vertex(const glm::vec3& position, std::uint32_t source) {
  const std::uint32_t vertex = new_slot(vertices_, free_vertices_);
  vertices_[vertex].position = position;
  vertices_[vertex].source = source;
  return vertex;
}

std::uint32_t WingedEdge::new_edge(std::uint32_t first, std::uint32_t second) {
  const std::uint32_t edge = new_slot(edges_, free_edges_);
  edges_[edge].vertex = {first, second};
  return edge;
}

std::uint32_t WingedEdge::new_face(std::uint32_t source) {
  const std::uint32_t face = new_slot(faces_, free_faces_);
  faces_[face].source = source;
  return face;
}

std::uint32_t WingedEdge::new_loop(std::uint32_t face) {
  const std::uint32_t loop = new_slot(loops_, free_loops_);
  hang(face, loop);
  return loop;
}

void WingedEdge::free_vertex(std::uint32_t vertex) {
  vertices_[vertex].edge = kDeadVertex;
  free_vertices_.push_back(vertex);
}

void WingedEdge::free_edge(std::uint32_t edge) {
  edges_[edge] = Edge();
  free_edges_.push_back(edge);
}

void WingedEdge::free_face(std::uint32_t face) {
  faces_[face] = Face();
  free_faces_.push_back(face);
}

void WingedEdge::free_loop(std::uint32_t loop) {
  loops_[loop] = Loop();
  free_loops_.push_back(loop);
}

std::size_t WingedEdge::shell_count() const {
  // Faces are joined by edges, and edges of one face by its loops.
  std::vector<std::uint32_t> parent(faces_.size() + vertices_.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<std::uint32_t>(i);
  const auto root = [&](std::uint32_t element) {
    while (parent[element] != element) element = parent[element] = parent[parent[element]];
    return element;
  };
  const auto first_vertex = static_cast<std::uint32_t>(faces_.size());
  for (const Edge& edge : edges_) {
    if (edge.vertex[0] == kNoElement) continue;
    const std::uint32_t vertex = root(first_vertex + edge.vertex[0]);
    parent[root(first_vertex + edge.vertex[1])] = vertex;
    for (const std::uint32_t face : edge.face) {
      if (face != kNoElement) parent[root(face)] = root(vertex);
    }
  }
  for (const Loop& loop : loops_) {
    if (loop.face != kNoElement && loop.half == kNoElement) parent[root(first_vertex + loop.vertex)] = root(loop.face);
  }
  std::size_t shells = 0;
  std::vector<std::uint8_t> seen(parent.size(), 0);
  for (std::uint32_t face = 0; face < faces_.size(); ++face) {
    if (!face_alive(face)) continue;
    std::uint8_t& mark = seen[root(face)];
    shells += mark == 0 ? 1 : 0;
    mark = 1;
  }
  return shells;
}

std::size_t WingedEdge::border_loop_count() const {
  std::vector<std::uint8_t> seen(2 * edges_.size(), 0);
  std::size_t loops = 0;
  for (Half half = 0; half < seen.size(); ++half) {
    if (!edge_alive(half >> 1) || left(half) != kNoElement || seen[half] != 0) continue;
    ++loops;
    for (const Half each : loop_of(half)) seen[each] = 1;
  }
  return loops;
}

WingedEdge WingedEdge::from_records(std::vector<Vertex> vertices, std::vector<Edge> edges,
                                    const std::vector<std::uint32_t>& face_edges) {
  WingedEdge solid;
  solid.vertices_.assign(vertices.begin(), vertices.end());
  solid.edges_.assign(edges.begin(), edges.end());
  solid.faces_.resize(face_edges.size());
  solid.loops_.resize(face_edges.size());
  for (std::uint32_t face = 0; face < face_edges.size(); ++face) {
    const std::uint32_t edge = face_edges[face];
    const bool second = edge < edges.size() && edges[edge].face[0] != face;
    solid.faces_[face] = {face, face};
    solid.loops_[face] = {edge << 1 | (second ? 1U : 0U), kNoElement, face, kNoElement};
  }
  return solid;
}

std::string WingedEdge::table() const {
  std::string text;
  for (std::uint32_t face = 0; face < faces_.size(); ++face) {
    if (!face_alive(face)) continue;
    text += fmt::format("f{}", face);
    for (const std::uint32_t loop : loops_of(face)) {
      if (loop != faces_[face].loop) text += " |";
      if (loops_[loop].half == kNoElement) text += fmt::format(" v{}", loops_[loop].vertex);
      for (const Half half : halves_of(loop)) text += fmt::format(" {}", half >> 1);
    }
    text += '\n';
  }
  const auto name = [](char kind, std::uint32_t index) {
    return index == kNoElement ? std::string("-") : fmt::format("{}{}", kind, index);
  };
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    if (!edge_alive(e)) continue;
    const Edge& edge = edges_[e];
    text += fmt::format("e{} v{} v{} {} {} {}\n", e, edge.vertex[0], edge.vertex[1], name('f', edge.face[0]),
                        name('f', edge.face[1]), fmt::join(edge.wing, " "));
  }
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (!vertex_alive(v)) continue;
    const glm::vec3& place = vertices_[v].position;
    text += fmt::format("v{} {},{},{}", v, place.x, place.y, place.z);
    for (const Half half : edges_of(v)) text += fmt::format(" {}", half >> 1);
    text += '\n';
  }
  return text;
}

}  // namespace azulejo
