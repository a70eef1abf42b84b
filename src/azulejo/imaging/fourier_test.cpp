#include "azulejo/imaging/fourier.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <random>

#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

constexpr int kLanes = FourierPlan::kLanes;

std::vector<float> random_values(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<float> values(count);
  for (float& value : values) value = unit(random);
  return values;
}

TEST(Fourier, IsTheDefinition) {
  for (const int n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 18, 24, 36, 48, 31, 97, 128, 144, 15, 60, 100, 250, 122}) {
    const auto un = static_cast<std::size_t>(n);
    const FourierPlan plan(n);
    std::vector<float> re = random_values(un * kLanes, static_cast<unsigned>(n));
    std::vector<float> im = random_values(un * kLanes, static_cast<unsigned>(n) + 1);
    const std::vector<float> from_re = re;
    const std::vector<float> from_im = im;
    std::vector<float> work(plan.work_values());
    plan.forward(re.data(), im.data(), work.data());
    // Chirps are two more transforms of twice the size.
    const double tolerance = 4e-7 * std::sqrt(n) * (std::log2(n) + 1) * 2;
    for (std::size_t l = 0; l < kLanes; l += 5) {
      for (int k = 0; k < n; ++k) {
        std::complex<double> sum = 0;
        for (int j = 0; j < n; ++j) {
          const Turn turn = turn_of(std::int64_t{j} * k, n);
          const std::size_t at = static_cast<std::size_t>(j) * kLanes + l;
          sum += std::complex<double>(from_re[at], from_im[at]) * std::complex<double>(turn.cosine, -turn.sine);
        }
        ASSERT_NEAR(re[static_cast<std::size_t>(k) * kLanes + l], sum.real(), tolerance) << n << ": " << k;
        ASSERT_NEAR(im[static_cast<std::size_t>(k) * kLanes + l], sum.imag(), tolerance) << n << ": " << k;
      }
    }
    plan.inverse(re.data(), im.data(), work.data());
    for (std::size_t i = 0; i < un * kLanes; ++i) {
      ASSERT_NEAR(re[i] / static_cast<float>(n), from_re[i], 4e-6) << n;
      ASSERT_NEAR(im[i] / static_cast<float>(n), from_im[i], 4e-6) << n;
    }
  }
}

TEST(Fourier, FastSizesAreFastAndNearBy) {
  for (int least = 1; least < 5000; ++least) {
    const int size = FourierPlan::fast_size(least);
    ASSERT_GE(size, least);
    ASSERT_LT(size, least * 1.25 + 1);
    int rest = size;
    while (rest % 2 == 0) rest /= 2;
    ASSERT_TRUE(rest == 1 || rest == 3 || rest == 5 || rest == 9 || rest == 15) << size;
  }
}

/// Of images: the definition in two dimensions, Parseval's theorem, the way back, the same bytes however it is computed.
TEST(Fourier, OfARealImage) {
  for (const auto& size : {std::pair{12, 8}, {13, 40}, {1, 5}, {48, 1}, {34, 67}}) {
    const int width = size.first;
    const int height = size.second;
    const auto uw = static_cast<std::size_t>(width);
    const std::vector<float> image = random_values(uw * static_cast<std::size_t>(height), 5);
    const auto transformed = [&](int threads) {
      azulejo::Run run;
      run.threads = threads;
      HalfSpectrum spectrum(width, height);
      fourier_rows(spectrum, run, [&](int y, float* row) {
        std::copy_n(image.data() + static_cast<std::size_t>(y) * uw, width, row);
      });
      fourier_columns(spectrum, run);
      return spectrum;
    };
    const HalfSpectrum spectrum = transformed(1);
    double energy = 0;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < spectrum.columns; ++u) {
        std::complex<double> sum = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const Turn a = turn_of(std::int64_t{u} * x, width);
            const Turn b = turn_of(std::int64_t{v} * y, height);
            sum += double{image[static_cast<std::size_t>(y) * uw + static_cast<std::size_t>(x)]} *
                   std::complex<double>(a.cosine, -a.sine) * std::complex<double>(b.cosine, -b.sine);
          }
        }
        const std::size_t at = static_cast<std::size_t>(v) * spectrum.stride + static_cast<std::size_t>(u);
        ASSERT_NEAR(spectrum.re[at], sum.real(), 2e-4);
        ASSERT_NEAR(spectrum.im[at], sum.imag(), 2e-4);
        const bool twice = u != 0 && 2 * u != width;
        energy +=
            (twice ? 2 : 1) * (double{spectrum.re[at]} * spectrum.re[at] + double{spectrum.im[at]} * spectrum.im[at]);
      }
    }
    double expected = 0;
    for (const float value : image) expected += double{value} * value;
    EXPECT_NEAR(energy / (width * height), expected, 1e-5 * expected);

    HalfSpectrum same = transformed(3);
    EXPECT_EQ(std::memcmp(same.re.data(), spectrum.re.data(), same.re.size() * sizeof(float)), 0);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(target);
      const HalfSpectrum other = transformed(1);
      EXPECT_EQ(std::memcmp(other.im.data(), spectrum.im.data(), other.im.size() * sizeof(float)), 0)
          << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
}

TEST(Fourier, ThereAndBackIsTheImage) {
  constexpr int kWidth = 36;
  constexpr int kHeight = 50;
  const std::vector<float> image = random_values(kWidth * kHeight, 8);
  HalfSpectrum spectrum(kWidth, kHeight);
  fourier_rows(spectrum, {}, [&](int y, float* row) { std::copy_n(image.data() + y * kWidth, kWidth, row); });
  fourier_columns(spectrum, {}, [](int, int, float*, float*) {});
  inverse_fourier_rows(spectrum, {}, kHeight, [&](int y, const float* row) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_NEAR(row[x] / (kWidth * kHeight), image[static_cast<std::size_t>(y * kWidth + x)], 4e-6);
    }
  });
}

}  // namespace
}  // namespace azulejo
