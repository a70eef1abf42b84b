#include "azulejo/modelling/distance_surface.h"

#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

DistanceSurface::DistanceSurface(const Mesh& mesh, const char* what, const Run& run)
    : mesh_(mesh), area_(mesh, run), vertices_(mesh.vertex_count(), 0), tree_(elements(what, run), run) {}

std::vector<NearestTriangle::Triangle> DistanceSurface::elements(const char* what, const Run& run) {
  std::vector<NearestTriangle::Triangle> list;
  list.reserve(area_.triangle_count());
  triangles_.reserve(area_.triangle_count());
  for (std::size_t t = 0; t < area_.triangle_count(); ++t) {
    if (!area_.finite(t)) continue;
    triangles_.push_back(static_cast<std::uint32_t>(t));
    NearestTriangle::Triangle& triangle = list.emplace_back();
    const auto corners = area_.corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh_.corners[corners[i]];
      vertices_[vertex] = 1;
      triangle[i] = mesh_.positions[vertex];
    }
  }
  std::size_t left_out = area_.triangle_count() - list.size();
  const bool as_points = list.empty();
  if (as_points) {
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
      const glm::vec3& p = mesh_.positions[v];
      if (!is_finite(p)) {
        ++left_out;
        continue;
      }
      vertices_[v] = 1;
      list.push_back({p, p, p});
    }
  }
  if (list.empty()) {
    throw Error(Error::Argument,
                fmt::format("{}: {} vertices, none of them finite, expected one at least", what, mesh_.vertex_count()));
  }
  if (left_out > 0) {
    warn(run, fmt::format("{}: {} of its {} are not finite and left out", what, left_out,
                          as_points ? "vertices" : "triangles"));
  }
  return list;
}

}  // namespace azulejo
