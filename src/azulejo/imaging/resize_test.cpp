#include "azulejo/imaging/resize.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

constexpr ResizeFilter kFilters[] = {ResizeFilter::Nearest, ResizeFilter::Bilinear, ResizeFilter::Bicubic,
                                     ResizeFilter::Lanczos, ResizeFilter::Area};

struct Sizes {
  int width, height, new_width, new_height;
};
constexpr Sizes kSizes[] = {{1, 1, 5, 3},    {7, 5, 1, 1},     {13, 9, 29, 31}, {40, 33, 7, 50}, {33, 40, 50, 7},
                            {90, 77, 11, 9}, {131, 167, 3, 2}, {12, 8, 24, 4},  {86, 6, 43, 3},  {2, 2, 1, 1}};

double value(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

double kernel(ResizeFilter filter, double x) {
  x = std::abs(x);
  const auto sinc = [](double t) { return t == 0 ? 1 : std::sin(std::numbers::pi * t) / (std::numbers::pi * t); };
  switch (filter) {
    case ResizeFilter::Bilinear: return std::max(0.0, 1 - x);
    case ResizeFilter::Bicubic:
      return x < 1 ? 1.5 * x * x * x - 2.5 * x * x + 1 : x < 2 ? -0.5 * x * x * x + 2.5 * x * x - 4 * x + 2 : 0;
    default: return x < 3 ? sinc(x) * sinc(x / 3) : 0;
  }
}

/// Weights of all source pixels of an axis in a result pixel, straight from the definition.
std::vector<double> exact_weights(ResizeFilter filter, int source, int result, int j) {
  std::vector<double> weights(static_cast<std::size_t>(source), 0.0);
  const double ratio = static_cast<double>(source) / result;
  const double centre = (j + 0.5) * ratio;
  const auto at = [&](int k) -> double& { return weights[static_cast<std::size_t>(std::clamp(k, 0, source - 1))]; };
  if (source == result) {
    at(j) = 1;
  } else if (filter == ResizeFilter::Nearest) {
    at(static_cast<int>(std::floor(centre + 1e-9))) = 1;
  } else if (filter == ResizeFilter::Area) {
    for (int k = 0; k < source; ++k) {
      at(k) = std::max(0.0, std::min(k + 1.0, (j + 1) * ratio) - std::max<double>(k, j * ratio)) / ratio;
    }
  } else {
    double sum = 0;
    const double width = std::max(1.0, ratio);
    const int reach = static_cast<int>(3 * width) + 2;
    for (int k = static_cast<int>(centre) - reach; k <= static_cast<int>(centre) + reach; ++k) {
      const double weight = kernel(filter, (k + 0.5 - centre) / width);
      at(k) += weight;
      sum += weight;
    }
    for (double& weight : weights) weight /= sum;
  }
  return weights;
}

double decode(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }
double encode(double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

/// The exact result in units of the stored type, neither rounded nor saturated; no alpha.
double exact(const Image& image, const Sizes& sizes, const ResizeOptions& options, int x, int y, int c) {
  const double top = static_cast<double>(full_range(image.type()));
  const auto across = exact_weights(options.filter, sizes.width, sizes.new_width, x);
  const auto down = exact_weights(options.filter, sizes.height, sizes.new_height, y);
  const bool linear = options.light == Light::Linear && options.filter != ResizeFilter::Nearest;
  double sum = 0;
  for (int row = 0; row < sizes.height; ++row) {
    double of_row = 0;
    if (down[static_cast<std::size_t>(row)] == 0) continue;
    for (int column = 0; column < sizes.width; ++column) {
      const double stored = value(image, column, row, c);
      of_row += across[static_cast<std::size_t>(column)] * (linear ? decode(stored / top) : stored);
    }
    sum += of_row * down[static_cast<std::size_t>(row)];
  }
  return linear ? (sum < 0 ? -encode(-sum) : encode(sum)) * top : sum;
}

TEST(Resize, IsWhatTheDefinitionSaysInDoublePrecision) {
  for (const ResizeFilter filter : kFilters) {
    for (const Light light : {Light::Encoded, Light::Linear}) {
      for (const Sizes& sizes : kSizes) {
        for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
          const ImageInfo info{sizes.width, sizes.height, 3, type, ColorState::Srgb, AlphaState::None};
          const Image image = random_image(info, 11);
          const ResizeOptions options{
              .width = sizes.new_width, .height = sizes.new_height, .filter = filter, .light = light};
          const Image result = resize(image, options);
          SCOPED_TRACE(testing::Message()
                       << enum_names(filter)[static_cast<std::size_t>(filter)] << ", "
                       << enum_names(light)[static_cast<std::size_t>(light)] << ", " << to_string(type) << ", "
                       << sizes.width << "×" << sizes.height << " to " << sizes.new_width << "×" << sizes.new_height);
          // Rounding, and f32 sums: 2 passes of at most about 32 additions of values below 2, so below 2·10⁻⁵ of the
          // full range in the worst case; random signs leave a tenth of it. In linear light the toe of the curve makes
          // that 13 times as much.
          const double top = static_cast<double>(full_range(type));
          const double error = (light == Light::Linear ? 2e-5 : 2e-6) * top;
          const double tolerance = type == PixelType::F32 ? error : 0.5 + error;
          for (int y = 0; y < sizes.new_height; ++y) {
            for (int x = 0; x < sizes.new_width; ++x) {
              for (int c = 0; c < 3; ++c) {
                double expected = exact(image, sizes, options, x, y, c);
                if (type != PixelType::F32) expected = std::clamp(expected, 0.0, top);
                ASSERT_NEAR(value(result, x, y, c), expected, tolerance)
                    << "column " << x << ", row " << y << ", channel " << c;
              }
            }
          }
        }
      }
    }
  }
}

bool same_bytes(const Image& a, const Image& b) {
  if (a.info() != b.info()) return false;
  for (int y = 0; y < a.height(); ++y) {
    if (std::memcmp(a.any().row(y), b.any().row(y), a.info().row_bytes()) != 0) return false;
  }
  return true;
}

TEST(Resize, HasTheBytesOfTheScalarDefinitionForEveryFilterAndTarget) {
  for (const ResizeFilter filter : kFilters) {
    for (const Light light : {Light::Encoded, Light::Linear}) {
      for (const Sizes& sizes : kSizes) {
        for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
          for (int channels = 1; channels <= 5; ++channels) {
            ImageInfo info{sizes.width, sizes.height, std::min(channels, 4), type, ColorState::Srgb, AlphaState::None};
            if (channels == 2 || channels == 4) info.alpha = AlphaState::Straight;
            if (channels == 5) info.alpha = AlphaState::Premultiplied;
            const Image image = random_image(info, static_cast<unsigned>(channels));
            const ResizeOptions options{
                .width = sizes.new_width, .height = sizes.new_height, .filter = filter, .light = light};
            SCOPED_TRACE(testing::Message() << enum_names(filter)[static_cast<std::size_t>(filter)] << ", "
                                            << enum_names(light)[static_cast<std::size_t>(light)] << ", "
                                            << describe(info) << " to " << sizes.new_width << "×" << sizes.new_height);
            const Image expected = resize(image, options, azulejo::Run{.threads = 1, .testing = {.reference = true}});
            for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
              hwy::SetSupportedTargetsForTest(target);
              hwy::GetChosenTarget().Update(target);
              ASSERT_TRUE(same_bytes(resize(image, options, {.threads = 1}), expected)) << hwy::TargetName(target);
            }
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().DeInit();
            const azulejo::Run tiles{.threads = 2, .testing = {.tile_width = 5, .tile_height = 3}};
            ASSERT_TRUE(same_bytes(resize(image, options, tiles), expected)) << "tiles";
          }
        }
      }
    }
  }
}

TEST(Resize, HasTheSameBytesInLargeImagesWhateverTheTiles) {
  // Wide enough for several stretches, for windows above the block length and for tables made by tile.
  const Image image = random_image({5000, 90, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}, 5);
  for (const auto& [width, height] : {std::pair{7000, 91}, {1251, 40}, {100, 2}, {6, 180}}) {
    const ResizeOptions options{.width = width, .height = height, .light = Light::Encoded};
    const Image expected = resize(image, options, azulejo::Run{.threads = 1, .testing = {.reference = true}});
    ASSERT_TRUE(same_bytes(resize(image, options), expected)) << width;
    ASSERT_TRUE(
        same_bytes(resize(image, options, azulejo::Run{.testing = {.tile_width = 333, .tile_height = 17}}), expected))
        << width;
  }
}

TEST(Resize, ToTheSameSizeKeepsEveryByte) {
  for (const ResizeFilter filter : kFilters) {
    Image image = random_image({21, 17, 4, PixelType::F32, ColorState::Srgb, AlphaState::Straight}, 3);
    image.view<float>()(3, 4, 1) = std::numeric_limits<float>::quiet_NaN();
    image.view<float>()(5, 6, 3) = 0;  // hidden color
    EXPECT_TRUE(same_bytes(resize(image, {.filter = filter}), image));
    EXPECT_TRUE(same_bytes(resize(image, {.width = 21, .filter = filter}), image));
  }
}

TEST(Resize, OfAConstantIsThatConstant) {
  for (const ResizeFilter filter : kFilters) {
    for (const Light light : {Light::Encoded, Light::Linear}) {
      for (const Sizes& sizes :
           {Sizes{700, 3, 2, 5}, Sizes{3, 1200, 4, 1}, Sizes{31, 17, 59, 43}, Sizes{64, 64, 16, 16}}) {
        const ResizeOptions options{
            .width = sizes.new_width, .height = sizes.new_height, .filter = filter, .light = light};
        for (const int level : {0, 1, 2, 3, 1000, 12345, 32767, 65534, 65535}) {
          Image wide(sizes.width, sizes.height, 1, PixelType::U16);
          Image bytes(sizes.width, sizes.height, 1);
          Image floats(sizes.width, sizes.height, 1, PixelType::F32);
          const float intensity = static_cast<float>(level) / 65535.0F;
          for (int y = 0; y < sizes.height; ++y) {
            std::fill_n(wide.view<std::uint16_t>().row(y), sizes.width, static_cast<std::uint16_t>(level));
            std::fill_n(bytes.view<std::uint8_t>().row(y), sizes.width, static_cast<std::uint8_t>(level));
            std::fill_n(floats.view<float>().row(y), sizes.width, intensity);
          }
          const Image wide_result = resize(wide, options);
          const Image bytes_result = resize(bytes, options);
          const Image floats_result = resize(floats, options);
          // 2 passes of at most 32 additions, the weights' own rounding; the curve's 10⁻⁶ there and back.
          const double tolerance = light == Light::Linear ? 6e-6 : 4e-6;
          for (int y = 0; y < sizes.new_height; ++y) {
            for (int x = 0; x < sizes.new_width; ++x) {
              ASSERT_EQ(wide_result.view<std::uint16_t>()(x, y), level);
              ASSERT_EQ(bytes_result.view<std::uint8_t>()(x, y), level % 256);
              ASSERT_NEAR(floats_result.view<float>()(x, y), intensity, tolerance * static_cast<double>(intensity));
            }
          }
        }
      }
    }
  }
}

TEST(Resize, OfACheckerboardToHalfIsTheMeanLight) {
  Image board(32, 32, 1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) board.view<std::uint8_t>()(x, y) = (x + y) % 2 == 0 ? 255 : 0;
  }
  const Image linear = resize(board, {.width = 16, .filter = ResizeFilter::Area});
  const Image encoded = resize(board, {.width = 16, .filter = ResizeFilter::Area, .light = Light::Encoded});
  const Image lanczos = resize(board, {.scale = 0.5F});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      ASSERT_EQ(linear.view<std::uint8_t>()(x, y), 188);   // encode(½) · 255 = 187.5157
      ASSERT_EQ(encoded.view<std::uint8_t>()(x, y), 128);  // 127.5, half up
      if (x >= 3 && y >= 3 && x < 13 && y < 13) {
        ASSERT_EQ(lanczos.view<std::uint8_t>()(x, y), 188);
      }
    }
  }
}

TEST(Resize, KeepsARampARamp) {
  // Filters whose weights sum to 1 and have their centre where they should reproduce linear functions. Bilinear and
  // bicubic do exactly when enlarging, lanczos within 2 % of the step: the largest |Σ w(k − x) · (k − x)| is 0.01998.
  Image ramp(40, 3, 1, PixelType::F32);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 40; ++x) ramp.view<float>()(x, y) = static_cast<float>(x) + 0.5F;
  }
  for (const auto& [filter, tolerance] :
       {std::pair{ResizeFilter::Bilinear, 1e-5}, {ResizeFilter::Bicubic, 1e-5}, {ResizeFilter::Lanczos, 0.02}}) {
    const Image result = resize(ramp, {.width = 93, .height = 3, .filter = filter, .light = Light::Encoded});
    for (int x = 10; x < 83; ++x) EXPECT_NEAR(result.view<float>()(x, 1), (x + 0.5) * 40 / 93, tolerance);
  }
}

TEST(Resize, ByAreaKeepsTheMean) {
  const unsigned seed = 23;
  SCOPED_TRACE(seed);
  const Image image = random_image({97, 61, 1, PixelType::F32, ColorState::Data, AlphaState::None}, seed);
  const auto mean = [](const Image& each) {
    double sum = 0;
    for (int y = 0; y < each.height(); ++y) {
      for (int x = 0; x < each.width(); ++x) sum += value(each, x, y, 0);
    }
    return sum / each.width() / each.height();
  };
  for (const auto& [width, height] : {std::pair{13, 7}, {1, 1}, {200, 3}, {96, 60}, {291, 122}}) {
    EXPECT_NEAR(mean(resize(image, {.width = width, .height = height, .filter = ResizeFilter::Area})), mean(image),
                1e-6);
  }
}

TEST(Resize, CommutesWithFlips) {
  // Mirrored sums are added the other way round: a difference of at most about 30 roundings.
  const unsigned seed = 31;
  SCOPED_TRACE(seed);
  const Image image = random_image({57, 43, 1, PixelType::F32, ColorState::Srgb, AlphaState::None}, seed);
  const auto flipped = [](const Image& each) {
    Image result(each.info());
    for (int y = 0; y < each.height(); ++y) {
      for (int x = 0; x < each.width(); ++x) {
        result.view<float>()(x, y) = each.view<float>()(each.width() - 1 - x, each.height() - 1 - y);
      }
    }
    return result;
  };
  for (const ResizeFilter filter :
       {ResizeFilter::Bilinear, ResizeFilter::Bicubic, ResizeFilter::Lanczos, ResizeFilter::Area}) {
    for (const auto& [width, height] : {std::pair{114, 20}, {23, 99}, {5, 4}}) {
      const ResizeOptions options{.width = width, .height = height, .filter = filter, .light = Light::Encoded};
      const Image one = flipped(resize(image, options));
      const Image other = resize(flipped(image), options);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) ASSERT_NEAR(one.view<float>()(x, y), other.view<float>()(x, y), 4e-6);
      }
    }
  }
}

TEST(Resize, LetsHiddenColorsNotBleed) {
  for (const ResizeFilter filter : kFilters) {
    for (const Light light : {Light::Encoded, Light::Linear}) {
      for (const auto& [width, height] : {std::pair{9, 7}, {60, 50}}) {
        const ResizeOptions options{.width = width, .height = height, .filter = filter, .light = light};
        Image one = random_image({30, 20, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, 17);
        Image other = random_image(one.info(), 18);
        for (int y = 0; y < 20; ++y) {
          for (int x = 0; x < 30; ++x) {
            const bool shown = (x / 3 + y / 2) % 2 == 0;
            for (int c = 0; c < 3 && shown; ++c)
              other.view<std::uint8_t>()(x, y, c) = one.view<std::uint8_t>()(x, y, c);
            one.view<std::uint8_t>()(x, y, 3) = other.view<std::uint8_t>()(x, y, 3) = shown ? 255 : 0;
          }
        }
        const Image a = resize(one, options);
        const Image b = resize(other, options);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const bool visible = a.view<std::uint8_t>()(x, y, 3) != 0;
            for (int c = 0; c < 4; ++c) {
              if (visible || c == 3) {
                ASSERT_EQ(a.view<std::uint8_t>()(x, y, c), b.view<std::uint8_t>()(x, y, c));
              } else if (filter != ResizeFilter::Nearest) {
                ASSERT_EQ(a.view<std::uint8_t>()(x, y, c), 0);
              }
            }
          }
        }
      }
    }
  }
}

TEST(Resize, PremultipliedAndStraightAgree) {
  // Opaque pixels are the same in both states; half of the pixels have no alpha.
  Image straight = random_image({24, 24, 4, PixelType::F32, ColorState::Srgb, AlphaState::Straight}, 41);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) straight.view<float>()(x, y, 3) = 0.25F + 0.75F * straight.view<float>()(x, y, 3);
  }
  Image premultiplied = straight.clone();
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      for (int c = 0; c < 3; ++c) premultiplied.view<float>()(x, y, c) *= straight.view<float>()(x, y, 3);
    }
  }
  for (const Light light : {Light::Encoded, Light::Linear}) {
    const ResizeOptions options{.width = 11, .filter = ResizeFilter::Bilinear, .light = light};
    const Image a = resize(straight, options);
    const Image b = resize(premultiplied, options);
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 11; ++x) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(a.view<float>()(x, y, c) * a.view<float>()(x, y, 3), b.view<float>()(x, y, c), 1e-5);
        }
      }
    }
  }
}

TEST(Resize, NaNStaysInItsWindow) {
  Image image(40, 40, 1, PixelType::F32);
  for (int y = 0; y < 40; ++y) std::fill_n(image.view<float>().row(y), 40, 0.5F);
  image.view<float>()(20, 20) = std::numeric_limits<float>::quiet_NaN();
  const Image large = resize(image, {.scale = 2});
  for (int y = 0; y < 80; ++y) {
    // Pixel 20 is in the six-pixel windows of those result pixels whose centres are less than 3 from 20.5.
    for (int x = 0; x < 80; ++x) {
      const bool near = std::abs((x + 0.5) / 2 - 20.5) < 3 && std::abs((y + 0.5) / 2 - 20.5) < 3;
      ASSERT_EQ(std::isnan(large.view<float>()(x, y)), near) << x << ", " << y;
    }
  }
  image.view<float>()(20, 20) = 0.5F;
  image.view<float>()(3, 3) = std::numeric_limits<float>::quiet_NaN();
  const Image small = resize(image, {.scale = 0.25F});
  for (int y = 0; y < 10; ++y) {
    // Windows of 24 pixels that begin at 4 j − 10, moved inside at the edges.
    for (int x = 0; x < 10; ++x) {
      const auto holds = [](int j) { return std::clamp(4 * j - 10, 0, 16) <= 3; };
      ASSERT_EQ(std::isnan(small.view<float>()(x, y)), holds(x) && holds(y)) << x << ", " << y;
    }
  }
}

TEST(Resize, SizesFollow) {
  const Image image(400, 301, 1);
  const auto size = [&](const ResizeOptions& options) {
    const Image result = resize(image, options);
    return std::pair{result.width(), result.height()};
  };
  EXPECT_EQ(size({.width = 200}), (std::pair{200, 151}));  // 150.5, half up
  EXPECT_EQ(size({.height = 1}), (std::pair{1, 1}));       // 1.33
  EXPECT_EQ(size({.width = 1}), (std::pair{1, 1}));        // 0.75
  EXPECT_EQ(size({.scale = 1e-4F}), (std::pair{1, 1}));
  EXPECT_EQ(size({.scale = 0.7F}), (std::pair{280, 211}));  // 210.7
  EXPECT_EQ(size({.width = 7, .height = 900, .filter = ResizeFilter::Nearest}), (std::pair{7, 900}));
  EXPECT_EQ(resize(Image(25, 5, 1), {.scale = 0.7F}).width(), 18);  // 17.5, half up
}

TEST(Resize, RefusesWhatDoesNotFit) {
  const auto kind_of = [](const ImageInfo& info, const ResizeOptions& options) {
    try {
      resize(Image(info), options);
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind("resize: ", 0), 0U) << error.what();
      return static_cast<int>(error.kind());
    }
    return -1;
  };
  const ImageInfo info{40, 30};
  EXPECT_EQ(kind_of(info, {.width = 0}), Error::Argument);
  EXPECT_EQ(kind_of(info, {.height = 1'000'001}), Error::Argument);
  EXPECT_EQ(kind_of(info, {.scale = 0}), Error::Argument);
  EXPECT_EQ(kind_of(info, {.scale = std::nanf("")}), Error::Argument);
  EXPECT_EQ(kind_of(info, {.width = 20, .scale = 2}), Error::Argument);
  EXPECT_EQ(kind_of({4000, 1}, {.scale = 9999}), Error::Argument);
  EXPECT_EQ(kind_of({1, 4000}, {.width = 4000}), Error::Argument);
  Image source(info);
  Image wrong(20, 14, 1);
  EXPECT_THROW(resize(source.any(), wrong.any(), {.width = 20}), Error);
}

}  // namespace
}  // namespace azulejo
