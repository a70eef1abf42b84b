#include "azulejo/modelling/sample_points.h"

#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/surface_samples.h"

namespace azulejo {

extern const Operation kSamplePoints;

namespace {

constexpr double kMostRandom = 1e8;
constexpr double kMostSpaced = 2e6;
constexpr std::size_t kDefaultCount = 10'000;
constexpr std::size_t kCandidates = 8;  ///< for each point of a count
constexpr std::size_t kTries = 12;      ///< for each square of a radius

void check_together(const SamplePointsOptions& options) {
  const int given = (options.count ? 1 : 0) + (options.density ? 1 : 0) + (options.radius ? 1 : 0);
  if (given > 1)
    throw Error(Error::Argument, fmt::format("count: {} of count, density and radius, expected one", given));
  if (options.radius && options.method != SampleMethod::Poisson) {
    throw Error(Error::Argument, "radius: of random points, expected method=poisson");
  }
}

std::size_t checked_count(double count, SampleMethod method) {
  const double most = method == SampleMethod::Poisson ? kMostSpaced : kMostRandom;
  if (count > most)
    throw Error(Error::Resource, fmt::format("count: {:.0f} points, expected at most {:.0f}", count, most));
  return static_cast<std::size_t>(count);
}

Json report_json(const SampledPoints& sampled, SampleMethod method) {
  Json json = Json::object();
  const auto count = static_cast<double>(sampled.points.vertex_count());
  json.set("points", static_cast<std::uint64_t>(sampled.points.vertex_count())).set("area", sampled.area);
  json.set("density", count / sampled.area);
  if (method == SampleMethod::Poisson) json.set("radius", sampled.radius);
  return json;
}

}  // namespace

SampledPoints sample_points(const Mesh& mesh, const SamplePointsOptions& options, const Run& run) {
  kSamplePoints.check(&options);
  check_together(options);
  const SurfaceArea surface(mesh, run);
  SampledPoints result;
  result.area = surface.total();
  std::size_t left_out = 0;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) left_out += surface.finite(t) ? 0 : 1;
  if (left_out > 0) warn(run, fmt::format("sample_points: {} triangles are not finite and left out", left_out));
  if (!(result.area > 0)) {
    result.points = cloud_of(mesh, surface, {}, run);
    return result;
  }
  if (options.radius) {
    // About 0.7 of so many find a place.
    const double radius = static_cast<double>(*options.radius);
    const std::size_t most = checked_count(std::ceil(result.area / (radius * radius)), options.method);
    const SpacedSamples spaced = spaced_by(surface, radius, kTries * most, options.seed, run);
    result.radius = radius;
    result.points = cloud_of(mesh, surface, spaced.samples, run);
    return result;
  }
  const double wanted = options.density ? std::round(static_cast<double>(*options.density) * result.area)
                                        : static_cast<double>(options.count.value_or(kDefaultCount));
  const std::size_t count = checked_count(wanted, options.method);
  if (options.method == SampleMethod::Random) {
    result.points = cloud_of(mesh, surface, random_samples(surface, 0, count, options.seed, run), run);
    return result;
  }
  const SpacedSamples spaced = spaced_count(surface, count, kCandidates * count, options.seed, run);
  result.radius = spaced.radius;
  result.points = cloud_of(mesh, surface, spaced.samples, run);
  return result;
}

extern const Operation kSamplePoints = with_examples(
    value_operation<SamplePointsOptions>(
        "sample_points", "Spreads points over the surface of a mesh, at random or with distances between them.",
        {{"source", "the mesh", ValueKind::Mesh}},
        {{"points", "a point cloud with normals, the index of each point's face, and the mesh's attributes",
          ValueKind::Mesh},
         {"report", "how many points there are on which area, and the distance that they keep", ValueKind::Report,
          true}},
        {field("method", &SamplePointsOptions::method, "each point by itself, or none near another"),
         field("count", &SamplePointsOptions::count, {0, kMostRandom}, "",
               "of points; auto: 10 000 if neither density nor radius is given"),
         field("density", &SamplePointsOptions::density, {0, 1e30}, "", "points on a unit of area"),
         field("radius", &SamplePointsOptions::radius, {1e-30, 1e30}, "",
               "of poisson: the smallest distance of two points"),
         field("seed", &SamplePointsOptions::seed, {0, 2147483647}, "", "other points for each")},
        [](std::span<const Value> inputs, const SamplePointsOptions& options, const Run& run) {
          SampledPoints sampled = sample_points(*inputs[0].mesh(), options, run);
          Report report{report_json(sampled, options.method), true};
          return std::vector<Value>{Value(std::move(sampled.points)), Value(std::move(report))};
        }),
    {{"primitive:kind=teapot sample_points:method=poisson,count=8000 render:point_size=3",
      "Points that keep a distance from each other."},
     {"primitive:kind=teapot sample_points:count=8000 render:point_size=3",
      "As many, each by itself: clusters and gaps."}});

}  // namespace azulejo
