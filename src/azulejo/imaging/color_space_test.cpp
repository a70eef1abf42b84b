#include "azulejo/imaging/color_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

using Triple = std::array<double, 3>;

constexpr ColorSpace kSpaces[] = {ColorSpace::Srgb, ColorSpace::Linear, ColorSpace::Xyz, ColorSpace::Lab,
                                  ColorSpace::Lch,  ColorSpace::Hsv,    ColorSpace::Hsl, ColorSpace::Ycbcr};

std::string name_of(ColorSpace space) { return std::string(enum_names(space)[static_cast<std::size_t>(space)]); }

// The definitions in double precision, straight from their sources.

double decoded(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

double determinant(const Triple& a, const Triple& b, const Triple& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// X, Y, Z of chromaticities with Y = 1.
Triple xyz_of_chromaticity(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

const Triple kWhite = xyz_of_chromaticity(0.3127, 0.3290);

/// X, Y, Z of linear light: each primary as much as they must be to make white together.
Triple xyz_of_linear(const Triple& rgb) {
  const Triple red = xyz_of_chromaticity(0.64, 0.33);
  const Triple green = xyz_of_chromaticity(0.30, 0.60);
  const Triple blue = xyz_of_chromaticity(0.15, 0.06);
  const double all = determinant(red, green, blue);
  const double r = rgb[0] * determinant(kWhite, green, blue) / all;
  const double g = rgb[1] * determinant(red, kWhite, blue) / all;
  const double b = rgb[2] * determinant(red, green, kWhite) / all;
  return {r * red[0] + g * green[0] + b * blue[0], r * red[1] + g * green[1] + b * blue[1],
          r * red[2] + g * green[2] + b * blue[2]};
}

Triple lab_of_xyz(const Triple& xyz) {
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f(xyz[0] / kWhite[0]);
  const double y = f(xyz[1]);
  const double z = f(xyz[2] / kWhite[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double hue_of(const Triple& rgb) {
  const auto [low, high] = std::minmax_element(rgb.begin(), rgb.end());
  const double range = *high - *low;
  if (range == 0) return 0;
  double sixths = 0;
  if (rgb[0] == *high) {
    sixths = (rgb[1] - rgb[2]) / range;
  } else if (rgb[1] == *high) {
    sixths = (rgb[2] - rgb[0]) / range + 2;
  } else {
    sixths = (rgb[0] - rgb[1]) / range + 4;
  }
  return sixths < 0 ? sixths / 6 + 1 : sixths / 6;
}

/// As stored, 0–1, of an sRGB color 0–1.
Triple coded(ColorSpace space, const Triple& rgb) {
  const Triple linear = {decoded(rgb[0]), decoded(rgb[1]), decoded(rgb[2])};
  const Triple xyz = xyz_of_linear(linear);
  const Triple lab = lab_of_xyz(xyz);
  const double high = *std::max_element(rgb.begin(), rgb.end());
  const double low = *std::min_element(rgb.begin(), rgb.end());
  const double luma = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  const double turn = std::atan2(lab[2], lab[1]) / (2 * std::numbers::pi);
  switch (space) {
    case ColorSpace::Srgb: return rgb;
    case ColorSpace::Linear: return linear;
    case ColorSpace::Xyz: return {xyz[0] / kWhite[0], xyz[1] / kWhite[1], xyz[2] / kWhite[2]};
    case ColorSpace::Lab: return {lab[0] / 100, (lab[1] + 128) / 255, (lab[2] + 128) / 255};
    case ColorSpace::Lch: return {lab[0] / 100, std::hypot(lab[1], lab[2]) / 150, turn < 0 ? turn + 1 : turn};
    case ColorSpace::Hsv: return {hue_of(rgb), high == 0 ? 0 : (high - low) / high, high};
    case ColorSpace::Hsl: {
      const double width = 1 - std::abs(high + low - 1);
      return {hue_of(rgb), width < 1e-12 ? 0 : (high - low) / width, (high + low) / 2};
    }
    case ColorSpace::Ycbcr: return {luma, (rgb[2] - luma) / 1.772 + 128.0 / 255, (rgb[0] - luma) / 1.402 + 128.0 / 255};
  }
  return {};
}

bool has_hue(ColorSpace space, int channel) {
  return space == ColorSpace::Lch ? channel == 2
                                  : channel == 0 && (space == ColorSpace::Hsv || space == ColorSpace::Hsl);
}

/// The difference of two values as stored; hues may go around.
double difference(double a, double b, double full, bool hue) {
  const double straight = std::abs(a - b);
  return hue ? std::min(straight, full - straight) : straight;
}

/// All colors whose channels are multiples of 3 (86³), or of 255/`steps` in floats.
template <class T>
Image lattice(int steps) {
  const int n = steps + 1;
  Image image(n * n, n, 3, kPixelTypeOf<T>);
  for (int r = 0; r < n; ++r) {
    for (int g = 0; g < n; ++g) {
      for (int b = 0; b < n; ++b) {
        T* const pixel = &image.view<T>()(g * n + b, r);
        const int values[] = {r, g, b};
        for (int c = 0; c < 3; ++c) {
          pixel[c] =
              static_cast<T>(static_cast<double>(values[c]) * static_cast<double>(full_range(kPixelTypeOf<T>)) / steps);
        }
      }
    }
  }
  return image;
}

template <class T, class F>
void for_each_pixel(const Image& a, const Image& b, F f) {
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) f(&a.view<T>()(x, y), &b.view<T>()(x, y));
  }
}

template <class T>
Triple unit_of(const T* pixel) {
  const auto full = static_cast<double>(full_range(kPixelTypeOf<T>));
  return {static_cast<double>(pixel[0]) / full, static_cast<double>(pixel[1]) / full,
          static_cast<double>(pixel[2]) / full};
}

Image pixel_of(const std::array<float, 3>& color) {
  Image image(1, 1, 3, PixelType::F32);
  std::copy_n(color.begin(), 3, image.view<float>().row(0));
  return image;
}

TEST(ColorSpace, FloatsAreWithinTwoMillionthsOfTheDefinition) {
  const Image source = lattice<float>(32);
  for (const ColorSpace space : kSpaces) {
    SCOPED_TRACE(name_of(space));
    const Image result = color_space(source, {.to = space});
    double worst = 0;
    for_each_pixel<float>(source, result, [&](const float* from, const float* to) {
      const Triple exact = coded(space, unit_of(from));
      for (int c = 0; c < 3; ++c) {
        // An error of the plane turns the angle by as much divided by the radius.
        const double radius = has_hue(space, c) ? std::min(1.0, exact[1]) : 1;
        if (radius < 1e-4) continue;
        worst = std::max(worst, radius * difference(static_cast<double>(to[c]), exact[static_cast<std::size_t>(c)], 1,
                                                    has_hue(space, c)));
      }
    });
    EXPECT_LT(worst, 2e-6);
  }
}

TEST(ColorSpace, BytesOfHueSpacesAndYcbcrAreTheExactQuotientsRounded) {
  const Image source = lattice<std::uint8_t>(85);
  for (const ColorSpace space : {ColorSpace::Hsv, ColorSpace::Hsl, ColorSpace::Ycbcr}) {
    SCOPED_TRACE(name_of(space));
    const Image result = color_space(source, {.to = space});
    int wrong = 0;
    for_each_pixel<std::uint8_t>(source, result, [&](const std::uint8_t* from, const std::uint8_t* to) {
      const Triple exact = coded(space, unit_of(from));
      // Quotients that aren't a half differ from it by 1/3060 at least.
      for (int c = 0; c < 3; ++c) {
        wrong += to[c] != std::min(255, static_cast<int>(exact[static_cast<std::size_t>(c)] * 255 + 0.5 + 1e-9));
      }
    });
    EXPECT_EQ(wrong, 0);
  }
}

TEST(ColorSpace, IntegersAreTheDefinitionRounded) {
  const Image bytes = lattice<std::uint8_t>(51);
  const Image words = random_image(Image(307, 101, 3, PixelType::U16).info(), 3);
  for (const ColorSpace space : kSpaces) {
    SCOPED_TRACE(name_of(space));
    double worst_byte = 0;
    double worst_word = 0;
    const auto compare = [&](double& worst, double full) {
      return [&worst, full, space](const auto* from, const auto* to) {
        const Triple exact = coded(space, unit_of(from));
        const double radius = space == ColorSpace::Lch ? exact[1] : 1;
        for (int c = 0; c < 3; ++c) {
          if (has_hue(space, c) && radius < 0.01) continue;
          const double expected = std::clamp(exact[static_cast<std::size_t>(c)], 0.0, 1.0) * full;
          worst = std::max(worst, difference(static_cast<double>(to[c]), expected, full, has_hue(space, c)));
        }
      };
    };
    for_each_pixel<std::uint8_t>(bytes, color_space(bytes, {.to = space}), compare(worst_byte, 255));
    for_each_pixel<std::uint16_t>(words, color_space(words, {.to = space}), compare(worst_word, 65535));
    // Half a step, and of 16 bits what f32 is off: 2·10⁻⁶ of 65535, hues of little chroma more.
    EXPECT_LE(worst_byte, 0.5 + 2e-3);
    EXPECT_LE(worst_word, 0.5 + (space == ColorSpace::Lch ? 2 : 0.14));
  }
}

TEST(ColorSpace, LabOfThePrimariesIsAsPublished) {
  // Lindbloom's color calculator, sRGB, D65: L*, a*, b*. Its white is (0.95047, 1, 1.08883), ours from (0.3127, 0.3290).
  const struct {
    std::array<float, 3> rgb;
    Triple lab;
  } pairs[] = {{{1, 0, 0}, {53.2408, 80.0925, 67.2032}},
               {{0, 1, 0}, {87.7347, -86.1827, 83.1793}},
               {{0, 0, 1}, {32.2970, 79.1875, -107.8602}},
               {{1, 1, 0}, {97.1393, -21.5537, 94.4780}},
               {{0, 1, 1}, {91.1132, -48.0875, -14.1312}},
               {{1, 0, 1}, {60.3242, 98.2343, -60.8249}},
               {{1, 1, 1}, {100, 0, 0}},
               {{0, 0, 0}, {0, 0, 0}}};
  for (const auto& [rgb, lab] : pairs) {
    const Image result = color_space(pixel_of(rgb));
    const float* const stored = result.view<float>().row(0);
    EXPECT_NEAR(100 * stored[0], lab[0], 0.02);
    EXPECT_NEAR(255 * stored[1] - 128, lab[1], 0.02);
    EXPECT_NEAR(255 * stored[2] - 128, lab[2], 0.02);
  }
}

TEST(ColorSpace, ThereAndBackLosesWhatTheHeaderSays) {
  const Image source = lattice<std::uint8_t>(85);
  const Image words = random_image(Image(307, 101, 3, PixelType::U16).info(), 4);
  const Image floats = random_image(Image(307, 101, 3, PixelType::F32).info(), 5);
  // In the order of kSpaces.
  const int bytes_lost[] = {0, 6, 25, 24, 34, 3, 4, 1};
  const int words_lost[] = {0, 6, 40, 40, 50, 4, 4, 1};
  for (const ColorSpace space : kSpaces) {
    SCOPED_TRACE(name_of(space));
    const auto lost = [&]<class T>(T, const Image& image) {
      const Image back = color_space(color_space(image, {.to = space}), {.to = ColorSpace::Srgb, .from = space});
      EXPECT_EQ(back.info(), image.info());
      double worst = 0;
      for_each_pixel<T>(image, back, [&](const T* from, const T* to) {
        for (int c = 0; c < 3; ++c) {
          worst = std::max(worst, std::abs(static_cast<double>(from[c]) - static_cast<double>(to[c])));
        }
      });
      return worst;
    };
    EXPECT_EQ(lost(std::uint8_t{}, source), bytes_lost[static_cast<std::size_t>(space)]);
    EXPECT_LE(lost(std::uint16_t{}, words), words_lost[static_cast<std::size_t>(space)]);
    EXPECT_LT(lost(float{}, floats), 2e-5);
  }
}

TEST(ColorSpace, OverOtherSpacesIsTheSameAsDirectly) {
  const Image source = random_image(Image(64, 64, 3, PixelType::F32).info(), 6);
  for (const ColorSpace between : kSpaces) {
    for (const ColorSpace space : kSpaces) {
      SCOPED_TRACE(name_of(between) + " " + name_of(space));
      const Image direct = color_space(source, {.to = space});
      const Image over = color_space(color_space(source, {.to = between}), {.to = space, .from = between});
      EXPECT_EQ(direct.info(), over.info());
      for_each_pixel<float>(direct, over, [&](const float* a, const float* b) {
        for (int c = 0; c < 3; ++c) {
          const double radius = has_hue(space, c) ? std::max(1e-6, double{a[1]}) : 1;
          ASSERT_LT(radius * difference(double{a[c]}, double{b[c]}, 1, has_hue(space, c)), 1e-4);
        }
      });
    }
  }
}

TEST(ColorSpace, GrayHasNoColorInAnySpace) {
  Image source(256, 1, 3);
  for (int i = 0; i < 768; ++i) source.view<std::uint8_t>().row(0)[i] = static_cast<std::uint8_t>(i / 3);
  const std::pair<ColorSpace, std::array<int, 3>> expected[] = {{ColorSpace::Lab, {-1, 128, 128}},
                                                                {ColorSpace::Lch, {-1, 0, -1}},
                                                                {ColorSpace::Hsv, {0, 0, -1}},
                                                                {ColorSpace::Hsl, {0, 0, -1}},
                                                                {ColorSpace::Ycbcr, {-1, 128, 128}}};
  for (const auto& [space, values] : expected) {
    SCOPED_TRACE(name_of(space));
    const Image result = color_space(source, {.to = space});
    for (int x = 0; x < 256; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int value = values[static_cast<std::size_t>(c)];
        if (value >= 0) {
          EXPECT_EQ(result.view<std::uint8_t>()(x, 0, c), value) << x;
        }
      }
    }
  }
}

TEST(ColorSpace, PremultipliedColorIsConvertedAsIfItWereNot) {
  Image straight = random_image(Image(64, 8, 4, PixelType::F32).info(), 7);
  Image premultiplied = straight.clone();
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 3; ++c) premultiplied.view<float>()(x, y, c) *= straight.view<float>()(x, y, 3);
    }
  }
  premultiplied.view<float>()(0, 0, 3) = 0;
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  const Image a = color_space(straight);
  const Image b = color_space(premultiplied);
  EXPECT_EQ(b.info().alpha, AlphaState::Premultiplied);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(b.view<float>()(0, 0, c), 0);
  for (int x = 1; x < 64; ++x) {
    const float alpha = straight.view<float>()(x, 1, 3);
    EXPECT_EQ(b.view<float>()(x, 1, 3), alpha);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b.view<float>()(x, 1, c), a.view<float>()(x, 1, c) * alpha, 3e-6);
  }
}

TEST(ColorSpace, WhatIsNotFiniteMakesThreeNaNs) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (const ColorSpace space : kSpaces) {
      if (space == ColorSpace::Srgb) continue;
      const Image result = color_space(pixel_of({0.5F, bad, 0.25F}), {.to = space});
      for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isnan(result.view<float>()(0, 0, c))) << name_of(space);
    }
  }
}

TEST(ColorSpace, StatesSayWhatTheValuesAre) {
  Image source = pixel_of({0.2F, 0.4F, 0.6F});
  EXPECT_EQ(color_space(source, {.to = ColorSpace::Linear}).info().color, ColorState::Linear);
  const Image lab = color_space(source);
  EXPECT_EQ(lab.info().color, ColorState::Data);
  EXPECT_THROW(color_space(lab, {.to = ColorSpace::Srgb}), Error);
  source.set_states(ColorState::Linear, AlphaState::None);
  const Image srgb = color_space(source, {.to = ColorSpace::Srgb});
  EXPECT_EQ(srgb.info().color, ColorState::Srgb);
  EXPECT_NEAR(srgb.view<float>()(0, 0, 0), 0.48453, 1e-5);
}

TEST(ColorSpace, RefusesOtherChannels) {
  for (const int channels : {1, 2, 4}) {
    Image source(1, 1, channels);
    source.set_states(ColorState::Srgb, AlphaState::None);
    EXPECT_THROW(color_space(source), Error) << channels;
  }
}

}  // namespace
}  // namespace azulejo
