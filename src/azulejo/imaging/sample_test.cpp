#include "azulejo/imaging/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace azulejo {
namespace {

Image random_floats(int width, int height, unsigned seed) {
  Image image(width, height, 1, PixelType::F32);
  std::mt19937 random(seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.view<float>()(x, y) = static_cast<float>(random() % 4096) / 4096;
  }
  return image;
}

/// The definition: a normalized product of weights of the pixels there are.
double expected(const Image& source, const SampleOptions& options, int i, int j) {
  const int n = options.step;
  const auto weight = [&](int k, int at, int size) {
    const int begin = at * n;
    const int end = std::min(begin + n, size);
    if (options.prefilter == Prefilter::None) return k == (begin + end - 1) / 2 ? 1.0 : 0.0;
    if (options.prefilter == Prefilter::Box) return k >= begin && k < end ? 1.0 : 0.0;
    const double distance = k + 0.5 - (begin + end) / 2.0;
    return std::exp(-distance * distance / (2 * (n / 2.0) * (n / 2.0)));
  };
  double sum = 0, all = 0;
  for (int y = 0; y < source.height(); ++y) {
    for (int x = 0; x < source.width(); ++x) {
      const double w = weight(x, i, source.width()) * weight(y, j, source.height());
      sum += w * static_cast<double>(source.view<float>()(x, y));
      all += w;
    }
  }
  return sum / all;
}

TEST(Sample, FollowsItsDefinition) {
  const Image source = random_floats(43, 29, 1);
  for (const Prefilter prefilter : {Prefilter::None, Prefilter::Box, Prefilter::Gaussian}) {
    for (const int step : {1, 2, 5, 8, 29, 100}) {
      const SampleOptions options{step, prefilter, false, Light::Encoded};
      const Image result = sample(source, options);
      ASSERT_EQ(result.width(), (43 + step - 1) / step);
      ASSERT_EQ(result.height(), (29 + step - 1) / step);
      for (int j = 0; j < result.height(); ++j) {
        for (int i = 0; i < result.width(); ++i) {
          // Rounding of sums in f32; of the Gaussian, what is cut off: beyond 4 σ, 6·10⁻⁵ of the weight in each
          // direction, and as much again for the edge that cuts asymmetrically.
          const double tolerance = prefilter == Prefilter::Gaussian ? 2.5e-4 : 1e-6;
          ASSERT_NEAR(result.view<float>()(i, j), expected(source, options, i, j), tolerance)
              << step << ": " << i << ", " << j;
        }
      }
    }
  }
}

TEST(Sample, BoxOfBytesIsTheRoundedMean) {
  std::mt19937 random(4);
  Image source(101, 67, 3);
  for (int y = 0; y < 67; ++y) {
    for (int i = 0; i < 303; ++i) source.view<std::uint8_t>().row(y)[i] = static_cast<std::uint8_t>(random());
  }
  for (const int step : {2, 8, 64}) {
    const Image result = sample(source, {step, Prefilter::Box, false, Light::Encoded});
    for (int j = 0; j < result.height(); ++j) {
      for (int i = 0; i < result.width(); ++i) {
        for (int c = 0; c < 3; ++c) {
          long sum = 0, area = 0;
          for (int y = j * step; y < std::min(67, (j + 1) * step); ++y) {
            for (int x = i * step; x < std::min(101, (i + 1) * step); ++x, ++area)
              sum += source.view<std::uint8_t>()(x, y, c);
          }
          ASSERT_EQ(result.view<std::uint8_t>()(i, j, c), (2 * sum + area) / (2 * area)) << step;
        }
      }
    }
  }
}

TEST(Sample, OfStepOneIsTheImage) {
  const Image source = random_floats(31, 17, 2);
  for (const Prefilter prefilter : {Prefilter::None, Prefilter::Box}) {
    for (const bool show : {false, true}) {
      const Image result = sample(source, {1, prefilter, show, Light::Encoded});
      for (int y = 0; y < 17; ++y) {
        for (int x = 0; x < 31; ++x) ASSERT_EQ(result.view<float>()(x, y), source.view<float>()(x, y));
      }
    }
  }
}

TEST(Sample, ShownEachFillsItsSquare) {
  const Image source = random_floats(45, 31, 3);
  for (const Prefilter prefilter : {Prefilter::None, Prefilter::Box, Prefilter::Gaussian}) {
    const Image samples = sample(source, {7, prefilter});
    const Image shown = sample(source, {7, prefilter, true});
    ASSERT_EQ(shown.info(), source.info());
    for (int y = 0; y < 31; ++y) {
      for (int x = 0; x < 45; ++x) ASSERT_EQ(shown.view<float>()(x, y), samples.view<float>()(x / 7, y / 7));
    }
  }
}

TEST(Sample, KeepsConstants) {
  for (const Prefilter prefilter : {Prefilter::None, Prefilter::Box, Prefilter::Gaussian}) {
    for (const Light in : {Light::Encoded, Light::Linear}) {
      for (const int step : {3, 8, 200}) {
        Image words(230, 90, 3, PixelType::U16);
        for (int y = 0; y < 90; ++y) std::fill_n(words.view<std::uint16_t>().row(y), 690, std::uint16_t{51'234});
        const Image result = sample(words, {step, prefilter, true, in});
        for (int y = 0; y < 90; ++y) {
          for (int i = 0; i < 690; ++i) ASSERT_EQ(result.view<std::uint16_t>().row(y)[i], 51'234);
        }
      }
    }
  }
}

// A checkerboard of black and white: its light is half of white's.
TEST(Sample, AveragesLight) {
  Image board(32, 32, 1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) board.view<std::uint8_t>()(x, y) = (x + y) % 2 == 0 ? 255 : 0;
  }
  EXPECT_EQ(sample(board, {4, Prefilter::Box}).view<std::uint8_t>()(3, 3), 188);
  EXPECT_EQ(sample(board, {4, Prefilter::Box, false, Light::Encoded}).view<std::uint8_t>()(3, 3), 128);
}

// Stripes of 0.45 cycles a pixel, sampled at every fourth: aliased to a period of five samples. Five phases are seen: of
// pixels at 4 i + 1 the extremes are cos(2π·0.05) and −cos(2π·0.05), of squares around 4 i + 1.5 cos(2π·0.075) and
// −cos(2π·0.025). A box of 4 pixels leaves |sin(4π·0.45) / (4 sin(π·0.45))| = 0.149 of them, a Gaussian of σ = 2
// exp(−2π²·0.45²·4): nothing.
TEST(Sample, PrefiltersKeepAliasesAway) {
  Image stripes(400, 4, 1, PixelType::F32);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 400; ++x)
      stripes.view<float>()(x, y) = static_cast<float>(0.5 + 0.5 * std::cos(2 * std::acos(-1.0) * 0.45 * x));
  }
  const auto contrast = [&](Prefilter prefilter) {
    const Image result = sample(stripes, {4, prefilter, false, Light::Encoded});
    float low = 1, high = 0;
    for (int i = 5; i < 95; ++i) {
      low = std::min(low, result.view<float>()(i, 0));
      high = std::max(high, result.view<float>()(i, 0));
    }
    return high - low;
  };
  EXPECT_NEAR(contrast(Prefilter::None), 0.9511, 1e-3);
  EXPECT_NEAR(contrast(Prefilter::Box), 0.149 * 0.9393, 1e-3);
  EXPECT_LT(contrast(Prefilter::Gaussian), 1e-3);
}

TEST(Sample, HiddenColorsDoNotBleed) {
  Image source(8, 8, 4);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const bool hidden = x % 2 == 1;
      for (int c = 0; c < 3; ++c) source.view<std::uint8_t>()(x, y, c) = hidden ? 255 : 60;
      source.view<std::uint8_t>()(x, y, 3) = hidden ? 0 : 255;
    }
  }
  for (const Prefilter prefilter : {Prefilter::Box, Prefilter::Gaussian}) {
    const Image result = sample(source, {4, prefilter});
    EXPECT_EQ(result.view<std::uint8_t>()(1, 1, 0), 60);
    EXPECT_NEAR(result.view<std::uint8_t>()(1, 1, 3), 128, 15);  // the Gaussian is cut at the edge
  }
}

}  // namespace
}  // namespace azulejo
