#include "azulejo/imaging/laplacian.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/detail_testing.h"

namespace azulejo {
namespace {

TEST(Laplacian, IsItsDefinition) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const Neighbors neighbors : {Neighbors::Four, Neighbors::Eight}) {
      const Image source = random_image(ImageInfo{37, 19, 3, type}, 2);
      const Image result = laplacian(source, {.neighbors = neighbors});
      ASSERT_EQ(result.type(), PixelType::F32);
      for (int y = 0; y < 19; ++y) {
        for (int x = 0; x < 37; ++x) {
          for (int c = 0; c < 3; ++c) {
            double expected = 0;
            for (int dy = -1; dy <= 1; ++dy) {
              for (int dx = -1; dx <= 1; ++dx) {
                if (neighbors == Neighbors::Four && dx != 0 && dy != 0) continue;
                expected += intensity(source, border_index(x + dx, 37, Border::Mirror),
                                      border_index(y + dy, 19, Border::Mirror), c) -
                            intensity(source, x, y, c);
              }
            }
            // Integers are exact but for 1/full and the product: 2⁻²³ of 8. Sums of f32: eight roundings of 2⁻²² at most.
            ASSERT_NEAR(result.view<float>()(x, y, c), expected, 2e-6) << x << ' ' << y;
          }
        }
      }
    }
  }
}

TEST(Laplacian, IsZeroOnEvenSlopes) {
  Image slope(ImageInfo{40, 30, 1, PixelType::U16});
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) slope.view<std::uint16_t>()(x, y) = static_cast<std::uint16_t>(700 * x + 300 * y + 11);
  }
  const Image result = laplacian(slope, {.neighbors = Neighbors::Eight});
  for (int y = 1; y < 29; ++y) {
    for (int x = 1; x < 39; ++x) EXPECT_EQ(result.view<float>()(x, y), 0.0F);
  }
}

TEST(Laplacian, OfAWhitePixelIsItsKernel) {
  Image source(5, 5, 1);
  for (int y = 0; y < 5; ++y) std::fill_n(source.view<std::uint8_t>().row(y), 5, std::uint8_t{0});
  source.view<std::uint8_t>()(2, 2) = 255;
  const Image four = laplacian(source);
  const Image eight = laplacian(source, {.neighbors = Neighbors::Eight});
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const int distance = std::max(std::abs(x - 2), std::abs(y - 2));
      const bool beside = std::abs(x - 2) + std::abs(y - 2) == 1;
      EXPECT_FLOAT_EQ(four.view<float>()(x, y), distance == 0 ? -4.0F : beside ? 1.0F : 0.0F);
      EXPECT_FLOAT_EQ(eight.view<float>()(x, y), distance == 0 ? -8.0F : distance == 1 ? 1.0F : 0.0F);
    }
  }
}

TEST(Laplacian, HiddenColorsDontCount) {
  Image source(9, 9, 2);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      source.view<std::uint8_t>()(x, y, 0) = static_cast<std::uint8_t>(31 * x + 7 * y);
      source.view<std::uint8_t>()(x, y, 1) = 0;
    }
  }
  const Image result = laplacian(source);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) EXPECT_EQ(result.view<float>()(x, y), 0.0F);
  }
  EXPECT_THROW(laplacian(source, {.border_value = 2}), Error);
}

}  // namespace
}  // namespace azulejo
