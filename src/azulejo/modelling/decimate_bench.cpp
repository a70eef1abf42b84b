#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <meshoptimizer.h>
#include <glm/geometric.hpp>

#include "azulejo/io/model_io.h"
#include "azulejo/modelling/decimate.h"
#include "azulejo/modelling/distance.h"
#include "harness.h"
#include "models.h"

namespace azulejo::bench {
namespace {

/// A sphere with waves on it, and fine noise.
Mesh bumpy_sphere(std::size_t triangles) {
  Mesh mesh = sphere(triangles);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> noise(-0.0002F, 0.0002F);
  for (glm::vec3& p : mesh.positions) {
    p *= 1 + 0.1F * std::sin(8 * p.x) * std::sin(9 * p.y) * std::sin(7 * p.z) + noise(random);
  }
  return mesh;
}

/// Decimated by meshoptimizer.
Mesh simplified(const Mesh& source, double ratio) {
  Mesh result;
  result.positions = source.positions;
  result.corners.resize(source.corners.size());
  const auto target = static_cast<std::size_t>(ratio * static_cast<double>(source.face_count()));
  result.corners.resize(meshopt_simplify(result.corners.data(), source.corners.data(), source.corners.size(),
                                         &source.positions[0].x, source.positions.size(), sizeof(glm::vec3), 3 * target,
                                         1.0F, 0, nullptr));
  return result;
}

Row decimation(std::shared_ptr<const Mesh> source, float ratio) {
  const auto ours = std::make_shared<Mesh>();
  const auto peer = std::make_shared<Mesh>();
  Row row;
  row.work = static_cast<double>(source->face_count());
  row.unit = "Mtri/s";
  row.aim = 1;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    DecimateOptions options;
    options.ratio = ratio;
    *ours = decimate(*source, options, run).mesh;
  };
  row.peer_name = "meshoptimizer";
  row.peer = [=](int) { *peer = simplified(*source, static_cast<double>(ratio)); };
  row.check = [=] {
    const double share = static_cast<double>(ours->face_count()) / static_cast<double>(peer->face_count());
    const MeshDistanceOptions one_way{.symmetric = false, .refinements = 0};  // from the source: vertices and samples
    const SurfaceDistance here = distance(*source, *ours, one_way).forward;
    const SurfaceDistance there = distance(*source, *peer, one_way).forward;
    const double mean = here.mean / there.mean;
    return Check{std::abs(share - 1) < 0.05 && mean < 0.8,
                 fmt::format("{} triangles, {}; mean distance from the source {:.2f} of its, largest {:.2f}",
                             ours->face_count(), peer->face_count(), mean, here.maximum / there.maximum)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  for (const float ratio : {0.5F, 0.1F, 0.01F}) {
    const std::string percent = fmt::format("{} %", 100 * ratio);
    bench.row("decimate bumpy sphere of 1 M triangles to " + percent,
              [=] { return decimation(std::make_shared<const Mesh>(bumpy_sphere(1000000)), ratio); });
    const std::optional<std::string> dragon = shared_model("meshes/scans/stanford_dragon_full.ply.gz");
    if (!dragon) continue;
    bench.row("decimate dragon of 0.9 M triangles to " + percent,
              [=] { return decimation(std::make_shared<const Mesh>(std::get<Mesh>(read_model(*dragon))), ratio); });
  }
});

}  // namespace
}  // namespace azulejo::bench
