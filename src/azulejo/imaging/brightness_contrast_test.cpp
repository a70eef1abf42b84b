#include "azulejo/imaging/brightness_contrast.h"

#include "azulejo/core/error.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

PointOperation with(float brightness, float contrast) {
  return [=](const Image& source) {
    return brightness_contrast(source, {.brightness = brightness, .contrast = contrast});
  };
}

TEST(BrightnessContrast, IsTheLine) {
  for (const float brightness : {-1.0F, -0.1F, 0.0F, 0.3F}) {
    for (const float contrast : {0.0F, 0.5F, 1.0F, 3.7F, 100.0F}) {
      const auto exact = [&](double v) {
        return (v - 0.5) * static_cast<double>(contrast) + 0.5 + static_cast<double>(brightness);
      };
      // Rounded four times, to 24 bits of numbers up to 1.5 + contrast: in levels of 65535, 0.016 of that.
      const double slack = 4 * 0x1p-25 * (1.5 + static_cast<double>(contrast));
      expect_rounded(with(brightness, contrast), exact, PixelType::U8, slack * 255);
      expect_rounded(with(brightness, contrast), exact, PixelType::U16, slack * 65535);
      expect_real(with(brightness, contrast), exact, slack, 0);
    }
  }
  EXPECT_TRUE(std::isnan(of_one(with(0.1F, 2), kNaN)));
}

TEST(BrightnessContrast, ByDefaultChangesNothing) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    expect_rounded(
        with(0, 1), [](double v) { return v; }, type, 1e-6);
  }
}

TEST(BrightnessContrast, LeavesAlphaAlone) { expect_alpha_is_left_alone(with(0.25F, 1.5F)); }

TEST(BrightnessContrast, RefusesOptionsOutOfRange) {
  const Image source(1, 1, 1);
  EXPECT_THROW(brightness_contrast(source, {.brightness = 2}), Error);
  EXPECT_THROW(brightness_contrast(source, {.contrast = -1}), Error);
}

}  // namespace
}  // namespace azulejo
