#include "azulejo/modelling/repair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/repair_work.h"
#include "azulejo/modelling/self_intersections.h"

namespace azulejo {
namespace {

/// Faces of patches that meet others.
void find_intersections(RepairWork& work) {
  const std::size_t first = work.first_patch_face();
  if (first == work.mesh.face_count()) return;
  const Welded welded = weld_exactly(work.mesh.positions, work.run);
  const auto pairs =
      self_intersections_from(static_cast<std::uint32_t>(first), most_looks(work.mesh.face_count() - first), work.mesh,
                              welded.corners, work.run);
  work.result.intersections_counted = pairs.has_value();
  if (!pairs) return;
  std::vector<std::uint32_t> faces;
  for (const auto& pair : *pairs) faces.push_back(pair[1]);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const std::uint32_t face : faces) work.note(RepairAction::IntersectingFace, work.middle_of_face(face));
}

void do_steps(RepairWork& work) {
  const RepairOptions& options = work.options;
  if (options.drop) drop_not_finite(work);
  if (options.drop) drop_degenerate(work);
  if (options.weld_borders) weld_borders(work);
  if (options.drop) drop_degenerate(work);
  if (options.drop) drop_duplicates(work);
  if (options.orient || options.split) orient_and_split(work);
  if (options.flat) remove_flat_faces(work);
  if (options.fill) fill_holes(work);
  if (options.flat && !work.patch_places.empty()) remove_flat_faces(work);
  sort_shells(work);
  if (options.drop) drop_unused_vertices(work);
  find_intersections(work);
  work.result.added_faces = work.mesh.face_count() - work.first_patch_face();
  work.result.added_vertices =
      static_cast<std::size_t>(std::count_if(work.vertex_of.begin(), work.vertex_of.end(),
                                             [&](std::uint32_t row) { return row >= work.source.vertex_count(); }));
}

bool changed_anything(const RepairedMesh& result) {
  for (std::size_t i = 0; i < kRepairActions; ++i) {
    const auto action = static_cast<RepairAction>(i);
    if (action == RepairAction::OpenHole || action == RepairAction::IntersectingFace) continue;
    if (result.actions[i].count > 0) return true;
  }
  return false;
}

void check(const RepairOptions& options) {
  const auto refuse = [](const char* name, const std::string& value, const char* wanted) {
    throw Error(Error::Argument, fmt::format("repair: {} is {}, expected {}", name, value, wanted));
  };
  for (const auto& [name, value] :
       {std::pair("tolerance", options.tolerance), std::pair("relative_tolerance", options.relative_tolerance)}) {
    if (!(value >= 0 && std::isfinite(value))) refuse(name, fmt::to_string(value), "a finite number from 0");
  }
  if (options.listed < 0) refuse("listed", fmt::to_string(options.listed), "0 or more");
  if (options.max_hole_edges.value_or(0) < 0) {
    refuse("max_hole_edges", fmt::to_string(*options.max_hole_edges), "0 or more");
  }
}

Json number(std::size_t value) { return Json(static_cast<std::uint64_t>(value)); }

}  // namespace

RepairedMesh repair(const Mesh& mesh, const RepairOptions& options, const Run& run) {
  check(options);
  if (mesh.face_count() == 0) {
    RepairedMesh same;
    same.mesh = mesh.clone();
    return same;
  }
  RepairWork work(mesh, options, run);
  do_steps(work);
  work.result.changed = changed_anything(work.result);
  work.result.mesh = work.result.changed ? work.done() : mesh.clone();
  return std::move(work.result);
}

Report report_of(const RepairedMesh& repaired) {
  Report report;
  report.verdict = repaired.solid;
  Json& json = report.json;
  json.set("changed", repaired.changed).set("solid", repaired.solid);
  json.set("vertices", number(repaired.mesh.vertex_count())).set("faces", number(repaired.mesh.face_count()));
  json.set("added_vertices", number(repaired.added_vertices)).set("added_faces", number(repaired.added_faces));
  Json places = Json::object();
  for (std::size_t i = 0; i < kRepairActions; ++i) {
    const std::string_view name = enum_names(RepairAction{})[i];
    const bool unknown =
        static_cast<RepairAction>(i) == RepairAction::IntersectingFace && !repaired.intersections_counted;
    json.set(name, unknown ? Json() : number(repaired.actions[i].count));
    if (repaired.actions[i].count == 0) continue;
    Json list = Json::array();
    for (const glm::vec3& p : repaired.actions[i].places) list.push(Json::array().push(p.x).push(p.y).push(p.z));
    places.set(name, list);
  }
  json.set("places", places);
  return report;
}

extern const Operation kRepair = with_examples(
    value_operation<RepairOptions>(
        "repair", "Makes a solid of a faulty mesh: closed, manifold, with its outside outside.",
        {{"source", "the mesh", ValueKind::Mesh}},
        {{"mesh", "the mesh without the faults", ValueKind::Mesh},
         {"report", "what was done, how often and where; the verdict is whether it is a solid", ValueKind::Report,
          true}},
        {field("weld_borders", &RepairOptions::weld_borders,
               "vertices at borders that are within the tolerance become one"),
         field("tolerance", &RepairOptions::tolerance, {0, 1e30}, "",
               "how far apart these are, in units of the mesh; 0: at exactly equal positions"),
         field("relative_tolerance", &RepairOptions::relative_tolerance, {0, 1}, "",
               "the same in diagonals of the bounding box; the larger of both counts"),
         field("drop", &RepairOptions::drop,
               "faces that are degenerate, double or not finite go, pieces without volume and unused vertices, too"),
         field("orient", &RepairOptions::orient, "faces are turned so that neighbors agree and the outside is outside"),
         field("split", &RepairOptions::split, "edges of more than two faces and vertices of several fans are split"),
         field("fill", &RepairOptions::fill, "holes are filled"),
         field("max_hole_edges", &RepairOptions::max_hole_edges, {0, 1e9}, "",
               "holes of more edges stay open; auto: none do"),
         field("fair", &RepairOptions::fair,
               "patches have triangles like those around them, and go on as the surface does"),
         field("flat", &RepairOptions::flat, "faces whose corners lie on one line go"),
         field("remove_inside", &RepairOptions::remove_inside, "shells inside of others go"),
         field("listed", &RepairOptions::listed, {0, 1e9}, "", "how many places of each kind the report names")},
        [](std::span<const Value> inputs, const RepairOptions& options, const Run& run) {
          RepairedMesh repaired = repair(*inputs[0].mesh(), options, run);
          if (repaired.count(RepairAction::IntersectingFace) > 0) {
            warn(run, fmt::format("{} faces of patches meet others", repaired.count(RepairAction::IntersectingFace)));
          }
          if (!repaired.solid)
            warn(run,
                 repaired.mesh.face_count() > 0 ? "the result is no solid" : "no faces are left: there is no solid");
          Report report = report_of(repaired);
          return std::vector<Value>{Value(std::move(repaired.mesh)), Value(std::move(report))};
        }),
    {{"primitive:kind=teapot repair", "Lid and body are closed, the spout, too."},
     {"primitive:kind=helicoid repair topology", "Between the spirals a surface is stretched: it is a solid."}});

}  // namespace azulejo
