#include "azulejo/imaging/median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// The middle of the sorted window.
double middle(const Image& image, const MedianOptions& options, int x, int y, int c) {
  double outside = options.border_value * full_range(image.type());
  if (image.type() != PixelType::F32) outside = std::floor(outside + 0.5);
  std::vector<double> window;
  for (int dy = -options.radius; dy <= options.radius; ++dy) {
    const int from_y = border_index(y + dy, image.height(), options.border);
    for (int dx = -options.radius; dx <= options.radius; ++dx) {
      const int from_x = border_index(x + dx, image.width(), options.border);
      window.push_back(from_x < 0 || from_y < 0 ? outside : value_at(image, from_x, from_y, c));
    }
  }
  std::sort(window.begin(), window.end());
  return window[window.size() / 2];
}

/// Few different values, so that many are equal; f32 below 0, too.
Image coarse_image(const ImageInfo& info, unsigned seed) {
  Image image = random_image(info, seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        T& value = view.row(y)[i];
        if constexpr (std::is_same_v<T, float>) {
          value = std::floor(value * 9) - 4;
        } else {
          value = static_cast<T>(value / 50 * 50);
        }
      }
    }
  });
  return image;
}

TEST(Median, IsTheMiddleOfTheSortedWindow) {
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int radius : {1, 2, 3, 4, 5, 8, 20}) {
      for (int channels = 1; channels <= 4; ++channels, ++seed) {
        for (const bool coarse : {false, true}) {
          SCOPED_TRACE(testing::Message() << to_string(type) << ", radius " << radius << ", seed " << seed);
          MedianOptions options{.radius = radius, .border = static_cast<Border>(seed % 5), .border_value = 0.4F};
          const ImageInfo info{41, 33, channels, type};
          const Image source = coarse ? coarse_image(info, seed) : random_image(info, seed);
          const Image result = median(source, options);
          for (int y = 0; y<33; y += radius> 8 ? 8 : 3) {
            for (int x = 0; x < 41; ++x) {
              const int c = x % channels;
              ASSERT_EQ(value_at(result, x, y, c), middle(source, options, x, y, c))
                  << x << ", " << y << ", " << coarse;
            }
          }
        }
      }
    }
  }
}

/// Several blocks, of both ways to compute large windows, the larger with more values than 16 bits number.
TEST(Median, OfLargeWindowsIsTheMiddleOfTheSortedWindow) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int radius : {30, 127, 128}) {
      const MedianOptions options{.radius = radius};
      const Image source = random_image({300, 170, 1, type}, static_cast<unsigned>(radius));
      const Image result = median(source, options);
      for (const auto& [x, y] : {std::pair{0, 0}, {299, 169}, {150, 80}, {17, 130}, {255, 63}, {256, 64}}) {
        ASSERT_EQ(value_at(result, x, y, 0), middle(source, options, x, y, 0))
            << to_string(type) << ", radius " << radius << ", " << x << ", " << y;
      }
    }
  }
}

/// The median commutes with what keeps or turns round the order of values.
TEST(Median, OfTheNegativeIsTheNegative) {
  for (const int radius : {1, 2, 3, 4, 6, 40}) {
    const Image source = random_image({90, 70, 1, PixelType::U8}, static_cast<unsigned>(radius));
    Image negative = source.clone();
    const auto pixels = negative.view<std::uint8_t>();
    for (int y = 0; y < 70; ++y) {
      for (int x = 0; x < 90; ++x) pixels(x, y) = static_cast<std::uint8_t>(255 - pixels(x, y));
    }
    const Image a = median(source, {.radius = radius});
    const Image b = median(negative, {.radius = radius});
    for (int y = 0; y < 70; ++y) {
      for (int x = 0; x < 90; ++x) {
        ASSERT_EQ(a.view<std::uint8_t>()(x, y), 255 - b.view<std::uint8_t>()(x, y)) << radius << ": " << x << ", " << y;
      }
    }
  }
}

TEST(Median, OfTheTurnedImageIsTheTurnedMedian) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int radius : {1, 2, 3, 4, 7, 33}) {
      const Image source = random_image({83, 61, 1, type}, static_cast<unsigned>(radius));
      Image turned(ImageInfo{61, 83, 1, type});
      visit(source.any(), [&](auto view) {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
        const auto to = turned.view<T>();
        for (int y = 0; y < 61; ++y) {
          for (int x = 0; x < 83; ++x) to(y, x) = view(x, y);
        }
      });
      const Image a = median(source, {.radius = radius});
      const Image b = median(turned, {.radius = radius});
      for (int y = 0; y < 61; ++y) {
        for (int x = 0; x < 83; ++x) ASSERT_EQ(value_at(a, x, y, 0), value_at(b, y, x, 0)) << radius;
      }
    }
  }
}

TEST(Median, RemovesSpecksAndKeepsEdges) {
  for (const int radius : {1, 3, 9}) {
    Image source(80, 60, 1);
    const auto pixels = source.view<std::uint8_t>();
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) pixels(x, y) = x < 37 ? 20 : 200;
    }
    const Image edge = source.clone();
    for (int y = 5; y < 60; y += 23) {
      for (int x = 6; x < 80; x += 22) pixels(x, y) = 255;
    }
    const Image result = median(source, {.radius = radius});
    for (int y = 0; y < 60; ++y) {
      ASSERT_EQ(std::memcmp(result.view<std::uint8_t>().row(y), edge.view<std::uint8_t>().row(y), 80), 0) << radius;
    }
  }
}

TEST(Median, CountsNaNAsAboveInfinity) {
  for (const float nan : {kNaN, -kNaN}) {
    const std::vector<std::pair<std::vector<float>, float>> rows = {
        {{nan, 1, 2}, 2}, {{nan, nan, 2}, kNaN}, {{nan, kInfinity, 2}, kInfinity}, {{-kInfinity, nan, -3}, -3}};
    for (const auto& [row, expected] : rows) {
      Image source(ImageInfo{3, 1, 1, PixelType::F32});
      std::copy(row.begin(), row.end(), source.view<float>().row(0));
      const float middle = median(source, {.radius = 1}).view<float>()(1, 0);
      EXPECT_TRUE(middle == expected || (std::isnan(middle) && std::isnan(expected))) << middle << ", " << expected;
    }
  }
  Image source(ImageInfo{40, 40, 1, PixelType::F32});
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) source.view<float>()(x, y) = x % 2 == 0 ? -kNaN : x % 4 == 1 ? -0.0F : -5.0F;
  }
  // 6 columns of NaN, 7 of numbers, or the other way: the greatest number, or NaN.
  const Image result = median(source, {.radius = 6});
  EXPECT_TRUE(std::isnan(result.view<float>()(10, 10)));
  EXPECT_EQ(result.view<float>()(11, 10), 0.0F);
  EXPECT_TRUE(std::signbit(result.view<float>()(11, 10)));
}

TEST(Median, OfRadiusZeroIsACopy) {
  const Image source = random_image({13, 9, 4, PixelType::U16}, 3);
  const Image result = median(source, {.radius = 0});
  for (int y = 0; y < 9; ++y) {
    ASSERT_EQ(std::memcmp(result.view<std::uint16_t>().row(y), source.view<std::uint16_t>().row(y), 13 * 4 * 2), 0);
  }
}

TEST(Median, RefusesRadiiOutOfRange) {
  const Image source(4, 4, 1);
  try {
    (void)median(source, {.radius = -1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Argument);
    EXPECT_EQ(std::string(error.what()), "median: radius: -1, expected a whole number from 0 to 1000 px");
  }
}

}  // namespace
}  // namespace azulejo
