#include <algorithm>
#include <limits>

#include "azulejo/io/gltf.h"
#include "azulejo/io/gltf_testing.h"

namespace azulejo {
namespace {

using Json = nlohmann::json;
using Indices = Array<std::uint32_t>;

Scene written_and_read(const Scene& scene, const Run& run = {}) {
  return std::get<Scene>(read_model(encode_model(scene, "glb", {}, run), "back.glb", {}, run));
}

/// The JSON of what is written.
Json json_of(const Scene& scene) {
  const std::vector<std::byte> file = encode_model(scene, "glb");
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + 12, 4);
  return Json::parse(std::string(reinterpret_cast<const char*>(file.data()) + 20, length));
}

Mesh square() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 3};
  mesh.face_offsets = {0, 4};
  return mesh;
}

void expect_same(const TextureUse& a, const TextureUse& b) {
  EXPECT_EQ(a.texture, b.texture);
  EXPECT_EQ(a.texcoord, b.texcoord);
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.strength, b.strength);
}

void expect_same(const Material& a, const Material& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.base_color, b.base_color);
  EXPECT_EQ(a.metallic, b.metallic);
  EXPECT_EQ(a.roughness, b.roughness);
  EXPECT_EQ(a.emissive, b.emissive);
  EXPECT_EQ(a.alpha_mode, b.alpha_mode);
  EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
  EXPECT_EQ(a.double_sided, b.double_sided);
  EXPECT_EQ(a.extensions.dump(), b.extensions.dump());
  expect_same(a.base_color_texture, b.base_color_texture);
  expect_same(a.metallic_roughness_texture, b.metallic_roughness_texture);
  expect_same(a.normal_texture, b.normal_texture);
  expect_same(a.occlusion_texture, b.occlusion_texture);
  expect_same(a.emissive_texture, b.emissive_texture);
}

/// Attributes in any order: a file keeps none.
void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.name, b.name);
  // As bits: NaN is NaN.
  ASSERT_EQ(a.positions.size(), b.positions.size());
  EXPECT_EQ(std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(glm::vec3)), 0);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.face_offsets, b.face_offsets);
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.attributes.size(), b.attributes.size());
  for (const Attribute& each : a.attributes) {
    const Attribute* const other = b.find(each.name);
    ASSERT_NE(other, nullptr) << each.name;
    EXPECT_EQ(other->domain, each.domain);
    EXPECT_EQ(other->components, each.components);
    EXPECT_EQ(other->values, each.values) << each.name;
  }
  ASSERT_EQ(a.morph_targets.size(), b.morph_targets.size());
  for (std::size_t t = 0; t < a.morph_targets.size(); ++t) {
    EXPECT_EQ(a.morph_targets[t].name, b.morph_targets[t].name);
    EXPECT_EQ(a.morph_targets[t].positions, b.morph_targets[t].positions);
    EXPECT_EQ(a.morph_targets[t].normals, b.morph_targets[t].normals);
  }
}

void expect_same(const Node& a, const Node& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.placement.index(), b.placement.index());
  EXPECT_EQ(parent_from_node(a), parent_from_node(b));
  EXPECT_EQ(a.children, b.children);
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.light, b.light);
  EXPECT_EQ(a.skin, b.skin);
  EXPECT_EQ(a.morph_weights, b.morph_weights);
  EXPECT_EQ(a.visible, b.visible);
}

void expect_same(const Texture& a, const Texture& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.wrap_u, b.wrap_u);
  EXPECT_EQ(a.wrap_v, b.wrap_v);
  EXPECT_EQ(a.magnification, b.magnification);
  EXPECT_EQ(a.minification, b.minification);
  EXPECT_EQ(a.mipmaps, b.mipmaps);
  ASSERT_EQ(a.image == nullptr, b.image == nullptr);
  if (a.image != nullptr) {
    EXPECT_TRUE(same_pixels(*a.image, *b.image));
  }
}

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.perspective, b.perspective);
  EXPECT_EQ(a.perspective ? a.fov_y : a.height, b.perspective ? b.fov_y : b.height);
  EXPECT_EQ(a.aspect, b.aspect);
  EXPECT_EQ(a.near, b.near);
  EXPECT_EQ(a.far, b.far);
}

void expect_same(const LightSource& a, const LightSource& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.inner_cone, b.inner_cone);
  EXPECT_EQ(a.outer_cone, b.outer_cone);
}

void expect_same(const Skin& a, const Skin& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.joints, b.joints);
  EXPECT_EQ(a.inverse_bind_matrices, b.inverse_bind_matrices);
  EXPECT_EQ(a.skeleton, b.skeleton);
}

void expect_same(const Animation& a, const Animation& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    EXPECT_EQ(a.channels[c].node, b.channels[c].node);
    EXPECT_EQ(a.channels[c].property, b.channels[c].property);
    EXPECT_EQ(a.channels[c].interpolation, b.channels[c].interpolation);
    EXPECT_EQ(a.channels[c].times, b.channels[c].times);
    EXPECT_EQ(a.channels[c].values, b.channels[c].values);
  }
}

template <class T>
void expect_same(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(a[i], b[i]);
  }
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.roots, b.roots);
  EXPECT_EQ(a.space, b.space);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) expect_same(*a.meshes[m], *b.meshes[m]);
  expect_same(a.nodes, b.nodes);
  expect_same(a.materials, b.materials);
  expect_same(a.textures, b.textures);
  expect_same(a.cameras, b.cameras);
  expect_same(a.lights, b.lights);
  expect_same(a.skins, b.skins);
  expect_same(a.animations, b.animations);
}

TEST(GltfWrite, WhatWasReadComesBack) {
  GltfSample sample = full_sample();
  sample.json["materials"].push_back(Json::parse(R"({"name": "m", "emissiveFactor": [1, 0.1, 0.3],
      "pbrMetallicRoughness": {"metallicFactor": 0.1, "baseColorTexture": {"index": 0, "texCoord": 3, "extensions":
      {"KHR_texture_transform": {"offset": [0.1, 0.7], "rotation": 0.3, "scale": [3, -4]}}}},
      "occlusionTexture": {"index": 0, "strength": 0.1}, "alphaMode": "BLEND", "doubleSided": true,
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3.3}, "KHR_materials_unlit": {}}})"));
  sample.json["cameras"].push_back(
      Json::parse(R"({"type": "orthographic", "orthographic": {"xmag": 4.2, "ymag": 2.1, "znear": 0, "zfar": 9}})"));
  sample.json["nodes"].push_back(Json::parse(R"({"matrix": [1,0,0,0, 0,2,0,0, 0,0,3,0, 4,5,0.1,1],
      "extensions": {"KHR_node_visibility": {"visible": false}}})"));
  const Scene scene = read_sample(sample);
  expect_same(scene, written_and_read(scene));
}

TEST(GltfWrite, AttributesOfAllTypesComeBack) {
  Mesh mesh = square();
  mesh.corners = {0, 1, 2, 0, 2, 3};
  mesh.face_offsets.clear();
  mesh.lines = {0, 2};
  mesh.positions[3].x = std::numeric_limits<float>::quiet_NaN();
  mesh.attributes = {{"NORMAL", Domain::Vertex, 3, Array<float>(12, 0.5F)},
                     {"COLOR_0", Domain::Vertex, 4, Array<float>(16, 0.25F)},
                     {"JOINTS_0", Domain::Vertex, 4, Indices(16, 300)},
                     {"_A", Domain::Vertex, 1, Array<std::uint8_t>{1, 2, 3, 4}},
                     {"_B", Domain::Vertex, 3, Array<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
                     {"_C", Domain::Vertex, 1, Indices{1, 70, 300, 65535}},
                     {"_D", Domain::Vertex, 2, Array<float>{1, 2, 3, 4, 5, 6, 7, 8}}};
  const Scene scene = scene_of(mesh.clone());
  expect_same(mesh, *written_and_read(scene).meshes[0]);
}

TEST(GltfWrite, PolygonsBecomeFansAndMaterialsPrimitives) {
  Mesh mesh = square();
  mesh.corners = {0, 1, 2, 3, 0, 1, 2, 0, 1, 3, 1, 2};
  mesh.face_offsets = {0, 4, 7, 10, 12};
  Scene scene = scene_of(std::move(mesh));
  scene.materials.resize(3);
  Mesh painted = scene.meshes[0]->clone();
  painted.material = {2, 0, 2, MaterialId::kNone};
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(painted));
  const Scene back = written_and_read(scene);
  EXPECT_EQ(back.meshes[0]->corners, (Indices{0, 1, 2, 0, 2, 3, 0, 1, 3, 0, 1, 2}))
      << "the face of two corners is none";
  EXPECT_EQ(back.meshes[0]->material, (Indices{2, 2, 2, 0}));
  EXPECT_EQ(back.meshes[0]->vertex_count(), 4U) << "shared";
}

TEST(GltfWrite, CornersThatDifferGetVerticesOfTheirOwn) {
  Mesh mesh = square();
  mesh.corners = {0, 1, 2, 0, 2, 3};
  mesh.face_offsets.clear();
  mesh.lines = {2, 3};
  mesh.attributes = {{"TEXCOORD_0", Domain::Corner, 2, Array<float>{0, 0, 1, 0, 1, 1, 0, 0, 9, 9, 0, 1}},
                     {"_ID", Domain::Vertex, 1, Indices{10, 11, 12, 13}}};
  const Scene back = written_and_read(scene_of(std::move(mesh)));
  const Mesh& result = *back.meshes[0];
  EXPECT_EQ(result.vertex_count(), 5U) << "vertex 2 has two, vertex 0 has one";
  EXPECT_EQ(result.corners, (Indices{0, 1, 2, 0, 4, 3}));
  EXPECT_EQ(result.lines, (Indices{2, 3}));
  EXPECT_EQ(result.positions[4], glm::vec3(1, 1, 0));
  EXPECT_EQ(*result.find("TEXCOORD_0")->get<float>(), (Array<float>{0, 0, 1, 0, 1, 1, 0, 1, 9, 9}));
  EXPECT_EQ(*result.find("_ID")->get<std::uint32_t>(), (Indices{10, 11, 12, 13, 12}));
}

TEST(GltfWrite, WhatGltfCannotHold) {
  Mesh mesh = square();
  mesh.attributes = {{"quality", Domain::Vertex, 1, Array<float>{1, 2, 3, 4}},
                     {"group", Domain::Face, 1, Indices{5}},
                     {"COLOR_0", Domain::Vertex, 3, Array<std::uint8_t>{255, 0, 188, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
                     {"_LARGE", Domain::Vertex, 1, Indices{0, 1, 2, 1U << 20}}};
  Warnings warnings;
  const Scene back = written_and_read(scene_of(std::move(mesh)), warnings.run());
  const Mesh& result = *back.meshes[0];
  EXPECT_EQ(warnings.lines.size(), 1U) << "the face's";
  EXPECT_EQ(*result.find("_quality")->get<float>(), (Array<float>{1, 2, 3, 4}));
  EXPECT_EQ(result.find("group"), nullptr);
  const Array<float>& color = *result.find("COLOR_0")->get<float>();
  EXPECT_NEAR(color[0], 1, 1e-5);
  EXPECT_NEAR(color[2], 0.5029F, 1e-4) << "sRGB 188 is half the light";
  EXPECT_EQ(*result.find("_LARGE")->get<float>(), (Array<float>{0, 1, 2, 1 << 20}));

  Scene empty = scene_of({});
  EXPECT_EQ(written_and_read(empty, warnings.run()).meshes.size(), 0U);
  EXPECT_EQ(warnings.lines.size(), 2U);
  empty.nodes[0].placement = glm::mat4(std::numeric_limits<float>::infinity());
  EXPECT_EQ(kind_of_error([&] { encode_model(empty, "glb"); }), Error::Data);
  EXPECT_NO_THROW(written_and_read(Scene()));
}

TEST(GltfWrite, PhongBecomesMetalRough) {
  Scene scene = scene_of(square());
  scene.materials.resize(1);
  scene.materials[0].model = MaterialModel::Phong;
  scene.materials[0].base_color = {0.5F, 0.25F, 0, 1};
  scene.materials[0].metallic = 1;
  scene.materials[0].shininess = 6;
  const Material back = written_and_read(scene).materials[0];
  EXPECT_EQ(back.base_color, glm::vec4(0.5F, 0.25F, 0, 1));
  EXPECT_EQ(back.metallic, 0);
  EXPECT_EQ(back.roughness, 0.5F);
}

TEST(GltfWrite, SpaceBecomesARoot) {
  Mesh mesh = square();
  mesh.space = {UpAxis::Z, 0.001F};
  const Scene back = written_and_read(scene_of(std::move(mesh)));
  const std::vector<PlacedNode> placed = walk(back);
  ASSERT_EQ(placed.size(), 2U);
  const glm::vec4 up = placed[1].world_from_node * glm::vec4(0, 0, 1000, 0);
  EXPECT_NEAR(up.y, 1, 1e-6);
  EXPECT_NEAR(up.z, 0, 1e-6);
}

TEST(GltfWrite, ImagesAreWrittenOnce) {
  Scene scene = scene_of(square());
  const auto image =
      std::make_shared<const Image>(random_image({3, 2, 1, PixelType::U8, ColorState::Srgb, AlphaState::None}, 5));
  scene.textures.resize(4);
  scene.textures[0].image = image;
  scene.textures[1].image = image;
  scene.textures[1].wrap_u = TextureWrap::Mirror;
  scene.textures[2].source = "a b\\c.png";
  const Json json = json_of(scene);
  EXPECT_EQ(json["images"].size(), 2U);
  EXPECT_EQ(json["images"][1]["uri"], "a%20b/c.png");
  EXPECT_EQ(json["samplers"].size(), 1U);
  EXPECT_FALSE(json["textures"][3].contains("source"));
  const Scene back = written_and_read(scene);
  EXPECT_EQ(back.textures[0].image, back.textures[1].image);
  EXPECT_TRUE(same_pixels(*back.textures[0].image, *image));
}

/// What the specification asks of files beyond being readable.
TEST(GltfWrite, FilesAreValid) {
  const Scene scene = read_sample(full_sample());
  const std::vector<std::byte> file = encode_model(scene, "glb");
  EXPECT_EQ(file.size() % 4, 0U);
  const Json json = json_of(scene);
  EXPECT_EQ(json["extensionsUsed"], (Json{"KHR_lights_punctual", "KHR_materials_clearcoat"}));
  for (const Json& accessor : json["accessors"]) {
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
    EXPECT_LE(view["byteOffset"].get<int>() + view["byteLength"].get<int>(), json["buffers"][0]["byteLength"]);
    if (view.value("target", 0) == 34962) {
      EXPECT_EQ(view["byteStride"].get<int>() % 4, 0);
    }
  }
  const Json& primitive = json["meshes"][0]["primitives"][0];
  const Json& positions = json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(positions["min"], (Json{0, 0, 0}));
  EXPECT_EQ(positions["max"], (Json{1, 1, 0}));
  EXPECT_TRUE(json["accessors"][json["animations"][0]["samplers"][0]["input"].get<std::size_t>()].contains("max"));
  for (const char* list : {"images", "textures", "nodes", "scenes", "skins"}) EXPECT_FALSE(json[list].empty()) << list;
  EXPECT_FALSE(json_of(Scene()).contains("nodes")) << "empty lists aren't allowed";
}

TEST(GltfWrite, ManyVerticesHaveLongIndices) {
  Mesh mesh;
  mesh.positions.resize(70000, glm::vec3(1));
  mesh.corners = {0, 69999, 65535};
  EXPECT_EQ(written_and_read(scene_of(std::move(mesh))).meshes[0]->corners, (Indices{0, 69999, 65535}));
}

}  // namespace
}  // namespace azulejo
