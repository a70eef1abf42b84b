// Transparent surfaces, cut-out ones, and metals.

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

float between(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

ZBufferOptions one_sample() { return {.antialias = 1, .output = FrameOutput::Linear}; }

struct Layers {
  std::vector<glm::vec3> corners;  ///< six a square
  std::vector<std::uint32_t> materials;
};

/// Tilted squares, some of which cross: one opaque in three.
Layers random_layers(std::mt19937& random, std::size_t count) {
  Layers layers;
  for (std::size_t i = 0; i < count; ++i) {
    const auto tilt_x = between(random, -0.4F, 0.4F);
    const auto tilt_y = between(random, -0.4F, 0.4F);
    const auto z = between(random, -2, 1);
    const float half = between(random, 0.4F, 1.4F);
    const auto at = [&](float x, float y) { return glm::vec3(x, y, z + tilt_x * x + tilt_y * y); };
    layers.corners.insert(layers.corners.end(), {at(-half, -half), at(half, -half), at(half, half), at(-half, -half),
                                                 at(half, half), at(-half, half)});
    layers.materials.push_back(static_cast<std::uint32_t>(i % 6));
  }
  return layers;
}

Scene scene_of_layers(const Layers& layers, const std::vector<std::size_t>& order) {
  Mesh mesh;
  mesh.positions.assign(layers.corners.begin(), layers.corners.end());
  for (const std::size_t i : order) {
    for (std::size_t k = 0; k < 6; ++k) mesh.corners.push_back(static_cast<std::uint32_t>(6 * i + k));
    mesh.material.insert(mesh.material.end(), 2, layers.materials[i]);
  }
  Scene scene = scene_with(Mesh(), unlit({0.9F, 0.1F, 0.2F, 0.3F}));
  scene.materials.push_back(unlit({0.1F, 0.8F, 0.3F, 0.6F}));
  scene.materials.push_back(unlit({0.2F, 0.3F, 1, 1}));
  scene.materials.push_back(unlit({0.7F, 0.7F, 0, 0.9F}));
  scene.materials.push_back(unlit({2, 0.5F, 1, 0.05F}));
  scene.materials.push_back(unlit({0, 0.4F, 0.4F, 0.2F}));
  for (const std::size_t blended : {0U, 1U, 3U, 4U}) scene.materials[blended].alpha_mode = AlphaMode::Blend;
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  return scene;
}

TEST(ShadingSurface, BlendedLayersAreSortedAndComposited) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    const Layers layers = random_layers(random, 14);
    std::vector<std::size_t> order(14);
    std::iota(order.begin(), order.end(), 0);
    const View view = view_of({});
    const Scene plain = scene_of_layers(layers, order);
    const RayScene rays(plain, view);
    std::shuffle(order.begin(), order.end(), random);
    const Frame frame = ZBufferRenderer(scene_of_layers(layers, order), one_sample()).draw(view, {});
    int compared = 0;
    std::size_t deepest = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const auto hits = rays.hits(x + 0.5, y + 0.5, 1.0 / 128);
        if (!hits) continue;
        bool apart = true;
        for (std::size_t i = 1; i < hits->size(); ++i) {
          apart = apart && rays.apart((*hits)[i - 1], (*hits)[i], x + 0.5, y + 0.5, 1.0 / 128);
        }
        if (!apart) continue;
        ++compared;
        deepest = std::max(deepest, hits->size());
        glm::dvec4 color(0);
        for (auto hit = hits->rbegin(); hit != hits->rend(); ++hit) {
          const Material& material = plain.materials[hit->triangle->material];
          const double opacity =
              material.alpha_mode == AlphaMode::Blend ? static_cast<double>(material.base_color.w) : 1;
          color = glm::dvec4(glm::dvec3(material.base_color), 1) * opacity + color * (1 - opacity);
        }
        ASSERT_LE(glm::distance(pixel_at(frame, "color", x, y), color), 1e-5)
            << "seed " << seed << " at " << x << ", " << y << " of " << hits->size() << " layers";
      }
    }
    EXPECT_GT(compared, 5000);
    EXPECT_GT(deepest, 6U);
  }
}

/// Opacity of 0 at the left, 1 at the right: what reaches the cutoff is opaque, the rest shows what is behind.
TEST(ShadingSurface, MaskedSurfacesShowWhereTheirOpacityReachesTheCutoff) {
  for (const int antialias : {1, 4}) {
    for (const float cutoff : {0.0F, 0.3F, 0.75F, 1.5F}) {
      Mesh mesh = square_mesh(1);
      mesh.attributes.push_back(
          attribute_of<glm::vec4>("COLOR_0", {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}}));
      Material material = unlit({0.2F, 0.9F, 0.1F, 1});
      material.alpha_mode = AlphaMode::Mask;
      material.alpha_cutoff = cutoff;
      Scene scene = scene_with(std::move(mesh), material);
      scene.materials.push_back(unlit({1, 0, 0, 1}));
      Mesh behind = square_mesh(3, -0.5F);
      behind.material = {1, 1};
      scene.meshes.push_back(std::make_shared<const Mesh>(std::move(behind)));
      scene.nodes.emplace_back().mesh = MeshId(1);
      scene.roots.emplace_back(1);
      TestView wanted{.width = 60, .height = 60};
      wanted.lens.perspective = false;
      ZBufferOptions options = one_sample();
      options.antialias = antialias;
      const Frame frame = ZBufferRenderer(scene, options).draw(view_of(wanted), {});
      for (int x = 0; x < 60; ++x) {
        const double place = ((x + 0.5) / 60 - 0.5) * 3;  // the picture is 3 units high
        const bool shown = std::fabs(place) < 1 && (place + 1) / 2 >= static_cast<double>(cutoff);
        if (std::fabs((place + 1) / 2 - static_cast<double>(cutoff)) < 1e-3) continue;
        const glm::dvec4 color = shown ? glm::dvec4(0.2, 0.9, 0.1, 1) : glm::dvec4(1, 0, 0, 1);
        EXPECT_LE(glm::distance(pixel_at(frame, "color", x, 30), color), 1e-5) << x << " cutoff " << cutoff;
      }
    }
  }
}

/// A sphere under one light from the camera.
Frame metal_rough(float metallic, float roughness, const glm::vec3& base, const Lighting& lighting) {
  Material material;
  material.base_color = glm::vec4(base, 1);
  material.metallic = metallic;
  material.roughness = roughness;
  TestView wanted{.width = 101, .height = 101};
  wanted.lens.perspective = false;
  wanted.lens.height = 2.2;
  return ZBufferRenderer(scene_with(sphere_mesh(60), material), one_sample()).draw(view_of(wanted), lighting);
}

Lighting headlight() {
  Lighting lighting;
  lighting.lights.emplace_back();
  return lighting;
}

TEST(ShadingSurface, MetalRoughStaysWithinBounds) {
  for (const float metallic : {0.0F, 0.5F, 1.0F, 2.0F, -1.0F}) {
    for (const float roughness : {0.0F, 0.3F, 1.0F, 5.0F}) {
      Lighting everywhere;
      everywhere.sky = everywhere.ground = {1, 1, 1};
      const Frame frame = metal_rough(metallic, roughness, {1, 1, 1}, everywhere);
      const Frame lit = metal_rough(metallic, roughness, {0.5F, 0.5F, 0.5F}, headlight());
      for (int i = 0; i < 101; ++i) {
        // Under even light white sends back about what it gets: not much less, and at grazing angles, where what is
        // mirrored comes on top, less than half more.
        const glm::dvec4 color = pixel_at(frame, "color", i, 50);
        if (color.w > 0) {
          EXPECT_LE(color.x, 1.5) << metallic << " " << roughness << " " << i;
          EXPECT_GE(color.x, 0.4) << metallic << " " << roughness << " " << i;
        }
        const glm::dvec4 under_light = pixel_at(lit, "color", i, 50);
        EXPECT_TRUE(std::isfinite(under_light.x) && under_light.x >= 0);
      }
    }
  }
}

TEST(ShadingSurface, ARoughDielectricIsNearlyLambertian) {
  const Frame frame = metal_rough(0, 1, {0.8F, 0.4F, 0.2F}, headlight());
  for (int x = 20; x <= 80; ++x) {
    const double across = (x - 50) / 101.0 * 2.2;
    const double cosine = std::sqrt(1 - across * across);
    EXPECT_NEAR(pixel_at(frame, "color", x, 50).x, 0.8 * cosine, 0.06) << x;
    EXPECT_NEAR(pixel_at(frame, "color", x, 50).z, 0.2 * cosine, 0.06) << x;
  }
}

TEST(ShadingSurface, AMetalsHighlightHasItsColorADielectricsTheLights) {
  const glm::vec3 base(0.9F, 0.45F, 0.09F);
  const glm::dvec4 metal = pixel_at(metal_rough(1, 0.3F, base, headlight()), "color", 50, 50);
  EXPECT_NEAR(metal.y / metal.x, 0.5, 0.02);
  EXPECT_NEAR(metal.z / metal.x, 0.1, 0.02);
  EXPECT_GT(metal.x, 1);
  const glm::dvec4 plain = pixel_at(metal_rough(0, 0.3F, base, headlight()), "color", 50, 50);
  const glm::dvec3 highlight = glm::dvec3(plain) - glm::dvec3(base);
  EXPECT_GT(highlight.x, 0.05);
  EXPECT_NEAR(highlight.y, highlight.x, 1e-3);
  EXPECT_NEAR(highlight.z, highlight.x, 1e-3);
  // Away from the highlight a metal is dark, a dielectric isn't.
  EXPECT_LT(pixel_at(metal_rough(1, 0.2F, base, headlight()), "color", 85, 50).x, 0.05);
  EXPECT_GT(pixel_at(metal_rough(0, 0.2F, base, headlight()), "color", 85, 50).x, 0.4);
}

TEST(ShadingSurface, RougherIsBroaderAndDimmer) {
  double last_peak = 1e9;
  int last_wide = 0;
  for (const float roughness : {0.2F, 0.35F, 0.5F, 0.7F}) {
    const Frame frame = metal_rough(1, roughness, {1, 1, 1}, headlight());
    const double peak = pixel_at(frame, "color", 50, 50).x;
    int wide = 0;
    for (int x = 0; x < 101; ++x) wide += pixel_at(frame, "color", x, 50).x > peak / 2 ? 1 : 0;
    EXPECT_LT(peak, last_peak) << roughness;
    EXPECT_GT(wide, last_wide) << roughness;
    last_peak = peak;
    last_wide = wide;
  }
}

}  // namespace
}  // namespace azulejo
