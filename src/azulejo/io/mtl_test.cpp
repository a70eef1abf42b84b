#include "azulejo/io/mtl.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/mtl_images.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

MtlMaterial parsed(const std::string& lines, const azulejo::Run& run = {}) {
  const std::string text = "newmtl a\n" + lines + "\n";
  auto materials = parse_mtl(text, "test.mtl", run);
  EXPECT_EQ(materials.size(), 1U);
  return std::move(materials.at(0));
}

constexpr float kHalf = 0.21404114F;  ///< sRGB 0.5

TEST(Mtl, ColorsAreLinear) {
  const Material material = parsed("Kd 0.5 1 0\nKs 0.5\nKe 3 0 0.5\nNs 96.5\nillum 2").material;
  EXPECT_EQ(material.model, MaterialModel::Phong);
  EXPECT_NEAR(material.base_color.x, kHalf, 1e-6);
  EXPECT_NEAR(material.base_color.y, 1, 1e-6);
  EXPECT_EQ(material.base_color.z, 0);
  EXPECT_EQ(material.base_color.w, 1);
  EXPECT_NEAR(material.specular.z, kHalf, 1e-6) << "one number is gray";
  EXPECT_EQ(material.emissive.x, 3) << "above 1 it is light";
  EXPECT_NEAR(material.emissive.z, kHalf, 1e-6);
  EXPECT_EQ(material.shininess, 96.5F);
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.name, "a");
}

TEST(Mtl, AmbientIsAFactor) {
  EXPECT_EQ(parsed("Kd 0.5 0.5 0.5").material.ambient, glm::vec3(1));
  EXPECT_EQ(parsed("Kd 0.5 0.5 0.5\nKa 0 0 0").material.ambient, glm::vec3(0));
  const glm::vec3 same = parsed("Ka 0.3 0.4 0\nKd 0.3 0.4 0").material.ambient;
  EXPECT_NEAR(same.x, 1, 1e-6);
  EXPECT_NEAR(same.y, 1, 1e-6);
  EXPECT_EQ(same.z, 1) << "black stays black";
  EXPECT_NEAR(parsed("Ka 0.5 0 0\nKd 1 1 1").material.ambient.x, kHalf, 1e-6);
}

TEST(Mtl, ModelsFollowFromTheFile) {
  EXPECT_EQ(parsed("illum 0").material.model, MaterialModel::Unlit);
  const Material metal = parsed("Pr 0.25\nPm 1").material;
  EXPECT_EQ(metal.model, MaterialModel::MetalRough);
  EXPECT_EQ(metal.roughness, 0.25F);
  EXPECT_EQ(metal.metallic, 1);
  EXPECT_EQ(parsed("Ks 1 1 1\nillum 1").material.specular, glm::vec3(0)) << "without a highlight";
  EXPECT_EQ(parsed("Ks 1 1 1\nNs 0").material.specular, glm::vec3(0));
}

TEST(Mtl, Opacity) {
  EXPECT_EQ(parsed("d 0.25").material.base_color.w, 0.25F);
  EXPECT_EQ(parsed("d 0.25").material.alpha_mode, AlphaMode::Blend);
  EXPECT_EQ(parsed("d -halo 0.25").material.base_color.w, 0.25F);
  EXPECT_EQ(parsed("Tr 0.25").material.base_color.w, 0.75F);
  EXPECT_EQ(parsed("d 1\nTr 0.25").material.base_color.w, 1);
  EXPECT_EQ(parsed("Tr 1").material.base_color.w, 1) << "nobody means what can't be seen";
  EXPECT_EQ(parsed("Tr 1").material.alpha_mode, AlphaMode::Opaque);
}

TEST(Mtl, MapsHaveOptions) {
  const MtlMap map =
      parsed("map_Kd -blendu on -o 0.25 0.5 -s 2 3 1 -mm 0 1 -bm 2 -clamp on -imfchan m  my picture.png ").base_color;
  EXPECT_EQ(map.file, "my picture.png");
  EXPECT_EQ(map.scale, glm::vec2(2, 3));
  EXPECT_EQ(map.offset, glm::vec2(0.25F, 0.5F));
  EXPECT_TRUE(map.clamp);
  EXPECT_EQ(map.channel, 'm');
  const TextureUse use = texture_use(map, TextureId(3));
  EXPECT_EQ(use.scale, glm::vec2(2, 3));
  EXPECT_EQ(use.offset, glm::vec2(0.25F, 1 - 3 - 0.5F)) << "v counts down";
  EXPECT_EQ(parsed("map_Kd -strange.png").base_color.file, "-strange.png");
  EXPECT_EQ(parsed("map_Kd -s 2 3.png").base_color.file, "3.png");
  EXPECT_EQ(parsed("map_Kd -o 1").base_color.file, "");
  EXPECT_EQ(parsed("MAP_KD a.png").base_color.file, "a.png");
  EXPECT_EQ(parsed("Kd 0 0 0\nmap_Kd a.png").material.base_color, glm::vec4(1)) << "or the map wouldn't be seen";
}

TEST(Mtl, OthersAreKept) {
  Warnings warnings;
  const Json kept = parsed("Ni 1.45\nmap_Bump -bm 0.5 bump.png\nTf 1 1 1", warnings.run()).material.extensions;
  EXPECT_EQ(kept["Ni"].text(), "1.45");
  EXPECT_EQ(kept["map_Bump"].text(), "-bm 0.5 bump.png");
  EXPECT_TRUE(warnings.lines.empty());
  parsed("Kd spectral a.rfl\nNs high", warnings.run());
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_EQ(warnings.lines[0], "test.mtl: line 2: not understood and left out; 2 such lines");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += fmt::format("k{} 1\n", i);
  EXPECT_EQ(parsed(many).material.extensions.size(), 64U);
}

TEST(Mtl, LinesMayEndInAnyWay) {
  const std::string text = "\r\nnewmtl one two\r\nKd 1 0 0\r\n\rnewmtl b # c\rNs 3\n";
  const auto materials = parse_mtl(text, "test.mtl", {});
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[0].material.name, "one two");
  EXPECT_EQ(materials[0].material.base_color, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(materials[1].material.shininess, 3);
}

/// A folder with a square, its materials and small pictures.
class MtlFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("azulejo_mtl_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "model");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) { std::ofstream(folder_ / "model" / name) << text; }
  void picture(const std::string& name, int channels, std::uint8_t last, int width = 2) {
    Image image(width, 2, channels);
    image.set_states(ColorState::Srgb, channels % 2 == 0 ? AlphaState::Straight : AlphaState::None);
    for (int y = 0; y < 2; ++y) {
      for (int i = 0; i < width * channels; ++i)
        image.view<std::uint8_t>().row(y)[i] = i % channels == channels - 1 ? last : 100;
    }
    write_image(image, (folder_ / "model" / name).string());
  }
  Scene read(const std::string& materials, const ModelReadOptions& options = {}) {
    put("a.mtl", materials);
    put("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n");
    warnings_.lines.clear();
    return std::get<Scene>(read_model((folder_ / "model" / "a.obj").string(), options, warnings_.run()));
  }
  const Texture& base(const Scene& scene, std::size_t material = 0) {
    return scene.textures.at(scene.materials.at(material).base_color_texture.texture.index);
  }

  fs::path folder_;
  Warnings warnings_;
};

TEST_F(MtlFiles, ImagesAreShared) {
  picture("p q.png", 3, 50);
  const Scene scene = read("newmtl a\nmap_Kd p q.png\nnewmtl b\nmap_Kd -clamp on .\\p%20q.png\nmap_Ke p q.png\n");
  EXPECT_TRUE(warnings_.lines.empty());
  ASSERT_EQ(scene.textures.size(), 2U);
  EXPECT_NE(base(scene).image, nullptr);
  EXPECT_EQ(base(scene).source, "p q.png");
  EXPECT_EQ(scene.materials[0].base_color_texture.texture, scene.materials[1].emissive_texture.texture);
  EXPECT_EQ(base(scene, 1).wrap_u, TextureWrap::Clamp);
  EXPECT_EQ(scene.materials[1].emissive, glm::vec3(1));
  ModelReadOptions without;
  without.textures = false;
  const Scene names = read("newmtl a\nmap_Kd p q.png\n", without);
  EXPECT_EQ(base(names).image, nullptr);
  EXPECT_EQ(base(names).source, "p q.png");
  EXPECT_TRUE(warnings_.lines.empty());
}

TEST_F(MtlFiles, WhatIsMissingIsSaid) {
  const Scene missing = read("newmtl a\nmap_Kd x.png\nmap_Ks x.png\n");
  EXPECT_EQ(base(missing).image, nullptr);
  ASSERT_EQ(warnings_.lines.size(), 1U);
  EXPECT_NE(warnings_.lines[0].find("'x.png' is missing"), std::string::npos);
  put("bad.png", "not a picture");
  EXPECT_EQ(base(read("newmtl a\nmap_Kd bad.png\n")).image, nullptr);
  EXPECT_EQ(warnings_.lines.size(), 1U);
  put("../secret.png", "secret");
  EXPECT_EQ(base(read("newmtl a\nmap_Kd ../secret.png\n")).image, nullptr);
  ASSERT_EQ(warnings_.lines.size(), 1U);
  EXPECT_NE(warnings_.lines[0].find("outside"), std::string::npos) << warnings_.lines[0];
  picture("near.png", 3, 0);
  EXPECT_NE(base(read("newmtl a\nmap_Kd C:\\pictures\\near.png\n")).image, nullptr) << "found beside the model";
}

TEST_F(MtlFiles, OpacityComesFromPictures) {
  picture("opaque.png", 4, 255);
  picture("mask.png", 4, 0);
  picture("glass.png", 4, 128);
  picture("gray.png", 1, 40);
  picture("color.png", 3, 50);
  picture("wide.png", 1, 40, 3);
  EXPECT_EQ(read("newmtl a\nmap_Kd opaque.png\n").materials[0].alpha_mode, AlphaMode::Opaque);
  EXPECT_EQ(read("newmtl a\nmap_Kd mask.png\n").materials[0].alpha_mode, AlphaMode::Mask);
  EXPECT_EQ(read("newmtl a\nmap_Kd glass.png\nmap_d glass.png\n").materials[0].alpha_mode, AlphaMode::Blend);
  const Scene both = read("newmtl a\nmap_Kd color.png\nmap_d gray.png\nnewmtl b\nmap_Kd color.png\n");
  EXPECT_EQ(both.materials[0].alpha_mode, AlphaMode::Blend);
  EXPECT_EQ(both.materials[1].alpha_mode, AlphaMode::Opaque);
  const auto pixel = base(both).image->view<std::uint8_t>();
  EXPECT_EQ(base(both).image->channels(), 4);
  EXPECT_EQ(std::vector<int>({pixel(1, 1, 0), pixel(1, 1, 2), pixel(1, 1, 3)}), (std::vector<int>{100, 50, 40}));
  EXPECT_EQ(base(both, 1).image->channels(), 3);
  const Scene alone = read("newmtl a\nmap_d gray.png\n");
  EXPECT_EQ(base(alone).image->view<std::uint8_t>()(0, 0, 3), 40);
  EXPECT_EQ(base(alone).image->view<std::uint8_t>()(0, 0, 0), 255);
  EXPECT_TRUE(warnings_.lines.empty());
  EXPECT_EQ(base(read("newmtl a\nmap_Kd color.png\nmap_d wide.png\n")).image->channels(), 3);
  EXPECT_EQ(warnings_.lines.size(), 1U);
}

TEST_F(MtlFiles, MetallicAndRoughnessOfOneFile) {
  picture("mr.png", 3, 50);
  const Scene scene =
      read("newmtl a\nPr 1\nPm 1\nmap_Pr -imfchan g mr.png\nmap_Pm -imfchan b mr.png\nnewmtl b\nmap_Pr mr.png\n");
  EXPECT_TRUE(scene.materials[0].metallic_roughness_texture.texture);
  EXPECT_FALSE(scene.materials[1].metallic_roughness_texture.texture);
  EXPECT_EQ(scene.materials[1].extensions["map_Pr"].text(), "mr.png");
  EXPECT_EQ(warnings_.lines.size(), 1U);
}

}  // namespace
}  // namespace azulejo
