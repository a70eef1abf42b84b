#include "azulejo/engine/operation.h"
#include "azulejo/modelling/distance.h"

namespace azulejo {
namespace {

Json point(const glm::dvec3& p) { return Json::array().push(p.x).push(p.y).push(p.z); }
Json number(std::size_t value) { return Json(static_cast<std::uint64_t>(value)); }

Json one_sided(const SurfaceDistance& distance) {
  return Json::object()
      .set("maximum", distance.maximum)
      .set("maximum_bound", distance.maximum_bound)
      .set("mean", distance.mean)
      .set("mean_error", distance.mean_error)
      .set("rms", distance.rms)
      .set("maximum_at", point(distance.place))
      .set("nearest_to_it", point(distance.nearest))
      .set("vertices", number(distance.vertices))
      .set("samples", number(distance.samples))
      .set("refinements", number(distance.refinements));
}

}  // namespace

bool is_close(const MeshDistance& distance, const MeshDistanceOptions& options) {
  if (!options.at_most) return true;
  const double values[] = {distance.maximum_bound(), distance.mean(), distance.rms()};
  const double value = values[static_cast<std::size_t>(options.metric)];
  // Bounds are floats: 0.1 is taken as the one nearest to it.
  return static_cast<float>(options.relative ? value / distance.diagonal : value) <= *options.at_most;
}

Report report_of(const MeshDistance& distance, const MeshDistanceOptions& options) {
  Report report;
  report.verdict = is_close(distance, options);
  const auto set_all = [&](Json& json, double unit) {
    json.set("maximum", distance.maximum() / unit).set("maximum_bound", distance.maximum_bound() / unit);
    json.set("mean", distance.mean() / unit).set("rms", distance.rms() / unit);
  };
  set_all(report.json, 1);
  Json relative = Json::object();
  set_all(relative, distance.diagonal);
  report.json.set("diagonal", distance.diagonal).set("relative", relative);
  report.json.set("to_reference", one_sided(distance.forward));
  if (distance.backward) report.json.set("from_reference", one_sided(*distance.backward));
  if (options.at_most) report.json.set("close", report.verdict);
  return report;
}

extern const Operation kDistance = with_examples(
    value_operation<MeshDistanceOptions>(
        "distance", "Measures how far two surfaces are apart: Hausdorff distance, mean and RMS.",
        {{"source", "the mesh, or points", ValueKind::Mesh},
         {"reference", "what it is compared with", ValueKind::Mesh}},
        {{"report", "both one-sided distances and their larger, also as shares of the diagonal, and where they are",
          ValueKind::Report},
         {"mesh", "the source with a vertex attribute `distance`, f32", ValueKind::Mesh}},
        {field("symmetric", &MeshDistanceOptions::symmetric, "from the reference to the source, too"),
         field("tolerance", &MeshDistanceOptions::tolerance, {0, 1}, "",
               "how exact the maximum is to be, as a share of the reference's diagonal"),
         field("samples", &MeshDistanceOptions::samples, {1, 1e9}, "",
               "points on each surface, for mean and RMS; auto: two a triangle, 10 000 to 2 000 000"),
         field("refinements", &MeshDistanceOptions::refinements, {0, 1e9}, "",
               "most points looked at for the tolerance; auto: two a triangle, and a million"),
         field("seed", &MeshDistanceOptions::seed, {0, 2147483647}, "", "other samples for each"),
         field("metric", &MeshDistanceOptions::metric, "what at_most is about"),
         field("at_most", &MeshDistanceOptions::at_most, {0, 1e30}, "",
               "exit status 3 if it isn't certain that the metric is at most this"),
         field("relative", &MeshDistanceOptions::relative, "at_most is a share of the reference's diagonal")},
        [](std::span<const Value> inputs, const MeshDistanceOptions& options, const Run& run) {
          const Mesh& source = *inputs[0].mesh();
          MeshDistance found = distance(source, *inputs[1].mesh(), options, run);
          Mesh mesh = source.clone();
          std::erase_if(mesh.attributes, [](const Attribute& each) { return each.name == "distance"; });
          mesh.attributes.push_back({"distance", Domain::Vertex, 1, std::move(found.of_vertices)});
          return std::vector<Value>{Value(report_of(found, options)), Value(std::move(mesh))};
        }),
    {{"primitive:kind=ico_sphere,subdivisions=1 as:a primitive:kind=ico_sphere,subdivisions=4 as:b @a "
      "distance:reference=@b",
      "A sphere of few faces, compared with one of many."}});

}  // namespace azulejo
