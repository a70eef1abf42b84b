#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <thread>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "azulejo/modelling/distance.h"
#include "models.h"

namespace azulejo::bench {
namespace {

/// Embree's tree, with a user's function that tells the nearest point of a triangle; its coordinates are floats.
class EmbreeDistances {
 public:
  EmbreeDistances(const Mesh& mesh, int threads)
      : mesh_(mesh), threads_(threads), device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
    scene_ = rtcNewScene(device_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                               sizeof(glm::vec3), mesh.vertex_count());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.corners.data(), 0,
                               3 * sizeof(std::uint32_t), mesh.face_count());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  EmbreeDistances(const EmbreeDistances&) = delete;
  EmbreeDistances& operator=(const EmbreeDistances&) = delete;
  ~EmbreeDistances() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void find(const Array<glm::vec3>& points, Array<float>& distances) const {
    const auto count = static_cast<std::size_t>(threads_);
    const auto part = [&](std::size_t worker) {
      const std::size_t end = points.size() * (worker + 1) / count;
      for (std::size_t i = points.size() * worker / count; i < end; ++i) distances[i] = distance(points[i]);
    };
    std::vector<std::jthread> workers;
    for (std::size_t worker = 1; worker < count; ++worker) workers.emplace_back(part, worker);
    part(0);
  }

 private:
  float distance(const glm::vec3& point) const {
    RTCPointQuery query{};
    query.x = point.x;
    query.y = point.y;
    query.z = point.z;
    query.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const Mesh* mesh = &mesh_;
    rtcPointQuery(scene_, &query, &context, look_at, &mesh);
    return query.radius;
  }

  static bool look_at(RTCPointQueryFunctionArguments* given) {
    const Mesh& mesh = **static_cast<const Mesh* const*>(given->userPtr);
    const auto corner = [&](std::size_t i) { return mesh.positions[mesh.corners[3 * std::size_t{given->primID} + i]]; };
    RTCPointQuery& query = *given->query;
    const float found = distance(glm::vec3(query.x, query.y, query.z), {corner(0), corner(1), corner(2)});
    if (!(found < query.radius)) return false;
    query.radius = found;
    return true;
  }

  /// Ericson, Real-Time Collision Detection, 5.1.5: by the region that the point is in.
  static float distance(const glm::vec3& p, const std::array<glm::vec3, 3>& t) {
    const glm::vec3 ab = t[1] - t[0];
    const glm::vec3 ac = t[2] - t[0];
    const glm::vec3 ap = p - t[0];
    const float d1 = glm::dot(ab, ap);
    const float d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return glm::length(ap);
    const glm::vec3 bp = p - t[1];
    const float d3 = glm::dot(ab, bp);
    const float d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return glm::length(bp);
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - ab * (d1 / (d1 - d3)));
    const glm::vec3 cp = p - t[2];
    const float d5 = glm::dot(ab, cp);
    const float d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return glm::length(cp);
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - ac * (d2 / (d2 - d6)));
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
      return glm::length(bp - (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    }
    const float sum = va + vb + vc;
    return glm::length(ap - ab * (vb / sum) - ac * (vc / sum));
  }

  const Mesh& mesh_;
  int threads_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

/// Distances of points from a sphere, with what has to be built for it.
Row distances(Mesh points, std::size_t triangles) {
  const auto cloud = std::make_shared<Mesh>(std::move(points));
  const auto mesh = std::make_shared<Mesh>(sphere(triangles));
  const auto ours = std::make_shared<Array<float>>();
  const auto peer = std::make_shared<Array<float>>(cloud->vertex_count());
  Row row;
  row.work = static_cast<double>(cloud->vertex_count());
  row.unit = "Mpoint/s";
  row.ours = [=](int threads) {
    Run run;
    run.threads = threads;
    *ours = distance(*cloud, *mesh, {.symmetric = false}, run).of_vertices;
  };
  row.peer_name = "Embree";
  row.peer = [=](int threads) { EmbreeDistances(*mesh, threads).find(cloud->positions, *peer); };
  row.check = [=] {
    float apart = 0;
    for (std::size_t i = 0; i < ours->size(); ++i) apart = std::max(apart, std::fabs((*ours)[i] - (*peer)[i]));
    return Check{apart < 1e-5F, fmt::format("distances {:.1e} apart", apart)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  for (const std::size_t triangles : {10'000U, 1'000'000U}) {
    bench.row(fmt::format("distance, 1 M points of a surface nearby, {} triangles", triangles), [=] {
      Mesh points;
      points.positions = sphere(2'000'000).positions;
      for (glm::vec3& p : points.positions) p *= 1.01F;
      return distances(std::move(points), triangles);
    });
    bench.row(fmt::format("distance, 1 M points anywhere, {} triangles", triangles), [=] {
      Mesh points;
      std::mt19937 random(1);
      std::uniform_real_distribution<float> place(-1.5F, 1.5F);
      for (int i = 0; i < 1'000'000; ++i) points.positions.emplace_back(place(random), place(random), place(random));
      return distances(std::move(points), triangles);
    });
  }
});

}  // namespace
}  // namespace azulejo::bench
