#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/modelling/winged_edge.h"

namespace azulejo {
namespace {

[[noreturn]] void refuse(const char* operation, const std::string& why) {
  throw Error(Error::Argument, fmt::format("{}: {}", operation, why));
}

/// The third vertex of the triangle to the left of a half; none if there is no triangle.
std::uint32_t apex(const WingedEdge& solid, WingedEdge::Half half) {
  const WingedEdge::Half after = solid.next(half);
  const WingedEdge::Half before = solid.previous(half);
  const bool triangle = solid.left(half) != kNoElement && solid.next(after) == before && after != before;
  return triangle ? solid.to(after) : kNoElement;
}

/// The triangle to the left has two border edges beside this one: without it they would be one edge without a face.
bool is_ear(const WingedEdge& solid, WingedEdge::Half half) {
  return apex(solid, half) != kNoElement && solid.is_border(solid.next(half) >> 1) &&
         solid.is_border(solid.previous(half) >> 1);
}

bool at_border(const WingedEdge& solid, std::uint32_t vertex) {
  for (const WingedEdge::Half half : solid.edges_of(vertex)) {
    if (solid.is_border(half >> 1)) return true;
  }
  return false;
}

std::vector<std::uint32_t> sorted_neighbors(const WingedEdge& solid, std::uint32_t vertex) {
  std::vector<std::uint32_t> neighbors;
  for (const WingedEdge::Half half : solid.edges_of(vertex)) neighbors.push_back(solid.to(half));
  std::sort(neighbors.begin(), neighbors.end());
  return neighbors;
}

}  // namespace

WingedEdge::Made WingedEdge::split_edge(std::uint32_t edge, const glm::vec3& position) {
  const Half there = edge << 1;
  const std::uint32_t end = to(there);
  const Half after = next(there);
  const Half before_back = previous(twin(there));
  Made made;
  made.vertex = new_vertex(position, vertices_[end].source);
  made.edge = new_edge(made.vertex, end);
  edges_[made.edge].face = edges_[edge].face;
  edges_[edge].vertex[1] = made.vertex;
  const Half rest = made.edge << 1;
  link(there, rest);
  if (after == twin(there)) {
    link(rest, twin(rest));
  } else {
    link(rest, after);
    link(before_back, twin(rest));
  }
  link(twin(rest), twin(there));
  point_at(end, rest);
  point_at(made.vertex, rest);
  return made;
}

void WingedEdge::join_edges(std::uint32_t edge, std::uint32_t vertex) {
  constexpr const char* kName = "join_edges";
  const Half out = edges_[edge].vertex[0] == vertex ? edge << 1 : edge << 1 | 1U;
  if (from(out) != vertex || degree(vertex) != 2) {
    refuse(kName, fmt::format("vertex {} has not two edges of which {} is one", vertex, edge));
  }
  const Half in = previous(out);
  const std::uint32_t end = to(out);
  if (from(in) == end) refuse(kName, "an edge would have two equal ends");
  const std::uint32_t loops[2] = {loop_with(out), loop_with(twin(out))};
  const Half after = next(out);
  const Half before_back = previous(twin(out));
  edges_[in >> 1].vertex[(in ^ 1) & 1] = end;
  if (after == twin(out)) {
    link(in, twin(in));
  } else {
    link(in, after);
    link(before_back, twin(in));
  }
  for (const std::uint32_t loop : loops) {
    if (loop == kNoElement) continue;
    if (loops_[loop].half == out) loops_[loop].half = in;
    if (loops_[loop].half == twin(out)) loops_[loop].half = twin(in);
  }
  point_at(end, in);
  free_edge(edge);
  free_vertex(vertex);
}

const char* WingedEdge::why_not_collapse(std::uint32_t edge) const {
  const Half there = edge << 1;
  const std::uint32_t a = from(there);
  const std::uint32_t b = to(there);
  if (!is_border(edge) && at_border(*this, a) && at_border(*this, b)) return "it joins two borders";
  if (is_ear(*this, there) || is_ear(*this, twin(there))) return "a triangle beside it is held by it alone";
  const std::uint32_t apexes[2] = {apex(*this, there), apex(*this, twin(there))};
  for (const Half side : {there, twin(there)}) {
    if (next(next(side)) == side) return "it bounds a face of two edges";
    if (left(side) == kNoElement && next(next(next(side))) == side) return "it bounds a hole of three edges";
    if (left(side) != kNoElement && left(side) == left(twin(side))) return "it has one face on both sides";
  }
  // The link condition: what is joined to both ends is joined to them by the triangles beside the edge.
  const std::vector<std::uint32_t> of_a = sorted_neighbors(*this, a);
  const std::vector<std::uint32_t> of_b = sorted_neighbors(*this, b);
  if (std::count(of_a.begin(), of_a.end(), b) != 1) return "another edge joins its ends";
  std::vector<std::uint32_t> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
  std::vector<std::uint32_t> expected;
  for (const std::uint32_t each : apexes) {
    if (each != kNoElement) expected.push_back(each);
  }
  std::sort(expected.begin(), expected.end());
  if (common != expected) return "its ends have a common neighbor that no triangle beside it has";
  if (apexes[0] != kNoElement && apexes[1] != kNoElement) {
    const Half across = find(apexes[0], apexes[1]);
    if (across != kNoElement) {
      const std::uint32_t beside[2] = {apex(*this, across), apex(*this, twin(across))};
      if ((beside[0] == a && beside[1] == b) || (beside[0] == b && beside[1] == a)) return "it is of a tetrahedron";
    }
  }
  return nullptr;
}

void WingedEdge::collapse_edge(std::uint32_t edge, const glm::vec3& position) {
  if (const char* const why = why_not_collapse(edge)) {
    refuse("collapse_edge", fmt::format("edge {}: {}", edge, why));
  }
  const Half there = edge << 1;
  const Half back = twin(there);
  const std::uint32_t a = from(there);
  const std::uint32_t b = to(there);
  // A triangle beside it goes with its edge at the vertex that goes; what lies behind that edge gets the other one.
  if (apex(*this, there) != kNoElement) kill_edge_face(next(there));
  if (apex(*this, back) != kNoElement) kill_edge_face(previous(back));
  const std::uint32_t loops[2] = {loop_with(there), loop_with(back)};
  const Half before = previous(there);
  const Half after = next(there);
  const Half before_back = previous(back);
  const Half after_back = next(back);
  std::vector<Half> leaving_b;
  for (const Half half : edges_of(b)) leaving_b.push_back(half);
  for (const Half half : leaving_b) edges_[half >> 1].vertex[half & 1] = a;
  // Without a triangle on one side, of a vertex with two edges only a spur may be left.
  if (after == back) {
    link(before, after_back);
  } else {
    link(before, after);
    link(before_back, after_back);
  }
  const Half kept[2] = {after == back ? after_back : after, after_back};
  for (int side = 0; side < 2; ++side) {
    if (loops[side] != kNoElement && loops_[loops[side]].half >> 1 == edge) loops_[loops[side]].half = kept[side];
  }
  point_at(a, after_back);
  vertices_[a].position = position;
  free_edge(edge);
  free_vertex(b);
}

const char* WingedEdge::why_not_flip(std::uint32_t edge) const {
  const Half there = edge << 1;
  const std::uint32_t left_apex = apex(*this, there);
  const std::uint32_t right_apex = apex(*this, twin(there));
  if (left_apex == kNoElement || right_apex == kNoElement) return "it is not between two triangles";
  if (left(there) == left(twin(there)) || left_apex == right_apex) return "its triangles are one";
  if (find(left_apex, right_apex) != kNoElement) return "the other diagonal is an edge already";
  return nullptr;
}

void WingedEdge::flip_edge(std::uint32_t edge) {
  if (const char* const why = why_not_flip(edge)) refuse("flip_edge", fmt::format("edge {}: {}", edge, why));
  const Half there = edge << 1;
  const Half back = twin(there);
  const Half left_after = next(there);
  const Half left_before = previous(there);
  const Half right_after = next(back);
  const Half right_before = previous(back);
  const std::uint32_t faces[2] = {left(there), left(back)};
  point_at(from(there), right_after);
  point_at(to(there), left_after);
  edges_[edge].vertex = {to(right_after), to(left_after)};
  link(there, left_before);
  link(left_before, right_after);
  link(right_after, there);
  link(back, right_before);
  link(right_before, left_after);
  link(left_after, back);
  set_left(right_after, faces[0]);
  set_left(left_after, faces[1]);
  loops_[faces_[faces[0]].loop].half = there;
  loops_[faces_[faces[1]].loop].half = back;
}

}  // namespace azulejo
