#include <algorithm>
#include <cmath>
#include <numbers>

#include "azulejo/engine/operation.h"
#include "azulejo/modelling/measure.h"

namespace azulejo {
namespace {

Json number(std::size_t value) { return Json(static_cast<std::uint64_t>(value)); }
Json vector(const glm::dvec3& v) { return Json::array().push(v.x).push(v.y).push(v.z); }
Json vectors(const std::array<glm::dvec3, 3>& list) {
  return Json::array().push(vector(list[0])).push(vector(list[1])).push(vector(list[2]));
}

/// Area, and what a solid has; all of that is null where there is none.
void set_shell(Json& json, const ShellMeasure& shell) {
  json.set("faces", number(shell.faces)).set("area", shell.area);
  json.set("surface_centroid", vector(shell.surface_centroid));
  if (!shell.solid) {
    for (const char* const name : {"volume", "centroid", "inertia", "principal_moments", "principal_axes"}) {
      json.set(name, Json());
    }
    json.set("no_volume_because", shell.open);
  } else {
    const SolidMeasure& solid = *shell.solid;
    json.set("volume", solid.volume).set("centroid", vector(solid.centroid));
    json.set("inertia", vectors({solid.inertia[0], solid.inertia[1], solid.inertia[2]}));
    json.set("principal_moments", vector(solid.moments)).set("principal_axes", vectors(solid.axes));
  }
  if (shell.box.empty()) {
    json.set("box", Json());
    return;
  }
  const glm::dvec3 lower(shell.box.lower);
  const glm::dvec3 upper(shell.box.upper);
  json.set("box",
           Json::object().set("lower", vector(lower)).set("upper", vector(upper)).set("size", vector(upper - lower)));
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace

Report report_of(const MeshMeasure& measure, const MeasureOptions& options) {
  Report report;
  Json& json = report.json;
  set_shell(json, measure.all);
  const OrientedBox& box = measure.oriented_box;
  json.set("oriented_box", measure.all.box.empty() ? Json()
                                                   : Json::object()
                                                         .set("center", vector(box.center))
                                                         .set("axes", vectors(box.axes))
                                                         .set("size", vector(box.size))
                                                         .set("volume", box.volume()));
  const EdgeLengths& edges = measure.edges;
  json.set("edges", Json::object()
                        .set("count", number(edges.count))
                        .set("minimum", edges.minimum)
                        .set("mean", edges.mean)
                        .set("maximum", edges.maximum));
  const TriangleQuality& quality = measure.quality;
  Json histogram = Json::array();
  for (const std::size_t count : quality.histogram) histogram.push(number(count));
  json.set("quality", Json::object()
                          .set("triangles", number(quality.triangles))
                          .set("without_area", number(quality.without_area))
                          .set("minimum", quality.minimum)
                          .set("mean", quality.mean)
                          .set("tenths", histogram)
                          .set("smallest_angle_deg", degrees(quality.smallest_angle))
                          .set("largest_angle_deg", degrees(quality.largest_angle)));
  json.set("shells", number(measure.shells.size()));
  Json shells = Json::array();
  for (std::size_t s = 0; s < std::min(measure.shells.size(), static_cast<std::size_t>(options.listed)); ++s) {
    Json shell = Json::object();
    set_shell(shell, measure.shells[s]);
    shells.push(shell);
  }
  json.set("each_shell", shells);
  return report;
}

extern const Operation kMeasure = with_examples(
    value_operation<MeasureOptions>(
        "measure", "Measures a mesh: area, volume, centroid, inertia, boxes, edges, the shape of its triangles.",
        {{"source", "the mesh", ValueKind::Mesh}},
        {{"report", "of all and of each shell; what an open one has not is null, with the reason", ValueKind::Report}},
        {field("by_position", &MeasureOptions::by_position,
               "vertices at exactly equal positions are one, for what is closed and what is a shell"),
         field("listed", &MeasureOptions::listed, {0, 1e9}, "", "how many shells the report names")},
        [](std::span<const Value> inputs, const MeasureOptions& options, const Run& run) {
          return std::vector<Value>{Value(report_of(measure(*inputs[0].mesh(), options, run), options))};
        }),
    {{"primitive:kind=torus measure", "A torus of many flat faces: a little less than 2 π² R r² of volume."}});

}  // namespace azulejo
