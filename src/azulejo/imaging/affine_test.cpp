#include "azulejo/imaging/affine.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/imaging/resize.h"
#include "azulejo/math/transform2d.h"
#include "azulejo/operations.h"

namespace azulejo {
namespace {

Image noise(int width, int height, int channels, PixelType type, unsigned seed, AlphaState alpha = AlphaState::None) {
  Image image({width, height, channels, type, ColorState::Srgb, alpha});
  std::mt19937 random(seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < width * channels; ++i) {
        if constexpr (std::is_same_v<T, float>) {
          view.row(y)[i] = static_cast<float>(random() % 1000) / 1000;
        } else {
          view.row(y)[i] = static_cast<T>(random());
        }
      }
    }
  });
  return image;
}

bool same(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (int y = 0; y < a.height(); ++y) {
    if (!std::equal(a.any().row(y), a.any().row(y) + a.info().row_bytes(), b.any().row(y))) return false;
  }
  return true;
}

constexpr AffineFilter kFilters[] = {AffineFilter::Nearest, AffineFilter::Bilinear, AffineFilter::Bicubic,
                                     AffineFilter::Lanczos};

double kernel(AffineFilter filter, double x) {
  x = std::fabs(x);
  switch (filter) {
    case AffineFilter::Bilinear: return std::max(0.0, 1 - x);
    case AffineFilter::Bicubic:
      return x < 1 ? 1.5 * x * x * x - 2.5 * x * x + 1 : x < 2 ? -0.5 * x * x * x + 2.5 * x * x - 4 * x + 2 : 0;
    default: {
      const double a = M_PI * x;
      return x == 0 ? 1 : x < 3 ? 3 * std::sin(a) * std::sin(a / 3) / (a * a) : 0;
    }
  }
}

/// The definition, in double: of gray f32, at one pixel of the result.
double truth(const Image& source, const AffineOptions& options, int x, int y) {
  const glm::dmat3 m = *inverse(options.target_from_source);
  const glm::dvec3 p = m * glm::dvec3(x + 0.5, y + 0.5, 1);
  const double wx = std::max(1.0, std::hypot(m[0].x, m[1].x));
  const double wy = std::max(1.0, std::hypot(m[0].y, m[1].y));
  const auto view = source.view<float>();
  double sum = 0;
  double weights = 0;
  for (int row = static_cast<int>(std::floor(p.y - 3 * wy)) - 1; row <= p.y + 3 * wy + 1; ++row) {
    for (int column = static_cast<int>(std::floor(p.x - 3 * wx)) - 1; column <= p.x + 3 * wx + 1; ++column) {
      const double weight =
          kernel(options.filter, (column + 0.5 - p.x) / wx) * kernel(options.filter, (row + 0.5 - p.y) / wy);
      weights += weight;
      const int inside_x = border_index(column, source.width(), options.border);
      const int inside_y = border_index(row, source.height(), options.border);
      if (inside_x >= 0 && inside_y >= 0) sum += weight * static_cast<double>(view(inside_x, inside_y));
    }
  }
  return sum / weights;
}

TEST(Affine, FollowsItsDefinitionInDouble) {
  const Image source = noise(37, 29, 1, PixelType::F32, 1);
  const glm::dmat3 matrices[] = {Rotation2d(0.4, {18, 14}).matrix(),
                                 Scaling2d{{2.3, 0.7}, {9, 3}}.matrix() * Rotation2d(-1).matrix(),
                                 Rotation2d(2, {18, 14}).matrix() * Scaling2d{{0.31, 0.17}, {18, 14}}.matrix(),
                                 Shear2d{{0.5, 0.2}, {10, 10}}.matrix(), Translation2d{{-300, 1.25}}.matrix()};
  for (const AffineFilter filter : {AffineFilter::Bilinear, AffineFilter::Bicubic, AffineFilter::Lanczos}) {
    for (const Border border : {Border::Constant, Border::Clamp, Border::Wrap, Border::Mirror, Border::Reflect}) {
      for (const glm::dmat3& m : matrices) {
        const AffineOptions options{
            .target_from_source = m, .filter = filter, .light = Light::Encoded, .border = border};
        const Image result = affine(source, options);
        double largest = 0;
        for (int y = 0; y < result.height(); ++y) {
          for (int x = 0; x < result.width(); ++x) {
            const double difference = std::fabs(result.view<float>()(x, y) - truth(source, options, x, y));
            largest = std::max(largest, difference);
          }
        }
        // Positions within 10⁻⁵ where the values may change by 3 a pixel; weights within 10⁻⁶, 64 of them.
        EXPECT_LE(largest, 6e-5) << enum_names(filter)[static_cast<std::size_t>(filter)];
      }
    }
  }
}

TEST(Affine, ShrinkingStraightIsResize) {
  const Image source = noise(64, 48, 3, PixelType::F32, 2);
  const std::pair<AffineFilter, ResizeFilter> pairs[] = {{AffineFilter::Bilinear, ResizeFilter::Bilinear},
                                                         {AffineFilter::Bicubic, ResizeFilter::Bicubic},
                                                         {AffineFilter::Lanczos, ResizeFilter::Lanczos}};
  for (const auto& [ours, filter] : pairs) {
    const Image expected = resize(source, {.width = 16, .height = 16, .filter = filter, .light = Light::Linear});
    const Image result = affine(source, {.target_from_source = Scaling2d{{0.25, 1.0 / 3}, {}}.matrix(),
                                         .filter = ours,
                                         .border = Border::Clamp,
                                         .size = AffineSize::Fit});
    ASSERT_EQ(result.width(), 16);
    ASSERT_EQ(result.height(), 16);
    for (int y = 0; y < 16; ++y) {
      for (int i = 0; i < 48; ++i)
        ASSERT_NEAR(result.view<float>().row(y)[i], expected.view<float>().row(y)[i], 3e-5) << i << ", " << y;
    }
  }
}

TEST(Affine, QuarterTurnsAndMirrorsMovePixelsOnly) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 2, 3, 4}) {
      for (const AffineFilter filter : kFilters) {
        // Encoded: the curve of u16 and f32 isn't undone to the last bit.
        const Image source = noise(70, 31, channels, type, 3);
        const auto at = [&](const Image& image, int x, int y) {
          return image.any().row(y) + static_cast<std::size_t>(x) * image.info().pixel_bytes();
        };
        const AffineOptions options{.filter = filter, .light = Light::Encoded, .size = AffineSize::Fit};
        AffineOptions turned = options;
        turned.target_from_source = Rotation2d(turn_of_degrees(90)).matrix();  // y down: clockwise
        const Image quarter = affine(source, turned);
        ASSERT_EQ(quarter.width(), 31);
        ASSERT_EQ(quarter.height(), 70);
        AffineOptions mirrored = options;
        mirrored.target_from_source = Reflection2d{{0, 0}, {0, 1}}.matrix();
        const Image mirror = affine(source, mirrored);
        for (int y = 0; y < 31; ++y) {
          for (int x = 0; x < 70; ++x) {
            const std::byte* const pixel = at(source, x, y);
            ASSERT_TRUE(std::equal(pixel, pixel + source.info().pixel_bytes(), at(quarter, 30 - y, x)));
            ASSERT_TRUE(std::equal(pixel, pixel + source.info().pixel_bytes(), at(mirror, 69 - x, y)));
          }
        }
        EXPECT_TRUE(same(affine(source, options), source)) << "nothing to do";
      }
    }
  }
}

TEST(Affine, AConstantStaysConstant) {
  Image gray(50, 40, 1);
  for (int y = 0; y < 40; ++y) std::fill_n(gray.view<std::uint8_t>().row(y), 50, std::uint8_t{188});
  for (const AffineFilter filter : kFilters) {
    for (const double scale : {0.07, 0.5, 1.0, 3.0}) {
      const Image result =
          affine(gray, {.target_from_source = Rotation2d(0.7).matrix() * Scaling2d{{scale, scale}, {}}.matrix(),
                        .filter = filter,
                        .border = Border::Clamp});
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 50; ++x) ASSERT_EQ(result.view<std::uint8_t>()(x, y), 188) << scale;
      }
    }
  }
}

TEST(Affine, LightIsLinearAndHiddenColorsDoNotBleed) {
  Image board(64, 64, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) board.view<std::uint8_t>()(x, y) = (x + y) % 2 == 0 ? 255 : 0;
  }
  const glm::dmat3 shrink = Scaling2d{{0.125, 0.125}, {}}.matrix();
  const Image linear = affine(board, {.target_from_source = shrink, .border = Border::Mirror});
  EXPECT_NEAR(linear.view<std::uint8_t>()(4, 4), 188, 1);
  const Image encoded =
      affine(board, {.target_from_source = shrink, .light = Light::Encoded, .border = Border::Mirror});
  EXPECT_NEAR(encoded.view<std::uint8_t>()(4, 4), 128, 1);

  Image half({8, 8, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      std::uint8_t* const p = half.view<std::uint8_t>().row(y) + 4 * x;
      p[0] = x < 4 ? 200 : 0;
      p[1] = x < 4 ? 0 : 255;  // green where nothing is seen
      p[2] = 0;
      p[3] = x < 4 ? 255 : 0;
    }
  }
  const Image moved =
      affine(half, {.target_from_source = Translation2d{{0.5, 0}}.matrix(), .filter = AffineFilter::Bilinear});
  const std::uint8_t* const edge = moved.view<std::uint8_t>().row(4) + 4 * 4;
  EXPECT_EQ(edge[0], 200);
  EXPECT_EQ(edge[1], 0);
  EXPECT_EQ(edge[3], 128);
}

TEST(Affine, FitShowsAllAndSameCutsOff) {
  const Image source = noise(100, 50, 1, PixelType::U8, 5);
  const glm::dmat3 turn = Rotation2d(turn_of_degrees(45), {50, 25}).matrix();
  const Image fit = affine(source, {.target_from_source = turn, .size = AffineSize::Fit});
  // 150 / √2 = 106.07 around the center (50, 25): from −3.03 to 103.03, from −28.03 to 78.03.
  EXPECT_EQ(fit.width(), 108);
  EXPECT_EQ(fit.height(), 108);
  const Image cut = affine(source, {.target_from_source = turn});
  EXPECT_EQ(cut.width(), 100);
  EXPECT_EQ(cut.height(), 50);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 100; ++x)
      ASSERT_EQ(cut.view<std::uint8_t>()(x, y), fit.view<std::uint8_t>()(x + 4, y + 29)) << x << ", " << y;
  }
}

std::string refusal(const AffineOptions& options) {
  try {
    affine(noise(20, 20, 1, PixelType::U8, 1), options);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Affine, RefusesWhatMakesNoImage) {
  const auto with = [](const glm::dmat3& m, AffineSize size = AffineSize::Same) {
    return AffineOptions{.target_from_source = m, .size = size};
  };
  glm::dmat3 projective(1);
  projective[0].z = 0.1;
  EXPECT_EQ(refusal(with(projective)), "affine: matrix: its last row is 0.1,0,1, expected 0,0,1 for an image");
  EXPECT_NE(refusal(with(Scaling2d{{0, 1}, {}}.matrix())).find("singular"), std::string::npos);
  EXPECT_NE(refusal(with(Scaling2d{{1e-3, 1}, {}}.matrix())).find("1/1000"), std::string::npos);
  EXPECT_NE(refusal(with(Translation2d{{1e12, 0}}.matrix())).find("away"), std::string::npos);
  EXPECT_NE(refusal(with(Scaling2d{{1e6, 1}, {}}.matrix(), AffineSize::Fit)).find("fit makes"), std::string::npos);
  EXPECT_NE(refusal(with(glm::dmat3(std::nan("")))).find("expected"), std::string::npos);
}

}  // namespace
}  // namespace azulejo
