// Textures as surfaces carry them: which way up, in perspective, at which level, transformed; normal maps.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "azulejo/rendering/texture_map.h"
#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

template <class F>
Texture texture_of(int width, int height, F color) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::ivec3 value = color(x, y);
      for (int c = 0; c < 3; ++c) image.view<std::uint8_t>()(x, y, c) = static_cast<std::uint8_t>(value[c]);
    }
  }
  Texture texture;
  texture.image = std::make_shared<const Image>(std::move(image));
  return texture;
}

/// 0 and 255 in squares of `side` texels.
Texture checker(int size, int side) {
  return texture_of(size, size, [&](int x, int y) { return glm::ivec3((x / side + y / side) % 2 == 0 ? 0 : 255); });
}

/// A mesh whose base colour is a texture.
Scene textured(Mesh mesh, const Texture& texture) {
  Material material = unlit({1, 1, 1, 1});
  material.base_color_texture.texture = TextureId(0);
  Scene scene = scene_with(std::move(mesh), material);
  scene.textures.push_back(texture);
  return scene;
}

ZBufferOptions linear() { return {.antialias = 1, .output = FrameOutput::Linear}; }

/// The square of side 2 fills the picture.
View square_view(int size) {
  TestView wanted{.width = size, .height = size};
  wanted.lens.perspective = false;
  wanted.lens.height = 2;
  return view_of(wanted);
}

TEST(ZBufferTexture, TheImagesTopLeftIsAtTheOriginOfCoordinates) {
  Texture texture = texture_of(2, 2, [](int x, int y) { return glm::ivec3(255 * x, 255 * y, 0); });
  texture.magnification = TextureFilter::Nearest;
  const Frame frame = ZBufferRenderer(textured(square_mesh(1), texture), linear()).draw(square_view(8), {});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(pixel_at(frame, "color", x, y), glm::dvec4(x >= 4 ? 1 : 0, y >= 4 ? 1 : 0, 0, 1)) << x << ", " << y;
    }
  }
}

/// A tilted square near the camera, magnified: what the texture holds where the ray goes.
TEST(ZBufferTexture, IsRightInPerspectiveAndTransformed) {
  const Texture texture =
      texture_of(8, 8, [](int x, int y) { return glm::ivec3(30 * x, 30 * y, 13 * ((x * 3 + y * 5) % 19)); });
  const TextureMap map(texture, true, {});
  const std::vector<glm::vec3> corners = {{-2, -1, 1}, {2, -1, 1}, {2, 1.5F, -5}, {-2, 1.5F, -5}};
  for (int variant = 0; variant < 3; ++variant) {
    Mesh mesh = soup_of(corners);
    mesh.corners = {0, 1, 2, 0, 2, 3};
    const std::vector<glm::vec2> uv = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.attributes.push_back(attribute_of(variant == 1 ? "TEXCOORD_1" : "TEXCOORD_0", uv));
    Scene scene = textured(std::move(mesh), texture);
    TextureUse& use = scene.materials[0].base_color_texture;
    if (variant > 0) {
      use.offset = {0.3F, -0.2F};
      use.scale = {0.5F, 1.5F};
      use.rotation = 0.7F;
      use.texcoord = variant == 1 ? 1 : 0;
    }
    TestView wanted{.width = 200, .height = 160};
    const View view = view_of(wanted);
    const RayScene rays(scene, view);
    const Frame frame = ZBufferRenderer(scene, linear()).draw(view, {});
    int compared = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const auto hit = rays.trace(x + 0.5, y + 0.5, 1.0 / 128);
        if (!hit || hit->triangle == nullptr) continue;
        glm::dvec2 place(0);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t corner = std::size_t{3} * hit->triangle->face + k;
          place += hit->weight[k] * glm::dvec2(uv[hit->triangle->mesh->corners[corner]]);
        }
        if (variant > 0) {
          const double cosine = std::cos(0.7);
          const double sine = std::sin(0.7);
          const double u = 0.5 * place.x;
          const double v = 1.5 * place.y;
          place = {0.3 + cosine * u + sine * v, -0.2 - sine * u + cosine * v};
        }
        ++compared;
        // 10⁻⁵ of the place, times 8 texels and a slope of one between neighbours.
        const glm::dvec4 color(map.sample(glm::vec2(place), 0));
        EXPECT_LE(glm::distance(pixel_at(frame, "color", x, y), color), 5e-4)
            << x << ", " << y << " variant " << variant;
      }
    }
    EXPECT_GT(compared, 4000);
  }
}

/// Contrast of what the texture looks like in a picture of so many pixels.
double contrast(const Texture& texture, int pixels) {
  const Frame frame = ZBufferRenderer(textured(square_mesh(1), texture), linear()).draw(square_view(pixels), {});
  double least = 1;
  double most = 0;
  for (int y = 0; y < pixels; ++y) {
    for (int x = 0; x < pixels; ++x) {
      least = std::min(least, pixel_at(frame, "color", x, y).x);
      most = std::max(most, pixel_at(frame, "color", x, y).x);
    }
  }
  return most - least;
}

TEST(ZBufferTexture, TheLevelIsThatOfAPixelsSize) {
  // Squares of 4 texels are whole in the levels down to 2 and gone in level 3.
  const Texture squares = checker(64, 4);
  EXPECT_NEAR(contrast(squares, 64), 1, 0.01);
  EXPECT_NEAR(contrast(squares, 32), 1, 0.01);
  EXPECT_NEAR(contrast(squares, 16), 1, 0.01);
  EXPECT_NEAR(contrast(squares, 8), 0, 0.01);
  // The nearest level changes at 2^2.5 = 5.66 texels a pixel.
  Texture nearest = squares;
  nearest.minification = TextureFilter::Nearest;
  nearest.mipmaps = MipFilter::Nearest;
  EXPECT_NEAR(contrast(nearest, 12), 1, 0.01);  // 5.3
  EXPECT_NEAR(contrast(nearest, 11), 0, 0.01);  // 5.8
}

TEST(ZBufferTexture, AMinifiedCheckerIsTheMeanOfTheLight) {
  // Not sRGB's mean, which would be 0.21 of the light.
  for (const int pixels : {32, 20, 9, 1}) {
    const Frame frame =
        ZBufferRenderer(textured(square_mesh(1), checker(64, 1)), linear()).draw(square_view(pixels), {});
    for (int x = 0; x < pixels; ++x) EXPECT_NEAR(pixel_at(frame, "color", x, pixels / 2).y, 0.5, 1e-4) << pixels;
  }
}

/// Toward the horizon texels shrink along one side first; far away the checker is gray, near the camera it isn't.
TEST(ZBufferTexture, AFloorFadesToGray) {
  Mesh mesh = soup_of({{-100, -1, 4}, {100, -1, 4}, {100, -1, -200}, {-100, -1, -200}});
  mesh.corners = {0, 1, 2, 0, 2, 3};
  mesh.attributes.push_back(attribute_of<glm::vec2>("TEXCOORD_0", {{0, 102}, {100, 102}, {100, 0}, {0, 0}}));
  const Scene scene = textured(std::move(mesh), checker(16, 8));
  TestView wanted{.width = 120, .height = 100};
  wanted.lens.infinite = true;
  const Frame frame = ZBufferRenderer(scene, linear()).draw(view_of(wanted), {});
  double spread[2] = {};
  for (int x = 0; x < 120; ++x) {
    spread[0] += std::fabs(pixel_at(frame, "color", x, 53).x - 0.5) / 120;  // 40 units away
    spread[1] += std::fabs(pixel_at(frame, "color", x, 98).x - 0.5) / 120;
  }
  EXPECT_LT(spread[0], 0.03);
  EXPECT_GT(spread[1], 0.4);
}

/// The normal of a square facing +z under a normal map of one value.
glm::dvec3 mapped(const glm::ivec3& value, bool mirrored_u = false, bool mirrored_node = false, float strength = 1) {
  Mesh mesh = square_mesh(1);
  if (mirrored_u) {
    mesh.attributes[0] = attribute_of<glm::vec2>("TEXCOORD_0", {{1, 1}, {0, 1}, {0, 0}, {1, 0}});
  }
  Scene scene = scene_with(std::move(mesh), unlit({1, 1, 1, 1}));
  scene.materials[0].normal_texture.texture = TextureId(0);
  scene.materials[0].normal_texture.strength = strength;
  scene.textures.push_back(texture_of(4, 4, [&](int, int) { return value; }));
  if (mirrored_node) scene.nodes[0].placement = Placement{{0, 0, 0}, {1, 0, 0, 0}, {-1, 1, 1}};
  ZBufferOptions options = linear();
  options.layers = {"normal"};
  const Frame frame = ZBufferRenderer(scene, options).draw(square_view(9), {});
  return glm::dvec3(pixel_at(frame, "normal", 4, 4));
}

TEST(ZBufferTexture, NormalMaps) {
  // Bytes have no middle: 128 is 0.004 above it.
  const double half = std::numbers::sqrt2 / 2;
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 0.008; };
  EXPECT_TRUE(near(mapped({128, 128, 255}), {0, 0, 1})) << "flat: no change";
  EXPECT_TRUE(near(mapped({128, 128, 255}, false, true), {0, 0, 1}));
  EXPECT_TRUE(near(mapped({255, 128, 255}), {half, 0, half})) << "red points along u";
  EXPECT_TRUE(near(mapped({255, 128, 255}, true), {-half, 0, half}));
  EXPECT_TRUE(near(mapped({255, 128, 255}, false, true), {-half, 0, half}));
  EXPECT_TRUE(near(mapped({128, 255, 255}), {0, half, half})) << "green points up the image";
  EXPECT_TRUE(near(mapped({128, 255, 255}, true), {0, half, half}));
  EXPECT_TRUE(near(mapped({128, 255, 255}, false, true), {0, half, half}));
  const glm::dvec3 weak = mapped({255, 128, 255}, false, false, 0.5F);
  EXPECT_TRUE(near(weak, glm::normalize(glm::dvec3(0.5, 0, 1))));
}

TEST(ZBufferTexture, AMissingImageOrCoordinatesIsNoError) {
  Texture missing;
  const Frame without = ZBufferRenderer(textured(square_mesh(1), missing), linear()).draw(square_view(5), {});
  EXPECT_EQ(pixel_at(without, "color", 2, 2), glm::dvec4(1));
  Mesh bare = soup_of({{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}});
  const Texture texture = texture_of(2, 2, [](int x, int y) { return glm::ivec3(x == 0 && y == 0 ? 255 : 0); });
  Texture nearest = texture;
  nearest.magnification = TextureFilter::Nearest;
  const Frame frame = ZBufferRenderer(textured(std::move(bare), nearest), linear()).draw(square_view(5), {});
  EXPECT_EQ(pixel_at(frame, "color", 2, 2), glm::dvec4(1)) << "the texel at (0, 0)";
}

}  // namespace
}  // namespace azulejo
