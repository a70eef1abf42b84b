#include "azulejo/imaging/histogram_counts.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>
#include <vector>

#include "azulejo/data/image.h"

namespace azulejo {
namespace {

Image bytes(int width, int height, int channels, unsigned seed) {
  Image image(width, height, channels);
  std::mt19937 random(seed);
  std::binomial_distribution<int> value(255, 0.3);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) {
      image.view<std::uint8_t>().row(y)[i] = static_cast<std::uint8_t>(value(random));
    }
  }
  return image;
}

// Large images are counted by pairs of bytes: odd rows have a byte more.
TEST(HistogramCounts, CountsEveryByteOnceInLargeAndSmallImages) {
  for (const auto& [width, height, channels] : {std::tuple{37, 23, 1}, {1001, 701, 1}, {513, 1031, 3}}) {
    const Image image = bytes(width, height, channels, 3);
    std::vector<std::uint64_t> expected(256);
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < width * channels; ++i) ++expected[image.view<std::uint8_t>().row(y)[i]];
    }
    // In two parts, one of which is merged before it is finished.
    const int middle = height / 3;
    HistogramCounts<std::uint8_t> all(image.info(), false);
    HistogramCounts<std::uint8_t> part(image.info(), false);
    all.add(image.any().crop({0, 0, width, middle}));
    part.add(image.any().crop({0, middle, width, height - middle}));
    all.merge(part);
    all.finish();
    EXPECT_EQ(std::vector<std::uint64_t>(all[0].begin(), all[0].end()), expected) << width;
    all.finish();
    EXPECT_EQ(std::vector<std::uint64_t>(all[0].begin(), all[0].end()), expected) << "finished twice";
  }
}

TEST(HistogramCounts, PerChannelTheyAddUpToTheWhole) {
  const Image image = bytes(211, 37, 3, 4);
  HistogramCounts<std::uint8_t> together(image.info(), false);
  HistogramCounts<std::uint8_t> each(image.info(), true);
  together.add(image.any());
  each.add(image.any());
  for (std::size_t v = 0; v < 256; ++v) EXPECT_EQ(each[0][v] + each[1][v] + each[2][v], together[0][v]);
}

}  // namespace
}  // namespace azulejo
