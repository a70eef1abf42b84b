#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/modelling/winged_edge.h"
#include "azulejo/modelling/winged_edge_parts.h"

namespace azulejo {
namespace {

[[noreturn]] void refuse(const char* operation, const std::string& why) {
  throw Error(Error::Argument, fmt::format("{}: {}", operation, why));
}

}  // namespace

WingedEdge::Made WingedEdge::make_vertex_face_shell(const glm::vec3& position) {
  Made made;
  made.vertex = new_vertex(position, kNoElement);
  made.face = new_face(kNoElement);
  made.loop = new_loop(made.face);
  loops_[made.loop].vertex = made.vertex;
  return made;
}

void WingedEdge::kill_vertex_face_shell(std::uint32_t face) {
  constexpr const char* kName = "kill_vertex_face_shell";
  if (face >= faces_.size() || !face_alive(face)) refuse(kName, "no such face");
  const std::uint32_t loop = faces_[face].loop;
  if (loops_[loop].next != kNoElement || loops_[loop].half != kNoElement) {
    refuse(kName, fmt::format("face {} has edges, expected a lone vertex", face));
  }
  free_vertex(loops_[loop].vertex);
  free_loop(loop);
  free_face(face);
}

WingedEdge::Made WingedEdge::make_edge_vertex(Half before, const glm::vec3& position) {
  Made made;
  const std::uint32_t begin = from(before);
  const Half arriving = previous(before);
  const std::uint32_t face = left(before);
  made.vertex = new_vertex(position, vertices_[begin].source);
  made.edge = new_edge(begin, made.vertex);
  edges_[made.edge].face = {face, face};
  const Half there = made.edge << 1;
  link(arriving, there);
  link(there, twin(there));
  link(twin(there), before);
  point_at(made.vertex, there);
  return made;
}

WingedEdge::Made WingedEdge::make_edge_vertex_at(std::uint32_t loop, const glm::vec3& position) {
  if (loop >= loops_.size() || loops_[loop].face == kNoElement || loops_[loop].half != kNoElement) {
    refuse("make_edge_vertex_at", fmt::format("loop {} is no lone vertex", loop));
  }
  Made made;
  const std::uint32_t begin = loops_[loop].vertex;
  const std::uint32_t face = loops_[loop].face;
  made.vertex = new_vertex(position, vertices_[begin].source);
  made.edge = new_edge(begin, made.vertex);
  edges_[made.edge].face = {face, face};
  const Half there = made.edge << 1;
  link(there, twin(there));
  link(twin(there), there);
  point_at(begin, there);
  point_at(made.vertex, there);
  loops_[loop].half = there;
  loops_[loop].vertex = kNoElement;
  return made;
}

void WingedEdge::kill_edge_vertex(Half half) {
  if (next(half) != twin(half)) {
    refuse("kill_edge_vertex", fmt::format("vertex {} has other edges than {}", to(half), half >> 1));
  }
  const std::uint32_t begin = from(half);
  const std::uint32_t loop = loop_with(half);
  const Half arriving = previous(half);
  const Half leaving_after = next(twin(half));
  free_vertex(to(half));
  if (arriving == twin(half)) {
    vertices_[begin].edge = kNoElement;
    if (loop != kNoElement) {
      loops_[loop].half = kNoElement;
      loops_[loop].vertex = begin;
    }
  } else {
    link(arriving, leaving_after);
    point_at(begin, leaving_after);
    if (loop != kNoElement && loops_[loop].half >> 1 == half >> 1) loops_[loop].half = leaving_after;
  }
  free_edge(half >> 1);
}

WingedEdge::Made WingedEdge::make_edge_face(Half begin, Half end) {
  constexpr const char* kName = "make_edge_face";
  const std::uint32_t face = left(begin);
  if (begin == end || from(begin) == from(end)) refuse(kName, "an edge would have two equal ends");
  bool same_loop = false;
  for (const Half each : loop_of(begin)) same_loop = same_loop || each == end;
  if (!same_loop) refuse(kName, fmt::format("edges {} and {} are in different loops", begin >> 1, end >> 1));
  const std::uint32_t loop = loop_with(begin);
  const Half before_begin = previous(begin);
  const Half before_end = previous(end);

  Made made;
  made.edge = new_edge(from(begin), from(end));
  made.face = new_face(face == kNoElement ? kNoElement : faces_[face].source);
  made.loop = new_loop(made.face);
  const Half kept = made.edge << 1;
  set_left(kept, face);
  link(before_end, twin(kept));
  link(twin(kept), begin);
  link(before_begin, kept);
  link(kept, end);
  loops_[made.loop].half = twin(kept);
  if (loop != kNoElement) loops_[loop].half = kept;
  for (const Half each : loop_of(begin)) set_left(each, made.face);
  return made;
}

void WingedEdge::kill_edge_face(Half half) {
  constexpr const char* kName = "kill_edge_face";
  const std::uint32_t killed = left(half);
  const std::uint32_t kept = left(twin(half));
  if (killed == kNoElement || killed == kept) refuse(kName, fmt::format("edge {} has one face only", half >> 1));
  const std::uint32_t loop = faces_[killed].loop;
  if (loops_[loop].next != kNoElement) refuse(kName, fmt::format("face {} has several loops", killed));
  const std::uint32_t kept_loop = loop_with(twin(half));
  const Half after = next(half);
  const Half before = previous(half);
  const Half after_twin = next(twin(half));
  const Half before_twin = previous(twin(half));
  for (const Half each : loop_of(half)) set_left(each, kept);
  link(before, after_twin);
  link(before_twin, after);
  point_at(from(half), after_twin);
  point_at(to(half), after);
  if (kept_loop != kNoElement && loops_[kept_loop].half == twin(half)) loops_[kept_loop].half = after_twin;
  free_loop(loop);
  free_face(killed);
  free_edge(half >> 1);
}

WingedEdge::Made WingedEdge::kill_edge_make_loop(Half half) {
  constexpr const char* kName = "kill_edge_make_loop";
  const std::uint32_t face = left(half);
  bool same_loop = false;
  for (const Half each : loop_of(half)) same_loop = same_loop || each == twin(half);
  if (face == kNoElement || !same_loop) {
    refuse(kName, fmt::format("edge {} has not the same loop on both sides", half >> 1));
  }
  const std::uint32_t loop = loop_with(half);
  const Half before = previous(half);
  const Half after = next(half);
  const Half before_twin = previous(twin(half));
  const Half after_twin = next(twin(half));
  if (before == twin(half)) refuse(kName, fmt::format("vertex {} has no other edge", from(half)));
  Made made;
  made.loop = new_loop(face);
  link(before, after_twin);
  point_at(from(half), after_twin);
  loops_[loop].half = after_twin;
  if (after == twin(half)) {
    vertices_[to(half)].edge = kNoElement;
    loops_[made.loop].vertex = to(half);
  } else {
    link(before_twin, after);
    point_at(to(half), after);
    loops_[made.loop].half = after;
  }
  free_edge(half >> 1);
  return made;
}

WingedEdge::Made WingedEdge::make_edge_kill_loop(Half outer, Half inner) {
  constexpr const char* kName = "make_edge_kill_loop";
  const std::uint32_t face = left(outer);
  if (face == kNoElement || left(inner) != face) refuse(kName, "the loops are not of one face");
  const std::uint32_t inner_loop = loop_with(inner);
  if (loop_with(outer) == inner_loop) refuse(kName, "both ends are in one loop");
  if (from(outer) == from(inner)) refuse(kName, "an edge would have two equal ends");
  const Half before_outer = previous(outer);
  const Half before_inner = previous(inner);
  unhang(inner_loop);
  free_loop(inner_loop);
  Made made;
  made.edge = new_edge(from(outer), from(inner));
  edges_[made.edge].face = {face, face};
  const Half there = made.edge << 1;
  link(before_outer, there);
  link(there, inner);
  link(before_inner, twin(there));
  link(twin(there), outer);
  return made;
}

WingedEdge::Made WingedEdge::make_edge_kill_loop_at(Half outer, std::uint32_t lone_loop) {
  constexpr const char* kName = "make_edge_kill_loop_at";
  const std::uint32_t face = left(outer);
  if (lone_loop >= loops_.size() || loops_[lone_loop].face == kNoElement || loops_[lone_loop].half != kNoElement) {
    refuse(kName, fmt::format("loop {} is no lone vertex", lone_loop));
  }
  if (face == kNoElement || loops_[lone_loop].face != face) refuse(kName, "the loops are not of one face");
  const Half before = previous(outer);
  const std::uint32_t lone = loops_[lone_loop].vertex;
  unhang(lone_loop);
  free_loop(lone_loop);
  Made made;
  made.edge = new_edge(from(outer), lone);
  edges_[made.edge].face = {face, face};
  const Half there = made.edge << 1;
  link(before, there);
  link(there, twin(there));
  link(twin(there), outer);
  point_at(lone, there);
  return made;
}

WingedEdge::Made WingedEdge::kill_face_make_loop(std::uint32_t kept, std::uint32_t killed) {
  constexpr const char* kName = "kill_face_make_loop";
  const auto known = [&](std::uint32_t face) { return face < faces_.size() && face_alive(face); };
  if (!known(kept) || !known(killed) || kept == killed) refuse(kName, "expected two faces");
  Made made;
  made.loop = faces_[killed].loop;
  if (loops_[made.loop].next != kNoElement) refuse(kName, fmt::format("face {} has several loops", killed));
  for (const Half each : halves_of(made.loop)) set_left(each, kept);
  hang(kept, made.loop);
  free_face(killed);
  return made;
}

WingedEdge::Made WingedEdge::make_face_kill_loop(std::uint32_t loop) {
  constexpr const char* kName = "make_face_kill_loop";
  if (loop >= loops_.size() || loops_[loop].face == kNoElement) refuse(kName, "no such loop");
  const std::uint32_t face = loops_[loop].face;
  if (loops_[faces_[face].loop].next == kNoElement) refuse(kName, fmt::format("face {} has no other loop", face));
  unhang(loop);
  Made made;
  made.face = new_face(faces_[face].source);
  made.loop = loop;
  hang(made.face, loop);
  for (const Half each : halves_of(loop)) set_left(each, made.face);
  return made;
}

void WingedEdge::move_loop(std::uint32_t loop, std::uint32_t face) {
  constexpr const char* kName = "move_loop";
  if (loop >= loops_.size() || loops_[loop].face == kNoElement) refuse(kName, "no such loop");
  if (face >= faces_.size() || !face_alive(face)) refuse(kName, "no such face");
  if (loops_[faces_[loops_[loop].face].loop].next == kNoElement) {
    refuse(kName, fmt::format("face {} has no other loop", loops_[loop].face));
  }
  unhang(loop);
  hang(face, loop);
  for (const Half each : halves_of(loop)) set_left(each, face);
}

}  // namespace azulejo
