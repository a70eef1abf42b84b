#include "azulejo/imaging/weighted_median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/median.h"

namespace azulejo {
namespace {

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// Each value as many times as it counts, sorted; the lower middle.
double middle(const Image& image, const WeightedMedianOptions& options, int x, int y, int c) {
  double outside = options.border_value * full_range(image.type());
  if (image.type() != PixelType::F32) outside = std::floor(outside + 0.5);
  const NumberGrid& weights = options.weights;
  std::vector<double> values;
  for (int dy = 0; dy < weights.rows; ++dy) {
    const int from_y = border_index(y + dy - weights.rows / 2, image.height(), options.border);
    for (int dx = 0; dx < weights.columns; ++dx) {
      const int from_x = border_index(x + dx - weights.columns / 2, image.width(), options.border);
      const double value = from_x < 0 || from_y < 0 ? outside : value_at(image, from_x, from_y, c);
      values.insert(values.end(), static_cast<std::size_t>(weights(dy, dx)), value);
    }
  }
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

TEST(WeightedMedian, IsTheMiddleOfTheRepeatedValues) {
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const auto& [rows, columns, most] :
         {std::tuple{1, 1, 4}, {3, 3, 5}, {5, 1, 3}, {1, 7, 90}, {5, 9, 40}, {9, 3, 1000}}) {
      for (const int channels : {1, 3}) {
        SCOPED_TRACE(testing::Message() << to_string(type) << ", " << rows << "×" << columns << ", seed " << seed);
        std::mt19937 random(seed);
        WeightedMedianOptions options{.border = static_cast<Border>(seed % 5), .border_value = 0.4F};
        options.weights = {rows, columns, {}};
        for (int i = 0; i < rows * columns; ++i) {
          options.weights.values.push_back(static_cast<float>(random() % static_cast<unsigned>(most + 1)));
        }
        options.weights.values[0] += 1;
        if (options.weights.values[0] > 1000) options.weights.values[0] = 1000;
        const Image source = random_image({43, 31, channels, type}, seed++);
        const Image result = weighted_median(source, options);
        for (int y = 0; y < 31; y += 3) {
          for (int x = 0; x < 43; x += 2) {
            const int c = x % channels;
            ASSERT_EQ(value_at(result, x, y, c), middle(source, options, x, y, c)) << x << ", " << y;
          }
        }
      }
    }
  }
}

TEST(WeightedMedian, OfOnesIsTheMedian) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image source = random_image({70, 50, 1, type}, 4);
    const Image expected = median(source, {.radius = 2});
    WeightedMedianOptions options;
    options.weights = {5, 5, std::vector<float>(25, 1.0F)};
    const Image result = weighted_median(source, options);
    for (int y = 0; y < 50; ++y) {
      for (int x = 0; x < 70; ++x) ASSERT_EQ(value_at(result, x, y, 0), value_at(expected, x, y, 0));
    }
  }
}

TEST(WeightedMedian, WithMoreThanHalfInTheMiddleIsACopy) {
  const Image source = random_image({60, 40, 1, PixelType::U8}, 4);
  WeightedMedianOptions options;
  options.weights = {3, 3, {1, 1, 1, 1, 9, 1, 1, 1, 1}};
  const Image result = weighted_median(source, options);
  for (int y = 0; y < 40; ++y) {
    ASSERT_EQ(std::memcmp(result.view<std::uint8_t>().row(y), source.view<std::uint8_t>().row(y), 60), 0);
  }
}

/// A line of one pixel: three of nine for a median, 2 + 5 + 2 of 17 by default. A speck is 5 of 17.
TEST(WeightedMedian, KeepsLinesThatAMedianTakesAway) {
  Image source(40, 30, 1);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) source.view<std::uint8_t>()(x, y) = y == 11 ? 200 : 30;
  }
  source.view<std::uint8_t>()(7, 20) = 255;
  const Image result = weighted_median(source);
  EXPECT_EQ(result.view<std::uint8_t>()(20, 11), 200);
  EXPECT_EQ(result.view<std::uint8_t>()(7, 20), 30);
  EXPECT_EQ(median(source, {.radius = 1}).view<std::uint8_t>()(20, 11), 30);
}

TEST(WeightedMedian, RefusesOtherWeights) {
  const Image source(8, 8, 1);
  const auto message = [&](const NumberGrid& weights) {
    WeightedMedianOptions options;
    options.weights = weights;
    try {
      (void)weighted_median(source, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Argument);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({2, 1, {1, 1}}), "weighted_median: weights: 2 rows of 1 numbers, expected odd numbers up to 65");
  EXPECT_EQ(message({1, 3, {1, 1.5F, 1}}), "weighted_median: weights: 1.5, expected whole numbers");
  EXPECT_EQ(message({1, 1, {0}}), "weighted_median: weights: a sum of 0, expected 1 to 32767");
  EXPECT_NE(message({1, 1, {-1}}), "");
  EXPECT_NE(message({}), "");
}

}  // namespace
}  // namespace azulejo
