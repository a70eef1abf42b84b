#include "azulejo/modelling/winding_number.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "azulejo/modelling/classify_points.h"
#include "azulejo/modelling/winding_number_testing.h"
#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

/// A sphere, of which one triangle of so many is missing; 0: none.
Row classification(std::size_t triangles, std::size_t missing) {
  const auto surface = std::make_shared<Mesh>(sphere(triangles));
  if (missing > 0) {
    Array<std::uint32_t> kept;
    for (std::size_t c = 0; c < surface->corner_count(); ++c) {
      if (c / 3 % missing != 0) kept.push_back(surface->corners[c]);
    }
    surface->corners = std::move(kept);
  }
  const auto points = std::make_shared<Mesh>();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1.1F, 1.1F);
  for (int i = 0; i < 1'000'000; ++i) points->positions.emplace_back(place(random), place(random), place(random));
  const auto ours = std::make_shared<ClassifiedPoints>();
  Row row;
  row.work = static_cast<double>(points->vertex_count());
  row.unit = "Mpoint/s";
  row.aim_seconds = 1;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = classify_points(*surface, *points, ClassifyInMeshOptions(), run);
  };
  row.check = [=] {
    const Array<float>& winding = *ours->points.find("winding")->get<float>();
    double apart = 0;
    for (std::size_t i = 0; i < points->vertex_count(); i += 50'000) {
      apart = std::max(apart, std::abs(winding[i] - winding_by_definition(*surface, glm::dvec3(points->positions[i]))));
    }
    return Check{apart < 0.005, fmt::format("{:.1e} from the sum over all triangles", apart)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("classify 10⁶ points, sphere of 100 k triangles", [] { return classification(100'000, 0); });
  bench.row("classify 10⁶ points, sphere of 1 M triangles", [] { return classification(1'000'000, 0); });
  bench.row("classify 10⁶ points, sphere of 1 M triangles with 1 k holes",
            [] { return classification(1'000'000, 1'000); });
});

}  // namespace
}  // namespace azulejo::bench
