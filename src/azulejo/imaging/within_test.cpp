#include "azulejo/imaging/within.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

Image flat(int width, int height, std::uint8_t level) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y) std::fill_n(image.view<std::uint8_t>().row(y), width, level);
  return image;
}

TEST(Within, TakesBytesOfEitherOutsideAndInside) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 3, 4}) {
      const ImageInfo info = Image(31, 23, channels, type).info();
      const Image source = random_image(info, 1);
      const Image changed = random_image(info, 2);
      Image mask(31, 23, 1);
      for (int y = 0; y < 23; ++y) {
        for (int x = 0; x < 31; ++x) mask.view<std::uint8_t>()(x, y) = (x * 7 + y * 3) % 5 < 2 ? 255 : 0;
      }
      const Image result = within(source, changed, mask);
      const std::size_t bytes = info.pixel_bytes();
      for (int y = 0; y < 23; ++y) {
        for (int x = 0; x < 31; ++x) {
          const Image& expected = (x * 7 + y * 3) % 5 < 2 ? changed : source;
          const auto at = static_cast<std::ptrdiff_t>(bytes) * x;
          ASSERT_TRUE(
              std::equal(result.any().row(y) + at, result.any().row(y) + at + bytes, expected.any().row(y) + at));
        }
      }
    }
  }
}

TEST(Within, CountsPartsOfPixelsOfARectangle) {
  // Columns 1.25–3.5: a quarter is missing of column 1, half of column 3.
  const Image result = within(flat(5, 3, 0), flat(5, 3, 200), {}, {.rect = std::array{1.25F, 0.0F, 2.25F, 2.0F}});
  const int expected[3][5] = {{0, 150, 200, 100, 0}, {0, 150, 200, 100, 0}, {0, 0, 0, 0, 0}};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) EXPECT_EQ(result.view<std::uint8_t>()(x, y), expected[y][x]) << x << ' ' << y;
  }
}

TEST(Within, FeatherRisesInAStraightLineFromTheEdgeInwards) {
  constexpr int kFeather = 4;
  const Image source(ImageInfo{40, 30, 1, PixelType::F32});
  Image black = source.clone();
  Image white = source.clone();
  for (int y = 0; y < 30; ++y) {
    std::fill_n(black.view<float>().row(y), 40, 0.0F);
    std::fill_n(white.view<float>().row(y), 40, 1.0F);
  }
  // The area reaches the image's right edge, which is no edge of the area.
  const Image result =
      within(black, white, {}, {.rect = std::array{10.0F, -50.0F, 100.0F, 200.0F}, .feather = kFeather});
  for (int x = 0; x < 40; ++x) {
    const double expected = std::clamp((2.0 * (x - 9) - 1) / (2 * kFeather + 1), 0.0, 1.0);
    EXPECT_NEAR(result.view<float>()(x, 15), expected, 1.5 / 65535) << x;  // weights are rounded
    EXPECT_EQ(result.view<float>()(x, 15), result.view<float>()(x, 0));
  }
}

TEST(Within, FeatherIsItsDefinition) {
  const unsigned seed = 11;
  Image mask = random_image(Image(29, 17, 1).info(), seed);
  const auto weights = mask.view<std::uint8_t>();
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 29; ++x) {
      if ((x - 14) * (x - 14) + (y - 8) * (y - 8) > 60) weights(x, y) = 0;
    }
  }
  constexpr int kFeather = 3;
  const Image result = within(flat(29, 17, 0), flat(29, 17, 255), mask, {.feather = kFeather});
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 29; ++x) {
      double mean = 0;
      for (int dy = -kFeather; dy <= kFeather; ++dy) {
        for (int dx = -kFeather; dx <= kFeather; ++dx) {
          mean += weights(std::clamp(x + dx, 0, 28), std::clamp(y + dy, 0, 16)) / 255.0 / 49;
        }
      }
      const double expected = weights(x, y) * std::max(0.0, 2 * mean - 1);
      EXPECT_NEAR(result.view<std::uint8_t>()(x, y), expected, 0.51) << x << ' ' << y;
      if (weights(x, y) == 0) {
        EXPECT_EQ(result.view<std::uint8_t>()(x, y), 0);
      }
    }
  }
}

TEST(Within, FindsARegionOfLabels) {
  Image labels(4, 1, 1, PixelType::U16);
  const std::uint16_t ids[] = {300, 7, 0, 300};
  std::copy_n(ids, 4, labels.view<std::uint16_t>().row(0));
  const Image result = within(flat(4, 1, 1), flat(4, 1, 9), labels, {.label = 300});
  for (int x = 0; x < 4; ++x) EXPECT_EQ(result.view<std::uint8_t>()(x, 0), ids[x] == 300 ? 9 : 1);
  EXPECT_EQ(within(flat(4, 1, 1), flat(4, 1, 9), labels, {.label = 0}).view<std::uint8_t>()(2, 0), 9);
}

TEST(Within, HiddenColorsDontBleed) {
  // Half of a transparent red and an opaque blue is blue, half transparent.
  Image source(1, 1, 4);
  Image changed(1, 1, 4);
  const std::uint8_t red[] = {255, 0, 0, 0};
  const std::uint8_t blue[] = {0, 0, 255, 255};
  std::copy_n(red, 4, source.view<std::uint8_t>().row(0));
  std::copy_n(blue, 4, changed.view<std::uint8_t>().row(0));
  const Image result = within(source, changed, {}, {.rect = std::array{0.5F, 0.0F, 1.0F, 1.0F}});
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 0), 0);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 2), 255);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 3), 128);
}

TEST(Within, RefusesWhatDoesntFit) {
  const Image small = flat(2, 2, 0);
  EXPECT_THROW(within(small, flat(3, 2, 0)), Error);
  EXPECT_THROW(within(small, Image(2, 2, 3)), Error);
  EXPECT_THROW(within(small, small, flat(2, 3, 0)), Error);
  EXPECT_THROW(within(small, small, {}, {.label = 1}), Error);
  EXPECT_THROW(within(small, small, {}, {.rect = std::array{0.0F, 0.0F, -1.0F, 2.0F}}), Error);
  EXPECT_THROW(within(small, small, {}, {.feather = 1001}), Error);
}

}  // namespace
}  // namespace azulejo
