#include "azulejo/imaging/blend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/grayscale.h"
#include "azulejo/imaging/threshold.h"

namespace azulejo {
namespace {

template <class T>
Image random_image(int width, int height, int channels, unsigned seed) {
  return random_image(Image(width, height, channels, kPixelTypeOf<T>).info(), seed);
}

/// A pixel.
Image pixel(std::vector<float> values, AlphaState alpha = AlphaState::None) {
  Image image(ImageInfo{1, 1, static_cast<int>(values.size()), PixelType::F32, ColorState::Srgb, alpha});
  std::copy(values.begin(), values.end(), image.view<float>().row(0));
  return image;
}

void expect_pixel(const Image& got, const std::vector<float>& expected) {
  ASSERT_EQ(got.channels(), static_cast<int>(expected.size()));
  for (std::size_t c = 0; c < expected.size(); ++c) {
    EXPECT_NEAR(got.view<float>().row(0)[c], expected[c], 2e-6F) << c;
  }
}

template <class T>
void expect_equal(const Image& a, const Image& b) {
  ASSERT_EQ(a.info(), b.info());
  for (int y = 0; y < a.height(); ++y) {
    for (int i = 0; i < a.width() * a.channels(); ++i) ASSERT_EQ(a.view<T>().row(y)[i], b.view<T>().row(y)[i]);
  }
}

TEST(Blend, OfBytesIsExactForAllPairs) {
  Image source(256, 256, 1);
  Image other(256, 256, 1);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      source.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(x);
      other.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(y);
    }
  }
  for (const double amount : {0.0, 0.125, 0.5, 0.75, 1.0}) {  // whole numbers of 32768ths
    const Image result = blend(source, other, {.amount = static_cast<float>(amount)});
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        ASSERT_EQ(result.view<std::uint8_t>()(x, y), std::floor((1 - amount) * x + amount * y + 0.5)) << x << ' ' << y;
      }
    }
  }
}

TEST(Blend, OfOtherTypesIsTheWeightedSum) {
  const Image a = random_image<std::uint16_t>(301, 17, 3, 1);
  const Image b = random_image<std::uint16_t>(301, 17, 3, 2);
  const Image mixed = blend(a, b, {.amount = 0.3F});
  const Image fa = random_image<float>(301, 17, 3, 1);
  const Image fb = random_image<float>(301, 17, 3, 2);
  const Image fmixed = blend(fa, fb, {.amount = 0.3F});
  const auto share = static_cast<double>(0.3F);
  for (int y = 0; y < 17; ++y) {
    for (int i = 0; i < 903; ++i) {
      const double exact = (1 - share) * a.view<std::uint16_t>().row(y)[i] + share * b.view<std::uint16_t>().row(y)[i];
      // Half a level for rounding; the two shares, products and sums are each off by 2⁻²⁴ of at most 65535.5.
      ASSERT_NEAR(mixed.view<std::uint16_t>().row(y)[i], exact, 0.5 + 5 * 65536.0 / (1 << 24));
      const double real = (1 - share) * static_cast<double>(fa.view<float>().row(y)[i]) +
                          share * static_cast<double>(fb.view<float>().row(y)[i]);
      ASSERT_NEAR(fmixed.view<float>().row(y)[i], real, 5.0 / (1 << 24));
    }
  }
}

TEST(Blend, EndsAreTheImagesAndExchangingThemIsTheOtherShare) {
  for (const unsigned seed : {3U, 4U}) {
    SCOPED_TRACE(seed);
    const Image a = random_image<std::uint8_t>(133, 21, 3, seed);
    const Image b = random_image<std::uint8_t>(133, 21, 3, seed + 10);
    expect_equal<std::uint8_t>(blend(a, b, {.amount = 0}), a);
    expect_equal<std::uint8_t>(blend(a, b, {.amount = 1}), b);
    expect_equal<std::uint8_t>(blend(a, b, {.amount = 0.25F}), blend(b, a, {.amount = 0.75F}));
    expect_equal<std::uint8_t>(blend(a, a, {.amount = 0.7F}), a);
    const Image straight = random_image<std::uint16_t>(133, 21, 4, seed);
    Image opaque = straight.clone();
    for (int y = 0; y < 21; ++y) {
      for (int x = 0; x < 133; ++x) opaque.view<std::uint16_t>()(x, y, 3) = 65535;
    }
    for (const Light light : {Light::Encoded, Light::Linear}) {
      expect_equal<std::uint16_t>(blend(opaque, opaque, {.amount = 0.7F, .light = light}), opaque);
    }
  }
}

TEST(Blend, WhatCannotBeSeenDoesNotShow) {
  const Image red = pixel({1, 0, 0, 1}, AlphaState::Straight);
  const Image hidden = pixel({0, 1, 0, 0}, AlphaState::Straight);
  expect_pixel(blend(red, hidden), {1, 0, 0, 0.5F});
  expect_pixel(blend(hidden, hidden), {0, 0, 0, 0});
  // 0.5 · 0.8 of 0.25 and 0.5 · 0.2 of 0.75, of 0.5 in all.
  expect_pixel(blend(pixel({0.25F, 0.8F}, AlphaState::Straight), pixel({0.75F, 0.2F}, AlphaState::Straight)),
               {0.35F, 0.5F});
}

TEST(Blend, PremultipliedIsThePlainSum) {
  const Image a = pixel({0.2F, 0.3F, 0.1F, 0.5F}, AlphaState::Premultiplied);
  const Image b = pixel({0.6F, 0.1F, 0.5F, 1.0F}, AlphaState::Premultiplied);
  expect_pixel(blend(a, b, {.amount = 0.25F}), {0.3F, 0.25F, 0.2F, 0.625F});
}

TEST(Blend, TakesTheRicherShapeOfBoth) {
  // Gray counts as a color, no alpha as opaque; the alpha state is the source's or the only one.
  const Image gray = pixel({0.5F});
  expect_pixel(blend(gray, pixel({1, 0, 0.5F})), {0.75F, 0.25F, 0.5F});
  expect_pixel(blend(gray, pixel({1, 0, 0.5F, 0}, AlphaState::Straight)), {0.5F, 0.5F, 0.5F, 0.5F});
  expect_pixel(blend(gray, pixel({0, 0, 0, 0}, AlphaState::Premultiplied)), {0.25F, 0.25F, 0.25F, 0.5F});
  const Image straight = pixel({1, 0.5F}, AlphaState::Straight);
  const Image premultiplied = pixel({0.25F, 0.5F}, AlphaState::Premultiplied);
  const Image first = blend(straight, premultiplied);
  expect_pixel(first, {0.75F, 0.5F});
  EXPECT_EQ(first.info().alpha, AlphaState::Straight);
  const Image second = blend(premultiplied, straight);
  expect_pixel(second, {0.375F, 0.5F});
  EXPECT_EQ(second.info().alpha, AlphaState::Premultiplied);
}

TEST(Blend, OfUnlikeAlphaStatesOfIntegersIsWhatItIsOfFloats) {
  const AlphaState states[] = {AlphaState::None, AlphaState::Straight, AlphaState::Premultiplied};
  const float values[] = {40000, 10000, 30000, 45000};
  for (const Light light : {Light::Encoded, Light::Linear}) {
    for (const AlphaState a : states) {
      for (const AlphaState b : states) {
        const int channels[] = {a == AlphaState::None ? 3 : 4, b == AlphaState::None ? 1 : 2};
        std::vector<Image> words, floats;
        for (const std::size_t i : {0U, 1U}) {
          ImageInfo info{1, 1, channels[i], PixelType::U16, ColorState::Srgb, i == 0 ? a : b};
          words.emplace_back(info);
          info.type = PixelType::F32;
          floats.emplace_back(info);
          for (int c = 0; c < channels[i]; ++c) {
            const float value = values[4 - channels[i] + c];
            words[i].view<std::uint16_t>()(0, 0, c) = static_cast<std::uint16_t>(value);
            floats[i].view<float>()(0, 0, c) = value / 65535;
          }
        }
        const Image got = blend(words[0], words[1], {.amount = 0.3F, .light = light});
        const Image expected = blend(floats[0], floats[1], {.amount = 0.3F, .light = light});
        ASSERT_EQ(got.info().alpha, expected.info().alpha);
        for (int c = 0; c < expected.channels(); ++c) {
          EXPECT_NEAR(got.view<std::uint16_t>()(0, 0, c), expected.view<float>()(0, 0, c) * 65535, 0.6) << c;
        }
      }
    }
  }
}

TEST(Blend, InLinearLightBlackAndWhiteMeetAt188) {
  Image black(1, 1, 1);
  Image white(1, 1, 1);
  black.view<std::uint8_t>()(0, 0) = 0;
  white.view<std::uint8_t>()(0, 0) = 255;
  EXPECT_EQ(blend(black, white, {.light = Light::Linear}).view<std::uint8_t>()(0, 0), 188);
  EXPECT_EQ(blend(black, white).view<std::uint8_t>()(0, 0), 128);
  black.set_states(ColorState::Linear, AlphaState::None);
  white.set_states(ColorState::Linear, AlphaState::None);
  EXPECT_EQ(blend(black, white, {.light = Light::Linear}).view<std::uint8_t>()(0, 0), 128);
}

TEST(Blend, LinearLightDoesNotSeePremultiplication) {
  const Image straight = pixel({0.8F, 0.5F}, AlphaState::Straight);
  const Image premultiplied = pixel({0.4F, 0.5F}, AlphaState::Premultiplied);
  const Image other = pixel({0.1F, 0.25F}, AlphaState::Straight);
  const Image a = blend(straight, other, {.light = Light::Linear});
  const Image b = blend(premultiplied, other, {.light = Light::Linear});
  const float alpha = a.view<float>()(0, 0, 1);
  EXPECT_FLOAT_EQ(alpha, 0.375F);
  EXPECT_NEAR(b.view<float>()(0, 0), a.view<float>()(0, 0) * alpha, 1e-6F);
}

TEST(Blend, NaNStaysNaN) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(blend(pixel({nan}), pixel({1}), {.amount = 1}).view<float>()(0, 0)));
  EXPECT_TRUE(std::isnan(blend(pixel({1}), pixel({nan}), {.amount = 0}).view<float>()(0, 0)));
}

TEST(Blend, MixesAnImageWithWhatWasMadeOfIt) {
  const Image photo = random_image<std::uint8_t>(91, 13, 3, 5);
  const Image mask = threshold(grayscale(photo));
  const Image result = blend(photo, mask, {.amount = 0.5F});
  for (int y = 0; y < 13; ++y) {
    for (int i = 0; i < 273; ++i) {
      const int expected = (photo.view<std::uint8_t>().row(y)[i] + mask.view<std::uint8_t>().row(y)[i / 3] + 1) / 2;
      ASSERT_EQ(result.view<std::uint8_t>().row(y)[i], expected);
    }
  }
}

TEST(Blend, RefusesWhatDoesNotFitAndNamesBoth) {
  const Image source(5, 4, 3);
  const auto refused = [&](const Image& other) {
    try {
      blend(source, other);
      ADD_FAILURE() << describe(other.info());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Argument);
      EXPECT_NE(std::string(error.what()).find(describe(source.info())), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(describe(other.info())), std::string::npos) << error.what();
    }
  };
  refused(Image(4, 5, 3));
  refused(Image(5, 4, 3, PixelType::U16));
  refused(Image(ImageInfo{5, 4, 3, PixelType::U8, ColorState::Linear}));
  refused(Image(ImageInfo{5, 4, 2, PixelType::U8, ColorState::Srgb}));
  EXPECT_THROW(blend(source, source, {.amount = 1.1F}), Error);
}

}  // namespace
}  // namespace azulejo
