#include "azulejo/imaging/grayscale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

template <class T>
Image random_colors(int width, int height, int channels, unsigned seed) {
  return random_image(Image(width, height, channels, kPixelTypeOf<T>).info(), seed);
}

double decoded(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }
double encoded(double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

TEST(Grayscale, LumaOfBytesIsExactForEveryReachableSum) {
  // All R and G, and B in an order that meets every residue: 16.7 M colors would do as well, only slower.
  Image source(256, 256, 3);
  for (int b = 0; b < 256; b += 5) {
    for (int r = 0; r < 256; ++r) {
      for (int g = 0; g < 256; ++g) {
        auto* const pixel = &source.view<std::uint8_t>()(g, r);
        pixel[0] = static_cast<std::uint8_t>(r);
        pixel[1] = static_cast<std::uint8_t>(g);
        pixel[2] = static_cast<std::uint8_t>((b + g) % 256);
      }
    }
    const Image gray = grayscale(source);
    for (int r = 0; r < 256; ++r) {
      for (int g = 0; g < 256; ++g) {
        const int exact = (299 * r + 587 * g + 114 * ((b + g) % 256) + 500) / 1000;
        ASSERT_EQ(gray.view<std::uint8_t>()(g, r), exact) << r << ' ' << g << ' ' << (b + g) % 256;
      }
    }
  }
}

TEST(Grayscale, TheEighthsOfASumGiveItsThousandth) {
  // What the kernels do, for every sum there is.
  for (std::uint32_t sum = 0; sum <= 255'500; ++sum) ASSERT_EQ((sum >> 3) * 33555U >> 22, sum / 1000);
  for (std::uint32_t eighths = 0; eighths <= 65'535'500 / 8; ++eighths) {
    ASSERT_EQ(static_cast<std::uint32_t>(static_cast<float>(eighths) * 0.008F), eighths / 125);
  }
}

TEST(Grayscale, LumaOf16BitsIsExact) {
  const Image source = random_colors<std::uint16_t>(301, 97, 3, 3);
  const Image gray = grayscale(source);
  for (int y = 0; y < 97; ++y) {
    for (int x = 0; x < 301; ++x) {
      const std::uint16_t* const p = &source.view<std::uint16_t>()(x, y);
      ASSERT_EQ(gray.view<std::uint16_t>()(x, y), (299U * p[0] + 587U * p[1] + 114U * p[2] + 500U) / 1000U);
    }
  }
}

TEST(Grayscale, LumaOfFloatsIsWithinThreeRoundings) {
  const Image source = random_colors<float>(301, 97, 3, 4);
  const Image gray = grayscale(source);
  for (int y = 0; y < 97; ++y) {
    for (int x = 0; x < 301; ++x) {
      const float* const p = &source.view<float>()(x, y);
      const double exact =
          0.299 * static_cast<double>(p[0]) + 0.587 * static_cast<double>(p[1]) + 0.114 * static_cast<double>(p[2]);
      // Constants, products and two sums are rounded, each by at most 2⁻²⁴ of a value that is at most the result.
      ASSERT_NEAR(gray.view<float>()(x, y), exact, 4 * exact / (1 << 24) + 1e-30);
    }
  }
}

TEST(Grayscale, GrayStaysGrayUnderBothLights) {
  for (const Light light : {Light::Encoded, Light::Linear}) {
    for (const ColorState state : {ColorState::Srgb, ColorState::Linear, ColorState::Data}) {
      Image source(256, 1, 3);
      for (int i = 0; i < 768; ++i) source.view<std::uint8_t>().row(0)[i] = static_cast<std::uint8_t>(i / 3);
      source.set_states(state, AlphaState::None);
      const Image gray = grayscale(source, {.light = light});
      for (int v = 0; v < 256; ++v) EXPECT_EQ(gray.view<std::uint8_t>()(v, 0), v);
      EXPECT_EQ(gray.info().color, state);
    }
  }
}

TEST(Grayscale, LinearLightIsTheLuminanceEncodedAgain) {
  const Image source = random_colors<float>(301, 41, 3, 5);
  const Image gray = grayscale(source, {.light = Light::Linear});
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 301; ++x) {
      const float* const p = &source.view<float>()(x, y);
      const auto light = [&](int c) { return decoded(static_cast<double>(p[c])); };
      // The curves are within 10⁻⁶ of their values.
      ASSERT_NEAR(gray.view<float>()(x, y), encoded(0.2126 * light(0) + 0.7152 * light(1) + 0.0722 * light(2)), 3e-6);
    }
  }
}

TEST(Grayscale, LinearLightDoesNotSeePremultiplication) {
  Image straight = random_colors<float>(64, 8, 4, 6);
  Image premultiplied = straight.clone();
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 3; ++c) premultiplied.view<float>()(x, y, c) *= straight.view<float>()(x, y, 3);
    }
  }
  premultiplied.view<float>()(0, 0, 3) = 0;
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  const Image a = grayscale(straight, {.light = Light::Linear});
  const Image b = grayscale(premultiplied, {.light = Light::Linear});
  EXPECT_EQ(b.view<float>()(0, 0), 0.0F);
  for (int y = 0; y < 8; ++y) {
    for (int x = y == 0 ? 1 : 0; x < 64; ++x) {
      const float alpha = straight.view<float>()(x, y, 3);
      EXPECT_EQ(b.view<float>()(x, y, 1), alpha);
      EXPECT_NEAR(b.view<float>()(x, y, 0), a.view<float>()(x, y, 0) * alpha, 3e-6);
    }
  }
}

TEST(Grayscale, ALinearImageBecomesLuminance) {
  Image source(1, 1, 3, PixelType::F32);
  source.set_states(ColorState::Linear, AlphaState::None);
  const float green[] = {0, 0.5F, 0};
  std::copy_n(green, 3, source.view<float>().row(0));
  for (const Light light : {Light::Encoded, Light::Linear}) {
    EXPECT_FLOAT_EQ(grayscale(source, {.light = light}).view<float>()(0, 0), 0.3576F);
  }
}

TEST(Grayscale, NaNStaysNaN) {
  for (const Light light : {Light::Encoded, Light::Linear}) {
    for (int c = 0; c < 3; ++c) {
      Image source(1, 1, 3, PixelType::F32);
      std::fill_n(source.view<float>().row(0), 3, 0.5F);
      source.view<float>()(0, 0, c) = std::numeric_limits<float>::quiet_NaN();
      EXPECT_TRUE(std::isnan(grayscale(source, {.light = light}).view<float>()(0, 0)));
    }
  }
}

TEST(Grayscale, GrayComesBackAsItIs) {
  const Image source = random_colors<std::uint16_t>(33, 5, 2, 7);
  const Image gray = grayscale(source);
  EXPECT_EQ(gray.info(), source.info());
  for (int i = 0; i < 66; ++i) EXPECT_EQ(gray.view<std::uint16_t>().row(4)[i], source.view<std::uint16_t>().row(4)[i]);
}

TEST(Grayscale, RefusesTwoAndFourChannelsWithoutAlpha) {
  for (const int channels : {2, 4}) {
    Image source(1, 1, channels);
    source.set_states(ColorState::Data, AlphaState::None);
    EXPECT_THROW(grayscale(source), Error);
  }
}

}  // namespace
}  // namespace azulejo
