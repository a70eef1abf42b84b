#include "azulejo/imaging/laplacian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "azulejo/imaging/convolve.h"

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

/// Of ax² + by² + cxy the second derivatives are 2a and 2b; by differences they are exactly that, and those over the
/// diagonals sum to twice as much. In the numbers of bytes, so that values are exact.
TEST(Laplacian, OfAQuadraticIsItsSecondDerivatives) {
  Image source(ImageInfo{13, 11, 1, PixelType::U16});
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 13; ++x) {
      source.view<std::uint16_t>()(x, y) = static_cast<std::uint16_t>(30 * x * x + 70 * y * y + 20 * x * y + 5);
    }
  }
  const Image four = laplacian(source);
  const Image eight = laplacian(source, {.neighbors = LaplacianNeighbors::Eight});
  ASSERT_EQ(four.type(), PixelType::F32);
  ASSERT_EQ(four.info().color, ColorState::Data);
  for (int y = 1; y < 10; ++y) {
    for (int x = 1; x < 12; ++x) {
      EXPECT_FLOAT_EQ(four.view<float>()(x, y), (2 * 30 + 2 * 70) / 65535.0F);
      EXPECT_FLOAT_EQ(eight.view<float>()(x, y), 3 * (2 * 30 + 2 * 70) / 65535.0F);
    }
  }
}

TEST(Laplacian, IsZeroOnConstantsToTheLastBit) {
  for (const PixelType type : kTypes) {
    for (const AlphaState alpha : {AlphaState::None, AlphaState::Straight, AlphaState::Premultiplied}) {
      for (const LaplacianNeighbors neighbors : {LaplacianNeighbors::Four, LaplacianNeighbors::Eight}) {
        const int channels = alpha == AlphaState::None ? 3 : 4;
        const Image source = drawn({17, 6, channels, type, ColorState::Srgb, alpha}, [](int, int, int c) {
          return c == 3 ? 0.9F : 0.1F + 0.2173F * static_cast<float>(c);
        });
        const Image result = laplacian(source, {.neighbors = neighbors});
        ASSERT_EQ(result.channels(), 3);
        for (int y = 0; y < 6; ++y) {
          for (int i = 0; i < 17 * 3; ++i) ASSERT_EQ(result.view<float>().row(y)[i], 0.0F);
        }
      }
    }
  }
}

TEST(Laplacian, OfBlackAmongWhiteIsPositive) {
  for (const PixelType type : kTypes) {
    const Image source = drawn({5, 5, 1, type}, [](int x, int y, int) { return x == 2 && y == 2 ? 0.0F : 1.0F; });
    EXPECT_EQ(laplacian(source).view<float>()(2, 2), 4.0F);
    EXPECT_EQ(laplacian(source).view<float>()(1, 2), -1.0F);
    EXPECT_EQ(laplacian(source).view<float>()(1, 1), 0.0F);
    const Image eight = laplacian(source, {.neighbors = LaplacianNeighbors::Eight});
    EXPECT_EQ(eight.view<float>()(2, 2), 8.0F);
    EXPECT_EQ(eight.view<float>()(1, 1), -1.0F);
  }
}

/// Subtracting it sharpens: the textbook's composite kernel.
TEST(Laplacian, SubtractedIsTheSharpeningKernel) {
  std::mt19937 random(3);
  const Image source = drawn({31, 12, 1, PixelType::F32},
                             [&](int, int, int) { return std::uniform_real_distribution<float>(0, 1)(random); });
  const Image derivative = laplacian(source);
  const Image sharpened = convolve(source);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 31; ++x) {
      ASSERT_NEAR(source.view<const float>()(x, y) - derivative.view<float>()(x, y), sharpened.view<float>()(x, y),
                  4e-6);
    }
  }
}

}  // namespace
}  // namespace azulejo
