#include "azulejo/rendering/resolve.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "azulejo/data/image.h"

namespace azulejo {
namespace {

double srgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

/// Stored values before they are rounded, 0 to `full`; not rounded for f32.
std::array<double, 4> wanted(const glm::vec4& color, const Resolve& resolve, PixelType type) {
  std::array<double, 4> out{};
  for (int c = 0; c < 4; ++c) {
    const double drawn = static_cast<double>(color[c]) * (c < 3 ? static_cast<double>(resolve.exposure) : 1);
    out[static_cast<std::size_t>(c)] =
        drawn + static_cast<double>(resolve.background[c]) * (1 - static_cast<double>(color.w));
  }
  if (type == PixelType::F32) return out;
  const double full = static_cast<double>(full_range(type));
  const double alpha = std::min(out[3], 1.0);
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = alpha > 0 ? full * srgb(std::clamp(out[c] / alpha, 0.0, 1.0)) : 0;
  }
  out[3] = full * std::max(alpha, 0.0);
  return out;
}

ImageInfo info_of(int width, int height, PixelType type) {
  return {width, height, 4, type, ColorState::Srgb, AlphaState::Straight};
}

Image resolved(const std::vector<glm::vec4>& colors, int width, int height, const Resolve& resolve, PixelType type) {
  Image image(info_of(width, height, type));
  // Vectors read whole: the rows of a tile are padded and aligned.
  const std::size_t stride = (static_cast<std::size_t>(width) + 63) / 64 * 64;
  struct alignas(64) Line {
    glm::vec4 pixels[4];
  };
  std::vector<Line> lines(stride / 4 * static_cast<std::size_t>(height));
  glm::vec4* const padded = lines[0].pixels;
  for (std::size_t i = 0; i < stride * static_cast<std::size_t>(height); ++i) padded[i] = glm::vec4(0);
  for (int y = 0; y < height; ++y) {
    std::copy_n(colors.begin() + static_cast<std::ptrdiff_t>(y) * width, width,
                padded + static_cast<std::size_t>(y) * stride);
  }
  kernels::resolve_pixels(padded, stride, resolve, image.any());
  return image;
}

double stored(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// What resolve.h promises, from the exact value: 0.52 of a level of u8, 0.6 of u16; f32: two roundings.
void expect_resolved(const std::vector<glm::vec4>& colors, const Resolve& resolve, PixelType type) {
  const int width = static_cast<int>(colors.size());
  const Image image = resolved(colors, width, 1, resolve, type);
  for (int x = 0; x < width; ++x) {
    const glm::vec4& color = colors[static_cast<std::size_t>(x)];
    const auto exact = wanted(color, resolve, type);
    for (int c = 0; c < 4; ++c) {
      const double value = exact[static_cast<std::size_t>(c)];
      const double tolerance = type == PixelType::U8    ? 0.52
                               : type == PixelType::U16 ? 0.6
                                                        : 3e-7 * (1 + std::fabs(value));
      ASSERT_NEAR(stored(image, x, 0, c), value, tolerance) << color.x << " alpha " << color.w << " channel " << c;
    }
  }
}

TEST(Resolve, OpaqueColorsAreTheirSrgb) {
  std::vector<glm::vec4> colors;
  for (int i = 0; i <= 30000; ++i) {
    const float t = static_cast<float>(i) / 30000;
    colors.emplace_back(t, t * t * t, t * t * t * t * 0.01F, 1);
  }
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) expect_resolved(colors, {}, type);
}

/// Every stored value comes back from the light that it stands for.
TEST(Resolve, EveryByteComesBack) {
  std::vector<glm::vec4> colors;
  for (int i = 0; i < 256; ++i) {
    const double encoded = i / 255.0;
    const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    colors.emplace_back(static_cast<float>(linear), 0, 0, 1);
  }
  const Image image = resolved(colors, 256, 1, {}, PixelType::U8);
  for (int i = 0; i < 256; ++i) EXPECT_EQ(image.view<std::uint8_t>()(i, 0, 0), i);
}

TEST(Resolve, TransparentColorsBackgroundsAndExposures) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int round = 0; round < 20; ++round) {
    std::vector<glm::vec4> colors;
    for (int i = 0; i < 500; ++i) {
      // Of opacities below a hundredth the rounding of the sum of two parts would show.
      const float alpha = i % 5 == 0 ? 1 : 0.01F + 0.99F * unit(random);
      colors.push_back(glm::vec4(unit(random) * alpha, unit(random) * alpha, unit(random) * alpha, alpha));
      if (i % 7 == 0) colors.back() = glm::vec4(0);
    }
    Resolve resolve;
    if (round % 2 == 1) {
      const float alpha = round % 4 == 1 ? 1 : unit(random);
      resolve.background = glm::vec4(unit(random) * alpha, unit(random) * alpha, unit(random) * alpha, alpha);
    }
    resolve.exposure = round % 3 == 0 ? 1 : 3 * unit(random);
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) expect_resolved(colors, resolve, type);
  }
}

TEST(Resolve, ValuesOutOfRangeAreClampedAndNanIsBlack) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<glm::vec4> colors = {{nan, 0.5F, nan, 1},       {infinity, -infinity, 1e30F, 1}, {-1, 2, -0.0F, 1},
                                         {0.5F, 0.5F, 0.5F, -0.5F}, {0.5F, 0.5F, 0.5F, 2},           {0, 0, 0, nan}};
  const Image bytes = resolved(colors, 6, 1, {}, PixelType::U8);
  const auto at = [&](int x, int c) { return static_cast<int>(bytes.view<std::uint8_t>()(x, 0, c)); };
  EXPECT_EQ(at(0, 0), 0);
  EXPECT_EQ(at(0, 1), 188);
  EXPECT_EQ(at(0, 2), 0);
  EXPECT_EQ(at(0, 3), 255);
  EXPECT_EQ(at(1, 0), 255);
  EXPECT_EQ(at(1, 1), 0);
  EXPECT_EQ(at(1, 2), 255);
  EXPECT_EQ(at(2, 0), 0);
  EXPECT_EQ(at(2, 1), 255);
  EXPECT_EQ(at(2, 2), 0);
  EXPECT_EQ(at(3, 3), 0);
  EXPECT_EQ(at(4, 3), 255);
  const Image floats = resolved(colors, 6, 1, {}, PixelType::F32);
  EXPECT_TRUE(std::isnan(floats.view<float>()(0, 0, 0))) << "floats are kept as they are";
  EXPECT_EQ(floats.view<float>()(2, 0, 1), 2);
}

/// Rows of every width, beside pixels that must stay; the same on every vector target but for a level.
TEST(Resolve, EveryWidthOnEveryVectorTarget) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const std::int64_t vector_target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(vector_target);
    for (int width = 1; width < 40; ++width) {
      std::vector<glm::vec4> colors(static_cast<std::size_t>(width) * 3);
      for (glm::vec4& color : colors) {
        const float alpha = unit(random);
        color = random() % 3 == 0 ? glm::vec4(0) : glm::vec4(unit(random) * alpha, 0, unit(random) * alpha, alpha);
      }
      const Resolve resolve{{0.1F, 0.2F, 0.3F, 0.7F}, 1};
      for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
        const Image image = resolved(colors, width, 3, resolve, type);
        for (int y = 0; y < 3; ++y) {
          for (int x = 0; x < width; ++x) {
            const auto exact = wanted(colors[static_cast<std::size_t>(y * width + x)], resolve, type);
            for (int c = 0; c < 4; ++c) {
              ASSERT_NEAR(stored(image, x, y, c), exact[static_cast<std::size_t>(c)],
                          type == PixelType::F32 ? 1e-6 : 0.6);
            }
          }
        }
        Image wide(info_of(width + 20, 3, type));
        for (int y = 0; y < 3; ++y) std::memset(wide.any().row(y), 0x5A, wide.info().row_bytes());
        std::vector<glm::vec4> aligned(64 * 3 + 4, glm::vec4(0.25F));
        auto* start =
            reinterpret_cast<glm::vec4*>((reinterpret_cast<std::uintptr_t>(aligned.data()) + 63) & ~std::uintptr_t{63});
        kernels::resolve_pixels(start, 64, resolve, wide.any().crop({0, 0, width, 3}));
        for (int y = 0; y < 3; ++y) {
          const std::byte* const row = wide.any().row(y);
          const std::size_t end = wide.info().row_bytes();
          for (std::size_t b = static_cast<std::size_t>(width) * wide.info().pixel_bytes(); b < end; ++b) {
            ASSERT_EQ(row[b], std::byte{0x5A}) << "width " << width;
          }
        }
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace azulejo
