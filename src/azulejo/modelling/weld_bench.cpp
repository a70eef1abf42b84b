#include "azulejo/modelling/weld.h"

#include <memory>
#include <random>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

/// Every triangle with vertices of its own, shaken by up to `shake` along each axis.
Mesh soup(const Mesh& mesh, float shake) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> jitter(-shake, shake);
  Mesh result;
  result.corners.resize(mesh.corner_count());
  result.positions.resize(mesh.corner_count());
  for (std::size_t i = 0; i < mesh.corner_count(); ++i) {
    result.corners[i] = static_cast<std::uint32_t>(i);
    result.positions[i] = mesh.positions[mesh.corners[i]];
    if (shake > 0) result.positions[i] += glm::vec3(jitter(random), jitter(random), jitter(random));
  }
  return result;
}

Row weld_row(float shake, const WeldOptions& options, double aim) {
  const auto source = std::make_shared<Mesh>(soup(sphere(1'000'000), shake));
  const auto found = std::make_shared<std::size_t>(0);
  const auto peers = std::make_shared<std::size_t>(0);
  const std::size_t vertices = sphere(1'000'000).vertex_count();
  Row row;
  row.work = static_cast<double>(source->face_count());
  row.unit = "Mtri/s";
  row.ours = [=](int threads) {
    azulejo::Run run;
    run.threads = threads;
    *found = weld(*source, options, run).mesh.vertex_count();
  };
  row.peer_name = "meshoptimizer, equal vertices";
  row.peer = [=](int) {
    // What it takes to have the mesh: the table, and vertices and indices by it.
    Array<unsigned int> remap(source->vertex_count());
    const std::size_t unique =
        meshopt_generateVertexRemap(remap.data(), source->corners.data(), source->corner_count(),
                                    source->positions.data(), source->vertex_count(), sizeof(glm::vec3));
    Array<glm::vec3> positions(unique);
    meshopt_remapVertexBuffer(positions.data(), source->positions.data(), source->vertex_count(), sizeof(glm::vec3),
                              remap.data());
    Array<unsigned int> corners(source->corner_count());
    meshopt_remapIndexBuffer(corners.data(), source->corners.data(), source->corner_count(), remap.data());
    *peers = unique;
  };
  row.limit = copy_limit(source->corner_count() * 16, source->corner_count() * 4 + vertices * 12);
  row.check = [=]() -> Check {
    return {*found == vertices && (shake > 0 || *peers == vertices),
            fmt::format("{} vertices of {}, the peer's {}", *found, vertices, *peers)};
  };
  row.aim = aim;
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("weld, equal places, soup of 1 M triangles", [] { return weld_row(0, {}, 1); });
  // The sphere's shortest edges are at the poles: 2π/1000 · sin(π/501) = 4e-5.
  bench.row("weld, tolerance 5e-6, soup of 1 M triangles", [] { return weld_row(1e-6F, {.tolerance = 5e-6F}, 0.2); });
});

}  // namespace
}  // namespace azulejo::bench
