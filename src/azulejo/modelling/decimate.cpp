#include "azulejo/modelling/decimate.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "azulejo/engine/operation.h"
#include "azulejo/modelling/decimate_parts.h"

namespace azulejo {
namespace {

/// How many triangles are to be left.
std::size_t target_of(const DecimateOptions& options, std::size_t triangles) {
  if (!options.faces && !options.ratio && !options.error) return triangles / 2;
  std::size_t target = 0;
  if (options.faces) target = static_cast<std::size_t>(*options.faces);
  if (options.ratio) {
    target = std::max(target,
                      static_cast<std::size_t>(static_cast<double>(*options.ratio) * static_cast<double>(triangles)));
  }
  return target;
}

std::vector<Value> run_decimate(std::span<const Value> inputs, const DecimateOptions& options, const Run& run) {
  Decimation decimation = decimate(*inputs[0].mesh(), options, run);
  Report report = report_of(decimation);
  std::vector<Value> results;
  results.emplace_back(std::move(decimation.mesh));
  results.emplace_back(std::move(report));
  return results;
}

}  // namespace

extern const Operation kDecimate = with_examples(
    value_operation<DecimateOptions>(
        "decimate", "Makes fewer triangles of nearly the same surface.", {{"source", "the mesh", ValueKind::Mesh}},
        {{"mesh", "triangles", ValueKind::Mesh},
         {.name = "report",
          .help = "faces and vertices before and after, the error that was reached, what ended it",
          .kind = ValueKind::Report,
          .on_request = true}},
        {shared_by_meshes(field("faces", &DecimateOptions::faces, {0, 2e9}, "",
                                "triangles that are to be left; the meshes of a scene share them in proportion")),
         field("ratio", &DecimateOptions::ratio, {0, 1}, "", "share of the triangles that is to be left"),
         field("error", &DecimateOptions::error, {0, 1}, "",
               "how far the surface may get from where it was, as a share of the largest side of its box"),
         field("keep_topology", &DecimateOptions::keep_topology,
               "shells, handles and holes stay; else small ones may close or vanish"),
         field("lock_borders", &DecimateOptions::lock_borders, "vertices on borders stay where they are"),
         field("border_weight", &DecimateOptions::border_weight, {0, 1e6}, "",
               "how much borders count against surfaces"),
         field("attribute_weight", &DecimateOptions::attribute_weight, {0, 1e3}, "",
               "how much full range of an attribute counts against the largest side of the box"),
         field(
             "measure", &DecimateOptions::measure,
             "the report, to be asked for, tells how far the surfaces are apart, at most and in the mean, both ways")},
        run_decimate),
    {{"primitive:kind=teapot,segments=24 decimate:ratio=0.1 wireframe:width=480,height=360",
      "A tenth of the triangles: many where the surface bends, few where it doesn't."},
     {"primitive:kind=torus_knot decimate:error=0.005 render:width=480,height=360",
      "No further from the surface than about half a percent of its size."}});

Decimation decimate(const Mesh& mesh, const DecimateOptions& options, const Run& run) {
  kDecimate.check(&options);
  Decimation result;
  result.faces_before = mesh.triangle_count();
  result.vertices_before = mesh.vertex_count();
  if (mesh.face_count() == 0) {
    result.mesh = mesh.clone();
    result.vertices_after = result.vertices_before;
    result.stopped = DecimateStop::Faces;
    return result;
  }
  const Attribute* faceted = nullptr;
  decimation::Surface surface = decimation::build_surface(mesh, options, faceted, run);
  const decimation::Reached reached =
      decimation::collapse_edges(surface, options, target_of(options, result.faces_before), run);
  result.mesh = decimation::mesh_of(mesh, surface, faceted, run);
  result.faces_after = result.mesh.face_count();
  result.vertices_after = result.mesh.vertex_count();
  result.error = reached.error;
  result.distance = reached.error / surface.scale;
  result.stopped = reached.stopped;
  if (options.measure && result.faces_after > 0) result.measured = distance(result.mesh, mesh, {}, run);
  return result;
}

Report report_of(const Decimation& decimation) {
  Report report;
  report.json.set("faces_before", static_cast<std::uint64_t>(decimation.faces_before))
      .set("faces_after", static_cast<std::uint64_t>(decimation.faces_after))
      .set("vertices_before", static_cast<std::uint64_t>(decimation.vertices_before))
      .set("vertices_after", static_cast<std::uint64_t>(decimation.vertices_after))
      .set("error", decimation.error)
      .set("distance", decimation.distance)
      .set("stopped_by", enum_names(DecimateStop{})[static_cast<std::size_t>(decimation.stopped)]);
  if (decimation.measured) report.json.set("measured", report_of(*decimation.measured).json);
  return report;
}

}  // namespace azulejo
