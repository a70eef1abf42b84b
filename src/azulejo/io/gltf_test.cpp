#include "azulejo/io/gltf.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <glm/gtc/type_ptr.hpp>

#include "azulejo/io/gltf_parts.h"
#include "azulejo/io/gltf_testing.h"

namespace azulejo {
namespace {

using Json = nlohmann::json;
using Indices = Array<std::uint32_t>;

/// Reads it as .gltf with the binary chunk in a data: URI.
std::string as_text(const GltfSample& sample) {
  static constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string code = "data:application/octet-stream;base64,";
  for (std::size_t i = 0; i < sample.binary.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < sample.binary.size() ? static_cast<std::uint32_t>(sample.binary[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padding = i + k > sample.binary.size();
      code += padding ? '=' : kLetters[(bits >> (18 - 6 * k)) & 63];
    }
  }
  Json json = sample.json;
  json["buffers"][0]["uri"] = code;
  return json.dump();
}

Indices elements(std::uint64_t mode, const Indices& vertices, std::uint32_t first = 0) {
  Indices result;
  append_gltf_elements(mode, vertices, first, result);
  return result;
}

TEST(Gltf, EveryPartOfASmallFile) {
  Warnings warnings;
  const Scene scene = read_sample(full_sample(), warnings.run());
  EXPECT_EQ(warnings.lines, std::vector<std::string>{});
  EXPECT_EQ(scene.space, (Space{UpAxis::Y, 1.0F}));
  EXPECT_EQ(scene.name, "all");
  EXPECT_EQ(scene.roots, (std::vector{NodeId(0), NodeId(1)}));
  ASSERT_EQ(scene.nodes.size(), 4U);
  EXPECT_EQ(scene.nodes[0].name, "a");
  EXPECT_EQ(scene.nodes[0].mesh, MeshId(0));
  EXPECT_EQ(scene.nodes[0].skin, SkinId(0));
  EXPECT_EQ(scene.nodes[0].morph_weights, std::vector<float>{0.5F}) << "the mesh's";
  EXPECT_EQ(scene.nodes[1].children, (std::vector{NodeId(2), NodeId(3)}));
  EXPECT_EQ(scene.nodes[2].camera, CameraId(0));
  EXPECT_EQ(scene.nodes[3].light, LightId(0));
  const auto& placement = std::get<Placement>(scene.nodes[3].placement);
  EXPECT_EQ(placement.rotation, glm::quat(0, 0, 0, 1));
  EXPECT_EQ(placement.scale, glm::vec3(1, 2, 3));
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].kind, LightKind::Spot);
  EXPECT_EQ(scene.lights[0].intensity, 9);
  EXPECT_EQ(scene.lights[0].inner_cone, 0.1F);
  EXPECT_EQ(scene.lights[0].outer_cone, 0.2F);
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_EQ(scene.cameras[0].fov_y, 1);
  EXPECT_EQ(scene.cameras[0].near, 0.5F);
  EXPECT_EQ(scene.cameras[0].far, 0) << "infinite";
}

TEST(Gltf, TheMeshOfASmallFile) {
  const Scene scene = read_sample(full_sample());
  ASSERT_EQ(scene.meshes.size(), 1U);
  const Mesh& mesh = *scene.meshes[0];
  EXPECT_EQ(mesh.positions, (Array<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.corners, (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(mesh.material, (Indices{0, 0}));
  ASSERT_EQ(mesh.attributes.size(), 2U);
  EXPECT_EQ(*mesh.find("JOINTS_0")->get<std::uint32_t>(), Indices(16, 1));
  EXPECT_EQ(*mesh.find("WEIGHTS_0")->get<float>(), Array<float>(16, 0.25F));
  ASSERT_EQ(mesh.morph_targets.size(), 1U);
  EXPECT_EQ(mesh.morph_targets[0].name, "bulge");
  EXPECT_EQ(mesh.morph_targets[0].positions, (Array<glm::vec3>{{0, 0, 0}, {0, 0, 5}, {0, 0, 0}, {0, 0, 6}}))
      << "sparse over zeros";
  EXPECT_TRUE(mesh.morph_targets[0].normals.empty());
}

TEST(Gltf, TheSkinAndTheAnimationOfASmallFile) {
  const Scene scene = read_sample(full_sample());
  ASSERT_EQ(scene.skins.size(), 1U);
  EXPECT_EQ(scene.skins[0].joints, (std::vector{NodeId(1), NodeId(2)}));
  EXPECT_EQ(scene.skins[0].skeleton, NodeId(1));
  EXPECT_EQ(scene.skins[0].inverse_bind_matrices.size(), 2U);
  ASSERT_EQ(scene.animations.size(), 1U);
  ASSERT_EQ(scene.animations[0].channels.size(), 2U);
  const AnimationChannel& moves = scene.animations[0].channels[0];
  EXPECT_EQ(moves.node, NodeId(2));
  EXPECT_EQ(moves.property, AnimatedProperty::Translation);
  EXPECT_EQ(moves.interpolation, KeyInterpolation::Step);
  EXPECT_EQ(moves.times, (Array<float>{0, 1}));
  EXPECT_EQ(moves.values, (Array<float>{0, 0, 0, 3, 0, 0}));
  EXPECT_EQ(scene.animations[0].channels[1].property, AnimatedProperty::MorphWeights);
}

TEST(Gltf, MaterialsTexturesAndTheirDefaults) {
  const Scene scene = read_sample(full_sample());
  ASSERT_EQ(scene.materials.size(), 1U);
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.metallic, 1) << "where a file says nothing";
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.normal_texture.texture, TextureId(0));
  EXPECT_EQ(material.normal_texture.strength, 2);
  EXPECT_FALSE(material.base_color_texture.texture);
  EXPECT_EQ(material.extensions["KHR_materials_clearcoat"]["clearcoatFactor"].number(), 0.5);
  ASSERT_EQ(scene.textures.size(), 1U);
  const Texture& texture = scene.textures[0];
  EXPECT_EQ(texture.wrap_u, TextureWrap::Clamp);
  EXPECT_EQ(texture.wrap_v, TextureWrap::Repeat);
  EXPECT_EQ(texture.magnification, TextureFilter::Nearest);
  EXPECT_EQ(texture.minification, TextureFilter::Nearest);
  EXPECT_EQ(texture.mipmaps, MipFilter::Nearest);
  ASSERT_NE(texture.image, nullptr);
  EXPECT_TRUE(
      same_pixels(*texture.image, random_image({2, 2, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}, 3)));
}

TEST(Gltf, ExtensionsOfMaterials) {
  GltfSample sample = full_sample();
  sample.json["materials"] = Json::parse(R"([
      {"emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
       "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_unlit": {}}},
      {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform":
          {"offset": [0.5, 1], "rotation": 2, "scale": [3, 4], "texCoord": 2}}}}},
      {"extensions": {"KHR_materials_pbrSpecularGlossiness":
          {"diffuseFactor": [0.1, 0.2, 0.3, 0.4], "glossinessFactor": 0.25}}}])");
  const Scene scene = read_sample(sample);
  EXPECT_EQ(scene.materials[0].emissive, glm::vec3(4, 2, 0));
  EXPECT_EQ(scene.materials[0].model, MaterialModel::Unlit);
  EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::Mask);
  EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.25F);
  EXPECT_TRUE(scene.materials[0].double_sided);
  EXPECT_TRUE(scene.materials[0].extensions.is_null());
  const TextureUse& use = scene.materials[1].base_color_texture;
  EXPECT_EQ(use.texcoord, 2);
  EXPECT_EQ(use.offset, glm::vec2(0.5F, 1));
  EXPECT_EQ(use.scale, glm::vec2(3, 4));
  EXPECT_EQ(use.rotation, 2);
  EXPECT_EQ(scene.materials[2].base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(scene.materials[2].roughness, 0.75F);
  EXPECT_EQ(scene.materials[2].metallic, 0);
}

TEST(Gltf, ModesBecomeTrianglesAndLines) {
  EXPECT_EQ(elements(4, {0, 1, 2, 3, 4, 5, 6}, 10), (Indices{10, 11, 12, 13, 14, 15})) << "the last is left out";
  EXPECT_EQ(elements(5, {0, 1, 2, 3, 4}), (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4})) << "every second turned";
  EXPECT_EQ(elements(5, {0, 1, 2, 2, 3, 3, 4, 5}), (Indices{0, 1, 2, 3, 5, 4})) << "joints of strips are dropped";
  EXPECT_EQ(elements(6, {0, 1, 2, 3}), (Indices{1, 2, 0, 2, 3, 0}));
  EXPECT_EQ(elements(1, {0, 1, 2, 3, 4}), (Indices{0, 1, 2, 3}));
  EXPECT_EQ(elements(2, {0, 1, 2}), (Indices{0, 1, 1, 2, 2, 0}));
  EXPECT_EQ(elements(2, {0, 1}), (Indices{0, 1}));
  EXPECT_EQ(elements(3, {0, 1, 2}), (Indices{0, 1, 1, 2}));
  for (std::uint64_t mode = 0; mode <= 6; ++mode) EXPECT_EQ(elements(mode, {}), Indices{}) << mode;
  for (std::uint64_t mode = 1; mode <= 6; ++mode) EXPECT_EQ(elements(mode, {7}), Indices{}) << mode;
}

TEST(Gltf, PointsAreVerticesWithoutFaces) {
  GltfSample sample = square_sample();
  sample.json["meshes"][0]["primitives"][0] = Json::parse(R"({"attributes": {"POSITION": 0}, "mode": 0})");
  const Scene scene = read_sample(sample);
  EXPECT_EQ(scene.meshes[0]->vertex_count(), 4U);
  EXPECT_EQ(scene.meshes[0]->face_count(), 0U);
  EXPECT_TRUE(scene.meshes[0]->lines.empty());
}

TEST(Gltf, PrimitivesOfTheSameAccessorsShareVertices) {
  GltfSample sample = square_sample({0, 1, 2});
  const std::size_t other = sample.add(std::vector<std::uint16_t>{0, 2, 3}, "SCALAR", 1);
  const std::size_t points = sample.add(std::vector<float>(9, 1), "VEC3", 3);
  sample.json["materials"] = {Json::object(), Json::object()};
  sample.json["meshes"][0]["primitives"] = {
      {{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 1}},
      {{"attributes", {{"POSITION", points}}}},
      {{"attributes", {{"POSITION", 0}}}, {"indices", other}, {"material", 0}},
  };
  const Scene scene = read_sample(sample);
  EXPECT_EQ(scene.meshes[0]->vertex_count(), 7U);
  EXPECT_EQ(scene.meshes[0]->corners, (Indices{0, 1, 2, 4, 5, 6, 0, 2, 3}));
  EXPECT_EQ(scene.meshes[0]->material, (Indices{1, MaterialId::kNone, 0}));
}

TEST(Gltf, AttributesThatSomePrimitivesLack) {
  GltfSample sample = square_sample();
  const std::size_t normals = sample.add(std::vector<float>(12, 1), "VEC3", 3);
  const std::size_t red = sample.add(std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0}, "VEC3", 3);
  const std::size_t clear = sample.add(std::vector<float>(16, 0), "VEC4", 4);
  const std::size_t own = sample.add(std::vector<std::uint16_t>{1, 2, 3, 4}, "SCALAR", 1);
  sample.json["accessors"][red]["normalized"] = true;
  sample.json["meshes"][0]["primitives"] = {
      {{"attributes", {{"POSITION", 0}, {"NORMAL", normals}, {"COLOR_0", red}}}},
      {{"attributes", {{"POSITION", 0}, {"COLOR_0", clear}, {"_OWN", own}}}},
      {{"attributes", {{"POSITION", 0}}}},
  };
  for (Json& primitive : sample.json["meshes"][0]["primitives"]) primitive["mode"] = 0;
  const Scene scene = read_sample(sample);
  const Mesh& mesh = *scene.meshes[0];
  EXPECT_EQ(mesh.vertex_count(), 12U);
  const Array<float>& normal = *mesh.find("NORMAL")->get<float>();
  EXPECT_EQ(normal[11], 1);
  EXPECT_EQ(Array<float>(normal.begin() + 12, normal.end()), Array<float>(24, 0.0F)) << "length 0: none";
  const Array<float>& color = *mesh.find("COLOR_0")->get<float>();
  EXPECT_EQ(Array<float>(color.begin(), color.begin() + 4), (Array<float>{1, 0, 0, 1}));
  EXPECT_EQ(Array<float>(color.begin() + 16, color.begin() + 20), (Array<float>{0, 0, 0, 0}));
  EXPECT_EQ(Array<float>(color.begin() + 32, color.end()), Array<float>(16, 1.0F));
  EXPECT_EQ(*mesh.find("_OWN")->get<std::uint32_t>(), (Indices{0, 0, 0, 0, 1, 2, 3, 4, 0, 0, 0, 0}));
}

TEST(Gltf, TextFilesAndDataUris) {
  const GltfSample sample = full_sample();
  const std::string text = as_text(sample);
  const auto scene = std::get<Scene>(read_model(as_bytes(text), "sample.gltf"));
  EXPECT_EQ(scene.meshes[0]->positions, read_sample(sample).meshes[0]->positions);
  EXPECT_NE(scene.textures[0].image, nullptr);
  const std::string marked = "\xEF\xBB\xBF \n" + text;
  EXPECT_EQ(std::get<Scene>(read_model(as_bytes(marked), "unnamed")).nodes.size(), 4U);
}

TEST(Gltf, WhichScene) {
  GltfSample sample = full_sample();
  sample.json.erase("scene");
  EXPECT_EQ(read_sample(sample).roots, std::vector{NodeId(1)}) << "the first";
  sample.json.erase("scenes");
  EXPECT_EQ(read_sample(sample).roots, (std::vector{NodeId(0), NodeId(1)})) << "all without parents";
  sample.json["scenes"] = {Json::object()};
  EXPECT_TRUE(read_sample(sample).roots.empty());
}

TEST(Gltf, InstancesBecomeNodes) {
  GltfSample sample = square_sample();
  const std::size_t moves = sample.add(std::vector<float>{1, 2, 3, 4, 5, 6}, "VEC3", 3);
  const std::size_t sizes = sample.add(std::vector<float>{2, 2, 2, 3, 3, 3}, "VEC3", 3);
  sample.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  sample.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", moves},
                                                                                    {"SCALE", sizes}};
  const Scene scene = read_sample(sample);
  ASSERT_EQ(scene.nodes.size(), 3U);
  EXPECT_FALSE(scene.nodes[0].mesh);
  EXPECT_EQ(scene.nodes[0].children, (std::vector{NodeId(1), NodeId(2)}));
  EXPECT_EQ(scene.nodes[2].mesh, MeshId(0));
  EXPECT_EQ(std::get<Placement>(scene.nodes[2].placement).translation, glm::vec3(4, 5, 6));
  EXPECT_EQ(std::get<Placement>(scene.nodes[2].placement).scale, glm::vec3(3, 3, 3));
}

TEST(Gltf, HiddenNodesAndMatrices) {
  GltfSample sample = empty_sample();
  sample.json["nodes"] = Json::parse(R"([{"extensions": {"KHR_node_visibility": {"visible": false}}},
      {"matrix": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]}, {"rotation": [0, 0, 0, 2]}])");
  const Scene scene = read_sample(sample);
  EXPECT_FALSE(scene.nodes[0].visible);
  EXPECT_TRUE(scene.nodes[1].visible);
  const auto& matrix = std::get<glm::mat4>(scene.nodes[1].placement);
  EXPECT_EQ(matrix[3], glm::vec4(13, 14, 15, 16)) << "by columns";
  EXPECT_EQ(std::get<Placement>(scene.nodes[2].placement).rotation, glm::quat(1, 0, 0, 0)) << "of unit length";
}

TEST(Gltf, OrthographicCamerasAndLights) {
  GltfSample sample = empty_sample();
  sample.json["cameras"] =
      Json::parse(R"([{"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 2, "znear": 0, "zfar": 9}}])");
  sample.json["extensions"] = Json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "directional"},
      {"type": "point", "range": 5, "color": [1, 0, 0]}]}})");
  const Scene scene = read_sample(sample);
  EXPECT_FALSE(scene.cameras[0].perspective);
  EXPECT_EQ(scene.cameras[0].height, 4);
  EXPECT_EQ(scene.cameras[0].aspect, 2);
  EXPECT_EQ(scene.cameras[0].far, 9);
  EXPECT_EQ(scene.lights[0].kind, LightKind::Directional);
  EXPECT_EQ(scene.lights[1].range, 5);
  EXPECT_EQ(scene.lights[1].color, glm::vec3(1, 0, 0));
}

TEST(Gltf, AHundredThousandDeep) {
  constexpr int kDepth = 100000;
  GltfSample sample = empty_sample();
  for (int n = 0; n < kDepth; ++n) {
    sample.json["nodes"].push_back(n + 1 < kDepth ? Json{{"children", {n + 1}}} : Json::object());
  }
  const Scene scene = read_sample(sample);
  EXPECT_EQ(scene.roots, std::vector{NodeId(0)});
  EXPECT_EQ(walk(scene).size(), static_cast<std::size_t>(kDepth));
  EXPECT_EQ(std::get<Scene>(read_model(encode_model(scene, "glb"), "again.glb")).nodes.size(),
            static_cast<std::size_t>(kDepth));
}

const ModelReadOptions kOutside = [] {
  ModelReadOptions options;
  options.outside = true;
  return options;
}();

/// A folder of its own, gone at the end.
class GltfFolder : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_ / "models"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void save(const std::string& name, std::span<const std::byte> bytes) const {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  Scene read(const Json& json, const ModelReadOptions& options = {}, const azulejo::Run& run = {}) const {
    const std::string text = json.dump();
    save("models/model.gltf", as_bytes(text));
    return std::get<Scene>(read_model((folder_ / "models/model.gltf").string(), options, run));
  }
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("azulejo_gltf_" + std::to_string(getpid()));
};

TEST_F(GltfFolder, BuffersAndImagesBeside) {
  GltfSample sample = full_sample();
  const std::vector<std::byte> png =
      encode_image(random_image({3, 2, 4, PixelType::U16, ColorState::Srgb, AlphaState::Straight}, 1), "png");
  save("models/a b.bin", sample.binary);
  save("models/a.png", png);
  save("b.png", png);
  sample.json["buffers"][0]["uri"] = "a%20b.bin";
  sample.json["images"] = Json::parse(R"([{"uri": "a.png"}, {"uri": "none.png"}, {"uri": "../b.png"}])");
  sample.json["textures"] = Json::parse(R"([{"source": 0}, {"source": 1}, {"source": 2}, {"source": 0}, {}])");
  Warnings warnings;
  const Scene scene = read(sample.json, {}, warnings.run());
  EXPECT_EQ(warnings.lines.size(), 3U) << "one missing, one outside, one without source";
  ASSERT_NE(scene.textures[0].image, nullptr);
  EXPECT_EQ(scene.textures[0].image->type(), PixelType::U8) << "16 bits become 8";
  EXPECT_EQ(scene.textures[0].image->channels(), 4);
  EXPECT_EQ(scene.textures[0].source, "a.png");
  EXPECT_EQ(scene.textures[3].image, scene.textures[0].image) << "shared";
  EXPECT_EQ(scene.textures[1].image, nullptr);
  EXPECT_EQ(scene.textures[1].source, "none.png");
  EXPECT_EQ(scene.textures[2].image, nullptr);
  EXPECT_EQ(scene.meshes[0]->vertex_count(), 4U);
  EXPECT_NE(read(sample.json, kOutside).textures[2].image, nullptr);
  ModelReadOptions names_only;
  names_only.textures = false;
  const Scene bare = read(sample.json, names_only, warnings.run());
  EXPECT_EQ(bare.textures[0].image, nullptr);
  EXPECT_EQ(bare.textures[0].source, "a.png");
}

TEST_F(GltfFolder, ADamagedImageIsAWarning) {
  GltfSample sample = full_sample();
  save("models/a.bin", sample.binary);
  save("models/a.png", as_bytes("no image"));
  sample.json["buffers"][0]["uri"] = "a.bin";
  sample.json["images"][0] = {{"uri", "a.png"}};
  Warnings warnings;
  EXPECT_EQ(read(sample.json, {}, warnings.run()).textures[0].image, nullptr);
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST_F(GltfFolder, MissingAndOutsideBuffersAreRefused) {
  GltfSample sample = full_sample();
  sample.json["buffers"][0]["uri"] = "none.bin";
  EXPECT_EQ(kind_of_error([&] { read(sample.json); }), Error::Data);
  save("outside.bin", sample.binary);
  sample.json["buffers"][0]["uri"] = "../outside.bin";
  EXPECT_EQ(kind_of_error([&] { read(sample.json); }), Error::Data);
  EXPECT_EQ(read(sample.json, kOutside).meshes.size(), 1U);
  save("models/short.bin", std::span(sample.binary).first(sample.binary.size() - 1));
  sample.json["buffers"][0]["uri"] = "short.bin";
  EXPECT_EQ(kind_of_error([&] { read(sample.json); }), Error::Data);
}

}  // namespace
}  // namespace azulejo
