#include "azulejo/imaging/frequency_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr PixelType kTypes[] = {PixelType::U8, PixelType::U16, PixelType::F32};

template <class F>
Image drawn(const ImageInfo& info, F intensity) {
  Image image(info);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        for (int c = 0; c < view.channels; ++c) {
          view(x, y, c) = static_cast<T>(intensity(x, y, c) * full_range(kPixelTypeOf<T>));
        }
      }
    }
  });
  return image;
}

ImageInfo gray(int width, int height, PixelType type) { return {width, height, 1, type}; }

double response(FrequencyShape shape, int order, double q) {
  if (shape == FrequencyShape::Ideal) return q <= 1 ? 1 : 0;
  if (shape == FrequencyShape::Gaussian) return std::exp(-0.5 * q * q);
  return 1 / (1 + std::pow(q, 2 * order));
}

/// A wave that fits into the image comes out with its amplitude times the response. Values up to 1: a few roundings in
/// each of the transform's stages.
TEST(FrequencyFilter, WeighsWavesByTheResponse) {
  constexpr int kWidth = 64;
  constexpr int kHeight = 45;
  for (const FrequencyShape shape : {FrequencyShape::Ideal, FrequencyShape::Gaussian, FrequencyShape::Butterworth}) {
    for (const FrequencyPass pass :
         {FrequencyPass::Low, FrequencyPass::High, FrequencyPass::Band, FrequencyPass::Stop}) {
      for (const auto& [u, v] : {std::pair{3, 2}, {12, 0}, {0, 9}, {20, -14}}) {
        const auto wave = [&, u = u, v = v](int x, int y) {
          return 0.4 * std::cos(2 * std::numbers::pi * (1.0 * u * x / kWidth + 1.0 * v * y / kHeight) + 0.3);
        };
        const Image source = drawn(gray(kWidth, kHeight, PixelType::F32),
                                   [&](int x, int y, int) { return static_cast<float>(0.5 + wave(x, y)); });
        const FrequencyFilterOptions options{.pass = pass,
                                             .shape = shape,
                                             .cutoff = 0.3F,
                                             .upper = 0.7F,
                                             .order = 3,
                                             .output = FilterOutput::F32,
                                             .border = Border::Wrap};
        const double distance = std::hypot(2.0 * u / kWidth, 2.0 * v / kHeight);
        const double low = response(shape, 3, distance / 0.3);
        const double band = (1 - low) * response(shape, 3, distance / 0.7);
        const double expected = pass == FrequencyPass::Low    ? low
                                : pass == FrequencyPass::High ? 1 - low
                                : pass == FrequencyPass::Band ? band
                                                              : 1 - band;
        const double mean = pass == FrequencyPass::Low || pass == FrequencyPass::Stop ? 0.5 : 0;
        const Image result = frequency_filter(source, options);
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            ASSERT_NEAR(result.view<float>()(x, y), mean + expected * wave(x, y), 2e-6)
                << static_cast<int>(shape) << static_cast<int>(pass) << ": " << u << ", " << v;
          }
        }
      }
    }
  }
}

TEST(FrequencyFilter, LeavesConstantsToTheLastBit) {
  for (const PixelType type : kTypes) {
    for (const FrequencyShape shape : {FrequencyShape::Ideal, FrequencyShape::Gaussian, FrequencyShape::Butterworth}) {
      for (const int channels : {1, 3, 4}) {
        const ImageInfo info{
            37, 22, channels, type, ColorState::Srgb, channels == 4 ? AlphaState::Premultiplied : AlphaState::None};
        const Image source =
            drawn(info, [](int, int, int c) { return c == 3 ? 0.9F : 0.1F + 0.2173F * static_cast<float>(c); });
        for (const FrequencyPass pass : {FrequencyPass::Low, FrequencyPass::Stop}) {
          const Image result = frequency_filter(source, {.pass = pass, .shape = shape});
          for (int y = 0; y < 22; ++y) {
            ASSERT_EQ(std::memcmp(result.any().row(y), source.any().row(y), info.row_bytes()), 0);
          }
        }
        for (const FrequencyPass pass : {FrequencyPass::High, FrequencyPass::Band}) {
          const Image result = frequency_filter(source, {.pass = pass, .shape = shape, .output = FilterOutput::F32});
          for (int y = 0; y < 22; ++y) {
            for (int i = 0; i < 37 * result.channels(); ++i) ASSERT_EQ(result.view<float>().row(y)[i], 0.0F);
          }
        }
      }
    }
  }
}

/// What a low pass lets through and what the high pass does are the image, whatever the border.
TEST(FrequencyFilter, LowAndHighAreTheWhole) {
  std::mt19937 random(4);
  const Image source = drawn(gray(53, 40, PixelType::F32),
                             [&](int, int, int) { return std::uniform_real_distribution<float>(0, 1)(random); });
  for (const Border border : {Border::Mirror, Border::Reflect, Border::Clamp, Border::Wrap, Border::Constant}) {
    const Image low = frequency_filter(source, {.pass = FrequencyPass::Low, .border = border});
    const Image high = frequency_filter(source, {.pass = FrequencyPass::High, .border = border});
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 53; ++x) {
        ASSERT_NEAR(low.view<float>()(x, y) + high.view<float>()(x, y), source.view<const float>()(x, y), 2e-6);
      }
    }
  }
}

/// Mirrored images give mirrored results: the border is continued alike on all sides.
TEST(FrequencyFilter, KnowsNoSides) {
  std::mt19937 random(6);
  const Image source = drawn(gray(41, 30, PixelType::F32),
                             [&](int, int, int) { return std::uniform_real_distribution<float>(0, 1)(random); });
  const Image mirrored = drawn(gray(41, 30, PixelType::F32),
                               [&](int x, int y, int) { return source.view<const float>()(40 - x, 29 - y); });
  const FrequencyFilterOptions options{.shape = FrequencyShape::Ideal, .cutoff = 0.5F};
  const Image a = frequency_filter(source, options);
  const Image b = frequency_filter(mirrored, options);
  for (int y = 0; y < 30; ++y) {
    // An odd number of places beside the image leaves one that belongs to neither side, far away.
    for (int x = 0; x < 41; ++x) ASSERT_NEAR(a.view<float>()(x, y), b.view<float>()(40 - x, 29 - y), 0.01);
  }
}

TEST(FrequencyFilter, NeverShowsHiddenColors) {
  const auto image = [](float hidden) {
    return drawn({16, 16, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, [&](int x, int, int c) {
      if (c == 3) return x < 8 ? 1.0F : 0.0F;
      return x < 8 ? 0.4F : hidden;
    });
  };
  const Image a = frequency_filter(image(0), {});
  const Image b = frequency_filter(image(1), {});
  for (int y = 0; y < 16; ++y) ASSERT_EQ(std::memcmp(a.any().row(y), b.any().row(y), 64), 0);
}

TEST(FrequencyFilter, IsTheSameOnAnyNumberOfThreads) {
  std::mt19937 random(6);
  const Image source = drawn({133, 170, 3, PixelType::U16},
                             [&](int, int, int) { return std::uniform_real_distribution<float>(0, 1)(random); });
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 5;
  const Image a = frequency_filter(source, {}, one);
  const Image b = frequency_filter(source, {}, many);
  for (int y = 0; y < 170; ++y) ASSERT_EQ(std::memcmp(a.any().row(y), b.any().row(y), a.info().row_bytes()), 0);
}

TEST(FrequencyFilter, RefusesWhatHasNoMeaning) {
  const Image source(8, 8, 1);
  EXPECT_THROW(frequency_filter(source, {.cutoff = 0}), Error);
  EXPECT_THROW(frequency_filter(source, {.pass = FrequencyPass::Band, .cutoff = 0.5F, .upper = 0.5F}), Error);
}

}  // namespace
}  // namespace azulejo
