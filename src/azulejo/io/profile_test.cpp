#include "azulejo/io/profile.h"

#include <lcms2.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  Bytes bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

Bytes srgb() { return saved(cmsCreate_sRGBProfile()); }

/// sRGB's colorants with a plain power as curve.
Bytes with_gamma(double gamma) {
  const cmsCIExyY white = {0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, gamma);
  cmsToneCurve* const curves[] = {curve, curve, curve};
  Bytes bytes = saved(cmsCreateRGBProfile(&white, &primaries, curves));
  cmsFreeToneCurve(curve);
  return bytes;
}

Bytes gray_with_gamma(double gamma) {
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, gamma);
  Bytes bytes = saved(cmsCreateGrayProfile(cmsD50_xyY(), curve));
  cmsFreeToneCurve(curve);
  return bytes;
}

constexpr ImageInfo kRgb8 = {1, 1, 3, PixelType::U8, ColorState::Srgb, AlphaState::None};

double encoded(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

TEST(Profile, SrgbIsNotConverted) {
  Warnings warnings;
  const ProfileConversion conversion = profile_to_srgb(srgb(), kRgb8, false, "a", warnings.run());
  EXPECT_TRUE(conversion.understood);
  EXPECT_EQ(conversion.transform, nullptr);
  EXPECT_TRUE(warnings.lines.empty());
  EXPECT_NE(profile_description(srgb()).find("sRGB"), std::string::npos);
}

TEST(Profile, LinearLightIsEncodedInEveryType) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const ImageInfo info = {4, 1, 4, type, ColorState::Srgb, AlphaState::Straight};
    const ProfileConversion conversion = profile_to_srgb(with_gamma(1), info, false, "a", {});
    ASSERT_NE(conversion.transform, nullptr);
    const Image source = random_image(info, 11);
    Image result(info);
    conversion.transform->apply(source.any(), result.any());
    // 8 bits are read from a table of Little CMS with 8 to 16 bits inside: a step more than rounding alone.
    const double tolerance = type == PixelType::U8 ? 1.1 / 255 : 1e-3;
    visit(source.any(), [&](auto before) {
      using T = std::remove_const_t<std::remove_reference_t<decltype(*before.data)>>;
      const double full = static_cast<double>(full_range(type));
      for (int x = 0; x < 4; ++x) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(static_cast<double>(result.view<T>()(x, 0, c)) / full,
                      encoded(static_cast<double>(before(x, 0, c)) / full), tolerance);
        }
        EXPECT_EQ(result.view<T>()(x, 0, 3), before(x, 0, 3)) << "alpha is copied";
      }
    });
  }
}

TEST(Profile, GrayStaysGray) {
  const ImageInfo info = {1, 1, 1, PixelType::U16, ColorState::Srgb, AlphaState::None};
  const ProfileConversion conversion = profile_to_srgb(gray_with_gamma(1), info, false, "a", {});
  ASSERT_NE(conversion.transform, nullptr);
  Image image(info);
  image.view<std::uint16_t>()(0, 0) = 32768;
  conversion.transform->apply(image.any(), image.any());
  EXPECT_NEAR(image.view<std::uint16_t>()(0, 0) / 65535.0, encoded(0.5), 1e-3);
}

TEST(Profile, DamageAndWrongChannelsAreWarnedOf) {
  Bytes damaged = with_gamma(1.8);
  damaged.resize(100);
  Warnings warnings;
  EXPECT_FALSE(profile_to_srgb(damaged, kRgb8, false, "a.png", warnings.run()).understood);
  EXPECT_FALSE(profile_to_srgb(gray_with_gamma(1), kRgb8, false, "a.png", warnings.run()).understood);
  ASSERT_EQ(warnings.lines.size(), 2U);
  for (const std::string& line : warnings.lines) EXPECT_EQ(line.find("a.png: "), 0U);
  EXPECT_EQ(profile_description(damaged), "");
}

TEST(Profile, AnyBytesAreAllowed) {
  const Bytes whole = with_gamma(1.8);
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    Bytes bytes = whole;
    for (int flips = 0; flips < 3; ++flips)
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    if (round % 3 == 0) bytes.resize(random() % bytes.size());
    profile_description(bytes);
    const ProfileConversion conversion = profile_to_srgb(bytes, kRgb8, false, "a", {});
    Image image = random_image(kRgb8, 1);
    if (conversion.transform) conversion.transform->apply(image.any(), image.any());
  }
}

TEST(Profile, InkTakesLightAway) {
  const ImageInfo cmyk = {1, 1, 4, PixelType::U8, ColorState::Srgb, AlphaState::None};
  Image inks(cmyk);
  const std::uint8_t given[] = {255, 0, 51, 51};
  std::copy(std::begin(given), std::end(given), inks.view<std::uint8_t>().row(0));
  Image result(kRgb8);
  cmyk_to_srgb()->apply(inks.any(), result.any());
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 0), 0);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 1), 204);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 2), 163);  // 0.8 · 0.8 · 255 = 163.2
}

TEST(Gamma, FollowsTheCurves) {
  const ImageInfo gray = {65536, 1, 1, PixelType::U16, ColorState::Srgb, AlphaState::None};
  Image ramp(gray);
  for (int i = 0; i < 65536; ++i) ramp.view<std::uint16_t>()(i, 0) = static_cast<std::uint16_t>(i);
  for (const float exponent : {0.35F, 0.7F, 1.0F, 2.5F}) {
    Image result(gray);
    gamma_to_srgb(exponent, gray)->apply(ramp.any(), result.any());
    for (int i = 0; i < 65536; i += 97) {
      const double wanted = encoded(std::pow(i / 65535.0, 1.0 / static_cast<double>(exponent))) * 65535;
      // The curves of transfer.h are within 10⁻⁶ and powers multiply that by the exponents: a step of 65535 more.
      EXPECT_NEAR(result.view<std::uint16_t>()(i, 0), wanted, 1.1) << exponent << " " << i;
    }
  }
}

TEST(Gamma, TheScreensIsSrgb) {
  EXPECT_EQ(gamma_to_srgb(0.45455F, kRgb8), nullptr);
  EXPECT_NE(gamma_to_srgb(1, kRgb8), nullptr);
}

}  // namespace
}  // namespace azulejo
