#include "azulejo/modelling/convex_hull.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include <fmt/format.h>

#include "harness.h"

namespace azulejo::bench {
namespace {

double volume_of(const Mesh& mesh) {
  double six = 0;
  const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.corners[c]]); };
  for (std::size_t c = 0; c + 2 < mesh.corner_count(); c += 3) {
    six += glm::dot(corner(c), glm::cross(corner(c + 1), corner(c + 2)));
  }
  return six / 6;
}

/// Points in a ball, or on a sphere, as uniform as random numbers are.
Mesh cloud(std::size_t count, bool filled) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0, 1);
  Mesh mesh;
  while (mesh.positions.size() < count) {
    const glm::dvec3 p(normal(random), normal(random), normal(random));
    mesh.positions.emplace_back(p / glm::length(p) * (filled ? std::cbrt(share(random)) : 1.0));
  }
  return mesh;
}

/// What qhull makes of the same points.
struct Qhull {
  double volume = 0;
  int vertices = 0;

  void compute(const Mesh& mesh) {
    std::vector<double> points;
    points.reserve(3 * mesh.vertex_count());
    for (const glm::vec3& p : mesh.positions) points.insert(points.end(), {p.x, p.y, p.z});
    qhT qhull;
    qh_zero(&qhull, stderr);
    char options[] = "qhull Pp";
    qh_new_qhull(&qhull, 3, static_cast<int>(mesh.vertex_count()), points.data(), 0, options, nullptr, stderr);
    qh_getarea(&qhull, qhull.facet_list);
    volume = qhull.totvol;
    vertices = qhull.num_vertices;
    qh_freeqhull(&qhull, !qh_ALL);
    int blocks = 0;
    int bytes = 0;
    qh_memfreeshort(&qhull, &blocks, &bytes);
  }
};

Row hull(std::size_t count, bool filled) {
  const auto source = std::make_shared<Mesh>(cloud(count, filled));
  const auto ours = std::make_shared<Mesh>();
  const auto peer = std::make_shared<Qhull>();
  Row row;
  row.work = static_cast<double>(count);
  row.unit = "Mpoint/s";
  row.aim = 1;
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = convex_hull(*source, {}, run);
  };
  row.peer_name = "qhull";
  row.peer = [=](int) { peer->compute(*source); };
  row.check = [=] {
    // qhull merges facets that doubles can't tell apart, by as much as their rounding.
    const double apart = std::abs(volume_of(*ours) - peer->volume) / peer->volume;
    return Check{apart < 1e-9,
                 fmt::format("volumes {:.1e} apart, {} vertices and {}", apart, ours->vertex_count(), peer->vertices)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("convex hull, 10⁶ points in a ball", [] { return hull(1'000'000, true); });
  bench.row("convex hull, 10⁵ points on a sphere", [] { return hull(100'000, false); });
});

}  // namespace
}  // namespace azulejo::bench
