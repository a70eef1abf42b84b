// What is written, read again.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <fmt/format.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

Scene again(const Scene& scene) {
  Warnings warnings;
  const auto bytes = encode_model(scene, "obj", {}, warnings.run());
  return std::get<Scene>(read_model(bytes, "again.obj", {}, warnings.run()));
}

std::string text_of(const Scene& scene, const azulejo::Run& run = {}) {
  const auto bytes = encode_model(scene, "obj", {}, run);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class T>
std::vector<T> values(const Array<T>& array) {
  return {array.begin(), array.end()};
}

void expect_near(const Attribute* a, const Attribute* b, float tolerance) {
  ASSERT_TRUE(a != nullptr && b != nullptr);
  EXPECT_EQ(a->domain, b->domain) << a->name;
  const auto& x = *a->get<float>();
  const auto& y = *b->get<float>();
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], y[i], tolerance) << a->name << " " << i;
}

/// A mesh whose vertices are all used, with random polygons and attributes of corners or vertices.
Mesh random_mesh(unsigned seed, Domain domain, bool triangles) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() % 100'000) / 100'000.0F; };
  Mesh mesh;
  mesh.name = "random";
  const std::uint32_t count = 200;
  for (std::uint32_t v = 0; v < count; ++v) mesh.positions.emplace_back(unit() * 1e4F, -unit() * 1e-4F, unit());
  if (!triangles) mesh.face_offsets.push_back(0);
  for (std::uint32_t f = 0; f < count; ++f) {
    const std::uint32_t size = triangles ? 3 : 3 + f % 4;
    for (std::uint32_t c = 0; c < size; ++c) mesh.corners.push_back((f + c * 7) % count);
    if (!triangles) mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.material.push_back(f % 50 == 7 ? MaterialId::kNone : f / 20 % 3);
  }
  const std::size_t elements = mesh.size_of(domain);
  Array<float> uv;
  Array<float> normal;
  for (std::size_t i = 0; i < elements; ++i) {
    for (int c = 0; c < 2; ++c) uv.push_back(unit());
    const glm::vec3 n = glm::normalize(glm::vec3(unit() - 0.5F, unit() - 0.5F, 0.1F + unit()));
    for (int c = 0; c < 3; ++c) normal.push_back(n[c]);
  }
  mesh.attributes.push_back({"NORMAL", domain, 3, std::move(normal)});
  mesh.attributes.push_back({"TEXCOORD_0", domain, 2, std::move(uv)});
  Array<float> color;
  for (std::uint32_t i = 0; i < 3 * count; ++i) color.push_back(unit());
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 3, std::move(color)});
  Array<std::uint32_t> groups;
  for (std::uint32_t f = 0; f < count; ++f) groups.push_back(f / 30 % 3);
  mesh.attributes.push_back({"SMOOTHING_GROUP", Domain::Face, 1, std::move(groups)});
  return mesh;
}

Scene scene_with(Mesh mesh) {
  const Array<std::uint32_t> material = mesh.material;
  Scene scene = scene_of(mesh.clone());
  for (const char* name : {"red", "green", "blue"}) scene.materials.emplace_back().name = name;
  mesh.material = material;
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  return scene;
}

TEST(ObjWrite, RoundTrip) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const Domain domain : {Domain::Vertex, Domain::Corner}) {
      for (const bool triangles : {true, false}) {
        SCOPED_TRACE(fmt::format("seed {}, {}, triangles {}", seed, to_string(domain), triangles));
        const Scene scene = scene_with(random_mesh(seed, domain, triangles));
        const Mesh& a = *scene.meshes[0];
        const Scene result = again(scene);
        ASSERT_EQ(result.meshes.size(), 1U);
        const Mesh& b = *result.meshes[0];
        EXPECT_EQ(b.name, "random");
        EXPECT_EQ(values(a.positions), values(b.positions)) << "exactly";
        EXPECT_EQ(values(a.corners), values(b.corners));
        EXPECT_EQ(values(a.face_offsets), values(b.face_offsets));
        // Materials are numbered by their first use.
        ASSERT_EQ(a.material.size(), b.material.size());
        for (std::size_t f = 0; f < a.material.size(); ++f) {
          const auto name = [&](const Scene& s, std::uint32_t m) {
            return m == MaterialId::kNone ? std::string("none") : s.materials[m].name;
          };
          ASSERT_EQ(name(scene, a.material[f]), name(result, b.material[f]));
        }
        expect_near(a.find("NORMAL"), b.find("NORMAL"), 1.2e-7F);        // rounded once, if it wasn't quite 1 long
        expect_near(a.find("TEXCOORD_0"), b.find("TEXCOORD_0"), 6e-8F);  // 1 − v, twice: half of 2^-24 each
        expect_near(a.find("COLOR_0"), b.find("COLOR_0"), 3e-6F);        // the curve and its inverse
        EXPECT_EQ(a.find("SMOOTHING_GROUP")->values, b.find("SMOOTHING_GROUP")->values);
      }
    }
  }
}

TEST(ObjWrite, CornersShareEqualValues) {
  const Scene scene = std::get<Scene>(read_model(
      as_bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"),
      "a.obj"));
  EXPECT_EQ(text_of(scene),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n");
}

TEST(ObjWrite, NodesAreWrittenInTheWorld) {
  Scene scene = std::get<Scene>(
      read_model(as_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.6 0.8\nf 1//1 2//1 3//1\nl 1 2\n"), "a.obj"));
  scene.nodes[0].name = "at home";
  scene.nodes[0].children = {NodeId(1), NodeId(2)};
  scene.nodes.resize(3);
  scene.nodes[1].mesh = MeshId(0);
  scene.nodes[1].placement = glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(5, 0, 0)), glm::vec3(-1, 2, 1));
  scene.nodes[2].mesh = MeshId(0);
  scene.nodes[2].visible = false;
  const Scene result = again(scene);
  ASSERT_EQ(result.meshes.size(), 2U) << "what can't be seen isn't there";
  EXPECT_EQ(result.meshes[0]->name, "at_home");
  EXPECT_EQ(result.meshes[1]->name, "mesh1");
  EXPECT_EQ(values(result.meshes[1]->positions), (std::vector<glm::vec3>{{5, 0, 0}, {4, 0, 0}, {5, 2, 0}}));
  EXPECT_EQ(values(result.meshes[1]->corners), (std::vector<std::uint32_t>{2, 1, 0})) << "mirrored";
  EXPECT_EQ(values(result.meshes[1]->lines), (std::vector<std::uint32_t>{0, 1}));
  const auto& normal = *result.meshes[1]->find("NORMAL")->get<float>();
  // (0, 0.6, 0.8) by the inverse transpose: (0, 0.3, 0.8), of length √0.73.
  EXPECT_NEAR(normal[1], 0.3 / std::sqrt(0.73), 1e-6);
  EXPECT_NEAR(normal[2], 0.8 / std::sqrt(0.73), 1e-6);
}

TEST(ObjWrite, ThreadsDoNotMatter) {
  Mesh mesh;
  std::mt19937 random(5);
  for (int i = 0; i < 100'000; ++i) mesh.positions.emplace_back(std::ldexp(static_cast<float>(random()), -20), i, 0);
  for (std::uint32_t i = 0; i < 300'000; ++i) mesh.corners.push_back(static_cast<std::uint32_t>(random() % 100'000));
  Array<float> uv;
  for (int i = 0; i < 600'000; ++i) uv.push_back(static_cast<float>(random() % 100) / 128.0F);
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Corner, 2, std::move(uv)});
  const Scene scene = scene_of(std::move(mesh));
  azulejo::Run run;
  run.threads = 1;
  const std::string one = text_of(scene, run);
  run.threads = 7;
  EXPECT_EQ(one, text_of(scene, run));
  const Scene result = again(scene);
  EXPECT_EQ(values(result.meshes[0]->positions), values(scene.meshes[0]->positions));
  EXPECT_EQ(result.meshes[0]->find("TEXCOORD_0")->values, scene.meshes[0]->find("TEXCOORD_0")->values)
      << "in steps of 1/128 turning v is exact";
}

TEST(ObjWrite, CloudsAndColorsOfBytes) {
  Mesh mesh;
  mesh.positions = {{1, 2, 3}, {NAN, INFINITY, -INFINITY}};
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 4, Array<std::uint8_t>{255, 0, 51, 9, 0, 0, 0, 0}});
  Warnings warnings;
  EXPECT_EQ(text_of(scene_of(mesh.clone()), warnings.run()), "v 1 2 3 1 0 0.2\nv nan inf -inf 0 0 0\n");
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_NE(warnings.lines[0].find("COLOR_0"), std::string::npos) << "its opacity";
  Scene two = scene_of(std::move(mesh));
  two.nodes.emplace_back().mesh = MeshId(0);
  two.roots.emplace_back(1);
  EXPECT_EQ(again(two).meshes.size(), 2U);
}

class ObjWriteFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("azulejo_obj_write_{}", static_cast<void*>(this));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

TEST_F(ObjWriteFiles, MaterialsAndTextures) {
  Scene scene = scene_of(random_mesh(4, Domain::Corner, true));
  auto image =
      std::make_shared<const Image>(random_image({5, 3, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, 1));
  scene.textures.resize(3);
  scene.textures[0].image = image;
  scene.textures[0].name = "bark / one";
  scene.textures[1].image = image;
  scene.textures[1].wrap_u = scene.textures[1].wrap_v = TextureWrap::Clamp;
  scene.textures[2].image =
      std::make_shared<const Image>(random_image({2, 2, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}, 2));
  scene.textures[2].source = "folder/norm.jpg";
  Material phong;
  phong.name = "a b";
  phong.model = MaterialModel::Phong;
  phong.base_color = {0.2F, 0.4F, 0.6F, 0.5F};
  phong.ambient = {0.5F, 1, 0};
  phong.specular = {0.1F, 0.2F, 0.3F};
  phong.shininess = 77.5F;
  phong.emissive = {2, 0, 0.25F};
  phong.alpha_mode = AlphaMode::Blend;
  phong.base_color_texture.texture = TextureId(0);
  phong.base_color_texture.scale = {2, 4};
  phong.base_color_texture.offset = {0.5F, 0.25F};
  phong.extensions = Json::object().set("map_Bump", "-bm 2 x.png");
  Material metal;
  metal.name = "a_b";
  metal.metallic = 0.75F;
  metal.roughness = 0.125F;
  metal.base_color_texture.texture = TextureId(1);
  metal.normal_texture.texture = TextureId(2);
  metal.metallic_roughness_texture.texture = TextureId(2);
  Material unlit;
  unlit.model = MaterialModel::Unlit;
  scene.materials = {phong, metal, unlit};
  Mesh mesh = scene.meshes[0]->clone();
  mesh.material.assign(mesh.face_count(), 0U);
  mesh.material.back() = 2;
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));

  Warnings warnings;
  write_model(scene, path("it is.obj"), {}, warnings.run());
  EXPECT_TRUE(fs::exists(path("it is_bark___one.png")));
  const Scene result = std::get<Scene>(read_model(path("it is.obj"), {}, warnings.run()));
  EXPECT_TRUE(warnings.lines.empty()) << warnings.lines.front();
  ASSERT_EQ(result.materials.size(), 3U);
  const Material& a = result.materials[0];
  EXPECT_EQ(a.name, "a_b");
  EXPECT_EQ(a.model, MaterialModel::Phong);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(a.base_color[c], phong.base_color[c], 2e-6);
    EXPECT_NEAR(a.ambient[c], phong.ambient[c], 1e-5);
    EXPECT_NEAR(a.specular[c], phong.specular[c], 2e-6);
    EXPECT_NEAR(a.emissive[c], phong.emissive[c], 2e-6);
  }
  EXPECT_EQ(a.base_color.w, 0.5F);
  EXPECT_EQ(a.shininess, 77.5F);
  EXPECT_EQ(a.alpha_mode, AlphaMode::Blend);
  EXPECT_EQ(a.base_color_texture.scale, phong.base_color_texture.scale);
  EXPECT_EQ(a.base_color_texture.offset, phong.base_color_texture.offset);
  EXPECT_EQ(a.extensions["map_Bump"].text(), "-bm 2 x.png");
  EXPECT_TRUE(same_pixels(*result.textures[a.base_color_texture.texture.index].image, *image));
  const Material& b = result.materials[1];
  EXPECT_EQ(b.name, "a_b_2");
  EXPECT_EQ(b.model, MaterialModel::MetalRough);
  EXPECT_EQ(b.metallic, 0.75F);
  EXPECT_EQ(b.roughness, 0.125F);
  EXPECT_EQ(b.alpha_mode, AlphaMode::Opaque) << "its picture is written without opacity";
  const Texture& base = result.textures[b.base_color_texture.texture.index];
  EXPECT_EQ(base.image->channels(), 3);
  EXPECT_EQ(base.wrap_u, TextureWrap::Clamp);
  const TextureId normal = b.normal_texture.texture;
  EXPECT_EQ(normal, b.metallic_roughness_texture.texture);
  EXPECT_EQ(result.textures[normal.index].source, "it is_norm.png");
  EXPECT_EQ(result.materials[2].name, "material2");
  EXPECT_EQ(result.materials[2].model, MaterialModel::Unlit);
  EXPECT_EQ(values(result.meshes[0]->material), values(scene.meshes[0]->material));
}

}  // namespace
}  // namespace azulejo
