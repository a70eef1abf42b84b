#include "azulejo/modelling/topology.h"

#include <fmt/format.h>

#include "azulejo/modelling/topology_marks.h"
#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

constexpr std::size_t kTriangles = 1'000'000;

/// A copy of the mesh's positions and corners is the limit: no program for the same report can be linked here.
Row survey(Mesh made, const TopologyOptions& options, double aim_seconds, std::size_t faults) {
  const auto mesh = std::make_shared<Mesh>(std::move(made));
  const auto found = std::make_shared<Topology>();
  Row row;
  row.work = static_cast<double>(mesh->face_count());
  row.unit = "Mtri/s";
  row.aim_seconds = aim_seconds;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *found = topology(*mesh, options, run);
  };
  row.limit = copy_limit(12 * mesh->vertex_count() + 4 * mesh->corner_count(), 4 * mesh->corner_count());
  row.check = [=] {
    std::size_t all = 0;
    for (const MeshFaults& each : found->faults) all += each.count;
    const bool right = all == faults && found->faces == mesh->face_count();
    return Check{right, fmt::format("{} faults, Euler {}", all, found->euler())};
  };
  return row;
}

/// A closed sphere, whose triangles are in any order.
Mesh shuffled(Mesh mesh) {
  std::uint64_t state = 1;
  for (std::size_t t = mesh.face_count(); t-- > 1;) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const std::size_t other = (state >> 33) % (t + 1);
    for (std::size_t c = 0; c < 3; ++c) std::swap(mesh.corners[3 * t + c], mesh.corners[3 * other + c]);
  }
  return mesh;
}

const Rows kRows([](Bench& bench) {
  bench.row("topology, 1 M triangles", [] { return survey(sphere(kTriangles), {}, 0.7, 0); });
  bench.row("topology, 1 M triangles in any order", [] { return survey(shuffled(sphere(kTriangles)), {}, 0, 0); });
  bench.row("topology with self-intersections, 1 M triangles",
            [] { return survey(sphere(kTriangles), {.self_intersections = true}, 3, 0); });
  bench.row("topology marked, 1 M triangles", [] {
    // One triangle is left out: three border edges to look for.
    Mesh open = sphere(kTriangles);
    open.corners.resize(open.corners.size() - 3);
    const auto scene = std::make_shared<Scene>(scene_of(std::move(open)));
    const auto found = std::make_shared<Topology>(topology(*scene->meshes[0]));
    const auto marked = std::make_shared<MarkedScene>();
    Row row;
    row.work = static_cast<double>(scene->meshes[0]->face_count());
    row.unit = "Mtri/s";
    row.ours = [=](int threads) {
      Run run;
      run.threads = threads;
      *marked = mark_faults(*scene, {found.get(), 1}, 20000, run);
    };
    row.check = [=] {
      const std::size_t marks = marked->marks[static_cast<std::size_t>(MeshFaultKind::BorderEdge)];
      return Check{marks == 3, fmt::format("{} marks", marks)};
    };
    return row;
  });
});

}  // namespace
}  // namespace azulejo::bench
