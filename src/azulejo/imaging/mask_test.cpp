#include "azulejo/imaging/mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/multiply.h"

namespace azulejo {
namespace {

ImageInfo kind(int channels, PixelType type, AlphaState alpha = AlphaState::None) {
  return {83, 11, channels, type, ColorState::Srgb, alpha};
}

double intensity(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) {
    return static_cast<double>(view(x, y, c)) / static_cast<double>(full_range(image.type()));
  });
}

/// The weight by its definition, in steps of the source's type.
double weight(const Image& mask, int x, int y, PixelType type) {
  const ImageInfo& info = mask.info();
  double sum = 0;
  for (int c = 0; c < info.color_channels(); ++c) sum += intensity(mask, x, y, c);
  sum /= info.color_channels();
  if (info.alpha == AlphaState::Straight) sum *= intensity(mask, x, y, info.channels - 1);
  const double fine = std::floor(std::clamp(sum, 0.0, 1.0) * 65535 + 0.5) / 65535;
  return type == PixelType::U8 ? std::floor(fine * 255 + 0.5) / 255 : fine;
}

TEST(Mask, IsColorTimesWeight) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const PixelType mask_type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
      for (const ImageInfo& area : {kind(1, mask_type), kind(3, mask_type), kind(2, mask_type, AlphaState::Straight)}) {
        for (const int channels : {1, 3}) {
          const Image source = random_image(kind(channels, type), 1);
          const Image marks = random_image(area, 2);
          const Image result = mask(source, marks);
          const double step = type == PixelType::F32 ? 1e-7 : 0.5001 / static_cast<double>(full_range(type));
          for (int y = 0; y < 11; ++y) {
            for (int x = 0; x < 83; ++x) {
              for (int c = 0; c < channels; ++c) {
                const double exact = intensity(source, x, y, c) * weight(marks, x, y, type);
                ASSERT_NEAR(intensity(result, x, y, c), exact, step) << describe(source.info()) << describe(area);
              }
            }
          }
        }
      }
    }
  }
}

TEST(Mask, OfTheSameTypeIsAProduct) {
  const Image source = random_image(kind(3, PixelType::U16), 3);
  const Image marks = random_image(kind(1, PixelType::U16), 4);
  const Image masked = mask(source, marks);
  const Image product = multiply(source, marks);
  for (int y = 0; y < 11; ++y) {
    for (int i = 0; i < 83 * 3; ++i) {
      ASSERT_EQ(masked.view<std::uint16_t>().row(y)[i], product.view<std::uint16_t>().row(y)[i]);
    }
  }
}

TEST(Mask, AndItsInverseMakeTheWhole) {
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  const Image source = random_image(kind(3, PixelType::U8), seed);
  Image marks = random_image(kind(1, PixelType::U8), seed + 1);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 83; ++x) {
      auto& value = marks.view<std::uint8_t>()(x, y);
      value = value > 127 ? 255 : 0;
    }
  }
  const Image inside = mask(source, marks);
  const Image outside = mask(source, marks, {.invert = true});
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 83; ++x) {
      for (int c = 0; c < 3; ++c) {
        const bool in = marks.view<std::uint8_t>()(x, y) == 255;
        const int value = source.view<std::uint8_t>()(x, y, c);
        ASSERT_EQ(inside.view<std::uint8_t>()(x, y, c), in ? value : 0);
        ASSERT_EQ(outside.view<std::uint8_t>()(x, y, c), in ? 0 : value);
      }
    }
  }
}

TEST(Mask, LeavesAlphaAloneOrMakesIt) {
  Image marks(3, 1, 1);
  const std::uint8_t weights[] = {0, 51, 255};
  std::copy_n(weights, 3, marks.view<std::uint8_t>().row(0));
  const auto masked = [&](AlphaState alpha, bool transparent) {
    const bool has_alpha = alpha != AlphaState::None;
    Image source(ImageInfo{3, 1, has_alpha ? 2 : 1, PixelType::U8, ColorState::Srgb, alpha});
    for (int x = 0; x < 3; ++x) {
      source.view<std::uint8_t>()(x, 0, 0) = 100;
      if (has_alpha) source.view<std::uint8_t>()(x, 0, 1) = 200;
    }
    const Image result = mask(source, marks, {.transparent = transparent});
    const std::uint8_t* const row = result.view<std::uint8_t>().row(0);
    return std::vector<int>(row, row + 3 * result.channels());
  };
  EXPECT_EQ(masked(AlphaState::None, false), (std::vector<int>{0, 20, 100}));
  EXPECT_EQ(masked(AlphaState::Straight, false), (std::vector<int>{0, 200, 20, 200, 100, 200}));
  EXPECT_EQ(masked(AlphaState::Premultiplied, false), (std::vector<int>{0, 200, 20, 200, 100, 200}));
  EXPECT_EQ(masked(AlphaState::None, true), (std::vector<int>{0, 0, 100, 51, 100, 255}));
  EXPECT_EQ(masked(AlphaState::Straight, true), (std::vector<int>{0, 0, 100, 40, 100, 200}));
  EXPECT_EQ(masked(AlphaState::Premultiplied, true), (std::vector<int>{0, 0, 20, 40, 100, 200}));
}

TEST(Mask, NaNIsLeftOutWithTheRest) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Image source(3, 1, 1, PixelType::F32);
  std::fill_n(source.view<float>().row(0), 3, nan);
  Image marks(3, 1, 1, PixelType::F32);
  const float weights[] = {0, 1, nan};
  std::copy_n(weights, 3, marks.view<float>().row(0));
  const Image result = mask(source, marks);
  EXPECT_EQ(result.view<float>()(0, 0), 0.0F);
  EXPECT_TRUE(std::isnan(result.view<float>()(1, 0)));
  EXPECT_EQ(result.view<float>()(2, 0), 0.0F);
}

TEST(Mask, RefusesWhatDoesNotFit) {
  EXPECT_THROW(mask(Image(4, 4, 3), Image(4, 5, 1)), Error);
  EXPECT_THROW(mask(Image(ImageInfo{4, 4, 2}), Image(4, 4, 1), {.transparent = true}), Error);
}

}  // namespace
}  // namespace azulejo
