#include "azulejo/imaging/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>
#include <random>

namespace azulejo {
namespace {

Image random_image(const ImageInfo& info, unsigned seed) {
  Image image(info);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        view.row(y)[i] = static_cast<T>(unit(random) * full_range(kPixelTypeOf<T>));
      }
    }
  });
  return image;
}

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// |F| at (u, v) cycles in the image, by the definition.
double magnitude(const Image& image, int u, int v, int c, bool hann) {
  const auto window = [&](int i, int size) {
    return hann ? std::pow(std::sin(std::numbers::pi * (i + 0.5) / size), 2) : 1.0;
  };
  std::complex<double> sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double angle = -2 * std::numbers::pi * (1.0 * u * x / image.width() + 1.0 * v * y / image.height());
      sum += value_at(image, x, y, c) / static_cast<double>(full_range(image.type())) * window(x, image.width()) *
             window(y, image.height()) * std::polar(1.0, angle);
    }
  }
  return std::abs(sum);
}

TEST(Spectrum, IsTheLogarithmOfTheMagnitude) {
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const auto& [width, height] : {std::pair{16, 12}, {13, 9}, {1, 7}, {10, 1}}) {
      for (const SpectrumWindow window : {SpectrumWindow::None, SpectrumWindow::Hann}) {
        const Image source = random_image({width, height, seed % 2 == 0 ? 3 : 1, type}, seed);
        ++seed;
        const Image result = spectrum(source, {.window = window, .output = FilterOutput::F32});
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const int c = x % source.channels();
            const double expected = magnitude(source, x - width / 2, y - height / 2, c, window == SpectrumWindow::Hann);
            // The largest |F| is about half the number of pixels, at most 100; where |F| is small, so is its error.
            ASSERT_NEAR(result.view<float>()(x, y, c), std::log1p(expected), 4e-5) << x << ", " << y;
          }
        }
      }
    }
  }
}

/// Parseval: the energy of the image is that of its transform, divided by the number of pixels.
TEST(Spectrum, KeepsTheEnergy) {
  const Image source = random_image({57, 44, 1, PixelType::F32}, 3);
  const Image result = spectrum(source, {.output = FilterOutput::F32});
  double energy = 0;
  double transformed = 0;
  for (int y = 0; y < 44; ++y) {
    for (int x = 0; x < 57; ++x) {
      energy += std::pow(value_at(source, x, y, 0), 2);
      transformed += std::pow(std::expm1(value_at(result, x, y, 0)), 2);
    }
  }
  EXPECT_NEAR(transformed / (57 * 44), energy, 1e-5 * energy);
}

TEST(Spectrum, OfAWaveIsTwoPointsAndTheMiddle) {
  Image source(ImageInfo{32, 24, 1, PixelType::U8});
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      const double wave = std::cos(2 * std::numbers::pi * (5.0 * x / 32 - 3.0 * y / 24));
      source.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(127.5 + 100 * wave);
    }
  }
  const Image result = spectrum(source);
  ASSERT_EQ(result.type(), PixelType::U8);
  EXPECT_EQ(value_at(result, 16, 12, 0), 255);
  EXPECT_GT(value_at(result, 16 + 5, 12 - 3, 0), 200);
  EXPECT_EQ(value_at(result, 16 - 5, 12 + 3, 0), value_at(result, 16 + 5, 12 - 3, 0));
  int bright = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) bright += value_at(result, x, y, 0) > 60 ? 1 : 0;
  }
  EXPECT_EQ(bright, 3);
}

TEST(Spectrum, IsTheSameOnAnyNumberOfThreads) {
  const Image source = random_image({97, 75, 3, PixelType::U16}, 3);
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 4;
  const Image a = spectrum(source, {}, one);
  const Image b = spectrum(source, {}, many);
  for (int y = 0; y < 75; ++y) ASSERT_EQ(std::memcmp(a.any().row(y), b.any().row(y), a.info().row_bytes()), 0);
}

}  // namespace
}  // namespace azulejo
