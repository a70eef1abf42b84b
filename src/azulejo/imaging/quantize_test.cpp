#include "azulejo/imaging/quantize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "azulejo/imaging/dither_masks.h"
#include "azulejo/imaging/posterize.h"

namespace azulejo {
namespace {

constexpr Dither kAll[] = {Dither::None, Dither::Ordered, Dither::BlueNoise, Dither::FloydSteinberg};
constexpr Dither kDithers[] = {Dither::Ordered, Dither::BlueNoise, Dither::FloydSteinberg};

Image constant(int width, int height, float value) {
  Image image(width, height, 1, PixelType::F32);
  for (int y = 0; y < height; ++y) std::fill_n(image.view<float>().row(y), width, value);
  return image;
}

double light(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

template <class F>
double mean(const Image& image, F f) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += f(static_cast<double>(image.view<float>()(x, y)));
  }
  return sum / image.width() / image.height();
}

TEST(DitherMask, BayersIsThePublishedMatrix) {
  // His 4×4 matrix times 4, in the upper left places of each quarter: D₈ = 4 D₄ + D₂.
  const int four[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  const int two[2][2] = {{0, 2}, {3, 1}};
  const DitherMask mask = bayer_mask();
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(mask.ranks[static_cast<std::size_t>(8 * y + x)], 4 * four[y % 4][x % 4] + two[y / 4][x / 4]);
    }
  }
}

TEST(DitherMask, BlueNoiseHasEachRankOnceAndNoLowFrequencies) {
  const DitherMask mask = blue_noise_mask();
  ASSERT_EQ(mask.size, 64);
  std::vector<int> seen(64 * 64);
  for (const std::uint16_t rank : mask.ranks) ++seen[rank];
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  // The spectrum of a share of the dots: white noise has share · (1 − share) at all frequencies on the average. Below a
  // third of the mean distance's frequency, blue noise has next to nothing, and more than white beyond.
  const double share = 0.25;
  double low = 0, high = 0;
  int lows = 0, highs = 0;
  for (int v = -20; v <= 20; v += 2) {
    for (int u = -20; u <= 20; u += 2) {
      const double frequency = std::hypot(u, v);
      if (frequency == 0 || (frequency > 8 && frequency < 26)) continue;
      double re = 0, im = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          if (mask.threshold(x, y) > share) continue;
          const double angle = 2 * std::acos(-1.0) * (u * x + v * y) / 64;
          re += std::cos(angle);
          im += std::sin(angle);
        }
      }
      const double power = (re * re + im * im) / (64 * 64) / (share * (1 - share));
      (frequency <= 8 ? low : high) += power;
      ++(frequency <= 8 ? lows : highs);
    }
  }
  EXPECT_LT(low / lows, 0.05);
  EXPECT_GT(high / highs, 1.0);
}

TEST(Quantize, WithoutDitherIsPosterize) {
  Image bytes(256, 1, 1);
  for (int v = 0; v < 256; ++v) bytes.view<std::uint8_t>()(v, 0) = static_cast<std::uint8_t>(v);
  for (int levels = 2; levels <= 256; ++levels) {
    const Image a = quantize(bytes, {.levels = levels});
    const Image b = posterize(bytes, {.levels = levels});
    for (int v = 0; v < 256; ++v) {
      ASSERT_EQ(a.view<std::uint8_t>()(v, 0), b.view<std::uint8_t>()(v, 0)) << levels << " levels, " << v;
    }
  }
}

TEST(Quantize, OnlyLevelsOccurAndLevelsStay) {
  std::mt19937 random(1);
  Image source(128, 40, 3);
  for (int y = 0; y < 40; ++y) {
    for (int i = 0; i < 384; ++i) source.view<std::uint8_t>().row(y)[i] = static_cast<std::uint8_t>(random());
  }
  for (const Dither dither : kAll) {
    for (const Light in : {Light::Encoded, Light::Linear}) {
      for (const int levels : {2, 3, 6, 52, 256}) {
        const QuantizeOptions options{levels, dither, in};
        const Image once = quantize(source, options);
        const Image twice = quantize(once, options);
        for (int y = 0; y < 40; ++y) {
          for (int i = 0; i < 384; ++i) {
            const int v = once.view<std::uint8_t>().row(y)[i];
            const double level = v * (levels - 1) / 255.0;
            // Half a stored step, in levels.
            ASSERT_NEAR(level, std::round(level), 0.5 * (levels - 1) / 255 + 1e-9);
            if (levels == 256) {
              ASSERT_EQ(v, source.view<std::uint8_t>().row(y)[i]);
            }
            // Levels that are rounded (5 to 8 bits) are off their places, which error diffusion carries on.
            if (255 % (levels - 1) == 0 || dither != Dither::FloydSteinberg) {
              ASSERT_EQ(twice.view<std::uint8_t>().row(y)[i], v) << levels;
            }
          }
        }
      }
    }
  }
}

// 64 thresholds give shares in steps of 1/64, blue noise in steps of 1/4096; error diffusion keeps all but what is left
// in the last row, less than one level in `width` of its pixels, over all pixels.
double tolerance(Dither dither, int height) {
  return dither == Dither::Ordered ? 0.5 / 64 : dither == Dither::BlueNoise ? 0.5 / 4096 : 0.5 / height;
}

TEST(Quantize, KeepsTheMeanOfConstants) {
  for (const Dither dither : kDithers) {
    for (const int levels : {2, 3, 5}) {
      for (float v = 0; v <= 1; v += 0.0375F) {
        const Image source = constant(128, 128, v);
        const Image result = quantize(source, {levels, dither, Light::Encoded});
        ASSERT_NEAR(mean(result, [](double u) { return u; }), v, tolerance(dither, 128) / (levels - 1) + 1e-6) << v;
        const Image shown = quantize(source, {levels, dither, Light::Linear});
        // The step between the levels around v.
        const double low = std::floor(static_cast<double>(v) * (levels - 1)) / (levels - 1);
        const double step = light(std::min(1.0, low + 1.0 / (levels - 1))) - light(low);
        ASSERT_NEAR(mean(shown, light), light(v), tolerance(dither, 128) * step + 2e-6) << v;
      }
    }
  }
}

TEST(Quantize, KeepsTheMeanAlongARamp) {
  Image ramp(512, 64, 1, PixelType::F32);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 512; ++x) ramp.view<float>()(x, y) = (static_cast<float>(x) + 0.5F) / 512;
  }
  for (const Dither dither : kDithers) {
    const Image result = quantize(ramp, {2, dither});
    for (int left = 0; left < 512; left += 64) {
      double sum = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = left; x < left + 64; ++x) sum += static_cast<double>(result.view<float>()(x, y));
      }
      // Thresholds are compared with values that vary by 1/8 within the block; differences of error diffusion cross
      // its sides and bottom: at most one level for each pixel there, of either sign.
      EXPECT_NEAR(sum / 4096, (left + 32) / 512.0, 0.02) << left;
    }
  }
}

TEST(Quantize, FloydSteinbergFollowsItsDefinition) {
  std::mt19937 random(2);
  Image source(37, 21, 1, PixelType::F32);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) source.view<float>()(x, y) = static_cast<float>(random() % 1024) / 1024;
  }
  const Image result = quantize(source, {5, Dither::FloydSteinberg});
  // Differences are spread forwards here; sums of sixteenths of such values are exact for a few rows only, so values
  // near the middle between levels may fall to the other side: none does in the first rows.
  std::vector<std::vector<double>> value(22, std::vector<double>(37));
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x)
      value[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = source.view<float>()(x, y) * 4.0;
  }
  for (int y = 0; y < 4; ++y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < 37; ++x) {
      const double level = std::clamp(std::floor(value[row][x] + 0.5), 0.0, 4.0);
      ASSERT_EQ(result.view<float>()(static_cast<int>(x), y), static_cast<float>(level / 4)) << x << ", " << y;
      const double left = value[row][x] - level;
      if (x + 1 < 37) value[row][x + 1] += left * 7 / 16;
      value[row + 1][x > 0 ? x - 1 : x] += left * 3 / 16;
      value[row + 1][x] += left * 5 / 16;
      value[row + 1][x + 1 < 37 ? x + 1 : x] += left * 1 / 16;
      if (x + 1 == 37) value[row + 1][x] += left * 7 / 16;
    }
  }
}

TEST(Quantize, HiddenColorsGiveNoDifference) {
  Image a(64, 32, 2);
  Image b(64, 32, 2);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool hidden = x % 3 == 1;
      a.view<std::uint8_t>()(x, y, 0) = b.view<std::uint8_t>()(x, y, 0) = static_cast<std::uint8_t>(4 * x);
      if (hidden) b.view<std::uint8_t>()(x, y, 0) = 99;
      a.view<std::uint8_t>()(x, y, 1) = b.view<std::uint8_t>()(x, y, 1) = hidden ? 0 : 255;
    }
  }
  const Image of_a = quantize(a, {2, Dither::FloydSteinberg});
  const Image of_b = quantize(b, {2, Dither::FloydSteinberg});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (x % 3 == 1) continue;
      ASSERT_EQ(of_a.view<std::uint8_t>()(x, y, 0), of_b.view<std::uint8_t>()(x, y, 0));
    }
  }
}

TEST(Quantize, NaNStaysAndGivesNothing) {
  Image source = constant(40, 10, 0.3F);
  source.view<float>()(7, 3) = std::numeric_limits<float>::quiet_NaN();
  source.view<float>()(9, 3) = std::numeric_limits<float>::infinity();
  for (const Dither dither : kAll) {
    for (const Light in : {Light::Encoded, Light::Linear}) {
      const Image result = quantize(source, {2, dither, in});
      for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 40; ++x) {
          if (x == 7 && y == 3) {
            EXPECT_TRUE(std::isnan(result.view<float>()(x, y)));
          } else {
            EXPECT_TRUE(result.view<float>()(x, y) == 0 || result.view<float>()(x, y) == 1);
          }
        }
      }
      EXPECT_EQ(result.view<float>()(9, 3), 1);
    }
  }
}

}  // namespace
}  // namespace azulejo
