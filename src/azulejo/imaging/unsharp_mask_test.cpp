#include "azulejo/imaging/unsharp_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/detail_testing.h"

namespace azulejo {
namespace {

TEST(UnsharpMask, IsItsDefinition) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 3}) {
      const Image source = random_image(ImageInfo{23, 19, channels, type}, 5);
      const UnsharpMaskOptions options{.sigma = 1.3F, .amount = 0.75F, .threshold = 0.1F};
      const Image result = unsharp_mask(source, options);
      const double step = type == PixelType::F32 ? 0 : 0.5 / full_range(type);
      const double error = smooth_error(type, 1.3);
      for (int y = 0; y < 19; ++y) {
        for (int x = 0; x < 23; ++x) {
          for (int c = 0; c < channels; ++c) {
            const double s = intensity(source, x, y, c);
            const double d = s - smooth(source, x, y, c, double{1.3F});
            if (std::fabs(std::fabs(d) - 0.1) <= error) continue;  // either side of the threshold
            double expected = s + 0.75 * (std::fabs(d) < 0.1 ? 0 : d);
            if (type != PixelType::F32) expected = std::clamp(expected, 0.0, 1.0);
            ASSERT_NEAR(intensity(result, x, y, c), expected, step + 0.75 * error + 1e-6) << x << ' ' << y;
          }
        }
      }
    }
  }
}

TEST(UnsharpMask, LeavesConstantImagesToTheLastBit) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const Light light : {Light::Encoded, Light::Linear}) {
      Image image(ImageInfo{40, 30, 4, type, ColorState::Srgb, AlphaState::Straight});
      visit(image.any(), [&](auto view) {
        using T = std::remove_pointer_t<decltype(view.data)>;
        for (int y = 0; y < 30; ++y) {
          for (int i = 0; i < 160; ++i) view.row(y)[i] = static_cast<T>(full_range(type) * (i % 4 == 3 ? 1.0F : 0.6F));
        }
      });
      const Image result = unsharp_mask(image, {.sigma = 2.5F, .amount = 3, .light = light});
      for (int y = 0; y < 30; ++y) {
        for (int i = 0; i < 160; ++i) {
          // In linear light f32 goes through both curves, each within 10⁻⁶.
          const double error = type == PixelType::F32 && light == Light::Linear ? 2e-6 : 0;
          ASSERT_NEAR(intensity(result, i / 4, y, i % 4), intensity(image, i / 4, y, i % 4), error);
        }
      }
    }
  }
}

TEST(UnsharpMask, HiddenColorsNeverShow) {
  // Two pictures that differ only where nobody can see it.
  Image first = random_image(Image(40, 30, 4).info(), 8);
  Image second = first.clone();
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      if ((x / 4 + y / 4) % 2 == 0) continue;
      first.view<std::uint8_t>()(x, y, 3) = second.view<std::uint8_t>()(x, y, 3) = 0;
      second.view<std::uint8_t>()(x, y, 0) ^= 0xFF;
    }
  }
  const Image a = unsharp_mask(first, {.sigma = 3, .amount = 2});
  const Image b = unsharp_mask(second, {.sigma = 3, .amount = 2});
  for (int y = 0; y < 30; ++y) {
    ASSERT_TRUE(
        std::equal(a.view<std::uint8_t>().row(y), a.view<std::uint8_t>().row(y) + 160, b.view<std::uint8_t>().row(y)));
    for (int x = 0; x < 40; ++x) EXPECT_EQ(a.view<std::uint8_t>()(x, y, 3), first.view<std::uint8_t>()(x, y, 3));
  }
}

TEST(UnsharpMask, ATranslucentColorIsSharpenedAsAnOpaqueOne) {
  // The same alpha everywhere: colors come out as without alpha.
  for (const AlphaState alpha : {AlphaState::Straight, AlphaState::Premultiplied}) {
    const Image plain = random_image(ImageInfo{25, 21, 3, PixelType::F32}, 2);
    Image translucent(ImageInfo{25, 21, 4, PixelType::F32, ColorState::Srgb, alpha});
    const float factor = alpha == AlphaState::Premultiplied ? 0.5F : 1.0F;
    for (int y = 0; y < 21; ++y) {
      for (int x = 0; x < 25; ++x) {
        for (int c = 0; c < 3; ++c) translucent.view<float>()(x, y, c) = plain.view<float>()(x, y, c) * factor;
        translucent.view<float>()(x, y, 3) = 0.5F;
      }
    }
    const Image expected = unsharp_mask(plain, {.sigma = 2});
    const Image result = unsharp_mask(translucent, {.sigma = 2});
    for (int y = 0; y < 21; ++y) {
      for (int x = 0; x < 25; ++x) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(result.view<float>()(x, y, c), expected.view<float>()(x, y, c) * factor, 2e-6);
        }
      }
    }
  }
}

TEST(UnsharpMask, CopiesWithoutWidthAndRefusesBadOptions) {
  const Image source = random_image(Image(9, 7, 3).info(), 1);
  const Image result = unsharp_mask(source, {.sigma = 0});
  for (int y = 0; y < 7; ++y) {
    EXPECT_TRUE(std::equal(source.view<std::uint8_t>().row(y), source.view<std::uint8_t>().row(y) + 27,
                           result.view<std::uint8_t>().row(y)));
  }
  EXPECT_THROW(unsharp_mask(source, {.amount = -1}), Error);
  EXPECT_THROW(unsharp_mask(source, {.threshold = std::numeric_limits<float>::quiet_NaN()}), Error);
}

}  // namespace
}  // namespace azulejo
