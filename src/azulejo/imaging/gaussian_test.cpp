#include "azulejo/imaging/gaussian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "azulejo/core/error.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Image random_image(const ImageInfo& info, unsigned seed) {
  Image image(info);
  std::mt19937 random(seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    std::uniform_real_distribution<float> unit(0, 1);
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        view.row(y)[i] =
            static_cast<T>(unit(random) * full_range(kPixelTypeOf<T>) + (info.type == PixelType::F32 ? 0.0F : 0.5F));
      }
    }
  });
  return image;
}

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

int radius_of(double sigma) { return static_cast<int>(std::ceil(4 * sigma)); }

std::vector<double> kernel(double sigma) {
  const int radius = radius_of(sigma);
  std::vector<double> weights;
  for (int k = -radius; k <= radius; ++k) weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// The convolution by its definition, in two dimensions.
double convolved(const Image& image, const GaussianOptions& options, const std::vector<double>& weights, int x, int y,
                 int c) {
  const int radius = static_cast<int>(weights.size()) / 2;
  double outside = options.border_value * full_range(image.type());
  if (image.type() != PixelType::F32) outside = std::floor(outside + 0.5);  // a pixel of the stored type
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    const int from_y = border_index(y + dy, image.height(), options.border);
    for (int dx = -radius; dx <= radius; ++dx) {
      const int from_x = border_index(x + dx, image.width(), options.border);
      const double value = from_x < 0 || from_y < 0 ? outside : value_at(image, from_x, from_y, c);
      sum += weights[static_cast<std::size_t>(dx + radius)] * weights[static_cast<std::size_t>(dy + radius)] * value;
    }
  }
  return sum;
}

/// What the header promises, in units of the stored type, for values that are weighted as they are stored.
double tolerance(PixelType type, double sigma) {
  if (type == PixelType::U8 && sigma <= 16) return 0.5 + (radius_of(sigma) + 4) / 128.0;
  return double{full_range(type)} * (radius_of(sigma) + 4) * 0x1p-22 + (type == PixelType::F32 ? 0 : 0.5);
}

TEST(Gaussian, IsTheConvolution) {
  unsigned seed = 1;
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const float sigma : {0.2F, 0.7F, 1.0F, 2.6F, 5.0F}) {
      for (const Border border : {Border::Mirror, Border::Reflect, Border::Clamp, Border::Wrap, Border::Constant}) {
        SCOPED_TRACE(testing::Message() << to_string(type) << ", sigma " << sigma << ", seed " << seed);
        const GaussianOptions options{.sigma = sigma, .border = border, .border_value = 0.25F};
        const Image source = random_image({21, 18, seed % 2 == 0 ? 3 : 1, type}, seed);
        ++seed;
        const Image result = gaussian(source, options);
        const auto weights = kernel(sigma);
        for (int y = 0; y < 18; y += 2) {
          for (int x = 0; x < 21; ++x) {
            const int c = x % source.channels();
            ASSERT_NEAR(value_at(result, x, y, c), convolved(source, options, weights, x, y, c), tolerance(type, sigma))
                << x << ", " << y;
          }
        }
      }
    }
  }
}

/// Full contrast at many scales, where errors of the integer weights of one sign meet 255 and those of the other 0.
TEST(Gaussian, OfBytesKeepsItsBoundForStripes) {
  for (const float sigma : {0.3F, 1.0F, 3.0F, 5.0F, 9.7F, 16.0F, 16.1F}) {
    for (const int period : {1, 2, 3, 5, 12, 40}) {
      Image source(150, 3, 1);
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 150; ++x) source.view<std::uint8_t>()(x, y) = x / period % 2 == 0 ? 0 : 255;
      }
      const Image result = gaussian(source, {.sigma = sigma});
      const auto weights = kernel(sigma);
      for (int x = 0; x < 150; ++x) {
        ASSERT_NEAR(value_at(result, x, 1, 0), convolved(source, {.sigma = sigma}, weights, x, 1, 0),
                    tolerance(PixelType::U8, sigma))
            << x << ", sigma " << sigma << ", period " << period;
      }
    }
  }
}

TEST(Gaussian, OfAnImpulseOfBytesIsTheRoundedKernel) {
  for (const float sigma : {0.1F, 0.2F, 0.4F, 1.0F, 1.7F}) {
    for (int channels = 1; channels <= 4; ++channels) {
      Image source({41, 41, channels, PixelType::U8, ColorState::Srgb,
                    channels % 2 == 0 ? AlphaState::Premultiplied : AlphaState::None});
      const auto pixels = source.view<std::uint8_t>();
      for (int y = 0; y < 41; ++y) std::fill_n(pixels.row(y), 41 * channels, std::uint8_t{0});
      for (int c = 0; c < channels; ++c) pixels(20, 20, c) = static_cast<std::uint8_t>(255 - 60 * c);
      const Image result = gaussian(source, {.sigma = sigma});
      const auto got = result.view<std::uint8_t>();
      const auto weights = kernel(sigma);
      const int radius = radius_of(sigma);
      for (int y = -20; y <= 20; ++y) {
        for (int x = -20; x <= 20; ++x) {
          const auto weight = [&](int k) {
            return std::abs(k) <= radius ? weights[static_cast<std::size_t>(k + radius)] : 0;
          };
          for (int c = 0; c < channels; ++c) {
            ASSERT_NEAR(got(20 + x, 20 + y, c), weight(x) * weight(y) * (255 - 60 * c),
                        tolerance(PixelType::U8, sigma));
            ASSERT_EQ(got(20 + x, 20 + y, c), got(20 - x, 20 - y, c));
          }
        }
      }
    }
  }
}

TEST(Gaussian, LeavesConstantBytesAsTheyAre) {
  for (int channels = 1; channels <= 4; ++channels) {
    for (float sigma = 0.1F; sigma <= 20; sigma *= 1.031F) {
      Image source({37, 3, channels, PixelType::U8, ColorState::Srgb,
                    channels % 2 == 0 ? AlphaState::Premultiplied : AlphaState::None});
      const int level = static_cast<int>(sigma * 1000) % 256;
      const auto value = [&](int i) { return static_cast<std::uint8_t>((255 + level * (i % channels)) % 256); };
      for (int y = 0; y < 3; ++y) {
        for (int i = 0; i < 37 * channels; ++i) source.view<std::uint8_t>().row(y)[i] = value(i);
      }
      const Image result = gaussian(source, {.sigma = sigma});
      for (int y = 0; y < 3; ++y) {
        for (int i = 0; i < 37 * channels; ++i) {
          ASSERT_EQ(result.view<std::uint8_t>().row(y)[i], value(i)) << "sigma " << sigma << ", channels " << channels;
        }
      }
    }
  }
}

TEST(Gaussian, OfAnImpulseIsTheKernel) {
  for (const float sigma : {0.5F, 1.5F, 6.0F}) {
    const int radius = radius_of(sigma);
    const int size = 2 * radius + 5;
    const int middle = size / 2;
    Image source(size, size, 1, PixelType::F32);
    const auto pixels = source.view<float>();
    for (int y = 0; y < size; ++y) std::fill_n(pixels.row(y), size, 0.0F);
    pixels(middle, middle) = 1;
    const Image result = gaussian(source, {.sigma = sigma});
    const auto got = result.view<float>();
    const auto weights = kernel(sigma);
    for (int y = -middle; y <= middle; ++y) {
      for (int x = -middle; x <= middle; ++x) {
        const bool inside = std::max(std::abs(x), std::abs(y)) <= radius;
        const double expected =
            inside ? weights[static_cast<std::size_t>(x + radius)] * weights[static_cast<std::size_t>(y + radius)] : 0;
        ASSERT_NEAR(got(middle + x, middle + y), expected, inside ? 1e-7 : 0) << x << ", " << y << ", sigma " << sigma;
        ASSERT_EQ(got(middle + x, middle + y), got(middle - x, middle + y));
        ASSERT_EQ(got(middle + x, middle + y), got(middle + x, middle - y));
      }
    }
  }
}

TEST(Gaussian, LeavesAConstantImageAsItIsToTheLastBit) {
  std::mt19937 random(5);
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (float sigma = 0.05F; sigma <= 1000; sigma *= sigma < 90 ? 1.17F : 3.1F) {
      Image source(sigma < 90 ? 19 : 2, 3, 1, type);
      visit(source.any(), [&](auto view) {
        using T = std::remove_pointer_t<decltype(view.data)>;
        const auto value = std::is_same_v<T, float> ? static_cast<T>(std::ldexp(static_cast<double>(random()), -30))
                                                    : static_cast<T>(random());
        for (int y = 0; y < view.height; ++y) std::fill_n(view.row(y), view.width, value);
        const Image result = gaussian(source, {.sigma = sigma});
        for (int y = 0; y < view.height; ++y) {
          for (int x = 0; x < view.width; ++x)
            ASSERT_EQ(result.view<T>()(x, y), value) << to_string(type) << ", sigma " << sigma;
        }
      });
    }
  }
}

Image mirrored(const Image& image) {
  Image result(image.info());
  visit(result.any(), [&](auto view) {
    const auto source = image.any().as<std::remove_pointer_t<decltype(view.data)>>();
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        for (int c = 0; c < view.channels; ++c) view(x, y, c) = source(view.width - 1 - x, view.height - 1 - y, c);
      }
    }
  });
  return result;
}

TEST(Gaussian, OfAMirroredImageIsTheMirroredResult) {
  const unsigned seed = 3;
  SCOPED_TRACE(seed);
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    const Image source = random_image({83, 45, 4, type, ColorState::Srgb, AlphaState::Straight}, seed);
    const Image expected = mirrored(gaussian(source, {.sigma = 2.3F}));
    const Image got = gaussian(mirrored(source), {.sigma = 2.3F});
    for (int y = 0; y < 45; ++y) {
      ASSERT_EQ(std::memcmp(got.any().row(y), expected.any().row(y), source.info().row_bytes()), 0) << to_string(type);
    }
  }
}

TEST(Gaussian, CommutesWithTransposition) {
  const unsigned seed = 4;
  SCOPED_TRACE(seed);
  const Image source = random_image({51, 34, 1, PixelType::F32}, seed);
  Image turned(34, 51, 1, PixelType::F32);
  for (int y = 0; y < 34; ++y) {
    for (int x = 0; x < 51; ++x) turned.view<float>()(y, x) = source.view<float>()(x, y);
  }
  const Image a = gaussian(source, {.sigma = 3});
  const Image b = gaussian(turned, {.sigma = 3});
  for (int y = 0; y < 34; ++y) {
    for (int x = 0; x < 51; ++x)
      ASSERT_NEAR(a.view<float>()(x, y), b.view<float>()(y, x), tolerance(PixelType::F32, 3));
  }
}

TEST(Gaussian, KeepsTheSumWhereTheBorderWraps) {
  const unsigned seed = 6;
  SCOPED_TRACE(seed);
  const Image source = random_image({64, 40, 1, PixelType::F32}, seed);
  const Image result = gaussian(source, {.sigma = 4, .border = Border::Wrap});
  double before = 0;
  double after = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 64; ++x) {
      before += source.view<float>()(x, y);
      after += result.view<float>()(x, y);
    }
  }
  EXPECT_NEAR(after / before, 1, 1e-6);
}

TEST(Gaussian, NeverShowsColorsHiddenUnderAlphaZero) {
  std::mt19937 random(8);
  for (const Light light : {Light::Encoded, Light::Linear}) {
    Image red(40, 30, 4);
    Image other(40, 30, 4);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        const std::uint8_t alpha = random() % 3 == 0 ? 0 : static_cast<std::uint8_t>(random());
        const std::uint8_t color[4] = {200, 10, 60, alpha};
        for (int c = 0; c < 4; ++c) {
          red.view<std::uint8_t>()(x, y, c) = color[c];
          other.view<std::uint8_t>()(x, y, c) = alpha == 0 && c < 3 ? static_cast<std::uint8_t>(random()) : color[c];
        }
      }
    }
    const Image a = gaussian(red, {.sigma = 1.4F, .light = light});
    const Image b = gaussian(other, {.sigma = 1.4F, .light = light});
    for (int y = 0; y < 30; ++y) {
      ASSERT_EQ(std::memcmp(a.any().row(y), b.any().row(y), 160), 0);
      for (int x = 0; x < 40; ++x) {  // one color everywhere stays that color whatever alpha is
        ASSERT_EQ(a.view<std::uint8_t>()(x, y, 0), 200);
        ASSERT_EQ(a.view<std::uint8_t>()(x, y, 1), 10);
        ASSERT_EQ(a.view<std::uint8_t>()(x, y, 2), 60);
      }
    }
  }
}

TEST(Gaussian, InLinearLightAveragesWhatIsDecoded) {
  const unsigned seed = 9;
  SCOPED_TRACE(seed);
  const Image source = random_image({33, 21, 3, PixelType::U8}, seed);
  Image decoded({33, 21, 3, PixelType::F32, ColorState::Linear});
  for (int y = 0; y < 21; ++y) {
    for (int i = 0; i < 99; ++i) {
      decoded.view<float>().row(y)[i] = srgb_to_linear(static_cast<float>(source.view<std::uint8_t>().row(y)[i]) / 255);
    }
  }
  const Image got = gaussian(source, {.sigma = 2, .light = Light::Linear});
  const Image expected = gaussian(decoded, {.sigma = 2, .light = Light::Linear});  // linear already: not decoded again
  for (int y = 0; y < 21; ++y) {
    for (int i = 0; i < 99; ++i) {
      ASSERT_NEAR(got.view<std::uint8_t>().row(y)[i], 255 * linear_to_srgb(expected.view<float>().row(y)[i]), 0.501);
    }
  }
}

TEST(Gaussian, SpreadsNaNAsFarAsTheKernelReaches) {
  Image source(31, 31, 1, PixelType::F32);
  for (int y = 0; y < 31; ++y) std::fill_n(source.view<float>().row(y), 31, 0.5F);
  source.view<float>()(15, 15) = kNaN;
  const Image result = gaussian(source, {.sigma = 1.2F});
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      const bool reached = std::max(std::abs(x - 15), std::abs(y - 15)) <= 5;
      EXPECT_EQ(std::isnan(result.view<float>()(x, y)), reached) << x << ", " << y;
    }
  }
}

TEST(Gaussian, OfSigmaZeroIsACopyAndRefusesOthersOutOfRange) {
  const Image source = random_image({9, 5, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, 2);
  const Image result = gaussian(source, {.sigma = 0});
  for (int y = 0; y < 5; ++y) EXPECT_EQ(std::memcmp(result.any().row(y), source.any().row(y), 36), 0);
  EXPECT_THROW(gaussian(source, {.sigma = -1}), Error);
  EXPECT_THROW(gaussian(source, {.sigma = 1001}), Error);
  EXPECT_THROW(gaussian(source, {.sigma = kNaN}), Error);
}

}  // namespace
}  // namespace azulejo
