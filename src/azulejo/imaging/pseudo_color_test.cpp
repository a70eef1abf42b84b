#include "azulejo/imaging/pseudo_color.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/color_space.h"

namespace azulejo {
namespace {

using Rgb = std::array<int, 3>;

constexpr ColorMap kMaps[] = {ColorMap::Viridis, ColorMap::Magma, ColorMap::Turbo,   ColorMap::Jet,
                              ColorMap::Hot,     ColorMap::Gray,  ColorMap::Rainbow, ColorMap::Cyclic};

Image ramp() {
  Image image(256, 1, 1);
  for (int v = 0; v < 256; ++v) image.view<std::uint8_t>()(v, 0) = static_cast<std::uint8_t>(v);
  return image;
}

Rgb at(const Image& image, int x) {
  const auto view = image.view<std::uint8_t>();
  return {view(x, 0, 0), view(x, 0, 1), view(x, 0, 2)};
}

Image floats(std::initializer_list<float> values) {
  Image image(static_cast<int>(values.size()), 1, 1, PixelType::F32);
  std::copy(values.begin(), values.end(), image.view<float>().row(0));
  return image;
}

void expect_near(const Rgb& got, const Rgb& expected) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 1);
}

TEST(PseudoColor, HasThePublishedColors) {
  // Of the tables of 256, times 255: places between the control points, where the error is largest.
  const struct {
    ColorMap map;
    int value;
    Rgb color;
  } published[] = {{ColorMap::Viridis, 0, {68, 1, 84}},      {ColorMap::Viridis, 127, {33, 144, 140}},
                   {ColorMap::Viridis, 255, {253, 231, 37}}, {ColorMap::Magma, 0, {0, 0, 4}},
                   {ColorMap::Magma, 127, {182, 54, 121}},   {ColorMap::Magma, 255, {252, 253, 191}},
                   {ColorMap::Turbo, 0, {48, 18, 59}},       {ColorMap::Turbo, 128, {164, 252, 60}},
                   {ColorMap::Turbo, 255, {122, 4, 3}}};
  for (const auto& [map, value, color] : published) expect_near(at(pseudo_color(ramp(), {.map = map}), value), color);
}

TEST(PseudoColor, TheSmoothMapsHaveNoKinks) {
  // Second differences over five of 256 steps, the distance of control points; a wrong one of them makes one of twice
  // its error.
  const std::pair<ColorMap, int> bounds[] = {
      {ColorMap::Viridis, 6}, {ColorMap::Magma, 3}, {ColorMap::Turbo, 6}, {ColorMap::Cyclic, 12}};
  for (const auto& [map, bound] : bounds) {
    const Image colors = pseudo_color(ramp(), {.map = map});
    for (int x = 5; x + 5 < 256; x += 5) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_LE(std::abs(at(colors, x - 5)[c] - 2 * at(colors, x)[c] + at(colors, x + 5)[c]), bound) << x;
      }
    }
  }
}

TEST(PseudoColor, JetAndHotAreTheirFormulas) {
  const Image jet = pseudo_color(ramp(), {.map = ColorMap::Jet});
  const Image hot = pseudo_color(ramp(), {.map = ColorMap::Hot});
  for (int v = 0; v < 256; ++v) {
    SCOPED_TRACE(v);
    const double t = v / 255.0;
    const auto byte = [](double x) { return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
    const auto hill = [&](double middle) { return byte(1.5 - std::abs(4 * t - middle)); };
    expect_near(at(jet, v), {hill(3), hill(2), hill(1)});
    expect_near(at(hot, v), {byte(t * 8 / 3), byte(t * 8 / 3 - 1), byte(t * 4 - 3)});
  }
}

TEST(PseudoColor, LightnessOfThePerceptualMapsRisesEvenly) {
  // CIELAB as a judge: no step is backwards, and none is more than twice the mean.
  for (const ColorMap map : {ColorMap::Viridis, ColorMap::Magma}) {
    const Image lab =
        color_space(pseudo_color(floats({0, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F, 0.8F, 0.9F, 1}), {.map = map}));
    const float rise = lab.view<float>()(10, 0) - lab.view<float>()(0, 0);
    for (int x = 1; x <= 10; ++x) {
      const float step = lab.view<float>()(x, 0) - lab.view<float>()(x - 1, 0);
      EXPECT_GT(step, 0.05F * rise);
      EXPECT_LT(step, 0.2F * rise);
    }
  }
  for (const ColorMap map : {ColorMap::Viridis, ColorMap::Magma}) {
    Image fine(1001, 1, 1, PixelType::F32);
    for (int x = 0; x <= 1000; ++x) fine.view<float>()(x, 0) = static_cast<float>(x) / 1000;
    const Image lab = color_space(pseudo_color(fine, {.map = map}));
    for (int x = 1; x <= 1000; ++x) EXPECT_GT(lab.view<float>()(x, 0), lab.view<float>()(x - 1, 0)) << x;
  }
}

TEST(PseudoColor, TheCyclicMapHasOneLightnessAndEndsWhereItBegan) {
  Image fine(1001, 1, 1, PixelType::F32);
  for (int x = 0; x <= 1000; ++x) fine.view<float>()(x, 0) = static_cast<float>(x) / 1000;
  const Image colors = pseudo_color(fine, {.map = ColorMap::Cyclic});
  const Image lch = color_space(colors, {.to = ColorSpace::Lch});
  for (int x = 0; x <= 1000; ++x) {
    EXPECT_NEAR(100 * lch.view<float>()(x, 0, 0), 70, 0.5);
    EXPECT_NEAR(150 * lch.view<float>()(x, 0, 1), 38, 1);
    const float turns = std::abs(lch.view<float>()(x, 0, 2) - static_cast<float>(x) / 1000);
    EXPECT_LT(std::min(turns, 1 - turns), 0.01);
  }
  for (int c = 0; c < 3; ++c) EXPECT_EQ(colors.view<float>()(0, 0, c), colors.view<float>()(1000, 0, c));
}

TEST(PseudoColor, TheGrayMapChangesNothing) {
  const Image source = random_image(Image(61, 17, 1, PixelType::U16).info(), 4);
  const Image result = pseudo_color(source, {.map = ColorMap::Gray});
  for (int x = 0; x < 61; ++x) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(result.view<std::uint16_t>()(x, 9, c), source.view<std::uint16_t>()(x, 9));
  }
}

TEST(PseudoColor, TheRangeStretchesCutsAndTurns) {
  const Image source = floats({-3, 2, 3, 4, 9});
  const Image gray = pseudo_color(source, {.map = ColorMap::Gray, .low = 2.0F, .high = 4.0F});
  const Image turned = pseudo_color(source, {.map = ColorMap::Gray, .low = 4.0F, .high = 2.0F});
  const Image constant = pseudo_color(source, {.map = ColorMap::Gray, .low = 3.0F, .high = 3.0F});
  const float expected[] = {0, 0, 0.5F, 1, 1};
  for (int x = 0; x < 5; ++x) {
    EXPECT_EQ(gray.view<float>()(x, 0), expected[x]);
    EXPECT_EQ(turned.view<float>()(x, 0), 1 - expected[x]);
    EXPECT_EQ(constant.view<float>()(x, 0), 0);
  }
}

TEST(PseudoColor, AutoTakesTheFiniteExtremes) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const PseudoColorOptions options{.map = ColorMap::Gray, .low = {}, .high = {}, .nan_color = {0.25F, 0.5F, 0.75F, 1}};
  const Image result = pseudo_color(floats({kNaN, -2, 0, 2, kInfinity, -kInfinity}), options);
  const float expected[] = {0.25F, 0, 0.5F, 1, 1, 0};
  for (int x = 0; x < 6; ++x) EXPECT_EQ(result.view<float>()(x, 0), expected[x]) << x;
  EXPECT_EQ(result.view<float>()(0, 0, 2), 0.75F);
  for (const float each : {kNaN, 5.0F}) {  // nothing, or nothing but one value
    EXPECT_EQ(pseudo_color(floats({each}), options).view<float>()(0, 0), each == each ? 0 : 0.25F);
  }
}

TEST(PseudoColor, LevelsAreBandsOfEqualWidth) {
  const Image source = ramp();
  for (const ColorMap map : kMaps) {
    const Image all = pseudo_color(source, {.map = map});
    const Image bands = pseudo_color(source, {.map = map, .levels = 4});
    for (int v = 0; v < 256; ++v) {
      const int band = std::min(3, v * 4 / 255);
      EXPECT_EQ(at(bands, v), at(all, band * 85)) << v;
    }
  }
}

TEST(PseudoColor, HiddenPixelsDoNotCountAndPremultipliedOnesAreDivided) {
  Image straight(3, 1, 2, PixelType::F32);
  const float values[] = {0.2F, 1, 0.6F, 0.5F, 0.9F, 0};
  std::copy_n(values, 6, straight.view<float>().row(0));
  Image premultiplied = straight.clone();
  premultiplied.view<float>()(1, 0) = 0.3F;
  premultiplied.view<float>()(2, 0) = 0;
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  const PseudoColorOptions options{.map = ColorMap::Gray, .low = {}, .high = {}};
  const Image a = pseudo_color(straight, options);
  const Image b = pseudo_color(premultiplied, options);
  EXPECT_EQ(a.info().channels, 4);
  const float expected[] = {0, 1, 1};
  for (int x = 0; x < 3; ++x) {
    const float alpha = values[2 * x + 1];
    EXPECT_EQ(a.view<float>()(x, 0, 0), expected[x]);
    EXPECT_EQ(b.view<float>()(x, 0, 0), expected[x] * alpha);
    EXPECT_EQ(a.view<float>()(x, 0, 3), alpha);
    EXPECT_EQ(b.view<float>()(x, 0, 3), alpha);
  }
}

TEST(PseudoColor, RefusesColors) {
  EXPECT_THROW(pseudo_color(Image(1, 1, 3)), Error);
  EXPECT_THROW(pseudo_color(Image(1, 1, 1), {.levels = 1}), Error);
}

}  // namespace
}  // namespace azulejo
