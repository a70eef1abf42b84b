#include "azulejo/imaging/bilateral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "azulejo/data/image_testing.h"
#include "azulejo/imaging/bilateral_kernels.h"

namespace azulejo {
namespace {

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// The definition in double precision, for images without alpha.
double filtered(const Image& image, const BilateralOptions& options, int x, int y, int c) {
  const double full = full_range(image.type());
  double outside = options.border_value * full;
  if (image.type() != PixelType::F32) outside = std::floor(outside + 0.5);
  const int radius = options.radius.value_or(static_cast<int>(std::ceil(2 * options.sigma_space)));
  double weights = 0;
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (dx * dx + dy * dy > radius * radius) continue;
      const int from_x = border_index(x + dx, image.width(), options.border);
      const int from_y = border_index(y + dy, image.height(), options.border);
      const auto value = [&](int channel) {
        return from_x < 0 || from_y < 0 ? outside : value_at(image, from_x, from_y, channel);
      };
      double difference = 0;
      for (int k = 0; k < image.channels(); ++k) {
        const double of_channel = (value(k) - value_at(image, x, y, k)) / full;
        difference += of_channel * of_channel;
      }
      const double weight = std::exp(-(dx * dx + dy * dy) / (2.0 * options.sigma_space * options.sigma_space) -
                                     difference / (2.0 * options.sigma_range * options.sigma_range));
      weights += weight;
      sum += weight * value(c);
    }
  }
  return sum / weights;
}

TEST(Bilateral, WeightIsTheExponential) {
  for (int i = 0; i < 64'000; ++i) {
    const double x = i / 1000.0;
    ASSERT_NEAR(kernels::bilateral_weight(static_cast<float>(x / 64)), std::exp(-x), 4e-6) << x;
  }
  EXPECT_LT(kernels::bilateral_weight(1e30F), 1e-28F);
}

// Weights are off by 4·10⁻⁶ at most, so the mean of differences of at most 1 by as much times the number of weights over
// their sum, which is at least 1; where many are off as much, many are as large.
TEST(Bilateral, IsItsDefinition) {
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 3}) {
      for (const auto& [space, range] : {std::pair{0.5F, 0.5F}, {2.0F, 0.1F}, {3.0F, 0.02F}, {5.0F, 10.0F}}) {
        SCOPED_TRACE(testing::Message() << to_string(type) << ", sigma " << space << ", " << range << ", seed "
                                        << seed);
        BilateralOptions options{
            .sigma_space = space, .sigma_range = range, .border = static_cast<Border>(seed % 5), .border_value = 0.4F};
        if (seed % 3 == 0) options.radius = 4;
        const Image source = random_image({37, 31, channels, type}, seed++);
        const Image result = bilateral(source, options);
        const double tolerance = 1e-5 * full_range(type) + (type == PixelType::F32 ? 0 : 0.5);
        for (int y = 0; y < 31; y += 3) {
          for (int x = 0; x < 37; ++x) {
            const int c = x % channels;
            ASSERT_NEAR(value_at(result, x, y, c), filtered(source, options, x, y, c), tolerance) << x << ", " << y;
          }
        }
      }
    }
  }
}

TEST(Bilateral, LeavesConstantsAndStepsAsTheyAre) {
  Image source(ImageInfo{150, 70, 1, PixelType::F32});
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 150; ++x) source.view<float>()(x, y) = x < 71 ? 0.1F : 0.9F;
  }
  const Image result = bilateral(source, {.sigma_space = 3, .sigma_range = 0.05F});
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 150; ++x) ASSERT_NEAR(result.view<float>()(x, y), x < 71 ? 0.1F : 0.9F, 1e-7);
  }
}

/// Turned by a half turn, an image gives the turned result, but for the order of additions.
TEST(Bilateral, CommutesWithHalfTurns) {
  const Image source = random_image({61, 47, 1, PixelType::F32}, 3);
  Image turned = source.clone();
  for (int y = 0; y < 47; ++y) {
    for (int x = 0; x < 61; ++x) turned.view<float>()(60 - x, 46 - y) = source.view<float>()(x, y);
  }
  const Image a = bilateral(source);
  const Image b = bilateral(turned);
  for (int y = 0; y < 47; ++y) {
    for (int x = 0; x < 61; ++x) ASSERT_NEAR(a.view<float>()(x, y), b.view<float>()(60 - x, 46 - y), 1e-6);
  }
}

TEST(Bilateral, NeverShowsHiddenColors) {
  Image source(ImageInfo{40, 30, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight});
  Image other(source.info());
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const bool hidden = (x / 5 + y / 4) % 2 == 0;
      for (int c = 0; c < 4; ++c) {
        const auto value = static_cast<std::uint8_t>(c == 3 ? (hidden ? 0 : 200) : 100 + 3 * c + x);
        source.view<std::uint8_t>()(x, y, c) = value;
        other.view<std::uint8_t>()(x, y, c) = hidden && c < 3 ? static_cast<std::uint8_t>(255 - value) : value;
      }
    }
  }
  const Image a = bilateral(source, {.sigma_range = 1});
  const Image b = bilateral(other, {.sigma_range = 1});
  for (int y = 0; y < 30; ++y) {
    ASSERT_EQ(std::memcmp(a.view<std::uint8_t>().row(y), b.view<std::uint8_t>().row(y), 160), 0) << y;
  }
}

TEST(Bilateral, SpreadsNaNAsFarAsItsWindow) {
  Image source = random_image({50, 40, 1, PixelType::F32}, 5);
  source.view<float>()(20, 15) = std::numeric_limits<float>::quiet_NaN();
  const Image result = bilateral(source, {.sigma_space = 2, .radius = 3});
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 50; ++x) {
      const int squared = (x - 20) * (x - 20) + (y - 15) * (y - 15);
      ASSERT_EQ(std::isnan(result.view<float>()(x, y)), squared <= 9) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace azulejo
