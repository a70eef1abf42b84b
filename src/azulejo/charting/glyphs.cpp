#include "azulejo/charting/glyphs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/charting/palette.h"
#include "azulejo/core/error.h"
#include "azulejo/data/scene.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

constexpr std::size_t kColors = 256;

/// A glyph of length 1 along y from the origin, of faces with normals at their corners.
struct Prototype {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< of corners
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> face_sizes;

  /// y  where the middle of the body's height goes
  void add(const Mesh& body, float y) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& position : body.positions) positions.push_back(position + glm::vec3(0, y, 0));
    const Attribute& normal = *body.find("NORMAL");
    const Array<float>& values = *normal.get<float>();
    for (std::size_t c = 0; c < body.corner_count(); ++c) {
      corners.push_back(first + body.corners[c]);
      const float* const n = &values[3 * (normal.domain == Domain::Vertex ? body.corners[c] : c)];
      normals.emplace_back(n[0], n[1], n[2]);
    }
    for (std::size_t f = 0; f < body.face_count(); ++f) {
      face_sizes.push_back(static_cast<std::uint32_t>(body.face_end(f) - body.face_begin(f)));
    }
  }
};

Prototype prototype(const GlyphsOptions& options) {
  constexpr float kShaft = 0.7F;  // of an arrow's length
  Prototype glyph;
  const auto body = [&](PrimitiveKind kind, float radius, float height) {
    PrimitiveOptions how{.kind = kind, .radius = radius, .height = height, .segments = options.segments};
    if (kind == PrimitiveKind::UvSphere) how.rings = std::max(2, options.segments / 2);
    return primitive(how, {.threads = 1});
  };
  switch (options.kind) {
    case GlyphKind::Arrow:
      glyph.add(body(PrimitiveKind::Cylinder, 0.035F, kShaft), 0.5F * kShaft);
      glyph.add(body(PrimitiveKind::Cone, 0.1F, 1 - kShaft), 0.5F * (1 + kShaft));
      break;
    case GlyphKind::Cone: glyph.add(body(PrimitiveKind::Cone, 0.18F, 1), 0.5F); break;
    case GlyphKind::Sphere: glyph.add(body(PrimitiveKind::UvSphere, 0.5F, 1), 0); break;
  }
  return glyph;
}

struct Vector {
  glm::vec3 place;
  glm::vec3 direction;  ///< unit length
  float length;
};

Array<float> vectors_at(const Mesh& mesh, const std::string& name, const Run& run) {
  const Attribute* const found = mesh.find(name);
  if (name == "NORMAL" && (found == nullptr || found->domain != Domain::Vertex)) {
    return std::get<Array<float>>(vertex_normals(mesh, {}, run).values);
  }
  if (found == nullptr) {
    std::string names = "NORMAL";
    for (const Attribute& each : mesh.attributes) {
      if (each.name != "NORMAL" && each.components == 3) names += ", " + each.name;
    }
    throw Error(Error::Argument, fmt::format("attribute: {}, expected one of {}", name, names));
  }
  const auto* const values = found->get<float>();
  if (found->domain != Domain::Vertex || found->components != 3 || values == nullptr) {
    throw Error(Error::Argument, fmt::format("attribute: {} has {} components of each {}, expected 3 numbers (f32) of "
                                             "each vertex",
                                             name, found->components, to_string(found->domain)));
  }
  return *values;
}

std::vector<Vector> chosen(const Mesh& mesh, const GlyphsOptions& options, const Run& run) {
  const Array<float> values = vectors_at(mesh, options.attribute, run);
  std::vector<Vector> all;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const glm::vec3 vector(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
    const glm::vec3& place = mesh.positions[v];
    const float length = glm::length(vector);
    // A difference with itself is 0 of finite numbers only.
    if (!(length > 0) || !std::isfinite(length) || place - place != glm::vec3(0)) continue;
    all.push_back({place, vector / length, length});
  }
  const auto most = static_cast<std::size_t>(options.most);
  const std::size_t step = (all.size() + most - 1) / most;
  if (step <= 1) return all;
  std::vector<Vector> some;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

/// Unit vectors x and z that with y make a right-handed system.
/// Source  T. Duff et al., Building an orthonormal basis, revisited, 2017
std::pair<glm::vec3, glm::vec3> basis(const glm::vec3& y) {
  const float sign = y.z >= 0 ? 1.0F : -1.0F;
  const float a = -1 / (sign + y.z);
  const float b = y.x * y.y * a;
  return {{b, sign + y.y * y.y * a, -y.y}, {1 + sign * y.x * y.x * a, sign * b, -sign * y.x}};
}

void check_size(const Prototype& glyph, std::size_t count, const Run& run) {
  const double bytes = static_cast<double>(count) * (16.0 * static_cast<double>(glyph.positions.size()) +
                                                     19.0 * static_cast<double>(glyph.corners.size()) +
                                                     4.0 * static_cast<double>(glyph.face_sizes.size()));
  if (bytes > static_cast<double>(run.limits.memory_bytes) ||
      static_cast<double>(count) * static_cast<double>(glyph.corners.size()) > 4e9) {
    throw Error(Error::Resource, fmt::format("glyphs: {} of them need {:.0f} bytes, the limit is {}", count, bytes,
                                             run.limits.memory_bytes));
  }
}

/// Both as a scene.
Scene scene_of(std::shared_ptr<const Mesh> surface, Mesh glyph_mesh) {
  Scene scene;
  scene.space = surface->space;
  glyph_mesh.space = surface->space;
  const auto add = [&](std::shared_ptr<const Mesh> mesh, const char* name) {
    Node node;
    node.name = name;
    node.mesh = MeshId(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.roots.emplace_back(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
  };
  if (surface->vertex_count() > 0) add(std::move(surface), "surface");
  add(std::make_shared<const Mesh>(std::move(glyph_mesh)), "glyphs");
  return scene;
}

std::vector<Value> run_glyphs(std::span<const Value> inputs, const GlyphsOptions& options, const Run& run) {
  const std::shared_ptr<const Mesh> source = inputs[0].shared<Mesh>();
  std::shared_ptr<const Mesh> surface = source;
  const bool has_materials = !source->material.empty();
  if (!options.surface) {
    auto nothing = std::make_shared<Mesh>();
    nothing->space = source->space;
    surface = std::move(nothing);
  } else if (has_materials) {
    // The materials stay with the scene that the mesh comes from.
    auto plain = std::make_shared<Mesh>(source->clone());
    plain->material.clear();
    surface = std::move(plain);
  }
  std::vector<Value> results;
  results.emplace_back(scene_of(std::move(surface), glyphs(*source, options, run)));
  return results;
}

}  // namespace

extern const Operation kGlyphs = with_examples(
    value_operation<GlyphsOptions>(
        "glyphs", "Shows vectors at the vertices of a mesh as arrows, cones or spheres.",
        {{"source", "the mesh", ValueKind::Mesh}}, {{"scene", "the mesh and the glyphs", ValueKind::Scene}},
        {field("kind", &GlyphsOptions::kind, "which body"),
         field("attribute", &GlyphsOptions::attribute, "the vectors: an attribute of vertices, of three numbers"),
         field("size", &GlyphsOptions::size, {1e-6, 1e3}, "", "of the longest, in diagonals of the mesh's box"),
         field("scaled", &GlyphsOptions::scaled, "as long as their vectors; else all alike"),
         field("most", &GlyphsOptions::most, {1, 10000000}, "", "of more vertices every so-many-th has one"),
         field("segments", &GlyphsOptions::segments, {3, 256}, "", "faces around"),
         field("map", &GlyphsOptions::map, "colors of lengths"),
         field("range", &GlyphsOptions::range, {-1e30, 1e30}, "",
               "lengths of the first and last color; auto: 0 to the longest"),
         field("surface", &GlyphsOptions::surface, "the mesh is shown, too")},
        run_glyphs),
    {{"primitive:kind=uv_sphere,segments=24 glyphs:size=0.12 render:width=480,height=360,background=white",
      "The normals of a sphere."},
     {"primitive:kind=teapot glyphs:kind=cone,size=0.05,most=3000,surface=false "
      "render:width=480,height=360,background=white",
      "The normals of the teapot, without it."}});

Mesh glyphs(const Mesh& mesh, const GlyphsOptions& options, const Run& run) {
  kGlyphs.check(&options);
  const std::vector<Vector> vectors = chosen(mesh, options, run);
  const Prototype glyph = prototype(options);
  check_size(glyph, vectors.size(), run);
  float longest = 0;
  for (const Vector& each : vectors) longest = std::max(longest, each.length);
  const Box3 box = bounds(mesh);
  const float diagonal = box.empty() ? 0 : glm::length(box.size());
  const float unit = options.size * (diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1);
  const double low = options.range ? options.range->x : 0;
  const double high = options.range ? options.range->y : static_cast<double>(longest);
  const std::vector<glm::vec4> map = map_colors(options.map, kColors);

  Mesh result;
  result.name = "glyphs";
  result.space = mesh.space;
  Array<float> normals;
  Array<float> values;
  Array<std::uint8_t> colors;
  result.face_offsets.push_back(0);
  for (const Vector& each : vectors) {
    const auto [x, z] = basis(each.direction);
    const auto turned = [&, x = x, z = z](const glm::vec3& v) { return x * v.x + each.direction * v.y + z * v.z; };
    const float size = unit * (options.scaled ? each.length / longest : 1);
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const glm::vec3& position : glyph.positions) {
      result.positions.push_back(each.place + size * turned(position));
      values.push_back(each.length);
    }
    const glm::vec4& color = map[color_index(static_cast<double>(each.length), low, high, map.size())];
    for (std::size_t c = 0; c < glyph.corners.size(); ++c) {
      result.corners.push_back(first + glyph.corners[c]);
      const glm::vec3 normal = turned(glyph.normals[c]);
      normals.insert(normals.end(), {normal.x, normal.y, normal.z});
      for (int k = 0; k < 3; ++k) colors.push_back(static_cast<std::uint8_t>(color[k] * 255 + 0.5F));
    }
    for (const std::uint32_t size_of_face : glyph.face_sizes) {
      result.face_offsets.push_back(result.face_offsets.back() + size_of_face);
    }
  }
  result.attributes.push_back({"NORMAL", Domain::Corner, 3, std::move(normals)});
  result.attributes.push_back({"COLOR_0", Domain::Corner, 3, std::move(colors)});
  result.attributes.push_back({"value", Domain::Vertex, 1, std::move(values)});
  return result;
}

}  // namespace azulejo
