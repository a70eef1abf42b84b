#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "azulejo/modelling/measure.h"
#include "models.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  for (const bool on_a_ball : {true, false}) {
    bench.row(fmt::format("measure, 1 M triangles, {}", on_a_ball ? "all on the hull" : "few on the hull"), [=] {
      const auto mesh = std::make_shared<Mesh>(sphere(1'000'000));
      if (!on_a_ball) {
        for (glm::vec3& p : mesh->positions) p *= 1 + 0.2F * std::sin(30 * p.x) * std::sin(30 * p.y);
      }
      const auto ours = std::make_shared<MeshMeasure>();
      Row row;
      row.work = static_cast<double>(mesh->face_count());
      row.unit = "Mtri/s";
      row.ours = [=](int threads) {
        Run run;
        run.threads = threads;
        *ours = measure(*mesh, {}, run);
      };
      row.limit = copy_limit(mesh->face_count() * 12 + mesh->vertex_count() * 12, 0);
      row.check = [=]() -> Check {
        if (!ours->all.solid) return {false, ours->all.open};
        const double apart = std::abs(ours->all.solid->volume / (4.0 / 3 * std::numbers::pi) - 1);
        return {apart < (on_a_ball ? 1e-4 : 0.1), fmt::format("volume {:.1e} from the ball's", apart)};
      };
      return row;
    });
  }
});

}  // namespace
}  // namespace azulejo::bench
