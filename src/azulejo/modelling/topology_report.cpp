#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "azulejo/engine/operation.h"
#include "azulejo/engine/united_report.h"
#include "azulejo/modelling/pose.h"
#include "azulejo/modelling/topology.h"
#include "azulejo/modelling/topology_marks.h"

namespace azulejo {
namespace {

Json number(std::size_t value) { return Json(static_cast<std::uint64_t>(value)); }
Json vector(const glm::vec3& v) { return Json::array().push(v.x).push(v.y).push(v.z); }
Json strings(const std::vector<std::string>& list) {
  Json json = Json::array();
  for (const std::string& each : list) json.push(each);
  return json;
}

/// How an element of a kind is named, and what else is with it.
struct Naming {
  std::string_view index;
  std::string_view other;  ///< empty: nothing
};
Naming naming(MeshFaultKind kind) {
  switch (kind) {
    case MeshFaultKind::SingularVertex:
    case MeshFaultKind::UnusedVertex:
    case MeshFaultKind::NotFiniteVertex: return {"vertex", ""};
    case MeshFaultKind::DoubledVertex: return {"vertex", "first_vertex"};
    case MeshFaultKind::DegenerateFace:
    case MeshFaultKind::FlatFace: return {"face", ""};
    case MeshFaultKind::DuplicateFace: return {"face", "first_face"};
    case MeshFaultKind::IntersectingFace: return {"face", "other_face"};
    default: return {"vertices", ""};
  }
}

Json listed(MeshFaultKind kind, const MeshFaults& faults, std::size_t at_most) {
  const Naming names = naming(kind);
  Json list = Json::array();
  for (const MeshFault& each : std::span(faults.listed).first(std::min(faults.listed.size(), at_most))) {
    Json fault = Json::object();
    if (names.index == "vertices") {
      fault.set("vertices", Json::array().push(number(each.index)).push(number(each.other)));
    } else {
      fault.set(names.index, number(each.index));
      if (!names.other.empty()) fault.set(names.other, number(each.other));
    }
    list.push(fault.set("at", vector(each.place)));
  }
  return list;
}

Json shell(const MeshShell& shell) {
  Json json = Json::object();
  json.set("vertices", number(shell.vertices)).set("edges", number(shell.edges)).set("faces", number(shell.faces));
  json.set("holes", number(shell.holes)).set("manifold", shell.manifold).set("closed", shell.closed);
  json.set("orientable", shell.orientable).set("oriented", shell.oriented);
  json.set(shell.orientable ? "genus" : "cross_caps", shell.genus ? number(*shell.genus) : Json());
  const bool solid = shell.closed && shell.oriented;
  return json.set("volume", solid ? Json(shell.volume) : Json()).set("area", shell.area);
}

Json hole(const MeshHole& hole) {
  return Json::object()
      .set("vertex", number(hole.vertex))
      .set("edges", number(hole.edges))
      .set("length", hole.length)
      .set("at", vector(hole.place));
}

bool is_fine(const Topology& topology, TopologyVerdict expected) {
  switch (expected) {
    case TopologyVerdict::Printable: return topology.printable();
    case TopologyVerdict::Closed: return topology.closed();
    case TopologyVerdict::Manifold: return topology.manifold();
  }
  return false;
}

}  // namespace

Report report_of(const Topology& topology, const TopologyOptions& options) {
  Report report;
  report.verdict = is_fine(topology, options.expect);
  Json& json = report.json;
  json.set("manifold", topology.manifold()).set("closed", topology.closed()).set("oriented", topology.oriented());
  json.set("printable", topology.printable());
  json.set("vertices", number(topology.vertices)).set("edges", number(topology.edges));
  json.set("faces", number(topology.faces)).set("loops", number(topology.loops));
  json.set("shells", number(topology.shells.size())).set("components", number(topology.components));
  json.set("holes", number(topology.holes.size()));
  json.set("genus", topology.genus() ? number(*topology.genus()) : Json());
  json.set("euler", static_cast<std::int64_t>(topology.euler()));
  json.set("euler_is_two_unless", strings(topology.euler_preconditions()));
  json.set("euler_poincare",
           topology.euler_poincare() ? Json(static_cast<std::int64_t>(*topology.euler_poincare())) : Json());
  json.set("regular_edges", number(topology.regular_edges)).set("regular_vertices", number(topology.regular_vertices));
  Json elements = Json::object();
  for (std::size_t k = 0; k < kMeshFaultKinds; ++k) {
    const auto kind = static_cast<MeshFaultKind>(k);
    const std::string_view name = enum_names(MeshFaultKind{})[k];
    if (kind == MeshFaultKind::IntersectingFace && !topology.self_intersections_looked_for) {
      json.set(name, Json());
      continue;
    }
    json.set(name, number(topology.count(kind)));
    if (topology.count(kind) > 0) {
      elements.set(name, listed(kind, topology.of(kind), static_cast<std::size_t>(options.listed)));
    }
  }
  Json shells = Json::array();
  for (const MeshShell& each : topology.shells) shells.push(shell(each));
  Json holes = Json::array();
  for (const MeshHole& each : topology.holes) holes.push(hole(each));
  json.set("elements", elements).set("each_shell", shells).set("each_hole", holes);
  return report;
}

namespace {

/// As many faults as the report lists or the picture shows.
Topology survey(const Mesh& mesh, TopologyOptions options, const Run& run) {
  options.listed = std::max(options.listed, options.marks);
  return topology(mesh, options, run);
}

/// What the picture shows: of each kind with marks, their color, how many there are, and how many the first camera
/// doesn't see.
Json legend(const MarkedScene& marked) {
  Json json = Json::object();
  for (std::size_t k = 0; k < kMeshFaultKinds; ++k) {
    if (marked.marks[k] == 0) continue;
    Json entry = Json::object().set("color", mark_color(static_cast<MeshFaultKind>(k)));
    json.set(enum_names(MeshFaultKind{})[k],
             entry.set("marks", number(marked.marks[k])).set("hidden", number(marked.hidden[k])));
  }
  return json;
}

std::vector<Value> values_of(Report report, MarkedScene marked) {
  report.json.set("marked", legend(marked));
  std::vector<Value> values;
  values.emplace_back(std::move(report));
  values.emplace_back(std::move(marked.scene));
  return values;
}

std::vector<Value> survey_mesh(std::span<const Value> inputs, const TopologyOptions& options, const Run& run) {
  Scene scene;
  scene.meshes.push_back(inputs[0].shared<Mesh>());
  scene.space = scene.meshes[0]->space;
  scene.nodes.emplace_back().mesh = MeshId(0U);
  scene.roots.emplace_back(0U);
  const Topology found = survey(*scene.meshes[0], options, run);
  return values_of(report_of(found, options),
                   mark_faults(scene, {&found, 1}, static_cast<std::size_t>(options.marks), run));
}

std::vector<Value> survey_scene(std::span<const Value> inputs, const TopologyOptions& options, const Run& run) {
  const Scene* scene = inputs[0].scene();
  std::optional<Scene> posed;
  if (needs_pose(*scene)) {
    warn(run, "topology: skinned and morphed meshes are taken as they are posed");
    scene = &posed.emplace(pose(*scene, run));
  }
  std::unordered_map<const Mesh*, std::size_t> first;
  std::vector<Topology> topologies;
  std::vector<Report> reports;
  for (const std::shared_ptr<const Mesh>& mesh : scene->meshes) {
    const auto [same, added] = first.emplace(mesh.get(), topologies.size());
    topologies.push_back(added ? survey(*mesh, options, run) : topologies[same->second]);
    reports.push_back(report_of(topologies.back(), options));
  }
  std::vector<NamedReport> named;
  for (std::size_t m = 0; m < reports.size(); ++m) named.push_back({scene->meshes[m]->name, &reports[m]});
  return values_of(united(named), mark_faults(*scene, topologies, static_cast<std::size_t>(options.marks), run));
}

Operation describe(ValueKind kind, std::string source,
                   std::vector<Value> (*function)(std::span<const Value>, const TopologyOptions&, const Run&)) {
  return value_operation<TopologyOptions>(
      "topology", "Tells how the faces of a mesh hang together, and whether it is a solid.",
      {{"source", std::move(source), kind}},
      {{"report", "counts, Euler's formulas, shells, holes, and each fault with its place; the verdict is `expect`",
        ValueKind::Report},
       {"marked", "the surface in pale gray, the faults on it in the colors that the report tells, and cameras",
        ValueKind::Scene}},
      {field("by_position", &TopologyOptions::by_position, "vertices at exactly equal positions are one"),
       field("self_intersections", &TopologyOptions::self_intersections, "faces that meet each other are looked for"),
       field("listed", &TopologyOptions::listed, {0, 1e9}, "", "how many elements of each kind the report names"),
       field("marks", &TopologyOptions::marks, {0, 200000}, "", "how many elements of each kind the scene marks"),
       field("expect", &TopologyOptions::expect, "what the mesh should be: if it isn't, the command exits with 3")},
      function);
}

const Operation kTopologyOfScene =
    describe(ValueKind::Scene, "the scene: an entry for each of its meshes", survey_scene);

}  // namespace

extern const Operation kTopology =
    with_examples(with_variants(describe(ValueKind::Mesh, "the mesh", survey_mesh), {&kTopologyOfScene}),
                  {{"primitive:kind=torus topology", "One shell with one handle: V + F − E is 0 where a ball has 2."},
                   {"primitive:kind=mobius topology as:found @found.marked render:width=480,height=360",
                    "A strip that is cut where its faces meet: its border is blue, doubled vertices are teal."}});

}  // namespace azulejo
