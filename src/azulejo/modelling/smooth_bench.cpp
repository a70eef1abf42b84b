#include "azulejo/modelling/smooth.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

Row smoothing(SmoothWeights weights) {
  const auto mesh = std::make_shared<Mesh>(sphere(1000000));
  const auto ours = std::make_shared<Mesh>();
  mesh->attributes.clear();
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.002F);
  for (glm::vec3& each : mesh->positions) each *= 1 + noise(random);
  const SmoothOptions options{.weights = weights};
  Row row;
  row.work = static_cast<double>(mesh->vertex_count()) * 2 * options.iterations;
  row.unit = "Mvertex/s";
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = smooth(*mesh, options, run);
  };
  // What each step reads and writes: six neighbors of each vertex, with their weights, and positions.
  const std::size_t steps = 2 * static_cast<std::size_t>(options.iterations);
  const std::size_t per_vertex = weights == SmoothWeights::Cotangent ? 48 : 24;
  row.limit = copy_limit(steps * mesh->vertex_count() * (per_vertex + 12), steps * mesh->vertex_count() * 12);
  row.check = [=] {
    const auto roughness = [](const Mesh& of) {
      double sum = 0;
      for (const glm::vec3& p : of.positions) sum += std::pow(glm::length(glm::dvec3(p)) - 1, 2);
      return std::sqrt(sum / static_cast<double>(of.vertex_count()));
    };
    const double left = roughness(*ours) / roughness(*mesh);
    return Check{left < 0.5, fmt::format("{:.2f} of the noise left", left)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("smooth, 10 iterations, 1 M triangles", [] { return smoothing(SmoothWeights::Uniform); });
  bench.row("smooth cotangent, 10 iterations, 1 M triangles", [] { return smoothing(SmoothWeights::Cotangent); });
});

}  // namespace
}  // namespace azulejo::bench
