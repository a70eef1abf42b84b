#include "azulejo/modelling/tangents.h"

#include <fmt/format.h>

#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/tessellate.h"
#include "harness.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  bench.row("tangents, 1 M triangles", [] {
    const auto mesh =
        std::make_shared<Mesh>(tessellate(primitive({.kind = PrimitiveKind::Torus, .segments = 1000, .rings = 500})));
    const auto ours = std::make_shared<Mesh>();
    Row row;
    row.work = static_cast<double>(mesh->face_count());
    row.unit = "Mtri/s";
    row.aim_seconds = 0.8;
    row.ours = [=](int threads) {
      Run run;
      run.threads = threads;
      *ours = tangents(*mesh, {}, run);
    };
    row.limit = copy_limit(32 * mesh->corner_count(), 16 * mesh->corner_count());
    row.check = [=] {
      const Attribute* const found = ours->find("TANGENT");
      const bool right = found != nullptr && found->size() >= mesh->vertex_count();
      return Check{right, fmt::format("{} tangents", right ? found->size() : 0)};
    };
    return row;
  });
});

}  // namespace
}  // namespace azulejo::bench
