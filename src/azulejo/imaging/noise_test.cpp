#include "azulejo/imaging/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "azulejo/imaging/noise_kernels.h"
#include "azulejo/math/normal.h"
#include "azulejo/math/random.h"

namespace azulejo {
namespace {

Image constant(int width, int height, int channels, float value) {
  Image image(width, height, channels, PixelType::F32);
  for (int y = 0; y < height; ++y) std::fill_n(image.view<float>().row(y), width * channels, value);
  return image;
}

std::vector<double> values_of(const Image& image) {
  std::vector<double> values;
  for (int y = 0; y < image.height(); ++y) {
    const float* const row = image.view<float>().row(y);
    values.insert(values.end(), row, row + image.width() * image.channels());
  }
  return values;
}

struct Moments {
  double mean, variance, skewness, kurtosis;
};
Moments moments(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, m2 = 0, m3 = 0, m4 = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) {
    const double d = v - mean;
    m2 += d * d / n;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  return {mean, m2, m3 / std::pow(m2, 1.5), m4 / (m2 * m2)};
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments of_a = moments(a);
  const Moments of_b = moments(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  return sum / static_cast<double>(a.size()) / std::sqrt(of_a.variance * of_b.variance);
}

// All tests look at one fixed outcome each: seeds are given, so what passes once passes always. Bounds are five
// standard errors of the n values that are looked at, which one outcome in two million exceeds.
constexpr int kSide = 600;
constexpr double kCount = kSide * kSide;

TEST(Noise, OfAKnownPlaceIsTheWordsOfPhilox) {
  const Image noisy = noise(constant(9, 3, 1, 0.25F), {.amount = 0.5F, .seed = 7});
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 9; ++x) {
      const auto block = static_cast<std::uint32_t>(x / 4);
      const auto words = philox({block, static_cast<std::uint32_t>(y), 0, 0}, {7, 0});
      const float deviate = normal_deviate(words[static_cast<std::size_t>(x % 4)]);
      EXPECT_EQ(noisy.view<float>()(x, y), 0.25F + deviate * 0.5F);
    }
  }
}

TEST(Noise, GaussianIsNormallyDistributed) {
  const auto values = values_of(noise(constant(kSide, kSide, 1, 0.5F), {.amount = 0.125F, .seed = 1}));
  const Moments found = moments(values);
  EXPECT_NEAR(found.mean, 0.5, 5 * 0.125 / std::sqrt(kCount));
  EXPECT_NEAR(std::sqrt(found.variance), 0.125, 5 * 0.125 / std::sqrt(2 * kCount));
  EXPECT_NEAR(found.skewness, 0, 5 * std::sqrt(6 / kCount));
  EXPECT_NEAR(found.kurtosis, 3, 5 * std::sqrt(24 / kCount));
  // Chi-square over 100 intervals of the same share.
  std::vector<double> counts(100);
  for (const double v : values) {
    const double share = 0.5 * std::erfc(-(v - 0.5) / 0.125 / std::sqrt(2.0));
    ++counts[static_cast<std::size_t>(std::min(99.0, share * 100))];
  }
  double chi_square = 0;
  for (const double count : counts) chi_square += (count - kCount / 100) * (count - kCount / 100) / (kCount / 100);
  EXPECT_NEAR(chi_square, 99, 5 * std::sqrt(2 * 99.0));
}

TEST(Noise, NeighborsChannelsAndSeedsAreIndependent) {
  const Image noisy = noise(constant(kSide, kSide, 3, 0.5F), {.amount = 0.1F, .seed = 2});
  const Image other = noise(constant(kSide, kSide, 3, 0.5F), {.amount = 0.1F, .seed = 3});
  const auto view = noisy.view<float>();
  const auto second = other.view<float>();
  std::vector<double> here, right, below, channel, seed;
  for (int y = 0; y + 1 < kSide; ++y) {
    for (int x = 0; x + 1 < kSide; ++x) {
      here.push_back(view(x, y, 0));
      right.push_back(view(x + 1, y, 0));
      below.push_back(view(x, y + 1, 0));
      channel.push_back(view(x, y, 1));
      seed.push_back(second(x, y, 0));
    }
  }
  for (const auto* with : {&right, &below, &channel, &seed}) {
    EXPECT_NEAR(correlation(here, *with), 0, 5 / std::sqrt(kCount));
    // Nor are their sizes: large beside large.
    std::vector<double> a, b;
    for (std::size_t i = 0; i < here.size(); ++i) {
      a.push_back(std::fabs(here[i] - 0.5));
      b.push_back(std::fabs((*with)[i] - 0.5));
    }
    EXPECT_NEAR(correlation(a, b), 0, 5 / std::sqrt(kCount));
  }
}

TEST(Noise, MonochromeIsTheSameInAllChannels) {
  for (const NoiseKind kind : {NoiseKind::Gaussian, NoiseKind::SaltPepper, NoiseKind::Poisson, NoiseKind::Speckle}) {
    const Image gray = noise(constant(50, 20, 1, 0.5F), {.kind = kind, .amount = 0.3F, .seed = 4});
    const Image colors =
        noise(constant(50, 20, 3, 0.5F), {.kind = kind, .amount = 0.3F, .seed = 4, .monochrome = true});
    for (int y = 0; y < 20; ++y) {
      for (int i = 0; i < 150; ++i) ASSERT_EQ(colors.view<float>().row(y)[i], gray.view<float>()(i / 3, y));
    }
  }
}

TEST(Noise, SaltAndPepperTakeTheirShares) {
  for (const float amount : {0.05F, 0.5F, 1.0F}) {
    const auto values = values_of(
        noise(constant(kSide, kSide, 1, 0.25F), {.kind = NoiseKind::SaltPepper, .amount = amount, .seed = 5}));
    const auto half = static_cast<double>(amount) / 2;
    const double error = 5 * std::sqrt(half * (1 - half) * kCount);
    EXPECT_NEAR(static_cast<double>(std::count(values.begin(), values.end(), 0.0)), half * kCount, error);
    EXPECT_NEAR(static_cast<double>(std::count(values.begin(), values.end(), 1.0)), half * kCount, error);
    if (amount < 1) {
      EXPECT_GT(std::count(values.begin(), values.end(), 0.25), 0);
    }
  }
}

TEST(Noise, SpeckleGrowsWithTheIntensity) {
  for (const double v : {0.125, 0.5, 2.0}) {
    const Moments found = moments(values_of(
        noise(constant(kSide, kSide, 1, static_cast<float>(v)), {.kind = NoiseKind::Speckle, .amount = 0.25F})));
    EXPECT_NEAR(found.mean, v, 5 * 0.25 * v / std::sqrt(kCount));
    EXPECT_NEAR(std::sqrt(found.variance), 0.25 * v, 5 * 0.25 * v / std::sqrt(2 * kCount));
  }
}

/// Shares of counts up to each, of a Poisson distribution.
std::vector<double> poisson_shares(double mean) {
  std::vector<double> up_to;
  double sum = 0;
  for (int k = 0; k < mean + 12 * std::sqrt(mean) + 20; ++k) {
    sum += std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
    up_to.push_back(sum);
  }
  return up_to;
}

TEST(Noise, PoissonCountsEvents) {
  // 1 / 0.1² = 100 events at full intensity; and 10⁴.
  for (const auto& [amount, intensity] :
       {std::pair{0.1F, 0.005F}, {0.1F, 0.05F}, {0.1F, 0.25F}, {0.1F, 0.33F}, {0.1F, 1.0F}, {0.01F, 0.5F}}) {
    const double events = 1 / (static_cast<double>(amount) * static_cast<double>(amount));
    const double mean = static_cast<double>(intensity) * events;
    const auto values = values_of(
        noise(constant(kSide, kSide, 1, intensity), {.kind = NoiseKind::Poisson, .amount = amount, .seed = 6}));
    std::vector<double> counts;
    for (const double v : values) {
      counts.push_back(std::floor(v * events + 0.5));
      ASSERT_NEAR(v * events, counts.back(), 1e-3 * std::max(1.0, mean / 100));  // whole, but for rounding to f32
    }
    const Moments found = moments(counts);
    EXPECT_NEAR(found.mean, mean, 5 * std::sqrt(mean / kCount));
    EXPECT_NEAR(found.variance, mean, 5 * mean * std::sqrt((2 + 1 / mean) / kCount)) << mean;
    // Kolmogorov–Smirnov: 1.95/√n is exceeded by one outcome in a thousand; 10⁻⁵ for the expansion.
    std::sort(counts.begin(), counts.end());
    const auto exact = poisson_shares(mean);
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const auto up_to = std::upper_bound(counts.begin(), counts.end(), static_cast<double>(k)) - counts.begin();
      largest = std::max(largest, std::fabs(static_cast<double>(up_to) / kCount - exact[k]));
    }
    EXPECT_LT(largest, 1.95 / std::sqrt(kCount) + 1e-5) << mean;
  }
}

// The quantile function itself, over evenly spread words instead of random ones.
TEST(Noise, PoissonCountsHaveTheirShares) {
  for (const double mean : {0.3, 7.0, 31.9, 32.0, 50.0, 400.0}) {
    const auto exact = poisson_shares(mean);
    std::vector<double> found(exact.size());
    constexpr int kWords = 1'000'000;
    for (int i = 0; i < kWords; ++i) {
      const auto word = static_cast<std::uint32_t>((i + 0.5) / kWords * 0x1p32);
      found[static_cast<std::size_t>(kernels::poisson_count(mean, word, normal_deviate(word)))] += 1.0 / kWords;
    }
    double sum = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      sum += found[k];
      EXPECT_NEAR(sum, exact[k], 1e-5) << mean << ", " << k;
    }
  }
}

TEST(Noise, RoundsAndSaturatesIntegers) {
  Image bytes(kSide, 100, 1);
  for (int y = 0; y < 100; ++y) std::fill_n(bytes.view<std::uint8_t>().row(y), kSide, std::uint8_t{128});
  const Image floats = constant(kSide, 100, 1, 128.0F / 255);
  const Image a = noise(bytes, {.amount = 0.4F, .seed = 8});
  const Image b = noise(floats, {.amount = 0.4F, .seed = 8});
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double exact = std::clamp(static_cast<double>(b.view<float>()(x, y)) * 255, 0.0, 255.0);
      ASSERT_NEAR(a.view<std::uint8_t>()(x, y), exact, 0.5001);
    }
  }
}

TEST(Noise, OfPremultipliedColorIsThatOfTheColorTimesAlpha) {
  Image straight = constant(64, 16, 4, 0.25F);
  Image premultiplied = constant(64, 16, 4, 0.25F);
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float alpha = y == 0 ? 0.0F : 0.5F;
      straight.view<float>()(x, y, 3) = premultiplied.view<float>()(x, y, 3) = alpha;
      for (int c = 0; c < 3; ++c) premultiplied.view<float>()(x, y, c) = 0.25F * alpha;
    }
  }
  for (const NoiseKind kind : {NoiseKind::Gaussian, NoiseKind::SaltPepper, NoiseKind::Poisson, NoiseKind::Speckle}) {
    const Image a = noise(straight, {.kind = kind, .amount = 0.25F, .seed = 9});
    const Image b = noise(premultiplied, {.kind = kind, .amount = 0.25F, .seed = 9});
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 64; ++x) {
        const float alpha = a.view<float>()(x, y, 3);
        ASSERT_EQ(alpha, y == 0 ? 0.0F : 0.5F);
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(b.view<float>()(x, y, c), y == 0 ? 0.0F : a.view<float>()(x, y, c) * alpha, 1e-6F);
        }
      }
    }
  }
}

TEST(Noise, NoneIsNone) {
  const Image source = constant(30, 5, 3, 0.3F);
  for (const NoiseKind kind : {NoiseKind::Gaussian, NoiseKind::SaltPepper, NoiseKind::Poisson, NoiseKind::Speckle}) {
    EXPECT_EQ(values_of(noise(source, {.kind = kind, .amount = 0})), values_of(source));
  }
}

}  // namespace
}  // namespace azulejo
