#include "azulejo/rendering/picture_onto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Image random_image(const ImageInfo& info, unsigned seed) {
  Image image(info);
  std::mt19937 random(seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    const float full = full_range(kPixelTypeOf<T>);
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        const float unit = static_cast<float>(random() % 1000) / 999.0F;
        view.row(y)[i] = static_cast<T>(unit * full);
      }
    }
  });
  return image;
}

/// Channel c of a pixel in units of full range: gray is three channels, no alpha is 1.
double at(const Image& image, int x, int y, int c) {
  const ImageInfo& info = image.info();
  double value = 0;
  visit(image.any(), [&](auto view) {
    const double full = static_cast<double>(full_range(info.type));
    if (c == 3) {
      value = info.alpha == AlphaState::None ? 1 : static_cast<double>(view(x, y, info.channels - 1)) / full;
    } else {
      value = static_cast<double>(view(x, y, info.color_channels() == 1 ? 0 : c)) / full;
    }
  });
  return value;
}

/// Over in double: straight alpha on both.
TEST(PictureOnto, IsOver) {
  const Rect area{2, 1, 9, 5};
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 2, 3, 4}) {
      const AlphaState alpha = channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
      const Image under = random_image({13, 7, channels, type, ColorState::Srgb, alpha}, 3);
      const Image picture = random_image({13, 7, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, 4);
      const Image result = picture_onto(under, picture, area, {});
      EXPECT_EQ(result.info().type, type);
      EXPECT_EQ(result.info().alpha, alpha);
      EXPECT_EQ(result.info().color_channels(), 3);
      // Half a step of rounding, and of f32 what a few roundings to 24 bits make, divided by an alpha of 1/255 at least.
      const double tolerance = type == PixelType::F32 ? 1e-4 : 0.51 / static_cast<double>(full_range(type));
      for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 13; ++x) {
          const bool inside = area.contains({x, y, 1, 1});
          const double share = inside ? at(picture, x, y, 3) : 0;
          const double below = at(under, x, y, 3);
          const double both = share + (1 - share) * below;
          if (alpha != AlphaState::None) {
            ASSERT_NEAR(at(result, x, y, 3), both, tolerance);
          }
          for (int c = 0; c < 3; ++c) {
            const double sum = share * at(picture, x, y, c) + (1 - share) * below * at(under, x, y, c);
            // The rounded alpha divides: small ones are coarse.
            const double slack = alpha != AlphaState::None && type == PixelType::U8 ? 0.6 / 255 / both : 0;
            if (both > 0.02) {
              ASSERT_NEAR(at(result, x, y, c), sum / both, tolerance + slack) << x << "," << y;
            }
          }
        }
      }
    }
  }
}

TEST(PictureOnto, LeavesBytesWhereNothingIsDrawn) {
  const ImageInfo info{40, 30, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight};
  const Image under = random_image(info, 5);
  Image clear(info);  // transparent
  for (int y = 0; y < 30; ++y) std::fill_n(clear.view<std::uint8_t>().row(y), 160, std::uint8_t{0});
  const Image result = picture_onto(under, clear, info.rect(), {});
  const Image outside = picture_onto(under, random_image(info, 6), {50, 2, 3, 3}, {});
  for (int y = 0; y < 30; ++y) {
    for (int i = 0; i < 160; ++i) {
      const std::uint8_t alpha = under.view<std::uint8_t>().row(y)[i / 4 * 4 + 3];
      if (alpha > 0) {
        ASSERT_EQ(result.view<std::uint8_t>().row(y)[i], under.view<std::uint8_t>().row(y)[i]);
      }
      ASSERT_EQ(outside.view<std::uint8_t>().row(y)[i], under.view<std::uint8_t>().row(y)[i]);
    }
  }
}

TEST(PictureOnto, RefusesWhatDoesNotFit) {
  const Image picture({4, 4, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight});
  const Image smaller({4, 3, 3, PixelType::U8, ColorState::Srgb, AlphaState::None});
  const Image data({4, 4, 1, PixelType::F32, ColorState::Data, AlphaState::None});
  EXPECT_THROW(picture_onto(smaller, picture, {0, 0, 4, 4}, {}), Error);
  EXPECT_THROW(picture_onto(data, picture, {0, 0, 4, 4}, {}), Error);
}

}  // namespace
}  // namespace azulejo
