#include "azulejo/imaging/clahe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "azulejo/imaging/clahe_tables.h"

namespace azulejo {
namespace {

template <class T>
Image random_image(int width, int height, int channels, unsigned seed) {
  Image image(width, height, channels, kPixelTypeOf<T>);
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 0.08F);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * channels; ++i) {
      const float value = 0.5F + 0.3F * std::sin(static_cast<float>(i + 2 * y) * 0.05F) + noise(random);
      const float top = full_range(kPixelTypeOf<T>);
      image.view<T>().row(y)[i] = static_cast<T>(std::clamp(value, 0.0F, 1.0F) * top);
    }
  }
  return image;
}

/// The definition in double precision, of one channel: piecewise linear cumulative histograms over [0, 1].
struct Definition {
  int tiles;
  double clip;
  int bins;

  /// The cumulative histogram at `u` of the tile's values, each 0–1, clipped by bisection.
  double mapped(const std::vector<double>& values, double u) const {
    std::vector<double> counts(static_cast<std::size_t>(bins));
    for (const double v : values) ++counts[static_cast<std::size_t>(std::min(bins - 1.0, std::floor(v * bins)))];
    const double all = static_cast<double>(values.size());
    const double limit = clip * all / bins;
    const auto filled = [&](double more) {
      double sum = 0;
      for (const double count : counts) sum += std::min(limit, count + more);
      return sum;
    };
    double low = 0, high = all;
    for (int i = 0; i < 100; ++i) (filled((low + high) / 2) < all ? low : high) = (low + high) / 2;
    const double place = u * bins;
    const int bin = static_cast<int>(std::min(bins - 1.0, std::floor(place)));
    double below = 0;
    for (int b = 0; b < bin; ++b) below += std::min(limit, counts[static_cast<std::size_t>(b)] + high);
    return (below + (place - bin) * std::min(limit, counts[static_cast<std::size_t>(bin)] + high)) / all;
  }

  /// Of a gray image whose values are 0–1 at `unit(x, y)`; what stands for u is given back.
  template <class Unit>
  double at(int x, int y, int width, int height, Unit unit) const {
    const auto begin = [&](int tile, int size) { return tile * size / tiles; };
    const auto center = [&](int tile, int size) { return (begin(tile, size) + begin(tile + 1, size)) / 2.0; };
    const auto around = [&](double at, int size) {
      int high = 0;
      while (high < tiles && center(high, size) <= at) ++high;
      const int low = std::max(0, high - 1);
      high = std::min(high, tiles - 1);
      const double weight = low == high ? 0 : (at - center(low, size)) / (center(high, size) - center(low, size));
      return std::tuple{low, high, weight};
    };
    const auto [left, right, across] = around(x + 0.5, width);
    const auto [above, below, down] = around(y + 0.5, height);
    const auto tile = [&](int row, int column) {
      std::vector<double> values;
      for (int v = begin(row, height); v < begin(row + 1, height); ++v) {
        for (int u = begin(column, width); u < begin(column + 1, width); ++u) values.push_back(unit(u, v));
      }
      return mapped(values, unit(x, y));
    };
    return (tile(above, left) * (1 - across) + tile(above, right) * across) * (1 - down) +
           (tile(below, left) * (1 - across) + tile(below, right) * across) * down;
  }
};

TEST(Clahe, FollowsTheDefinitionInBytes) {
  const Image source = random_image<std::uint8_t>(150, 67, 1, 1);  // stretches long enough for vectors, and short ones
  for (const double clip : {1.5, 4.0, 1000.0}) {
    const Image result = clahe(source, {.columns = 3, .rows = 3, .clip = static_cast<float>(clip)});
    const Definition definition{3, clip, 256};
    for (int y = 0; y < 67; y += 7) {
      for (int x = 0; x < 150; x += 13) {
        const auto unit = [&](int u, int v) { return (source.view<std::uint8_t>()(u, v) + 0.5) / 256; };
        const double exact = definition.at(x, y, 150, 67, unit) * 256 - 0.5;
        // Tables (cut by up to 1/128), rows and columns are rounded to 1/128, weights to 2⁻¹⁵ of up to 256, the result
        // to a whole.
        ASSERT_NEAR(result.view<std::uint8_t>()(x, y), exact, 0.5 + 4.0 / 256 + 2 * 256.0 / 65536) << x << ", " << y;
      }
    }
  }
}

TEST(Clahe, FollowsTheDefinitionIn16BitsAndFloats) {
  const Image words = random_image<std::uint16_t>(150, 67, 1, 2);
  const Image floats = random_image<float>(150, 67, 1, 3);
  const Image mapped_words = clahe(words, {.columns = 2, .rows = 2, .clip = 3});
  const Image mapped_floats = clahe(floats, {.columns = 2, .rows = 2, .clip = 3});
  const Definition definition{2, 3, 1024};
  for (int y = 0; y < 67; y += 9) {
    for (int x = 0; x < 150; x += 13) {
      const auto word = [&](int u, int v) { return (words.view<std::uint16_t>()(u, v) + 0.5) / 65536; };
      const auto real = [&](int u, int v) { return double{floats.view<float>()(u, v)}; };
      // Weights are rounded to 2⁻¹⁵, sums of values up to 1 in f32; a float near a bin's end is in the next.
      ASSERT_NEAR((mapped_words.view<std::uint16_t>()(x, y) + 0.5) / 65536, definition.at(x, y, 150, 67, word), 4e-5);
      ASSERT_NEAR(mapped_floats.view<float>()(x, y), definition.at(x, y, 150, 67, real), 4e-5);
    }
  }
}

TEST(Clahe, ALimitOfOneChangesNothing) {
  const ClaheOptions options{.columns = 3, .rows = 2, .clip = 1};
  const Image bytes = random_image<std::uint8_t>(161, 40, 3, 4);
  const Image words = random_image<std::uint16_t>(161, 40, 1, 5);
  const Image floats = random_image<float>(161, 40, 1, 6);
  const Image byte_result = clahe(bytes, options);
  const Image word_result = clahe(words, options);
  const Image float_result = clahe(floats, options);
  for (int y = 0; y < 40; ++y) {
    for (int i = 0; i < 3 * 161; ++i)
      ASSERT_EQ(byte_result.view<std::uint8_t>().row(y)[i], bytes.view<std::uint8_t>().row(y)[i]);
    for (int x = 0; x < 161; ++x) {
      ASSERT_EQ(word_result.view<std::uint16_t>()(x, y), words.view<std::uint16_t>()(x, y));
      // A sum of two numbers below 1 that is exact but for its last bit.
      ASSERT_NEAR(float_result.view<float>()(x, y), floats.view<float>()(x, y), 6e-8F);
    }
  }
}

TEST(Clahe, OfTheInverseIsTheInverse) {
  const Image source = random_image<std::uint8_t>(160, 96, 1, 7);
  Image inverse(160, 96, 1);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 160; ++x)
      inverse.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(255 - source.view<std::uint8_t>()(x, y));
  }
  const Image a = clahe(source);
  const Image b = clahe(inverse);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 160; ++x) {
      // Halves are rounded up, both times.
      ASSERT_NEAR(a.view<std::uint8_t>()(x, y) + b.view<std::uint8_t>()(x, y), 255, 1) << x << ", " << y;
    }
  }
}

TEST(Clahe, NoTileHasMoreContrastThanTheLimit) {
  // One tile: the mapping is the same everywhere, and read off the values that occur.
  const Image source = random_image<std::uint8_t>(200, 200, 1, 8);
  for (const float clip : {1.25F, 2.0F, 5.0F}) {
    const Image result = clahe(source, {.columns = 1, .rows = 1, .clip = clip});
    std::vector<int> mapping(256, -1);
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) mapping[source.view<std::uint8_t>()(x, y)] = result.view<std::uint8_t>()(x, y);
    }
    int last = -1;
    bool steep = false;
    for (int v = 0; v < 256; ++v) {
      const int now = mapping[static_cast<std::size_t>(v)];
      if (now < 0) continue;
      if (last >= 0) {
        const int before = mapping[static_cast<std::size_t>(last)];
        EXPECT_GE(now, before);
        EXPECT_LE(now - before, clip * static_cast<float>(v - last) + 1) << v;  // both ends are rounded
        steep |= static_cast<float>(now - before) > 1.2F * static_cast<float>(v - last);
      }
      last = v;
    }
    EXPECT_TRUE(steep || clip < 2);
  }
}

TEST(Clahe, ClippingKeepsTheSumAndTheLimit) {
  std::mt19937 random(9);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint64_t> counts(256);
    for (auto& count : counts) count = random() % 4 == 0 ? random() % 1000 : random() % 7;
    std::vector<double> clipped(256);
    const double all = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
    for (const double clip : {1.0, 1.1, 3.0, 300.0}) {
      clahe_clip(counts, clip, clipped);
      EXPECT_NEAR(std::accumulate(clipped.begin(), clipped.end(), 0.0), all, 1e-6);
      for (std::size_t b = 0; b < 256; ++b) {
        EXPECT_LE(clipped[b], clip * all / 256 * (1 + 1e-12));
        EXPECT_GE(clipped[b], std::min(static_cast<double>(counts[b]), clip * all / 256) * (1 - 1e-12));
      }
    }
  }
}

TEST(Clahe, KeepsChroma) {
  // Luma changes by as much as each channel; no value saturates here.
  Image source = random_image<float>(64, 48, 3, 10);
  const Image result = clahe(source, {.columns = 2, .rows = 2});
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto a = source.view<float>();
      const auto b = result.view<float>();
      ASSERT_NEAR(b(x, y, 0) - b(x, y, 1), a(x, y, 0) - a(x, y, 1), 3e-7);
      ASSERT_NEAR(b(x, y, 2) - b(x, y, 1), a(x, y, 2) - a(x, y, 1), 3e-7);
    }
  }
}

TEST(Clahe, OfGrayColorsIsThatOfGrayAndSoIsEachChannelsOwn) {
  const Image gray = random_image<std::uint8_t>(130, 60, 1, 11);
  Image colors(130, 60, 3);
  for (int y = 0; y < 60; ++y) {
    for (int i = 0; i < 390; ++i) colors.view<std::uint8_t>().row(y)[i] = gray.view<std::uint8_t>()(i / 3, y);
  }
  const Image expected = clahe(gray);
  const Image by_luma = clahe(colors);
  const Image by_channel = clahe(colors, {.per_channel = true});
  for (int y = 0; y < 60; ++y) {
    for (int i = 0; i < 390; ++i) {
      ASSERT_EQ(by_luma.view<std::uint8_t>().row(y)[i], expected.view<std::uint8_t>()(i / 3, y));
      ASSERT_EQ(by_channel.view<std::uint8_t>().row(y)[i], expected.view<std::uint8_t>()(i / 3, y));
    }
  }
}

TEST(Clahe, HiddenColorsDoNotCount) {
  Image a = random_image<std::uint8_t>(60, 40, 4, 12);
  Image b = a.clone();
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) {
      const bool hidden = (x + y) % 3 == 0;
      a.view<std::uint8_t>()(x, y, 3) = b.view<std::uint8_t>()(x, y, 3) = hidden ? 0 : 200;
      if (hidden) b.view<std::uint8_t>()(x, y, 1) = 255;
    }
  }
  const Image of_a = clahe(a);
  const Image of_b = clahe(b);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) {
      if ((x + y) % 3 == 0) continue;
      for (int c = 0; c < 4; ++c)
        ASSERT_EQ(of_a.view<std::uint8_t>()(x, y, c), of_b.view<std::uint8_t>()(x, y, c)) << x << ", " << y;
      ASSERT_EQ(of_a.view<std::uint8_t>()(x, y, 3), 200);
    }
  }
}

TEST(Clahe, NaNStaysAndIsNotCounted) {
  Image source = random_image<float>(80, 20, 1, 13);
  const Image before = clahe(source, {.columns = 1, .rows = 1});
  Image more(81, 20, 1, PixelType::F32);
  for (int y = 0; y < 20; ++y) {
    std::copy_n(source.view<float>().row(y), 80, more.view<float>().row(y));
    more.view<float>()(80, y) = std::numeric_limits<float>::quiet_NaN();
  }
  const Image result = clahe(more, {.columns = 1, .rows = 1});
  for (int y = 0; y < 20; ++y) {
    EXPECT_TRUE(std::isnan(result.view<float>()(80, y)));
    for (int x = 0; x < 80; ++x) ASSERT_EQ(result.view<float>()(x, y), before.view<float>()(x, y));
  }
}

}  // namespace
}  // namespace azulejo
