#include "azulejo/modelling/corners_of_vertices.h"

#include <algorithm>
#include <vector>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kVertices = std::size_t{1} << 14;  // a chunk

/// Turns counts, part by part, into where each part's corners of each vertex begin.
void add_up(std::vector<Array<std::uint32_t>>& parts, Array<std::uint32_t>& first, const Run& run) {
  const std::size_t vertices = first.size() - 1;
  std::vector<std::uint32_t> chunk_begins((vertices + kVertices - 1) / kVertices + 1, 0);
  parallel_for(vertices, kVertices, run, [&](std::size_t begin, std::size_t end) {
    std::uint32_t sum = 0;
    for (const Array<std::uint32_t>& part : parts) {
      for (std::size_t v = begin; v < end; ++v) sum += part[v];
    }
    chunk_begins[begin / kVertices + 1] = sum;
  });
  for (std::size_t c = 1; c < chunk_begins.size(); ++c) chunk_begins[c] += chunk_begins[c - 1];
  parallel_for(vertices, kVertices, run, [&](std::size_t begin, std::size_t end) {
    std::uint32_t sum = chunk_begins[begin / kVertices];
    for (std::size_t v = begin; v < end; ++v) {
      first[v] = sum;
      for (Array<std::uint32_t>& part : parts) {
        const std::uint32_t count = part[v];
        part[v] = sum;
        sum += count;
      }
    }
  });
  first[vertices] = chunk_begins.back();
}

}  // namespace

VertexCorners corners_of_vertices(const Mesh& mesh, const Run& run) {
  const std::size_t vertices = mesh.vertex_count();
  const std::size_t corners = mesh.corner_count();
  // A stable counting sort: the result is the same for any number of parts.
  constexpr std::size_t kSmallest = std::size_t{1} << 16;
  const std::size_t parts =
      std::clamp<std::size_t>(corners / kSmallest, 1, static_cast<std::size_t>(std::min(thread_count(run), 8)));
  const auto begin_of = [&](std::size_t part) { return part * corners / parts; };
  std::vector<Array<std::uint32_t>> places(parts);
  parallel_tasks(parts, run, [&](std::size_t part, int) {
    places[part].assign(vertices, 0);
    std::uint32_t* const count = places[part].data();
    for (std::size_t c = begin_of(part); c < begin_of(part + 1); ++c) ++count[mesh.corners[c]];
  });
  VertexCorners result;
  result.first.resize(vertices + 1);
  result.corners.resize(corners);
  add_up(places, result.first, run);
  parallel_tasks(parts, run, [&](std::size_t part, int) {
    std::uint32_t* const place = places[part].data();
    for (std::size_t c = begin_of(part); c < begin_of(part + 1); ++c) {
      result.corners[place[mesh.corners[c]]++] = static_cast<std::uint32_t>(c);
    }
  });
  return result;
}

Array<std::uint32_t> faces_of_corners(const Mesh& mesh, const Run& run) {
  Array<std::uint32_t> faces;
  if (mesh.all_triangles()) return faces;
  faces.resize(mesh.corner_count());
  parallel_for(mesh.face_count(), kVertices, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      std::fill(faces.begin() + static_cast<std::ptrdiff_t>(mesh.face_begin(f)),
                faces.begin() + static_cast<std::ptrdiff_t>(mesh.face_end(f)), static_cast<std::uint32_t>(f));
    }
  });
  return faces;
}

}  // namespace azulejo
