#include <algorithm>
#include <utility>

#include "azulejo/modelling/decimate_parts.h"

namespace azulejo::decimation {
namespace {

/// Of each that is left, which one it becomes; kNone where it is gone.
template <class IsGone>
Array<std::uint32_t> numbered(std::size_t count, IsGone is_gone) {
  Array<std::uint32_t> numbers(count);
  std::uint32_t left = 0;
  for (std::size_t i = 0; i < count; ++i) numbers[i] = is_gone(i) ? kNone : left++;
  return numbers;
}

/// Moves `width` values each to their new numbers.
template <class T>
void move_rows(const Array<std::uint32_t>& numbers, std::size_t width, Array<T>& rows) {
  if (rows.empty()) return;
  std::size_t left = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == kNone) continue;
    std::copy_n(rows.data() + i * width, width, rows.data() + left++ * width);
  }
  rows.resize(left * width);
}

}  // namespace

void renew_stars(Surface& surface, const Array<std::uint32_t>& triangles) {
  Array<std::uint32_t> stars;
  stars.reserve(kStarRoom * surface.faces);
  stars.resize(3 * surface.faces);
  std::uint32_t size = 0;
  for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
    const std::uint32_t first = size;
    surface.each_corner(v, [&](std::uint32_t corner) {
      stars[size++] = triangles.empty() ? corner : 3 * triangles[corner / 3] + corner % 3;
    });
    surface.vertices[v].star_first = first;
    surface.vertices[v].star_size = size - first;
  }
  surface.stars = std::move(stars);
}

Array<std::uint32_t> compact(Surface& surface) {
  Surface& s = surface;
  const std::size_t count = s.corners.size() / 3;
  const Array<std::uint32_t> triangles = numbered(count, [&](std::size_t t) { return s.corners[3 * t] == kNone; });
  Array<std::uint32_t> edges = numbered(s.ends.size(), [&](std::size_t e) { return s.ends[e][0] == kNone; });
  if (s.source_faces.empty()) {
    s.source_faces.resize(count);
    for (std::size_t t = 0; t < count; ++t) s.source_faces[t] = static_cast<std::uint32_t>(t);
  }
  renew_stars(surface, triangles);
  s.source_corners.clear();
  move_rows(triangles, 1, s.source_faces);
  move_rows(triangles, 3, s.corners);
  move_rows(triangles, 3, s.edge_of_corner);
  move_rows(triangles, 3, s.wedges);
  for (std::uint32_t& edge : s.edge_of_corner) edge = edges[edge];
  move_rows(edges, 1, s.ends);
  move_rows(edges, 1, s.flags);
  move_rows(edges, 1, s.costs);
  return edges;
}

}  // namespace azulejo::decimation
