#include "azulejo/imaging/high_boost.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/detail_testing.h"
#include "azulejo/imaging/unsharp_mask.h"

namespace azulejo {
namespace {

TEST(HighBoost, IsItsDefinition) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image source = random_image(ImageInfo{21, 18, 1, type}, 6);
    const Image result = high_boost(source, {.boost = 1.7F, .sigma = 1.1F});
    const double step = type == PixelType::F32 ? 0 : 0.5 / full_range(type);
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 21; ++x) {
        double expected = double{1.7F} * intensity(source, x, y, 0) - smooth(source, x, y, 0, double{1.1F});
        if (type != PixelType::F32) expected = std::clamp(expected, 0.0, 1.0);
        ASSERT_NEAR(intensity(result, x, y, 0), expected, step + smooth_error(type, 1.1) + 1e-6) << x << ' ' << y;
      }
    }
  }
}

TEST(HighBoost, OfTwoIsAnUnsharpMaskOfOne) {
  const Image source = random_image(ImageInfo{50, 40, 3, PixelType::U16}, 7);
  const Image boosted = high_boost(source, {.boost = 2, .sigma = 2});
  const Image sharpened = unsharp_mask(source, {.sigma = 2, .amount = 1});
  for (int y = 0; y < 40; ++y) {
    EXPECT_TRUE(std::equal(boosted.view<std::uint16_t>().row(y), boosted.view<std::uint16_t>().row(y) + 150,
                           sharpened.view<std::uint16_t>().row(y)));
  }
}

TEST(HighBoost, MultipliesConstantImages) {
  Image source(20, 20, 1);
  for (int y = 0; y < 20; ++y) std::fill_n(source.view<std::uint8_t>().row(y), 20, std::uint8_t{100});
  const Image result = high_boost(source, {.boost = 2.5F});
  const Image nothing = high_boost(source, {.boost = 1});
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      EXPECT_EQ(result.view<std::uint8_t>()(x, y), 150);
      EXPECT_EQ(nothing.view<std::uint8_t>()(x, y), 0);
    }
  }
}

}  // namespace
}  // namespace azulejo
