#include "azulejo/imaging/histogram.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

TEST(Histogram, CountsEveryValue) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int bins : {1, 7, 100, 256}) {
      const Image image = random_image(ImageInfo{53, 29, 3, type}, 4);
      const Histogram found = histogram(image, {.bins = bins});
      std::vector<std::vector<std::uint64_t>> expected(3,
                                                       std::vector<std::uint64_t>(static_cast<std::size_t>(bins), 0));
      visit(image.any(), [&](auto view) {
        for (int y = 0; y < 29; ++y) {
          for (int i = 0; i < 53 * 3; ++i) {
            const double levels = type == PixelType::U8 ? 256 : 65536;
            const double value = static_cast<double>(view.row(y)[i]);
            const double level =
                type == PixelType::F32
                    ? static_cast<double>(static_cast<long>(static_cast<float>(value) * 65535.0F + 0.5F))
                    : value;
            ++expected[static_cast<std::size_t>(i % 3)][static_cast<std::size_t>(level * bins / levels)];
          }
        }
      });
      EXPECT_EQ(found.counts, expected) << to_string(type) << ' ' << bins;
      EXPECT_EQ(found.names, (std::vector<std::string>{"red", "green", "blue"}));
      EXPECT_EQ(found.bins, bins);
    }
  }
}

TEST(Histogram, FloatsBeyondTheRangeCountAtItsEnds) {
  Image image(ImageInfo{4, 1, 1, PixelType::F32});
  const float values[] = {-5, 7, std::numeric_limits<float>::quiet_NaN(), 0.5F};
  std::copy_n(values, 4, image.view<float>().row(0));
  EXPECT_EQ(histogram(image, {.bins = 4}).counts[0], (std::vector<std::uint64_t>{1, 0, 1, 1}));
}

TEST(Histogram, BarsAreAsHighAsTheCounts) {
  // Levels 0, 64, 128, 192 occur 1, 2, 4 and 0 times.
  Image image(7, 1, 1);
  const std::uint8_t values[] = {0, 64, 64, 128, 128, 128, 128};
  std::copy_n(values, 7, image.view<std::uint8_t>().row(0));
  const auto bars = [&](const HistogramOptions& options) {
    const Image chart = histogram_chart(image, options);
    std::vector<int> heights;
    for (int bin = 0; bin < 4; ++bin) {
      int height = 0;
      for (int y = 0; y < chart.height(); ++y) height += chart.view<std::uint8_t>()(bin * 16 + 5, y) < 255 ? 1 : 0;
      heights.push_back(height);
    }
    return heights;
  };
  HistogramOptions options{.bins = 4, .width = 64, .height = 100};
  EXPECT_EQ(bars(options), (std::vector<int>{25, 50, 100, 0}));
  options.cumulative = true;
  EXPECT_EQ(bars(options), (std::vector<int>{14, 43, 100, 100}));  // 1/7, 3/7
  options.cumulative = false;
  options.logarithmic = true;
  EXPECT_EQ(bars(options), (std::vector<int>{43, 68, 100, 0}));  // log 2 / log 5, log 3 / log 5
}

TEST(Histogram, ChannelsThatShareAreGray) {
  Image image(2, 1, 3);
  const std::uint8_t values[] = {10, 10, 10, 200, 100, 100};
  std::copy_n(values, 6, image.view<std::uint8_t>().row(0));
  const Image chart = histogram_chart(image, {.width = 256, .height = 16});
  const auto pixel = [&](int x) {
    const std::uint8_t* const p = &chart.view<std::uint8_t>()(x, 15);
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  EXPECT_EQ(pixel(50), (std::array{255, 255, 255}));
  EXPECT_LT(pixel(10)[0], 120);
  EXPECT_LT(pixel(10)[1], 120);
  EXPECT_LT(pixel(10)[2], 120);
  EXPECT_GT(pixel(200)[0], pixel(200)[1] + 100) << "red alone";
  EXPECT_LT(pixel(100)[0], pixel(100)[1]) << "green and blue";
}

TEST(Histogram, RefusesMoreBinsThanLevels) {
  EXPECT_THROW(histogram(Image(2, 2, 1), {.bins = 257}), Error);
  EXPECT_NO_THROW(histogram(Image(2, 2, 1, PixelType::U16), {.bins = 65536}));
}

}  // namespace
}  // namespace azulejo
