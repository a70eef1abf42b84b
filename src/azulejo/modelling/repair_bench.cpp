#include "azulejo/modelling/repair.h"

#include <memory>
#include <random>

#include <fmt/format.h>

#include "azulejo/modelling/topology.h"
#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

/// Without some faces, and some turned.
Mesh holed(const Mesh& mesh, unsigned one_of) {
  std::mt19937 random(1);
  Mesh left;
  left.positions = mesh.positions;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (random() % one_of == 0) continue;
    const bool turned = random() % 64 == 0;
    for (const std::size_t i : {0, turned ? 2 : 1, turned ? 1 : 2}) left.corners.push_back(mesh.corners[3 * f + i]);
  }
  return left;
}

Row repair_row(Mesh mesh, double aim_seconds) {
  const auto source = std::make_shared<Mesh>(std::move(mesh));
  const auto found = std::make_shared<RepairedMesh>();
  Row row;
  row.work = static_cast<double>(source->face_count());
  row.unit = "Mtri/s";
  row.ours = [=](int threads) {
    azulejo::Run run;
    run.threads = threads;
    *found = repair(*source, {}, run);
  };
  const std::size_t bytes = source->corner_count() * 4 + source->vertex_count() * 12;
  row.limit = copy_limit(bytes, bytes);
  row.check = [=]() -> Check {
    return {topology(found->mesh).printable(),
            fmt::format("{} holes, {} faces turned", found->count(RepairAction::FilledHole),
                        found->count(RepairAction::TurnedFace))};
  };
  row.aim_seconds = aim_seconds;
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("repair, a solid of 1 M triangles", [] { return repair_row(sphere(1'000'000), 1); });
  bench.row("repair, 1 M triangles with 10 000 holes", [] { return repair_row(holed(sphere(1'000'000), 100), 3); });
});

}  // namespace
}  // namespace azulejo::bench
