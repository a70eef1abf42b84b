#include "azulejo/imaging/sobel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

TEST(Sobel, IsTheConvolution) {
  constexpr int kX[3][3] = {{-1, 0, 1}, {-2, 0, 2}, {-1, 0, 1}};
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const Border border : {Border::Mirror, Border::Reflect, Border::Clamp, Border::Wrap, Border::Constant}) {
      SCOPED_TRACE(testing::Message() << to_string(type) << ", seed " << seed);
      const Image source = random_image({37, 12, 3, type}, seed++);
      const SobelResult result = sobel(source, {.border = border, .border_value = 0.5F});
      ASSERT_EQ(result.x.info(), (ImageInfo{37, 12, 3, PixelType::F32, ColorState::Data, AlphaState::None}));
      visit(source.any(), [&](auto view) {
        const double full = full_range(type);
        for (int y = 0; y < 12; ++y) {
          for (int i = 0; i < 3 * 37; ++i) {
            double dx = 0;
            double dy = 0;
            for (int v = -1; v <= 1; ++v) {
              for (int u = -1; u <= 1; ++u) {
                const int from_x = border_index(i / 3 + u, 37, border);
                const int from_y = border_index(y + v, 12, border);
                double value = std::floor(0.5 * full + 0.5) / full;
                if (type == PixelType::F32) value = 0.5;
                if (from_x >= 0 && from_y >= 0) value = view(from_x, from_y, i % 3) / full;
                dx += kX[v + 1][u + 1] * value;
                dy += kX[u + 1][v + 1] * value;
              }
            }
            // Nine values up to 1, four additions of up to 4: below 2⁻²²; the scale's rounding is relative.
            const auto at = [&](const Image& image) { return double{image.view<float>().row(y)[i]}; };
            ASSERT_NEAR(at(result.x), dx, 1e-6);
            ASSERT_NEAR(at(result.y), dy, 1e-6);
            ASSERT_NEAR(at(result.magnitude), std::hypot(dx, dy), 2e-6);
            const double error = std::remainder(at(result.orientation) - std::atan2(-dy, dx), 2 * std::numbers::pi);
            ASSERT_NEAR(error, 0, 4e-7 + 1e-6 / std::hypot(dx, dy));
          }
        }
      });
    }
  }
}

TEST(Sobel, OfARampIsItsSlope) {
  Image source(20, 15, 1, PixelType::F32);
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 20; ++x)
      source.view<float>()(x, y) = 0.25F * static_cast<float>(x) - 0.5F * static_cast<float>(y);
  }
  const SobelResult result = sobel(source);
  for (int y = 1; y < 14; ++y) {
    for (int x = 1; x < 19; ++x) {
      EXPECT_EQ(result.x.view<float>()(x, y), 2);  // 8 times the slope
      EXPECT_EQ(result.y.view<float>()(x, y), -4);
      EXPECT_EQ(result.magnitude.view<float>()(x, y), std::sqrt(20.0F));
      EXPECT_NEAR(result.orientation.view<float>()(x, y), std::atan2(4.0, 2.0), 4e-7);  // up and to the right
    }
  }
}

TEST(Sobel, OfAStepOfBytesIsFour) {
  Image source(6, 3, 1);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 6; ++x) source.view<std::uint8_t>()(x, y) = x < 3 ? 255 : 0;
  }
  const SobelResult result = sobel(source);
  EXPECT_EQ(result.x.view<float>()(2, 1), -4);
  EXPECT_EQ(result.magnitude.view<float>()(3, 1), 4);
  EXPECT_EQ(result.orientation.view<float>()(2, 1), std::numbers::pi_v<float>);  // brighter to the left
  EXPECT_EQ(result.magnitude.view<float>()(0, 1), 0);
  EXPECT_EQ(result.orientation.view<float>()(0, 1), 0);
}

TEST(Sobel, OfTheTransposedImageHasXAndYExchanged) {
  const unsigned seed = 21;
  SCOPED_TRACE(seed);
  const Image source = random_image({45, 33, 1, PixelType::F32}, seed);
  Image turned(33, 45, 1, PixelType::F32);
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 45; ++x) turned.view<float>()(y, x) = source.view<float>()(x, y);
  }
  const SobelResult a = sobel(source);
  const SobelResult b = sobel(turned);
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 45; ++x) {
      ASSERT_EQ(a.x.view<float>()(x, y), b.y.view<float>()(y, x));
      ASSERT_EQ(a.y.view<float>()(x, y), b.x.view<float>()(y, x));
      ASSERT_EQ(a.magnitude.view<float>()(x, y), b.magnitude.view<float>()(y, x));
    }
  }
}

/// Isotropic enough: on a smooth disk, brighter inside, the gradient points to the middle.
TEST(Sobel, OnADisksEdgePointsToTheMiddle) {
  constexpr int kSize = 129;
  constexpr double kMiddle = 64;
  Image source(kSize, kSize, 1, PixelType::F32);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double distance = std::hypot(x - kMiddle, y - kMiddle);
      source.view<float>()(x, y) = static_cast<float>(1 / (1 + std::exp((distance - 40) / 4)));
    }
  }
  const SobelResult result = sobel(source);
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::numbers::pi / 180;
    const int x = static_cast<int>(std::lround(kMiddle + 40 * std::cos(angle)));
    const int y = static_cast<int>(std::lround(kMiddle - 40 * std::sin(angle)));
    const double inwards = std::atan2(y - kMiddle, kMiddle - x);  // y down: −(middle − y)
    const double error = std::remainder(result.orientation.view<float>()(x, y) - inwards, 2 * std::numbers::pi);
    EXPECT_NEAR(error, 0, 0.01) << i << "°";
  }
}

TEST(Sobel, DoesNotSeeColorsUnderAlphaZero) {
  Image source(12, 9, 4);
  Image clear(12, 9, 2, PixelType::U16);
  std::mt19937 random(3);
  for (int y = 0; y < 9; ++y) {
    for (int i = 0; i < 48; ++i)
      source.view<std::uint8_t>().row(y)[i] = i % 4 == 3 ? 0 : static_cast<std::uint8_t>(random());
    for (int x = 0; x < 12; ++x) {
      clear.view<std::uint16_t>()(x, y, 0) = 65535;
      clear.view<std::uint16_t>()(x, y, 1) = static_cast<std::uint16_t>(x < 6 ? 0 : 65535);
    }
  }
  const SobelResult hidden = sobel(source);
  ASSERT_EQ(hidden.magnitude.channels(), 3);
  for (int i = 0; i < 36; ++i) EXPECT_EQ(hidden.magnitude.view<float>().row(4)[i], 0);
  const SobelResult edge = sobel(clear);  // white that begins to show: a step of 1
  ASSERT_EQ(edge.x.channels(), 1);
  EXPECT_NEAR(edge.x.view<float>()(6, 4), 4, 1e-6);
  EXPECT_EQ(edge.x.view<float>()(8, 4), 0);
}

TEST(Sobel, ComputesOnlyWhatIsWanted) {
  const Image source = random_image({70, 20, 1, PixelType::U8}, 6);
  const SobelResult all = sobel(source);
  Image magnitude(all.magnitude.info());
  Image y(all.y.info());
  sobel(source.any(), SobelViews{.magnitude = magnitude.any()});
  sobel(source.any(), SobelViews{.y = y.any()});
  for (int row = 0; row < 20; ++row) {
    EXPECT_EQ(std::memcmp(magnitude.any().row(row), all.magnitude.any().row(row), 280), 0);
    EXPECT_EQ(std::memcmp(y.any().row(row), all.y.any().row(row), 280), 0);
  }
}

TEST(Sobel, RefusesABorderValueOutsideTheRange) { EXPECT_THROW(sobel(Image(2, 2, 1), {.border_value = 2}), Error); }

}  // namespace
}  // namespace azulejo
