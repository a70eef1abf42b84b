#include "azulejo/imaging/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/engine/border.h"

namespace azulejo {
namespace {

/// A smooth image with some noise.
Image picture(int width, int height, PixelType type, unsigned seed, double noise) {
  Image image(ImageInfo{width, height, 1, type});
  const Image random = random_image(ImageInfo{width, height, 1, PixelType::F32}, seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    const double top = full_range(type);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double level =
            0.5 + 0.3 * std::sin(0.21 * x) * std::cos(0.17 * y) + noise * (random.view<float>()(x, y) - 0.5);
        view(x, y) = static_cast<T>(type == PixelType::F32 ? level : std::floor(level * top + 0.5));
      }
    }
  });
  return image;
}

double intensity(const Image& image, int x, int y) {
  const double top = full_range(image.type());
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y)) / top; });
}

/// The definition, in double precision; windows mirrored at the borders.
double ssim_at(const Image& a, const Image& b, int cx, int cy) {
  double weights = 0, x1 = 0, y1 = 0, xx = 0, yy = 0, xy = 0;
  for (int dy = -5; dy <= 5; ++dy) {
    for (int dx = -5; dx <= 5; ++dx) {
      const double weight = std::exp(-0.5 * (dx * dx + dy * dy) / 2.25);
      const int px = border_index(cx + dx, a.width(), Border::Mirror);
      const int py = border_index(cy + dy, a.height(), Border::Mirror);
      const double u = intensity(a, px, py);
      const double v = intensity(b, px, py);
      weights += weight;
      x1 += weight * u;
      y1 += weight * v;
      xx += weight * u * u;
      yy += weight * v * v;
      xy += weight * u * v;
    }
  }
  x1 /= weights;
  y1 /= weights;
  const double vx = xx / weights - x1 * x1;
  const double vy = yy / weights - y1 * y1;
  const double cov = xy / weights - x1 * y1;
  return (2 * x1 * y1 + 1e-4) * (2 * cov + 9e-4) / ((x1 * x1 + y1 * y1 + 1e-4) * (vx + vy + 9e-4));
}

TEST(Compare, AgreesWithTheDefinitionsInDoublePrecision) {
  for (const auto& [type, other] : {std::pair{PixelType::U8, PixelType::U8},
                                    {PixelType::U16, PixelType::U16},
                                    {PixelType::F32, PixelType::F32},
                                    {PixelType::U8, PixelType::F32}}) {
    const Image a = picture(37, 29, type, 1, 0.2);
    const Image b = picture(37, 29, other, 2, 0.25);
    double sum = 0, squares = 0, maximum = 0, ssim = 0;
    for (int y = 0; y < 29; ++y) {
      for (int x = 0; x < 37; ++x) {
        const double d = std::fabs(intensity(a, x, y) - intensity(b, x, y));
        sum += d;
        squares += d * d;
        maximum = std::max(maximum, d);
        if (x >= 5 && x < 32 && y >= 5 && y < 24) ssim += ssim_at(a, b, x, y) / (27 * 19);
      }
    }
    const double count = 37 * 29;
    const Comparison found = compare(a, b);
    // Differences of values below 1 are within 2⁻²⁴, and so are their sums, relatively.
    EXPECT_NEAR(found.maximum, maximum, 1.2e-7);
    EXPECT_NEAR(found.mean, sum / count, 1.2e-7);
    EXPECT_NEAR(found.mse, squares / count, 1.2e-7);
    EXPECT_NEAR(found.psnr, -10 * std::log10(squares / count), 1e-4);
    // Variances are within some 10⁻⁶ of sums of f32; 9·10⁻⁴ is added to them.
    EXPECT_NEAR(found.ssim.value(), ssim, 2e-4);
    EXPECT_EQ(found.pixels, 37 * 29);
  }
}

TEST(Compare, ItsPicturesShowWhere) {
  const Image a = picture(33, 27, PixelType::U8, 3, 0.1);
  Image b = a.clone();
  b.view<std::uint8_t>()(20, 10) ^= 0x40;
  Image difference(ImageInfo{33, 27, 1, PixelType::F32});
  Image similarity(ImageInfo{33, 27, 1, PixelType::F32});
  compare(a.any(), b.any(), difference.any(), similarity.any(), {.gain = 2});
  for (int y = 0; y < 27; ++y) {
    for (int x = 0; x < 33; ++x) {
      EXPECT_FLOAT_EQ(difference.view<float>()(x, y), x == 20 && y == 10 ? 2 * (64.0F / 255) : 0.0F);
      EXPECT_NEAR(similarity.view<float>()(x, y), ssim_at(a, b, x, y), 1e-3) << x << ' ' << y;
      if (std::abs(x - 20) > 5 || std::abs(y - 10) > 5) {
        EXPECT_EQ(similarity.view<float>()(x, y), 1.0F);
      }
    }
  }
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.differing_pixels, 1);
  EXPECT_EQ(found.maximum_x, 20);
  EXPECT_EQ(found.maximum_y, 10);
  EXPECT_NEAR(found.maximum, 64.0 / 255, 1e-7);
  // Whole levels: exact.
  EXPECT_EQ(found.mse, 64.0 * 64.0 / 255 / 255 / (33 * 27));
  EXPECT_NEAR(compare(a, b, {.gain = 1000}).maximum, 64.0 / 255, 1e-6) << "the gain is of the picture alone";
}

TEST(Compare, EqualImagesAreEqual) {
  for (const int channels : {1, 2, 3, 4}) {
    const Image image = random_image(Image(23, 19, channels, PixelType::U16).info(), 9);
    const Comparison found = compare(image, image);
    EXPECT_EQ(found.maximum, 0);
    EXPECT_EQ(found.mse, 0);
    EXPECT_EQ(found.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(found.ssim, 1.0);
    EXPECT_EQ(found.differing_pixels, 0);
  }
}

TEST(Compare, HiddenColorsMakeNoDifferenceAndAlphaDoes) {
  Image a(2, 1, 4);
  Image b(2, 1, 4);
  const std::uint8_t first[] = {255, 0, 0, 0, 10, 20, 30, 255};
  const std::uint8_t second[] = {0, 255, 0, 0, 10, 20, 30, 204};
  std::copy_n(first, 8, a.view<std::uint8_t>().row(0));
  std::copy_n(second, 8, b.view<std::uint8_t>().row(0));
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.differing_pixels, 1);
  EXPECT_EQ(found.maximum_x, 1);
  EXPECT_NEAR(found.maximum, 51.0 / 255, 1e-7);
}

TEST(Compare, NumbersThatAreNotFiniteAreCountedApart) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Image a(ImageInfo{5, 1, 1, PixelType::F32});
  Image b(ImageInfo{5, 1, 1, PixelType::F32});
  const float first[] = {kNaN, kNaN, kInfinity, kInfinity, 0.5F};
  const float second[] = {kNaN, 1, kInfinity, 3, 0.25F};
  std::copy_n(first, 5, a.view<float>().row(0));
  std::copy_n(second, 5, b.view<float>().row(0));
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.not_finite_pixels, 2);
  EXPECT_EQ(found.maximum, 0.25);
  EXPECT_EQ(found.mean, 0.25 / 3);
  EXPECT_FALSE(is_close(found, {.at_most = 1.0F}));
  EXPECT_TRUE(is_close(found, {}));
}

TEST(Compare, KeepsToItsLimits) {
  Comparison found;
  found.maximum = 0.1;
  found.ssim = 0.95;
  found.psnr = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_close(found, {.at_most = 0.1F}));
  EXPECT_FALSE(is_close(found, {.at_most = 0.0999F}));
  EXPECT_TRUE(is_close(found, {.metric = Metric::Ssim, .at_least = 0.9F}));
  EXPECT_FALSE(is_close(found, {.metric = Metric::Ssim, .at_least = 0.96F}));
  EXPECT_TRUE(is_close(found, {.metric = Metric::Psnr, .at_least = 100.0F}));
}

TEST(Compare, RefusesWhatDoesntFit) {
  const Image image(4, 4, 3);
  EXPECT_THROW(compare(image, Image(4, 5, 3)), Error);
  EXPECT_THROW(compare(image, Image(4, 4, 1)), Error);
  Image linear(4, 4, 3);
  linear.set_states(ColorState::Linear, AlphaState::None);
  EXPECT_THROW(compare(image, linear), Error);
  EXPECT_THROW(compare(image, image, {.metric = Metric::Ssim, .at_least = 0.5F, .ssim = false}), Error);
}

}  // namespace
}  // namespace azulejo
