// Tests that run on every operation that is not on tiles: any values in give values or an Error, the same on any number
// of threads.
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/conversion.h"
#include "azulejo/core/error.h"
#include "azulejo/operations.h"
#include "azulejo/operations_testing.h"

namespace azulejo {
namespace {

Mesh cube() {
  Mesh mesh;
  mesh.name = "cube";
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  mesh.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  mesh.face_offsets = {0, 4, 8, 12, 16, 20, 24};
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 3, Array<std::uint8_t>(24, 200)});
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Corner, 2, Array<float>(48, 0.25F)});
  mesh.attributes.push_back({"group", Domain::Face, 1, Array<std::uint32_t>(6, 7)});
  return mesh;
}

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  return mesh;
}

/// What files may hold and nobody wants: faces of no and of two corners, a face that names one vertex thrice, one face
/// twice, and vertices that are not used.
Mesh degenerate() {
  Mesh mesh = triangle();
  mesh.positions.emplace_back(9, 9, 9);
  mesh.corners = {0, 1, 0, 0, 0, 0, 1, 2, 0, 1, 2, 2, 1, 0};
  mesh.face_offsets = {0, 0, 2, 5, 8, 11, 14};
  return mesh;
}

Mesh not_finite() {
  Mesh mesh = cube();
  mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[5].y = std::numeric_limits<float>::infinity();
  mesh.positions[6] = glm::vec3(3e38F, -3e38F, 3e38F);
  return mesh;
}

Mesh all_nan() {
  Mesh mesh = triangle();
  for (glm::vec3& position : mesh.positions) position = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  return mesh;
}

Mesh points() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  return mesh;
}

Mesh lines() {
  Mesh mesh = points();
  mesh.lines = {0, 1, 1, 2, 2, 2};
  return mesh;
}

/// Faces of 3 to 6 corners between any of few vertices, on a coarse grid, so that all meet and many coincide.
Mesh soup() {
  std::mt19937 random(7);
  Mesh mesh;
  for (int i = 0; i < 40; ++i) mesh.positions.emplace_back(random() % 4, random() % 4, random() % 3);
  mesh.face_offsets.push_back(0);
  for (int face = 0; face < 120; ++face) {
    for (auto corners = 3 + random() % 4; corners > 0; --corners)
      mesh.corners.push_back(static_cast<std::uint32_t>(random() % 40));
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Vertex, 2, Array<float>(80, 0.5F)});
  return mesh;
}

/// What no manifold is: many faces at one edge, two fans at one vertex, a Möbius strip, a face on itself.
Mesh singular() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < 9; ++i) {
    mesh.positions.emplace_back(i % 3 == 0 ? -1.0F : 1.0F, static_cast<float>(i), 0.5F);
    mesh.corners.insert(mesh.corners.end(), {i % 2, 1 - i % 2, 2 + i});
  }
  mesh.corners.insert(mesh.corners.end(), {0, 1, 2, 0, 9, 10});
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  constexpr std::uint32_t kSteps = 5;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const auto at = static_cast<float>(i);
    mesh.positions.emplace_back(5 + at, at * at, 0);
    mesh.positions.emplace_back(5 + at, at * at, 1);
    const std::uint32_t a = first + 2 * i;
    const bool last = i + 1 == kSteps;
    const std::uint32_t c = last ? first + 1 : a + 2;  // turned over where it is closed
    const std::uint32_t d = last ? first : a + 3;
    mesh.corners.insert(mesh.corners.end(), {a, c, a + 1, a + 1, c, d});
  }
  return mesh;
}

/// So many faces that they are divided among threads: a bumpy ring with a hole.
Mesh many_faces() {
  constexpr std::uint32_t kAround = 160;
  constexpr std::uint32_t kAcross = 80;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const float u = static_cast<float>(i) * (6.2831853F / kAround);
      const float v = static_cast<float>(j) * (6.2831853F / kAcross);
      const float r = 1 + (0.3F + 0.02F * std::sin(9 * u + 5 * v)) * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), 0.3F * std::sin(v));
      if (i * j < 50) continue;
      const std::uint32_t next_i = (i + 1) % kAround * kAcross;
      const std::uint32_t next_j = (j + 1) % kAcross;
      const std::uint32_t a = i * kAcross + j;
      mesh.corners.insert(mesh.corners.end(),
                          {a, next_i + j, next_i + next_j, a, next_i + next_j, i * kAcross + next_j});
    }
  }
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 3, Array<float>(3 * std::size_t{kAround} * kAcross, 0.5F)});
  return mesh;
}

/// Curves, a hole, a dashed line with points, patterns, groups, a clip.
Drawing ordinary_drawing() {
  Drawing drawing;
  drawing.width = 40;
  drawing.height = 30;
  DrawingStyle style;
  Gradient gradient{.to = {40, 0}, .stops = {{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 0.5F}}}};
  style.fill = Paint({1, 1, 1, 0.5F}, drawing.add_pattern(gradient));
  style.fill_rule = FillRule::EvenOdd;
  const Path ring = Path()
                        .move_to({2, 2})
                        .cubic_to({20, -5}, {38, 10}, {30, 28})
                        .quadratic_to({10, 30}, {2, 2})
                        .close()
                        .move_to({10, 8})
                        .line_to({20, 8})
                        .line_to({15, 15})
                        .close();
  drawing.add_path(ring, drawing.add_style(style), "ring");
  DrawingStyle line;
  line.fill.reset();
  line.stroke = Paint({0, 0.5F, 0, 1}, drawing.add_pattern(Hatch()));
  line.stroke_width = 3;
  line.dash = {5, 2, 1};
  line.points = glm::vec4(0, 0, 0, 1);
  const std::uint32_t group = drawing.add_group({0.5F, 0.5F, -0.5F, 0.5F, 20, 0}, 0.5F);
  drawing.add_path(Path().move_to({0, 0}).line_to({20, 0}).line_to({20, 20}), drawing.add_style(line), "", group);
  const std::uint32_t clip = drawing.add_clip();
  drawing.add_path(Path().move_to({0, 0}).line_to({18, 0}).line_to({18, 18}).close(), 0, "", clip);
  drawing.groups[group].clip = clip;
  return drawing;
}

/// A copy with the points changed.
Drawing with_points(const Drawing& drawing, glm::vec2 (*change)(const glm::vec2& point, std::size_t index)) {
  Drawing changed = drawing.clone();
  for (std::size_t i = 0; i < changed.points.size(); ++i) changed.points[i] = change(changed.points[i], i);
  return changed;
}

struct Sample {
  std::string name;
  Value value;
};

/// Values of a kind; the first is an ordinary one, the second may be anything.
std::vector<Sample> samples(ValueKind kind) {
  std::vector<Sample> meshes;
  meshes.push_back({"a cube", Value(cube())});
  meshes.push_back({"a soup of faces", Value(soup())});
  meshes.push_back({"a triangle", Value(triangle())});
  meshes.push_back({"an empty mesh", Value(Mesh())});
  meshes.push_back({"degenerate faces", Value(degenerate())});
  meshes.push_back({"NaN and infinity", Value(not_finite())});
  meshes.push_back({"NaN only", Value(all_nan())});
  meshes.push_back({"points", Value(points())});
  meshes.push_back({"lines", Value(lines())});
  meshes.push_back({"singular edges and vertices", Value(singular())});
  meshes.push_back({"many faces", Value(many_faces())});
  std::vector<Sample> list;
  switch (kind) {
    case ValueKind::Mesh: return meshes;
    case ValueKind::Scene:
      for (const Sample& each : meshes) list.push_back({each.name, convert(each.value, kind, {})});
      list.push_back({"an empty scene", Value(Scene())});
      return list;
    case ValueKind::Volume: {
      Volume volume;
      volume.width = volume.height = volume.depth = 4;
      for (int i = 0; i < 64; ++i) volume.samples.push_back(static_cast<float>(i % 7));
      Volume broken = volume.clone();
      broken.samples.assign(64, std::numeric_limits<float>::quiet_NaN());
      list.push_back({"a volume", Value(std::move(volume))});
      list.push_back({"NaN samples", Value(std::move(broken))});
      list.push_back({"an empty volume", Value(Volume())});
      return list;
    }
    case ValueKind::Frame: {
      Frame frame;
      frame.layers.push_back({"color", Image(9, 7, 4)});
      list.push_back({"a frame", Value(std::move(frame))});
      list.push_back({"an empty frame", Value(Frame())});
      return list;
    }
    case ValueKind::Drawing: {
      const Drawing ordinary = ordinary_drawing();
      list.push_back({"a drawing", Value(ordinary.clone())});
      list.push_back({"an empty drawing", Value(Drawing())});
      list.push_back({"points that are one",
                      Value(with_points(ordinary, [](const glm::vec2&, std::size_t) { return glm::vec2(3, 3); }))});
      list.push_back({"points on a line",
                      Value(with_points(ordinary, [](const glm::vec2& p, std::size_t) { return glm::vec2(p.x, 7); }))});
      list.push_back({"NaN and infinity", Value(with_points(ordinary, [](const glm::vec2& p, std::size_t i) {
                        return i % 5 == 1   ? glm::vec2(std::numeric_limits<float>::quiet_NaN(), p.y)
                               : i % 5 == 3 ? glm::vec2(p.x, -std::numeric_limits<float>::infinity())
                                            : p;
                      }))});
      list.push_back({"huge coordinates",
                      Value(with_points(ordinary, [](const glm::vec2& p, std::size_t) { return p * 1e37F; }))});
      Drawing pageless = ordinary.clone();
      pageless.width = 0;
      list.push_back({"a page without width", Value(std::move(pageless))});
      Drawing singular = ordinary.clone();
      singular.groups[1].parent_from_group = {0, 0, 0, 0, 5, 5};
      list.push_back({"a group without size", Value(std::move(singular))});
      return list;
    }
    case ValueKind::Image: list.push_back({"an image", Value(Image(9, 7, 3))}); return list;
    case ValueKind::Labels: list.push_back({"labels", Value(Labels(9, 7))}); return list;
    case ValueKind::Report: list.push_back({"a report", Value(Report())}); return list;
  }
  return list;
}

// What a value holds, as bytes that can be compared.

void append(std::string& bytes, const void* data, std::size_t size) {
  if (size > 0) bytes.append(static_cast<const char*>(data), size);
}

template <class T>
void append(std::string& bytes, const Array<T>& array) {
  append(bytes, array.data(), array.size() * sizeof(T));
}

std::string bytes_of(const Mesh& mesh) {
  std::string bytes = mesh.name;
  append(bytes, mesh.positions);
  append(bytes, mesh.corners);
  append(bytes, mesh.face_offsets);
  append(bytes, mesh.lines);
  append(bytes, mesh.material);
  for (const Attribute& each : mesh.attributes) {
    bytes += each.name;
    std::visit([&](const auto& array) { append(bytes, array); }, each.values);
  }
  return bytes;
}

std::string bytes_of(const Drawing& drawing) {
  std::string bytes;
  append(bytes, drawing.commands);
  append(bytes, drawing.points);
  for (const PlacedPath& each : walk(drawing)) {
    bytes += drawing.paths[each.path].id;
    append(bytes, &each.page_from_path, sizeof each.page_from_path);
  }
  return bytes;
}

std::string bytes_of(const Image& image) {
  std::string bytes = describe(image.info());
  for (int y = 0; y < image.height(); ++y) append(bytes, image.any().row(y), image.info().row_bytes());
  return bytes;
}

std::string bytes_of(const Value& value) {
  std::string bytes = to_string(value.kind());
  if (value.mesh() != nullptr) bytes += bytes_of(*value.mesh());
  if (value.drawing() != nullptr) bytes += bytes_of(*value.drawing());
  if (value.image() != nullptr) bytes += bytes_of(*value.image());
  if (value.report() != nullptr) {
    const Json& json = value.report()->json;
    for (const std::string& key : json.keys()) {
      if (!key.ends_with("_ms")) bytes += key + json[key].dump();  // times differ
    }
  }
  if (value.volume() != nullptr) append(bytes, value.volume()->samples);
  if (value.scene() != nullptr) {
    for (const auto& mesh : value.scene()->meshes) bytes += bytes_of(*mesh);
  }
  if (value.frame() != nullptr) {
    for (const Frame::Layer& layer : value.frame()->layers) bytes += layer.name + bytes_of(layer.image);
  }
  return bytes;
}

void check_result(const Value& value) {
  if (value.mesh() != nullptr) {
    EXPECT_NO_THROW(value.mesh()->check("result"));
  }
  if (value.drawing() != nullptr) {
    EXPECT_NO_THROW(value.drawing()->check("result"));
  }
  EXPECT_FALSE(value.image() != nullptr && value.image()->empty());
  if (value.scene() != nullptr) {
    EXPECT_NO_THROW(value.scene()->check("result"));
    for (const auto& mesh : value.scene()->meshes) EXPECT_NO_THROW(mesh->check("result"));
  }
  if (value.frame() != nullptr) {
    ASSERT_FALSE(value.frame()->layers.empty());
    for (const Frame::Layer& layer : value.frame()->layers) EXPECT_FALSE(layer.image.empty()) << layer.name;
  }
}

/// The results' bytes, or the error's message.
std::string outcome(const Operation& operation, const void* options, const std::vector<Value>& inputs, int threads) {
  Run run;
  run.threads = threads;
  try {
    const std::vector<Value> results = invoke(operation, options, inputs, run);
    EXPECT_EQ(results.size(), operation.outputs.size());
    std::string bytes;
    EXPECT_FALSE(results[0].empty());
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (results[i].empty() && i > 0) continue;  // the options leave it out
      EXPECT_EQ(results[i].kind(), operation.outputs[i].kind);
      check_result(results[i]);
      bytes += bytes_of(results[i]);
    }
    return bytes;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(operation.name + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(error.kind(), Error::Cancelled);
    return message;
  }
}

/// Pictures of a few pixels show what large ones do.
void make_small(const Operation& operation, void* options) {
  for (const char* name : {"width", "height"}) {
    const Field* const field = operation.find_field(name);
    if (field != nullptr && field->type == FieldType::Int) field->parse(options, "40");
  }
}

TEST(EveryValueOperation, GivesValuesOrAnErrorOnAnyNumberOfThreads) {
  for (const Operation* operation : every_variant()) {
    if (operation->make_node != nullptr) continue;
    const std::vector<Sample> first =
        operation->inputs.empty() ? std::vector<Sample>(1) : samples(operation->inputs[0].kind);
    for (const auto& [label, options] : option_sets(*operation)) {
      if (!label.starts_with("width=") && !label.starts_with("height=")) make_small(*operation, options.get());
      for (const Sample& sample : first) {
        // Options other than the defaults are tried on the first two.
        if (label != "defaults" && &sample > first.data() + 1) break;
        SCOPED_TRACE(title_of(*operation) + " " + label + " on " + sample.name);
        std::vector<Value> inputs;
        for (const Port& port : operation->inputs) inputs.push_back(samples(port.kind)[0].value);
        if (!inputs.empty()) inputs[0] = sample.value;
        EXPECT_EQ(outcome(*operation, options.get(), inputs, 1), outcome(*operation, options.get(), inputs, 3));
      }
    }
  }
}

TEST(EveryValueOperation, TakesOrdinaryValuesWithItsDefaults) {
  for (const Operation* operation : every_variant()) {
    if (operation->make_node != nullptr) continue;
    const auto options = operation->make_options();
    make_small(*operation, options.get());
    std::vector<Value> inputs;
    for (const Port& port : operation->inputs) inputs.push_back(samples(port.kind)[0].value);
    EXPECT_NO_THROW(invoke(*operation, options.get(), inputs, {})) << title_of(*operation);
  }
}

}  // namespace
}  // namespace azulejo
