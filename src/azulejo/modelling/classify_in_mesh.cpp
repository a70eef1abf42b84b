#include "azulejo/modelling/classify_in_mesh.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/winding_number.h"

namespace azulejo {
namespace {

std::vector<Value> run_classify_in_mesh(std::span<const Value> inputs, const ClassifyInMeshOptions& options,
                                        const Run& run) {
  ClassifiedPoints result = classify_points(*inputs[0].mesh(), *inputs[1].mesh(), options, run);
  std::vector<Value> results;
  results.emplace_back(std::move(result.points));
  results.emplace_back(std::move(result.report));
  return results;
}

void set_attribute(Mesh& mesh, std::string_view name, Attribute::Values values) {
  std::erase_if(mesh.attributes, [&](const Attribute& each) { return each.name == name; });
  mesh.attributes.push_back({std::string(name), Domain::Vertex, 1, std::move(values)});
}

}  // namespace

const Operation kClassifyInMesh = value_operation<ClassifyInMeshOptions>(
    "classify_points", "Tells which points are inside of what a drawing fills, or of a surface.",
    {{"source", "the surface", ValueKind::Mesh}, {"points", "a mesh, whose vertices are classified", ValueKind::Mesh}},
    {{"mesh",
      "the points with attributes class: 0 outside, 1 inside, 2 border, and winding: how often the surface goes around",
      ValueKind::Mesh},
     {"report", "how many there are of each, and open edges of the surface", ValueKind::Report}},
    {field("border", &ClassifyInMeshOptions::border, {0, 1e6}, "", "what is nearer to the surface than this is border"),
     field("accuracy", &ClassifyInMeshOptions::accuracy, {1, 100}, "",
           "of open surfaces: how many times its radius away a group of triangles is taken as one")},
    run_classify_in_mesh);

ClassifiedPoints with_classes(const Mesh& points, Array<std::uint32_t> classes) {
  ClassifiedPoints result{points.clone(), {}};
  for (const auto& [name, value] : {std::pair("outside", 0U), std::pair("inside", 1U), std::pair("border", 2U)}) {
    result.report.json.set(name, std::count(classes.begin(), classes.end(), value));
  }
  set_attribute(result.points, "class", std::move(classes));
  return result;
}

ClassifiedPoints classify_points(const Mesh& surface, const Mesh& points, const ClassifyInMeshOptions& options,
                                 const Run& run) {
  kClassifyInMesh.check(&options);
  const WindingNumber number(surface, {options.accuracy, points.vertex_count()}, run);
  const std::size_t count = points.vertex_count();
  Array<float> winding(count);
  Array<std::uint32_t> classes(count);
  parallel_for(count, std::size_t{1} << 10, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3& point = points.positions[i];
      winding[i] = static_cast<float>(number(point));
      const PointClass found = number.is_near(point, options.border) ? PointClass::Border
                               : std::abs(winding[i]) > 0.5F         ? PointClass::Inside
                                                                     : PointClass::Outside;
      classes[i] = static_cast<std::uint32_t>(found);
    }
  });
  ClassifiedPoints result = with_classes(points, std::move(classes));
  result.report.json.set("open_edges", number.open_edges());
  set_attribute(result.points, "winding", std::move(winding));
  return result;
}

}  // namespace azulejo
