#include "azulejo/modelling/weld.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/picked_mesh.h"
#include "azulejo/modelling/weld_vertices.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// What elements are compared by.
struct Column {
  std::span<const std::byte> bytes;
  std::size_t size;  ///< of an element
  bool same(std::size_t a, std::size_t b) const {
    return std::memcmp(bytes.data() + a * size, bytes.data() + b * size, size) == 0;
  }
};

Column column(const Attribute& attribute) {
  return std::visit(
      [&](const auto& values) {
        const auto components = static_cast<std::size_t>(attribute.components);
        return Column{std::as_bytes(std::span(values)), components * sizeof(values[0])};
      },
      attribute.values);
}

bool moves(const Attribute& attribute) {
  return attribute.name.rfind("JOINTS_", 0) == 0 || attribute.name.rfind("WEIGHTS_", 0) == 0;
}

/// What must be the same of vertices that become one.
std::vector<Column> columns_that_part(const Mesh& mesh, WeldAttributes attributes) {
  std::vector<Column> columns;
  for (const Attribute& each : mesh.attributes) {
    if (each.domain != Domain::Vertex) continue;
    if (attributes == WeldAttributes::Separate || moves(each)) columns.push_back(column(each));
  }
  for (const MorphTarget& each : mesh.morph_targets) {
    if (!each.positions.empty()) columns.push_back({std::as_bytes(std::span(each.positions)), sizeof(glm::vec3)});
    if (!each.normals.empty() && attributes == WeldAttributes::Separate) {
      columns.push_back({std::as_bytes(std::span(each.normals)), sizeof(glm::vec3)});
    }
  }
  return columns;
}

/// Numbers vertices so that those with equal bytes in all columns have the same: that of the first of them.
Array<std::uint32_t> classes_of(std::size_t count, const std::vector<Column>& columns, const Run& run) {
  Array<std::uint32_t> classes(columns.empty() ? 0 : count);
  std::vector<std::uint32_t> order(classes.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  const auto compared = [&](std::uint32_t a, std::uint32_t b) {
    for (const Column& each : columns) {
      const int sign = std::memcmp(each.bytes.data() + a * each.size, each.bytes.data() + b * each.size, each.size);
      if (sign != 0) return sign;
    }
    return 0;
  };
  parallel_sort(order.begin(), order.end(), run, [&](std::uint32_t a, std::uint32_t b) { return compared(a, b) < 0; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool as_before = i > 0 && compared(order[i - 1], order[i]) == 0;
    classes[order[i]] = as_before ? classes[order[i - 1]] : order[i];
  }
  return classes;
}

double tolerance_of(const Mesh& mesh, const WeldOptions& options) {
  if (options.relative_tolerance == 0) return static_cast<double>(options.tolerance);
  const Box3 box = bounds(mesh);
  const double diagonal = box.empty() ? 0 : glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
  return std::max(static_cast<double>(options.tolerance), static_cast<double>(options.relative_tolerance) * diagonal);
}

class Weld {
 public:
  Weld(const Mesh& mesh, const WeldOptions& options) : mesh_(mesh), options_(options) {}

  WeldedMesh done(const Run& run) {
    result_.tolerance = tolerance_of(mesh_, options_);
    const Array<std::uint32_t> classes =
        classes_of(mesh_.vertex_count(), columns_that_part(mesh_, options_.attributes), run);
    first_ = weld_vertices(mesh_.positions, classes, options_.method, result_.tolerance, run);
    number_vertices();
    gather_faces();
    gather_lines();
    const bool nothing =
        result_.welded == 0 && result_.dropped_faces == 0 && result_.dropped_corners == 0 && result_.dropped_lines == 0;
    if (nothing) {
      result_.mesh = mesh_.clone();
      return std::move(result_);
    }
    const std::vector<bool> parted = attributes_that_differ();
    const Array<std::uint32_t> corner_of = pick_.corner_of;
    result_.mesh = picked(mesh_, std::move(pick_));
    move_to_corners(parted, corner_of);
    return std::move(result_);
  }

 private:
  void number_vertices() {
    result_.vertices.resize(mesh_.vertex_count());
    double largest = 0;
    pick_.vertices.reserve(mesh_.vertex_count());
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      if (first_[v] == v) {
        result_.vertices[v] = static_cast<std::uint32_t>(pick_.vertices.size());
        pick_.vertices.push_back(v);
        continue;
      }
      result_.vertices[v] = result_.vertices[first_[v]];
      const glm::dvec3 way = glm::dvec3(mesh_.positions[v]) - glm::dvec3(mesh_.positions[first_[v]]);
      const double squared = glm::dot(way, way);
      if (squared > largest) largest = squared;
    }
    result_.welded = mesh_.vertex_count() - pick_.vertices.size();
    result_.largest_distance = std::sqrt(largest);
  }

  std::uint32_t vertex(std::size_t corner) const { return result_.vertices[mesh_.corners[corner]]; }

  /// Corners that the face keeps: of the same vertex several times in turn, the first.
  void gather_face(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = i == begin ? end - 1 : i - 1;
      if (options_.drop_degenerate && vertex(i) == vertex(before)) continue;
      pick_.corners.push_back(vertex(i));
      pick_.corner_of.push_back(static_cast<std::uint32_t>(i));
    }
  }

  void gather_faces() {
    const bool triangles = mesh_.all_triangles();
    pick_.corners.reserve(mesh_.corner_count());
    pick_.corner_of.reserve(mesh_.corner_count());
    pick_.faces.reserve(mesh_.face_count());
    if (!triangles) pick_.face_offsets.push_back(0);
    for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
      const std::size_t begin = mesh_.face_begin(face);
      const std::size_t end = mesh_.face_end(face);
      const std::size_t start = pick_.corners.size();
      gather_face(begin, end);
      const std::size_t kept = pick_.corners.size() - start;
      if (options_.drop_degenerate && kept < 3) {
        pick_.corners.resize(start);
        pick_.corner_of.resize(start);
        ++result_.dropped_faces;
        continue;
      }
      result_.dropped_corners += end - begin - kept;
      pick_.faces.push_back(face);
      if (!triangles) pick_.face_offsets.push_back(static_cast<std::uint32_t>(pick_.corners.size()));
    }
  }

  void gather_lines() {
    for (std::size_t i = 0; i + 1 < mesh_.lines.size(); i += 2) {
      const std::uint32_t a = result_.vertices[mesh_.lines[i]];
      const std::uint32_t b = result_.vertices[mesh_.lines[i + 1]];
      if (options_.drop_degenerate && a == b) {
        ++result_.dropped_lines;
        continue;
      }
      pick_.lines.push_back(a);
      pick_.lines.push_back(b);
    }
  }

  /// Of each attribute, whether it is one of vertices and corners lose a value of it that their vertex has no more.
  std::vector<bool> attributes_that_differ() const {
    std::vector<bool> differ(mesh_.attributes.size(), false);
    if (options_.attributes != WeldAttributes::Corner) return differ;
    for (std::size_t a = 0; a < mesh_.attributes.size(); ++a) {
      if (mesh_.attributes[a].domain != Domain::Vertex) continue;
      const Column values = column(mesh_.attributes[a]);
      differ[a] = std::any_of(pick_.corner_of.begin(), pick_.corner_of.end(), [&](std::uint32_t corner) {
        const std::uint32_t v = mesh_.corners[corner];
        return first_[v] != v && !values.same(v, first_[v]);
      });
    }
    return differ;
  }

  void move_to_corners(const std::vector<bool>& parted, const Array<std::uint32_t>& corner_of) {
    for (std::size_t a = 0; a < parted.size(); ++a) {
      if (!parted[a]) continue;
      Array<std::uint32_t> vertices(corner_of.size());
      for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = mesh_.corners[corner_of[i]];
      result_.mesh.attributes[a] = picked(mesh_.attributes[a], vertices);
      result_.mesh.attributes[a].domain = Domain::Corner;
      result_.corner_attributes.push_back(mesh_.attributes[a].name);
    }
  }

  const Mesh& mesh_;
  const WeldOptions& options_;
  Array<std::uint32_t> first_;  ///< of each vertex, the one that stays
  MeshPick pick_;
  WeldedMesh result_;
};

Json number(std::size_t value) { return Json(static_cast<std::uint64_t>(value)); }

void check_tolerance(const char* name, float value) {
  if (value >= 0 && std::isfinite(value)) return;
  throw Error(Error::Argument, fmt::format("weld: {} is {}, expected a finite number from 0", name, value));
}

}  // namespace

WeldedMesh weld(const Mesh& mesh, const WeldOptions& options, const Run& run) {
  check_tolerance("tolerance", options.tolerance);
  check_tolerance("relative_tolerance", options.relative_tolerance);
  return Weld(mesh, options).done(run);
}

Report report_of(const WeldedMesh& welded, const Mesh& before) {
  Report report;
  Json names = Json::array();
  for (const std::string& each : welded.corner_attributes) names.push(each);
  report.json.set("tolerance", welded.tolerance)
      .set("vertices_before", number(before.vertex_count()))
      .set("vertices", number(welded.mesh.vertex_count()))
      .set("welded_vertices", number(welded.welded))
      .set("largest_distance", welded.largest_distance)
      .set("faces", number(welded.mesh.face_count()))
      .set("dropped_faces", number(welded.dropped_faces))
      .set("dropped_corners", number(welded.dropped_corners))
      .set("dropped_lines", number(welded.dropped_lines))
      .set("corner_attributes", names);
  return report;
}

extern const Operation kWeld = with_examples(
    value_operation<WeldOptions>(
        "weld", "Makes one vertex of those that are at one place, or within a tolerance.",
        {{"source", "the mesh", ValueKind::Mesh}},
        {{"mesh", "the mesh with fewer vertices", ValueKind::Mesh},
         {"report", "how many vertices became one, how far they were apart, what was dropped", ValueKind::Report,
          true}},
        {field("tolerance", &WeldOptions::tolerance, {0, 1e30}, "",
               "vertices no farther apart become one, in units of the mesh; 0: at exactly equal positions"),
         field("relative_tolerance", &WeldOptions::relative_tolerance, {0, 1}, "",
               "the same in diagonals of the bounding box; the larger of both counts"),
         field("method", &WeldOptions::method, "within a distance, or in cells of a grid as large as the tolerance"),
         field("attributes", &WeldOptions::attributes,
               "where they differ: go to the corners, the first vertex's stay, or the vertices stay separate"),
         field("drop_degenerate", &WeldOptions::drop_degenerate,
               "faces left with fewer than three sides go, lines left with one vertex, too")},
        [](std::span<const Value> inputs, const WeldOptions& options, const Run& run) {
          WeldedMesh welded = weld(*inputs[0].mesh(), options, run);
          Report report = report_of(welded, *inputs[0].mesh());
          return std::vector<Value>{Value(std::move(welded.mesh)), Value(std::move(report))};
        }),
    {{"primitive:kind=torus weld:relative_tolerance=0.1,method=grid", "On a coarse grid, a torus becomes lumps."},
     {"primitive:kind=mobius weld topology:expect=manifold", "The strip is whole where it was cut."}});

}  // namespace azulejo
