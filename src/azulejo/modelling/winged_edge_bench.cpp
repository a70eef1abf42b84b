#include "azulejo/modelling/winged_edge_build.h"

#include <fmt/format.h>

#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  bench.row("winged edge of a mesh, 1 M triangles", [] {
    const auto mesh = std::make_shared<Mesh>(sphere(1'000'000));
    const auto made = std::make_shared<WingedEdgeOfMesh>();
    Row row;
    row.work = static_cast<double>(mesh->face_count());
    row.unit = "Mtri/s";
    row.aim_seconds = 0.4;
    row.ours = [=](int threads) {
      Run run;
      run.threads = threads;
      *made = winged_edge(*mesh, run);
    };
    const std::size_t edges = mesh->face_count() * 3 / 2;
    row.limit = copy_limit(4 * mesh->corner_count(), 32 * edges);
    row.check = [=] {
      const WingedEdge& solid = made->solid;
      const bool right = solid.edge_count() == edges && solid.face_count() == mesh->face_count() &&
                         made->changes.none() && solid.border_loop_count() == 0;
      return Check{right, fmt::format("{:.1f} bytes an edge in all",
                                      static_cast<double>(solid.memory_bytes()) / static_cast<double>(edges))};
    };
    return row;
  });
});

}  // namespace
}  // namespace azulejo::bench
