#include "azulejo/imaging/box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// The average by its definition.
double averaged(const Image& image, const BoxOptions& options, int x, int y, int c) {
  double outside = options.border_value * full_range(image.type());
  if (image.type() != PixelType::F32) outside = std::floor(outside + 0.5);
  const int radius_y = options.radius_y.value_or(options.radius);
  double sum = 0;
  for (int dy = -radius_y; dy <= radius_y; ++dy) {
    const int from_y = border_index(y + dy, image.height(), options.border);
    for (int dx = -options.radius; dx <= options.radius; ++dx) {
      const int from_x = border_index(x + dx, image.width(), options.border);
      sum += from_x < 0 || from_y < 0 ? outside : value_at(image, from_x, from_y, c);
    }
  }
  return sum / ((2 * options.radius + 1) * (2 * radius_y + 1));
}

TEST(Box, OfIntegersIsTheAverageRoundedHalfUp) {
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    for (const auto& [radius, radius_y] :
         {std::pair{1, 1}, {2, 1}, {0, 3}, {3, 0}, {5, 5}, {7, 8}, {15, 9}, {31, 20}}) {
      for (int channels = 1; channels <= 3; channels += 2, ++seed) {
        SCOPED_TRACE(testing::Message() << to_string(type) << ", radius " << radius << ", " << radius_y << ", seed "
                                        << seed);
        const BoxOptions options{
            .radius = radius, .radius_y = radius_y, .border = static_cast<Border>(seed % 5), .border_value = 0.4F};
        const Image source = random_image({43, 37, channels, type}, seed);
        const Image result = box(source, options);
        for (int y = 0; y < 37; y += 3) {
          for (int x = 0; x < 43; ++x) {
            const int c = x % channels;
            ASSERT_EQ(value_at(result, x, y, c), std::floor(averaged(source, options, x, y, c) + 0.5))
                << x << ", " << y;
          }
        }
      }
    }
  }
}

// Sums of 1 … 2 · pixels + 1: each remainder is met, and the greatest quotients.
TEST(Box, RoundsEverySumRight) {
  for (const int radius : {1, 2, 3, 4, 5, 6, 7, 8, 15}) {
    const int side = 2 * radius + 1;
    for (const int top : {2, 255}) {
      Image source(3 * side * side, 1, 1);
      for (int x = 0; x < source.width(); ++x) {
        source.view<std::uint8_t>()(x, 0) = static_cast<std::uint8_t>(top - (x * 7919 % side * side < x ? 1 : 0));
      }
      const BoxOptions options{.radius = side * side / 2, .radius_y = 0, .border = Border::Clamp};
      const Image result = box(source, options);
      for (int x = 0; x < source.width(); ++x) {
        ASSERT_EQ(value_at(result, x, 0, 0), std::floor(averaged(source, options, x, 0, 0) + 0.5))
            << radius << ": " << x;
      }
    }
  }
}

/// Sums beyond 16 bits in a column, and beyond 24 bits in all.
TEST(Box, OfLargeWindowsIsTheAverage) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int radius : {85, 90, 130, 300}) {
      const BoxOptions options{.radius = radius, .border = Border::Wrap};
      Image source = random_image({320, 200, 1, type}, static_cast<unsigned>(radius));
      const Image result = box(source, options);
      for (const auto& [x, y] : {std::pair{0, 0}, {319, 199}, {150, 80}, {17, 130}, {255, 63}, {256, 64}}) {
        const double expected = averaged(source, options, x, y, 0);
        const bool exact = type == PixelType::U8 || (type == PixelType::U16 && radius <= 90);
        const double tolerance =
            exact ? 0.5 : (type == PixelType::U16 ? 0.5 : 0) + (2 * radius + 21) * 0x1p-24 * full_range(type);
        ASSERT_NEAR(value_at(result, x, y, 0), expected, tolerance) << to_string(type) << ", radius " << radius;
      }
    }
  }
}

TEST(Box, OfWhiteIsWhite) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    for (const int radius : {1, 7, 8, 90, 128, 1000}) {
      Image source(ImageInfo{130, 3, 1, type});
      visit(source.any(), [](auto view) {
        using T = std::remove_pointer_t<decltype(view.data)>;
        for (int y = 0; y < 3; ++y) std::fill_n(view.row(y), 130, std::numeric_limits<T>::max());
      });
      const Image result = box(source, {.radius = radius});
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 130; ++x) ASSERT_EQ(value_at(result, x, y, 0), full_range(type)) << radius;
      }
    }
  }
}

TEST(Box, OfFloatsIsTheAverage) {
  unsigned seed = 1;
  for (const auto& [radius, radius_y] : {std::pair{1, 1}, {2, 0}, {0, 3}, {6, 11}, {31, 20}}) {
    for (int channels = 1; channels <= 3; channels += 2, ++seed) {
      const BoxOptions options{
          .radius = radius, .radius_y = radius_y, .border = static_cast<Border>(seed % 5), .border_value = 0.4F};
      const Image source = random_image({43, 37, channels, PixelType::F32}, seed);
      const Image result = box(source, options);
      for (int y = 0; y < 37; y += 3) {
        for (int x = 0; x < 43; ++x) {
          const int c = x % channels;
          ASSERT_NEAR(value_at(result, x, y, c), averaged(source, options, x, y, c), (2 * radius_y + 21) * 0x1p-24)
              << x << ", " << y;
        }
      }
    }
  }
}

TEST(Box, WeightsColorsByAlpha) {
  Image source(ImageInfo{2, 1, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight});
  const std::uint8_t pixels[] = {200, 100, 0, 255, 7, 8, 9, 0};
  std::memcpy(source.view<std::uint8_t>().row(0), pixels, 8);
  const Image result = box(source, {.radius = 1, .radius_y = 0, .border = Border::Clamp});
  const auto got = result.view<std::uint8_t>();
  EXPECT_EQ(got(0, 0, 0), 200);
  EXPECT_EQ(got(0, 0, 1), 100);
  EXPECT_EQ(got(0, 0, 3), 170);
  EXPECT_EQ(got(1, 0, 0), 200);
  EXPECT_EQ(got(1, 0, 3), 85);
}

TEST(Box, AveragesLinearLightOnRequest) {
  Image source(ImageInfo{30, 1, 1, PixelType::U8});
  for (int x = 0; x < 30; ++x) source.view<std::uint8_t>()(x, 0) = x % 3 == 0 ? 255 : 0;
  const Image result = box(source, {.radius = 1, .radius_y = 0, .light = Light::Linear});
  const int third = static_cast<int>(linear_to_srgb(1.0F / 3) * 255 + 0.5F);
  for (int x = 1; x < 29; ++x) ASSERT_EQ(result.view<std::uint8_t>()(x, 0), third);
}

TEST(Box, KeepsNaNToTheWindowsThatItIsIn) {
  Image source = random_image({40, 30, 1, PixelType::F32}, 5);
  source.view<float>()(20, 15) = std::numeric_limits<float>::quiet_NaN();
  const Image result = box(source, {.radius = 4, .radius_y = 2});
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(std::isnan(result.view<float>()(x, y)), std::abs(x - 20) <= 4 && std::abs(y - 15) <= 2);
    }
  }
}

/// The average of averages is the average by the larger window's weights: 1 2 3 2 1 in both directions.
TEST(Box, TwiceIsATent) {
  const Image source = random_image({60, 50, 1, PixelType::F32}, 9);
  const Image twice = box(box(source, {.radius = 1}), {.radius = 1});
  const int weights[] = {1, 2, 3, 2, 1};
  for (int y = 2; y < 48; ++y) {
    for (int x = 2; x < 58; ++x) {
      double sum = 0;
      for (int dy = 0; dy < 5; ++dy) {
        for (int dx = 0; dx < 5; ++dx) sum += weights[dx] * weights[dy] * value_at(source, x + dx - 2, y + dy - 2, 0);
      }
      ASSERT_NEAR(twice.view<float>()(x, y), sum / 81, 1e-6);
    }
  }
}

}  // namespace
}  // namespace azulejo
