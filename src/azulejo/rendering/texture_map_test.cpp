#include "azulejo/rendering/texture_map.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace azulejo {
namespace {

Texture texture_of(Image image) {
  Texture texture;
  texture.image = std::make_shared<const Image>(std::move(image));
  return texture;
}

Image random_image(std::mt19937& random, int width, int height, int channels) {
  const AlphaState alpha = channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
  Image image(ImageInfo{width, height, channels, PixelType::U8, ColorState::Srgb, alpha});
  const auto view = image.view<std::uint8_t>();
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) view.row(y)[i] = static_cast<std::uint8_t>(random() % 256);
  }
  return image;
}

double decoded(double byte, bool srgb) {
  const double e = byte / 255;
  if (!srgb) return e;
  return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}

/// A texel as light: red, green, blue, opacity.
glm::dvec4 texel_of(const Image& image, int x, int y, bool srgb) {
  const auto view = image.view<std::uint8_t>();
  const int colors = image.info().color_channels();
  glm::dvec4 texel(0, 0, 0, 1);
  for (int c = 0; c < 3; ++c) texel[c] = decoded(view(x, y, colors == 3 ? c : 0), srgb);
  if (image.info().alpha != AlphaState::None) texel.w = view(x, y, image.channels() - 1) / 255.0;
  return texel;
}

int wrapped(int at, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) return std::clamp(at, 0, size - 1);
  const int period = wrap == TextureWrap::Repeat ? size : 2 * size;
  const int rest = ((at % period) + period) % period;
  return rest < size ? rest : 2 * size - 1 - rest;
}

double distance(const glm::vec4& a, const glm::dvec4& b) {
  double most = 0;
  for (int c = 0; c < 4; ++c) most = std::max(most, std::fabs(static_cast<double>(a[c]) - b[c]));
  return most;
}

TEST(TextureMap, ColorsAreDecodedAndDataIsNot) {
  std::mt19937 random(1);
  for (int channels = 1; channels <= 4; ++channels) {
    const Texture texture = texture_of(random_image(random, 37, 11, channels));
    for (const bool srgb : {false, true}) {
      const TextureMap map(texture, srgb, {});
      EXPECT_EQ(map.width(), 37);
      EXPECT_EQ(map.height(), 11);
      EXPECT_EQ(map.has_alpha(), channels % 2 == 0);
      for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 37; ++x) {
          // Half a step of 16 bits, and the decoding's 10⁻⁶.
          ASSERT_LE(distance(map.texel(0, x, y), texel_of(*texture.image, x, y, srgb)), 1e-5);
        }
      }
    }
  }
}

/// Texels are right to half a step of 16 bits; a place is right to 24 bits of up to 3·9 texels, times a slope below 1.
TEST(TextureMap, BilinearInEveryWrapMode) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-3, 3);
  for (const TextureWrap wrap_u : {TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp}) {
    for (const TextureWrap wrap_v : {TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp}) {
      for (const auto& [width, height] : {std::pair{9, 5}, {1, 4}, {2, 1}}) {
        Texture texture = texture_of(random_image(random, width, height, 4));
        texture.wrap_u = wrap_u;
        texture.wrap_v = wrap_v;
        const TextureMap map(texture, true, {});
        for (int i = 0; i < 400; ++i) {
          const glm::vec2 uv(place(random), place(random));
          const double x = static_cast<double>(uv.x) * width - 0.5;
          const double y = static_cast<double>(uv.y) * height - 0.5;
          glm::dvec4 sum(0);
          for (int corner = 0; corner < 4; ++corner) {
            const int column = static_cast<int>(std::floor(x)) + corner % 2;
            const int row = static_cast<int>(std::floor(y)) + corner / 2;
            const double weight = (1 - std::fabs(x - column)) * (1 - std::fabs(y - row));
            sum +=
                weight * texel_of(*texture.image, wrapped(column, width, wrap_u), wrapped(row, height, wrap_v), true);
          }
          ASSERT_LE(distance(map.sample(uv, 0), sum), 2e-5) << uv.x << ", " << uv.y;
        }
      }
    }
  }
}

TEST(TextureMap, NearestTakesTheTexelUnderThePoint) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-3, 3);
  for (const TextureWrap wrap : {TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp}) {
    Texture texture = texture_of(random_image(random, 7, 4, 3));
    texture.wrap_u = texture.wrap_v = wrap;
    texture.magnification = TextureFilter::Nearest;
    const TextureMap map(texture, false, {});
    for (int i = 0; i < 1000; ++i) {
      const glm::vec2 uv(place(random), place(random));
      const double x = static_cast<double>(uv.x) * 7;
      const double y = static_cast<double>(uv.y) * 4;
      if (std::fabs(x - std::round(x)) < 1e-4 || std::fabs(y - std::round(y)) < 1e-4) continue;
      const int column = wrapped(static_cast<int>(std::floor(x)), 7, wrap);
      const int row = wrapped(static_cast<int>(std::floor(y)), 4, wrap);
      ASSERT_LE(distance(map.sample(uv, -1), texel_of(*texture.image, column, row, false)), 1e-5);
    }
  }
}

TEST(TextureMap, MipmapsOfEverySizeKeepTheMean) {
  std::mt19937 random(4);
  for (const auto& [width, height] : {std::pair{64, 64}, {7, 5}, {13, 1}, {1, 9}, {33, 20}, {3, 2}, {1, 1}, {255, 3}}) {
    const Texture texture = texture_of(random_image(random, width, height, 4));
    const TextureMap map(texture, true, {});
    EXPECT_EQ(map.levels(), 1 + static_cast<int>(std::log2(std::max(width, height))));
    glm::dvec4 mean(0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) mean += texel_of(*texture.image, x, y, true) / (1.0 * width * height);
    }
    int w = width;
    int h = height;
    for (int level = 0; level < map.levels(); ++level) {
      glm::dvec4 sum(0);
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) sum += glm::dvec4(map.texel(level, x, y)) / (1.0 * w * h);
      }
      // Half a step of 16 bits a level.
      EXPECT_LE(distance(glm::vec4(sum), mean), 1e-5 * (level + 1)) << width << "×" << height << " level " << level;
      w = std::max(1, w / 2);
      h = std::max(1, h / 2);
    }
  }
}

/// An odd side halved: each texel is the mean of two and a half above it, by area.
TEST(TextureMap, AnOddSideIsDividedByArea) {
  Image image(5, 1, 1);
  const auto view = image.view<std::uint8_t>();
  for (int x = 0; x < 5; ++x) view(x, 0, 0) = static_cast<std::uint8_t>(x == 2 ? 255 : x * 10);
  const TextureMap map(texture_of(std::move(image)), false, {});
  EXPECT_NEAR(map.texel(1, 0, 0).x, (0 + 10 + 0.5 * 255) / 2.5 / 255, 1e-5);
  EXPECT_NEAR(map.texel(1, 1, 0).x, (30 + 40 + 0.5 * 255) / 2.5 / 255, 1e-5);
}

TEST(TextureMap, TheLevelFollowsTheFilters) {
  std::mt19937 random(5);
  Texture texture = texture_of(random_image(random, 16, 16, 3));
  texture.minification = TextureFilter::Nearest;
  // In texel (3, 5) of the image, (1, 2) of the first mipmap, (0, 1) of the second.
  const glm::vec2 uv(3.01F / 16, 5.01F / 16);
  const auto at = [&](MipFilter mipmaps, float lod) {
    texture.mipmaps = mipmaps;
    return TextureMap(texture, false, {}).sample(uv, lod);
  };
  const TextureMap map(texture, false, {});
  const glm::dvec4 fine(map.texel(0, 3, 5));
  const glm::dvec4 half(map.texel(1, 1, 2));
  const glm::dvec4 coarse(map.texel(2, 0, 1));
  EXPECT_LE(distance(at(MipFilter::None, 3), fine), 1e-6);
  EXPECT_LE(distance(at(MipFilter::Nearest, 0.4F), fine), 1e-6);
  EXPECT_LE(distance(at(MipFilter::Nearest, 0.6F), half), 1e-6);
  EXPECT_LE(distance(at(MipFilter::Linear, 1), half), 1e-6);
  EXPECT_LE(distance(at(MipFilter::Linear, 0.25F), 0.75 * fine + 0.25 * half), 1e-6);
  EXPECT_LE(distance(at(MipFilter::Linear, 1.5F), 0.5 * half + 0.5 * coarse), 1e-6);
  EXPECT_LE(distance(at(MipFilter::Linear, 99), glm::dvec4(map.texel(4, 0, 0))), 1e-6);
}

TEST(TextureMap, PlacesThatAreNotFiniteOrFarAwayAreLookedUpAllTheSame) {
  std::mt19937 random(6);
  Texture texture = texture_of(random_image(random, 6, 3, 3));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const TextureWrap wrap : {TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp}) {
    texture.wrap_u = texture.wrap_v = wrap;
    const TextureMap map(texture, true, {});
    const glm::dvec4 origin(map.sample({0, 0}, 0));
    EXPECT_EQ(distance(map.sample({nan, infinity}, 0), origin), 0);
    EXPECT_EQ(distance(map.sample({0, 0}, nan), origin), 0);
    for (const float far : {1e9F, -1e9F, 3e38F, -3e38F}) {
      const glm::vec4 value = map.sample({far, far}, 2.5F);
      EXPECT_TRUE(value.x >= 0 && value.x <= 1);
    }
  }
}

}  // namespace
}  // namespace azulejo
