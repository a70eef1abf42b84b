// What holds for every picture of the z-buffer: no cracks, one picture for any order and number of threads, counts.

#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

float between(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

glm::quat turned(std::mt19937& random) {
  return glm::normalize(
      glm::quat(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)));
}

Scene sphere_scene(std::mt19937& random, std::uint32_t rings, const Material& material) {
  Scene scene = scene_with(sphere_mesh(rings), material);
  scene.nodes[0].placement = Placement{{0, 0, 0}, turned(random), {1, 1, 1}};
  return scene;
}

/// Red where a crack shows what is behind a white surface.
ZBufferOptions over_red(int antialias) {
  return {.antialias = antialias, .background = {1, 0, 0, 1}, .output = FrameOutput::Linear};
}

/// Pixels whose rays, whole squares of them, pass the origin at less than `radius`.
bool within(const View& view, double radius, int x, int y) {
  const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(view.clip_from_view) * glm::dmat4(view.view_from_world));
  for (int corner = 0; corner < 4; ++corner) {
    const double u = 2 * (x + corner % 2) / (1.0 * view.width) - 1;
    const double v = 1 - 2 * (y + corner / 2) / (1.0 * view.height);
    const glm::dvec4 a = world_from_clip * glm::dvec4(u, v, 1, 1);
    const glm::dvec4 b = world_from_clip * glm::dvec4(u, v, 0.5, 1);
    const glm::dvec3 from = glm::dvec3(a) / a.w;
    const glm::dvec3 way = glm::normalize(glm::dvec3(b) / b.w - from);
    if (glm::length(glm::cross(from, way)) > radius) return false;
  }
  return true;
}

TEST(ZBufferLaws, ASphereHasNoCracksFromOutside) {
  std::mt19937 random(1);
  for (int round = 0; round < 12; ++round) {
    const std::uint32_t rings = 5 + static_cast<std::uint32_t>(random() % (round % 2 == 0 ? 8 : 90));
    const Scene scene = sphere_scene(random, rings, unlit({1, 1, 1, 1}, round % 3 == 0));
    TestView wanted{.eye = {between(random, -1, 1), between(random, -2, 2), 3}, .width = 90, .height = 70};
    wanted.lens.perspective = round % 4 != 3;
    wanted.lens.height = 2.5;
    const View view = view_of(wanted);
    const Frame frame = ZBufferRenderer(scene, over_red(round % 2 == 0 ? 4 : 1)).draw(view, {});
    // The faces lie inside the unit sphere, no deeper than the cosine of half the angle across a quad.
    const double radius = std::cos(1.5 * 3.1416 / rings / std::sqrt(2.0));
    int inside = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        if (!within(view, radius, x, y)) continue;
        ++inside;
        ASSERT_EQ(pixel_at(frame, "color", x, y), glm::dvec4(1)) << "round " << round << " at " << x << ", " << y;
      }
    }
    EXPECT_GT(inside, 300);
  }
}

/// From inside, with triangles all around the camera; half transparent ones, so that a sample drawn twice shows too.
TEST(ZBufferLaws, ASphereIsDrawnOnceFromInside) {
  std::mt19937 random(2);
  for (int round = 0; round < 12; ++round) {
    const std::uint32_t rings = 4 + static_cast<std::uint32_t>(random() % 30);
    Material material = unlit({1, 1, 1, 0.5F});
    if (round % 2 == 0) material.alpha_mode = AlphaMode::Blend;
    const Scene scene = sphere_scene(random, rings, material);
    // Near the wall some triangles pass just beside the camera.
    TestView wanted{.eye = {0, 0, round % 3 == 0 ? 0 : between(random, 0.3F, 0.7F)}, .width = 90, .height = 70};
    wanted.center = glm::dvec3(between(random, -3, 3), between(random, -3, 3), between(random, -3, 3));
    wanted.lens.near = 1e-3;
    wanted.lens.fov_y = 1.8;
    const View view = view_of(wanted);
    ZBufferOptions options = over_red(round % 4 < 2 ? 4 : 1);
    const Frame frame = ZBufferRenderer(scene, options).draw(view, {});
    const glm::dvec4 color = round % 2 == 0 ? glm::dvec4(1, 0.5, 0.5, 1) : glm::dvec4(1);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        ASSERT_EQ(pixel_at(frame, "color", x, y), color) << "round " << round << " at " << x << ", " << y;
      }
    }
  }
}

/// Opaque and transparent triangles through each other, lit.
Scene crossing_triangles(const std::vector<std::size_t>& order, std::mt19937 random) {
  std::vector<glm::vec3> corners;
  std::vector<std::uint32_t> materials;
  for (std::size_t t = 0; t < order.size(); ++t) {
    const glm::vec3 middle(between(random, -1, 1), between(random, -1, 1), between(random, -1, 3.5F));
    for (int k = 0; k < 3; ++k) {
      corners.push_back(middle + glm::vec3(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)));
    }
    materials.push_back(static_cast<std::uint32_t>(random() % 4));
  }
  Mesh mesh;
  mesh.positions.assign(corners.begin(), corners.end());
  for (const std::size_t t : order) {
    for (std::size_t k = 0; k < 3; ++k) mesh.corners.push_back(static_cast<std::uint32_t>(3 * t + k));
    mesh.material.push_back(materials[t]);
  }
  Scene scene = scene_with(Mesh(), unlit({0.9F, 0.4F, 0.2F, 1}));
  Material lit;
  lit.base_color = {0.3F, 0.8F, 0.5F, 1};
  scene.materials.push_back(lit);
  lit.model = MaterialModel::Phong;
  lit.double_sided = true;
  lit.specular = {0.5F, 0.5F, 0.5F};
  scene.materials.push_back(lit);
  lit.alpha_mode = AlphaMode::Blend;
  lit.base_color = {0.2F, 0.3F, 0.9F, 0.4F};
  scene.materials.push_back(lit);
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  return scene;
}

Lighting some_light() {
  Lighting lighting;
  lighting.lights = {ShadingLight{.direction = glm::normalize(glm::vec3(0.3F, -0.5F, -1))}};
  lighting.sky = {0.2F, 0.2F, 0.3F};
  lighting.ground = {0.1F, 0.1F, 0.1F};
  return lighting;
}

TEST(ZBufferLaws, TheOrderOfTrianglesAndTheThreadsDontMatter) {
  std::vector<std::size_t> order(300);
  std::iota(order.begin(), order.end(), 0);
  const View view = view_of({.width = 150, .height = 130});
  const Lighting lighting = some_light();
  for (const int antialias : {1, 4}) {
    const ZBufferOptions options{.antialias = antialias, .output = FrameOutput::Linear};
    std::iota(order.begin(), order.end(), 0);
    const Frame first = ZBufferRenderer(crossing_triangles(order, std::mt19937(3)), options).draw(view, lighting);
    std::mt19937 random(4);
    for (const int threads : {1, 2, 7}) {
      std::shuffle(order.begin(), order.end(), random);
      azulejo::Run run;
      run.threads = threads;
      const Scene shuffled = crossing_triangles(order, std::mt19937(3));
      const Frame frame = ZBufferRenderer(shuffled, options, run).draw(view, lighting, run);
      EXPECT_TRUE(same_pixels(first, frame)) << antialias << " samples, " << threads << " threads";
    }
  }
}

/// Of two at one depth the earlier is seen, whatever thread draws them and wherever chunks end.
TEST(ZBufferLaws, OfTrianglesAtOneDepthTheFirstIsSeen) {
  // Two squares of many triangles each, in one plane.
  Mesh mesh;
  constexpr std::uint32_t kSide = 100;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      mesh.positions.emplace_back(static_cast<float>(x) * 0.02F - 1, static_cast<float>(y) * 0.02F - 1, 0.0F);
    }
  }
  for (std::uint32_t copy = 0; copy < 2; ++copy) {
    for (std::uint32_t y = 0; y < kSide; ++y) {
      for (std::uint32_t x = 0; x < kSide; ++x) {
        const std::uint32_t at = y * (kSide + 1) + x;
        for (const std::uint32_t corner : {at, at + 1, at + kSide + 2, at, at + kSide + 2, at + kSide + 1}) {
          mesh.corners.push_back(corner);
        }
        mesh.material.insert(mesh.material.end(), 2, copy);
      }
    }
  }
  Scene scene = scene_with(Mesh(), unlit({0, 1, 0, 1}));
  scene.materials.push_back(unlit({1, 0, 0, 1}));
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  const View view = view_of({});
  for (const int threads : {1, 7}) {
    azulejo::Run run;
    run.threads = threads;
    const ZBufferOptions options{.antialias = 4, .output = FrameOutput::Linear, .layers = {"color", "material_id"}};
    const Frame frame = ZBufferRenderer(scene, options).draw(view, {}, run);
    int seen = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        ASSERT_EQ(pixel_at(frame, "color", x, y).x, 0) << x << ", " << y;
        seen += pixel_at(frame, "material_id", x, y).x == 1 ? 1 : 0;
      }
    }
    EXPECT_GT(seen, 1000);
  }
}

/// Samples that see something, of a picture with 1 sample a pixel.
int covered(const Scene& scene, const View& view) {
  const Frame frame = ZBufferRenderer(scene, {.antialias = 1, .output = FrameOutput::Linear}).draw(view, {});
  int count = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) count += pixel_at(frame, "color", x, y).w > 0 ? 1 : 0;
  }
  return count;
}

/// Small triangles, ones as large as the picture, and clipped ones: each way to the tiles has its own test for the side.
TEST(ZBufferLaws, OneSidedSurfacesAreSeenFromTheFrontOnly) {
  for (const bool mixed : {false, true}) {
    for (const float size : {0.02F, 1.0F, 90.0F, 1e6F}) {
      for (const bool mirrored : {false, true}) {
        for (const bool behind : {false, true}) {
          Mesh mesh =
              soup_of({{-size, -size, 0}, {size, -size, 0}, {0, size, 0}, {9, 9, 9}, {9, 9.1F, 9}, {9.1F, 9, 9}});
          mesh.material = {0, mixed ? 1U : 0U};
          Scene scene = scene_with(Mesh(), unlit({1, 1, 1, 1}, false));
          scene.materials.push_back(unlit({1, 1, 1, 1}, true));
          scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
          scene.nodes[0].placement = Placement{{0, 0, 0}, {1, 0, 0, 0}, {mirrored ? -1.0F : 1.0F, 1, 1}};
          const int seen = covered(scene, view_of({.eye = {0, 0, behind ? -4 : 4}, .width = 300, .height = 200}));
          EXPECT_EQ(seen > 0, !behind) << size << " mirrored " << mirrored << " mixed " << mixed << " " << seen;
        }
      }
    }
  }
}

TEST(ZBufferLaws, TwoSidedSurfacesAreSeenFromBothSides) {
  std::mt19937 random(5);
  TestView inside{.eye = {0, 0, 0.5}};
  for (const bool mirrored : {false, true}) {
    for (const bool double_sided : {false, true}) {
      Scene scene = scene_with(sphere_mesh(12), unlit({1, 1, 1, 1}, double_sided));
      scene.nodes[0].placement = Placement{{0, 0, 0}, turned(random), {mirrored ? -1.0F : 1.0F, 1, 1}};
      EXPECT_EQ(covered(scene, view_of(inside)), double_sided ? 96 * 80 : 0);
      EXPECT_GT(covered(scene, view_of({})), 1000);
    }
  }
}

std::uint64_t sum_of(const ZBufferStatistics& s) {
  return s.faces_outside + s.faces_culled + s.faces_empty + s.faces_drawn;
}

TEST(ZBufferLaws, EveryFaceIsCountedOnce) {
  for (unsigned seed = 40; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::vector<glm::vec3> corners;
    const float size = seed % 2 == 0 ? 0.3F : 8;
    for (int t = 0; t < 500; ++t) {
      const glm::vec3 middle(between(random, -4, 4), between(random, -4, 4), between(random, -4, 4));
      for (int k = 0; k < 3; ++k) {
        corners.push_back(middle +
                          size * glm::vec3(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)));
      }
      if (random() % 16 == 0) corners.back() = corners[corners.size() - 2];
      if (random() % 16 == 0) corners.back().y = std::numeric_limits<float>::quiet_NaN();
    }
    Mesh mesh = soup_of(corners);
    mesh.lines = {0, 1, 3, 3, 4, 900};
    mesh.material.resize(500);
    for (std::uint32_t& material : mesh.material) material = seed % 3 == 0 ? random() % 2 : 0;
    Scene scene = scene_with(Mesh(), unlit({1, 1, 1, 1}, false));
    scene.materials.push_back(unlit({1, 1, 1, 1}, true));
    scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
    ZBufferStatistics statistics;
    const View view = view_of({.eye = {0, 0, 3}});
    ZBufferRenderer(scene, {.antialias = seed % 4 < 2 ? 1 : 4}).draw(view, {}, {}, &statistics);
    EXPECT_EQ(statistics.faces_in, 503U);
    EXPECT_EQ(sum_of(statistics), statistics.faces_in) << "seed " << seed;
    EXPECT_GT(statistics.faces_empty, 20U) << "seed " << seed;
    EXPECT_GT(statistics.faces_culled, 10U);
    EXPECT_GT(statistics.faces_drawn, 20U);
    EXPECT_GT(statistics.faces_clipped, 5U);
    EXPECT_LE(statistics.faces_clipped, statistics.faces_in);
    EXPECT_LE(statistics.fragments_passed, statistics.fragments_tested);
  }
}

TEST(ZBufferLaws, FragmentsAreCountedBySample) {
  const View view = view_of({});
  constexpr std::uint64_t kPixels = 96 * 80;
  const auto counts = [&](std::vector<float> depths, int antialias, AlphaMode mode) {
    std::vector<glm::vec3> corners;
    for (const float z : depths) corners.insert(corners.end(), {{-90, -90, z}, {90, -90, z}, {0, 90, z}});
    Material material = unlit({1, 1, 1, 0.7F});
    material.alpha_mode = mode;
    ZBufferStatistics statistics;
    ZBufferRenderer(scene_with(soup_of(corners), material), {.antialias = antialias}).draw(view, {}, {}, &statistics);
    EXPECT_EQ(statistics.faces_drawn, depths.size());
    return std::array{statistics.fragments_tested, statistics.fragments_passed, statistics.fragments_shaded};
  };
  for (const std::uint64_t n : {1U, 4U}) {
    const int antialias = static_cast<int>(n);
    EXPECT_EQ(counts({0}, antialias, AlphaMode::Opaque), (std::array{n * kPixels, n * kPixels, kPixels}));
    EXPECT_EQ(counts({1, 0}, antialias, AlphaMode::Opaque), (std::array{2 * n * kPixels, n * kPixels, kPixels}));
    EXPECT_EQ(counts({0, 1}, antialias, AlphaMode::Opaque), (std::array{2 * n * kPixels, 2 * n * kPixels, kPixels}));
    // Where the opacity, 0.7, reaches the cutoff.
    EXPECT_EQ(counts({0}, antialias, AlphaMode::Mask), (std::array{n * kPixels, n * kPixels, kPixels}));
  }
}

}  // namespace
}  // namespace azulejo
