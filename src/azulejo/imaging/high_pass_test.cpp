#include "azulejo/imaging/high_pass.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/detail_testing.h"

namespace azulejo {
namespace {

TEST(HighPass, IsItsDefinition) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image source = random_image(ImageInfo{21, 18, 3, type}, 6);
    const Image result = high_pass(source, {.sigma = 1.6F});
    ASSERT_EQ(result.type(), PixelType::F32);
    EXPECT_EQ(result.info().color, ColorState::Data);
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 21; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double expected = intensity(source, x, y, c) - smooth(source, x, y, c, double{1.6F});
          ASSERT_NEAR(result.view<float>()(x, y, c), expected, smooth_error(type, 1.6) + 1e-6) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(HighPass, IsZeroToTheLastBitWhereNothingChanges) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const AlphaState alpha : {AlphaState::None, AlphaState::Straight, AlphaState::Premultiplied}) {
      for (const Light light : {Light::Encoded, Light::Linear}) {
        Image source(ImageInfo{30, 20, alpha == AlphaState::None ? 3 : 4, type, ColorState::Srgb, alpha});
        visit(source.any(), [&](auto view) {
          using T = std::remove_pointer_t<decltype(view.data)>;
          for (int y = 0; y < 20; ++y) {
            for (int i = 0; i < 30 * view.channels; ++i) {
              view.row(y)[i] = static_cast<T>(full_range(type) * 0.1F * static_cast<float>(1 + i % view.channels));
            }
          }
        });
        const Image result = high_pass(source, {.sigma = 2, .light = light});
        ASSERT_EQ(result.channels(), 3);
        for (int y = 0; y < 20; ++y) {
          for (int i = 0; i < 90; ++i) ASSERT_EQ(result.view<float>().row(y)[i], 0.0F) << describe(source.info());
        }
      }
    }
  }
}

TEST(HighPass, CountsColorsTimesAlpha) {
  // A white disk on nothing, and one on black, have the same detail.
  Image clear(31, 31, 2);
  Image black(31, 31, 1);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      const bool inside = (x - 15) * (x - 15) + (y - 15) * (y - 15) < 70;
      clear.view<std::uint8_t>()(x, y, 0) = 255;
      clear.view<std::uint8_t>()(x, y, 1) = inside ? 255 : 0;
      black.view<std::uint8_t>()(x, y) = inside ? 255 : 0;
    }
  }
  const Image a = high_pass(clear, {.sigma = 1.5F});
  const Image b = high_pass(black, {.sigma = 1.5F});
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      EXPECT_NEAR(a.view<float>()(x, y), b.view<float>()(x, y), smooth_error(PixelType::U8, 1.5) + 1e-6);
    }
  }
}

}  // namespace
}  // namespace azulejo
