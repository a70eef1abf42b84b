#include "azulejo/imaging/convolve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include <hwy/highway.h>

#include "azulejo/core/error.h"
#include "azulejo/imaging/kernel_factors.h"
#include "azulejo/imaging/linear_filter.h"
#include "azulejo/io/image_io.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr PixelType kTypes[] = {PixelType::U8, PixelType::U16, PixelType::F32};

Image random_image(const ImageInfo& info, unsigned seed) {
  Image image(info);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    const float half = std::is_same_v<T, float> ? 0.0F : 0.5F;
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        view.row(y)[i] = static_cast<T>(unit(random) * full_range(kPixelTypeOf<T>) + half);
      }
    }
  });
  return image;
}

Image constant_image(const ImageInfo& info, float intensity) {
  Image image(info);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < view.height; ++y) {
      std::fill_n(view.row(y), view.width * view.channels, static_cast<T>(intensity * full_range(kPixelTypeOf<T>)));
    }
  });
  return image;
}

NumberGrid random_kernel(int rows, int columns, unsigned seed, bool whole) {
  NumberGrid kernel{rows, columns, {}};
  std::mt19937 random(seed);
  for (int i = 0; i < rows * columns; ++i) {
    const float number = std::uniform_real_distribution<float>(-3, 5)(random);
    kernel.values.push_back(whole ? std::round(number) : number);
  }
  return kernel;
}

double value_at(const Image& image, int x, int y, int c) {
  return visit(image.any(), [&](auto view) { return static_cast<double>(view(x, y, c)); });
}

/// The definition, in units of full range, neither rounded nor saturated; no alpha.
double weighed(const Image& image, const ConvolveOptions& options, int x, int y, int c) {
  const NumberGrid& kernel = options.kernel;
  double sum = 0;
  double total = 0;
  for (int r = 0; r < kernel.rows; ++r) {
    for (int k = 0; k < kernel.columns; ++k) {
      const int sign = options.correlate ? 1 : -1;
      const int from_x = border_index(x + sign * (k - kernel.columns / 2), image.width(), options.border);
      const int from_y = border_index(y + sign * (r - kernel.rows / 2), image.height(), options.border);
      double value = options.border_value;
      if (image.type() != PixelType::F32) {  // a pixel of the stored type
        value = std::floor(value * double{full_range(image.type())} + 0.5) / double{full_range(image.type())};
      }
      if (from_x >= 0 && from_y >= 0) value = value_at(image, from_x, from_y, c) / double{full_range(image.type())};
      sum += double{kernel(r, k)} * value;
      total += double{kernel(r, k)};
    }
  }
  return sum * options.scale / (options.normalize ? total : 1) + options.offset;
}

double magnitude(const ConvolveOptions& options) {
  const KernelSum sum = kernel_sum(options.kernel.values);
  return sum.magnitude * std::fabs(options.scale) / (options.normalize ? std::fabs(sum.sum) : 1);
}

/// The header's bound in units of full range for sources in 0–1, and the rounding of `sum · scale + offset`.
double bound(const ConvolveOptions& options) {
  return (static_cast<double>(options.kernel.values.size()) + 4) * 0x1p-23 * magnitude(options) +
         std::fabs(options.offset) * 0x1p-23;
}

void expect_definition(const Image& source, const ConvolveOptions& options) {
  const Image result = convolve(source, options);
  const bool as_f32 = options.output == FilterOutput::F32;
  ASSERT_EQ(result.type(), as_f32 ? PixelType::F32 : source.type());
  const double full = full_range(result.type());
  double tolerance = bound(options) * full + (result.type() == PixelType::F32 ? 0 : 0.5);
  if (result.type() == PixelType::U8) tolerance += 1.0 / 32;  // weights of 16 bits
  for (int y = 0; y < source.height(); ++y) {
    for (int x = 0; x < source.width(); ++x) {
      const int c = (x + y) % source.channels();
      double expected = weighed(source, options, x, y, c) * full;
      if (result.type() != PixelType::F32) expected = std::clamp(expected, 0.0, full);
      ASSERT_NEAR(value_at(result, x, y, c), expected, tolerance) << x << ", " << y << ", " << c;
    }
  }
}

TEST(Convolve, IsTheDefinition) {
  unsigned seed = 1;
  const std::pair<int, int> sizes[] = {{1, 1}, {1, 4}, {5, 1}, {2, 3}, {3, 3}, {5, 5}, {4, 7}, {9, 6}};
  for (const PixelType type : kTypes) {
    for (const auto& [rows, columns] : sizes) {
      for (const bool correlate : {false, true}) {
        for (const FilterOutput output : {FilterOutput::Same, FilterOutput::F32}) {
          SCOPED_TRACE(testing::Message() << to_string(type) << ", " << rows << "×" << columns << ", seed " << seed);
          const ConvolveOptions options{.kernel = random_kernel(rows, columns, seed, seed % 2 == 0),
                                        .correlate = correlate,
                                        .scale = 0.05F,
                                        .offset = 0.2F,
                                        .output = output,
                                        .border = static_cast<Border>(seed % 5),
                                        .border_value = 0.3F};
          expect_definition(random_image({37, 23, seed % 3 == 0 ? 3 : 1, type}, seed), options);
          ++seed;
        }
      }
    }
  }
}

/// Kernels whose left mirrors their right, among them averages, are summed in another way.
TEST(Convolve, IsTheDefinitionForSymmetricKernels) {
  unsigned seed = 50;
  for (const PixelType type : kTypes) {
    for (const int columns : {3, 5, 9}) {
      for (const bool normalize : {false, true}) {
        SCOPED_TRACE(testing::Message() << to_string(type) << ", " << columns << " columns, seed " << seed);
        NumberGrid kernel = random_kernel(4, columns, seed, false);
        for (int r = 0; r < 4; ++r) {
          for (int c = 0; c < columns / 2; ++c) {
            kernel.values[static_cast<std::size_t>(r * columns + columns - 1 - c)] = kernel(r, c);
          }
        }
        const ConvolveOptions options{
            .kernel = kernel, .normalize = normalize, .scale = normalize ? 1.0F : 0.1F, .border = Border::Clamp};
        expect_definition(random_image({35, 14, seed % 3 == 0 ? 3 : 1, type}, seed), options);
        ++seed;
      }
    }
  }
}

TEST(Convolve, OfAnImpulseIsTheKernelAndTurnedByCorrelation) {
  const NumberGrid kernel = random_kernel(4, 5, 7, true);
  Image source({11, 9, 1, PixelType::F32, ColorState::Data});
  for (int y = 0; y < 9; ++y) std::fill_n(source.view<float>().row(y), 11, 0.0F);
  source.view<float>()(5, 4) = 1;
  const Image convolved = convolve(source, {.kernel = kernel});
  const Image correlated = convolve(source, {.kernel = kernel, .correlate = true});
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 11; ++x) {
      const auto at = [&](int row, int column) {
        return row >= 0 && row < 4 && column >= 0 && column < 5 ? kernel(row, column) : 0.0F;
      };
      EXPECT_EQ(convolved.view<float>()(x, y), at(y - 4 + 2, x - 5 + 2)) << x << ", " << y;
      EXPECT_EQ(correlated.view<float>()(x, y), at(4 - y + 2, 5 - x + 2)) << x << ", " << y;
    }
  }
}

/// Sums of bytes by whole weights are exact, so the result is the exactly rounded one.
TEST(Convolve, OfBytesByWholeWeightsIsExact) {
  for (const bool separable : {false, true}) {
    const NumberGrid kernel =
        separable ? NumberGrid{3, 3, {3, -6, 9, 5, -10, 15, 1, -2, 3}} : random_kernel(5, 5, 3, true);
    EXPECT_EQ(kernel_factors(kernel).has_value(), separable);
    const Image source = random_image({70, 20, 1, PixelType::U8}, 5);
    const ConvolveOptions options{.kernel = kernel, .scale = 0.0625F};
    const Image result = convolve(source, options);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 70; ++x) {
        const double exact = std::round(weighed(source, options, x, y, 0) * 255 * 16) / 16;
        ASSERT_EQ(value_at(result, x, y, 0), std::clamp(std::floor(exact + 0.5), 0.0, 255.0));
      }
    }
  }
}

TEST(Convolve, LeavesConstantsToTheLastBit) {
  unsigned seed = 1;
  for (const PixelType type : kTypes) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (const int side : {1, 3, 5, 8}) {
        for (const bool tent : {false, true}) {
          SCOPED_TRACE(testing::Message() << to_string(type) << ", " << channels << " channels, side " << side);
          NumberGrid kernel = random_kernel(side, side, seed, false);
          if (tent) {
            for (int i = 0; i < side * side; ++i) {
              kernel.values[static_cast<std::size_t>(i)] =
                  static_cast<float>(1 + i / side) * static_cast<float>(2 + i % side) * 0.01F;
            }
          }
          const float level = static_cast<float>(seed % 97) / 97.0F;
          const Image source = constant_image({19, 6, channels, type, ColorState::Srgb,
                                               channels % 2 == 0 ? AlphaState::Premultiplied : AlphaState::None},
                                              level);
          const Image result = convolve(source, {.kernel = kernel, .normalize = true});
          visit(source.any(), [&](auto view) {
            using T = std::remove_pointer_t<decltype(view.data)>;
            const auto other = result.view<std::remove_const_t<T>>();
            for (int y = 0; y < 6; ++y) {
              for (int i = 0; i < 19 * channels; ++i) ASSERT_EQ(other.row(y)[i], view.row(y)[i]) << i << ", " << y;
            }
          });
          ++seed;
        }
      }
    }
  }
}

TEST(Convolve, WithWeightsThatSumToZeroIsExactlyTheOffsetOnConstants) {
  NumberGrid kernel = random_kernel(3, 5, 4, false);
  double sum = 0;
  for (const float weight : kernel.values) sum += double{weight};
  kernel.values[7] -= static_cast<float>(sum);
  for (const PixelType type : kTypes) {
    const Image source = constant_image({17, 9, 1, type}, 0.7123F);
    const Image result = convolve(source, {.kernel = kernel, .offset = 0.25F, .output = FilterOutput::F32});
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 17; ++x) ASSERT_EQ(result.view<float>()(x, y), 0.25F);
    }
  }
}

TEST(Convolve, FindsFactors) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const int rows = 2 + trial % 6;
    const int columns = 2 + trial / 6;
    const bool whole = trial % 2 == 0;
    const NumberGrid column = random_kernel(rows, 1, static_cast<unsigned>(random()), whole);
    const NumberGrid row = random_kernel(1, columns, static_cast<unsigned>(random()), whole);
    NumberGrid kernel{rows, columns, {}};
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) kernel.values.push_back(column(r, 0) * row(0, c));
    }
    const bool zero = std::all_of(kernel.values.begin(), kernel.values.end(), [](float w) { return w == 0; });
    const auto factors = kernel_factors(kernel);
    ASSERT_EQ(factors.has_value(), !zero) << "trial " << trial;
    if (zero) continue;
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const float product = factors->column[static_cast<std::size_t>(r)] * factors->row[static_cast<std::size_t>(c)];
        EXPECT_NEAR(product, kernel(r, c), whole ? 0 : 25 * 0x1p-20);
      }
    }
  }
  for (const float more : {1.0F, 1e-4F, -3e-5F}) {
    EXPECT_FALSE(kernel_factors({2, 3, {1, 2, 3, 2, 4, 6 + more}}).has_value()) << more;
    EXPECT_FALSE(kernel_factors({3, 2, {0.1F, 0.2F, 0, more, 0.2F, 0.4F}}).has_value()) << more;
  }
}

/// A separable kernel gives what the same kernel gives that was made unseparable by a weight too small to matter.
TEST(Convolve, IsTheSameInOnePassAndTwo) {
  NumberGrid kernel{3, 5, {}};
  for (const float column : {0.2F, 0.9F, -0.4F}) {
    for (const float row : {0.1F, 0.5F, 0.3F, 0.25F, 0.05F}) kernel.values.push_back(column * row);
  }
  NumberGrid other = kernel;
  other.values[0] += 1e-5F;
  const ImageInfo info{41, 17, 1, PixelType::F32};
  ASSERT_EQ(LinearFilter(info, {.kernel = kernel, .center_row = 1, .center_column = 2}).passes(), 2);
  ASSERT_EQ(LinearFilter(info, {.kernel = other, .center_row = 1, .center_column = 2}).passes(), 1);
  const Image source = random_image(info, 2);
  const Image two = convolve(source, {.kernel = kernel});
  const Image one = convolve(source, {.kernel = other});
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 41; ++x) ASSERT_NEAR(two.view<float>()(x, y), one.view<float>()(x, y), 1.2e-5);
  }
}

TEST(Convolve, IsLinear) {
  const unsigned seed = 9;
  const ImageInfo info{29, 31, 1, PixelType::F32};
  const Image a = random_image(info, seed);
  const Image b = random_image(info, seed + 1);
  Image sum(info);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 29; ++x) {
      sum.view<float>()(x, y) = 2 * a.view<const float>()(x, y) - 0.5F * b.view<const float>()(x, y);
    }
  }
  const ConvolveOptions options{.kernel = random_kernel(5, 3, seed, false)};
  const Image of_a = convolve(a, options);
  const Image of_b = convolve(b, options);
  const Image of_sum = convolve(sum, options);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 29; ++x) {
      ASSERT_NEAR(of_sum.view<float>()(x, y), 2 * of_a.view<float>()(x, y) - 0.5F * of_b.view<float>()(x, y),
                  6 * bound(options));
    }
  }
}

/// Opaque pixels are what they would be without alpha, by any kernel.
TEST(Convolve, OfOpaquePixelsIsThatOfColors) {
  for (const PixelType type : kTypes) {
    for (const AlphaState alpha : {AlphaState::Straight, AlphaState::Premultiplied}) {
      for (const float middle : {4.0F, 5.0F, -2.0F}) {
        const Image colors = random_image({23, 12, 3, type}, 5);
        Image source({23, 12, 4, type, ColorState::Srgb, alpha});
        visit(colors.any(), [&](auto from) {
          using T = std::remove_const_t<std::remove_pointer_t<decltype(from.data)>>;
          for (int y = 0; y < 12; ++y) {
            for (int x = 0; x < 23; ++x) {
              for (int c = 0; c < 3; ++c) source.view<T>()(x, y, c) = from(x, y, c);
              source.view<T>()(x, y, 3) = static_cast<T>(full_range(type));
            }
          }
        });
        const ConvolveOptions options{.kernel = {3, 3, {0, -1, 0, -1, middle, -1, 0, -1, 0}}, .offset = 0.125F};
        const Image expected = convolve(colors, options);
        const Image result = convolve(source, options);
        for (int y = 0; y < 12; ++y) {
          for (int x = 0; x < 23; ++x) {
            ASSERT_EQ(value_at(result, x, y, 3), double{full_range(type)});
            for (int c = 0; c < 3; ++c) {
              // Of f32, colors may differ in the last bit: sums are those of other units.
              ASSERT_NEAR(value_at(result, x, y, c), value_at(expected, x, y, c), type == PixelType::F32 ? 2e-6 : 1);
            }
          }
        }
      }
    }
  }
}

TEST(Convolve, NeverShowsHiddenColors) {
  for (const bool averages : {true, false}) {
    Image source(9, 9, 4);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        const bool visible = x < 5;
        const std::uint8_t pixel[4] = {static_cast<std::uint8_t>(visible ? 40 : 255), 80, 120,
                                       static_cast<std::uint8_t>(visible ? 255 : 0)};
        std::copy_n(pixel, 4, &source.view<std::uint8_t>()(x, y));
      }
    }
    Image other = source.clone();
    for (int y = 0; y < 9; ++y) {
      for (int x = 5; x < 9; ++x) std::fill_n(&other.view<std::uint8_t>()(x, y), 3, std::uint8_t{7});
    }
    const ConvolveOptions options{.kernel = averages ? NumberGrid{1, 3, {1, 1, 1}} : NumberGrid{1, 3, {-1, 3, -1}},
                                  .normalize = true};
    const Image a = convolve(source, options);
    const Image b = convolve(other, options);
    for (int y = 0; y < 9; ++y) {
      ASSERT_EQ(std::memcmp(a.view<const std::uint8_t>().row(y), b.view<const std::uint8_t>().row(y), 36), 0);
    }
    EXPECT_EQ(value_at(a, 5, 4, 3), averages ? 85 : 0);  // a third of full
    if (averages) {
      EXPECT_EQ(value_at(a, 5, 4, 0), 40);
    }
  }
}

TEST(Convolve, AveragesLinearLightOnRequest) {
  Image source(3, 1, 1);
  for (int x = 0; x < 3; ++x) source.view<std::uint8_t>()(x, 0) = x == 1 ? 255 : 0;
  const Image result =
      convolve(source, {.kernel = {1, 2, {1, 1}}, .normalize = true, .border = Border::Clamp, .light = Light::Linear});
  EXPECT_EQ(value_at(result, 1, 0, 0), 188);  // half the light
  EXPECT_EQ(value_at(result, 0, 0, 0), 188);
  EXPECT_EQ(value_at(result, 2, 0, 0), 0);
}

/// What no weight reads isn't seen, not even a NaN.
TEST(Convolve, SpreadsNaNAsFarAsWeightsReach) {
  Image source = constant_image({15, 9, 1, PixelType::F32}, 0.5F);
  source.view<float>()(7, 4) = std::numeric_limits<float>::quiet_NaN();
  const NumberGrid kernel{3, 3, {1, 0, 0, 2, 0, 1, 0, 0, 3}};
  const Image result = convolve(source, {.kernel = kernel});
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 15; ++x) {
      const bool inside = std::abs(x - 7) <= 1 && std::abs(y - 4) <= 1;
      EXPECT_EQ(std::isnan(result.view<float>()(x, y)), inside && kernel(y - 4 + 1, x - 7 + 1) != 0) << x << ", " << y;
    }
  }
}

TEST(Convolve, ReadsKernelsFromFiles) {
  const auto folder = std::filesystem::temp_directory_path() / "azulejo_convolve_test";
  std::filesystem::create_directories(folder);
  const std::string text = (folder / "kernel.txt").string();
  std::ofstream(text) << "1 2,1\r\n\n 2\t4  2\n1, 2, 1 \n";
  const std::string picture = (folder / "kernel.png").string();
  Image drawn(3, 3, 1);
  const NumberGrid kernel{3, 3, {1, 2, 1, 2, 4, 2, 1, 2, 1}};
  for (int i = 0; i < 9; ++i) {
    drawn.view<std::uint8_t>()(i % 3, i / 3) = static_cast<std::uint8_t>(kernel.values[static_cast<std::size_t>(i)]);
  }
  write_image(drawn, picture);
  const std::string colors = (folder / "colors.png").string();
  write_image(Image(3, 3, 3), colors);
  const std::string ragged = (folder / "ragged.txt").string();
  std::ofstream(ragged) << "1 2\n3\n";
  const std::string rows = (folder / "rows.txt").string();
  std::ofstream(rows) << "\xEF\xBB\xBF# 16 / 16\n1 2 1 / 2,4,2/ 1 2 1 # the last\n";
  const std::string word = (folder / "word.txt").string();
  std::ofstream(word) << "1 two\n";
  const std::string large = (folder / "large.txt").string();
  std::ofstream(large) << "1e7 1\n";
  const std::string no_number = (folder / "nan.pfm").string();
  Image not_finite(ImageInfo{2, 1, 1, PixelType::F32, ColorState::Linear});
  not_finite.view<float>()(1, 0) = std::numeric_limits<float>::quiet_NaN();
  write_image(not_finite, no_number);
  const std::string nothing = (folder / "nothing.txt").string();
  std::ofstream(nothing) << " \n";

  const Image source = random_image({20, 11, 1, PixelType::U8}, 3);
  const Image expected = convolve(source, {.kernel = kernel, .normalize = true});
  ConvolveOptions options;
  options.normalize = true;
  for (const std::string& file : {text, picture, rows}) {
    options.file = file;
    const Image result = convolve(source, options);
    for (int y = 0; y < 11; ++y) {
      ASSERT_EQ(std::memcmp(result.view<const std::uint8_t>().row(y), expected.view<const std::uint8_t>().row(y), 20),
                0);
    }
  }
  // An image's weights are intensities.
  options.normalize = false;
  options.file = picture;
  options.scale = 255.0F / 16;
  const Image dim = convolve(source, options);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 20; ++x) ASSERT_NEAR(value_at(dim, x, y, 0), value_at(expected, x, y, 0), 1);
  }
  for (const std::string& file : {colors, ragged, nothing, word, large, no_number, (folder / "absent.txt").string()}) {
    options.file = file;
    EXPECT_THROW(convolve(source, options), Error) << file;
  }
  options.file = text;
  options.kernel = kernel;
  EXPECT_THROW(convolve(source, options), Error);  // two kernels
  std::filesystem::remove_all(folder);
}

/// Every way to sum, by every vector target, on rows shorter and longer than a vector.
TEST(Convolve, AgreesWithTheScalarDefinition) {
  const NumberGrid kernels[] = {{3, 3, {1, 2, 1, 2, 4, 2, 1, 2, 1}},
                                {4, 5, {1, 2, 3, -2, 1, 2, 4, 6, -4, 2, -1, -2, -3, 2, -1, 0, 0, 0, 0, 0}},
                                {2, 4, {1, 2, 3, 4, 2, 4, 6, 8}},
                                {3, 3, {0.1F, 0.2F, 0.1F, 0.3F, 0.5F, 0.3F, -0.2F, 0.1F, -0.2F}},
                                {3, 4, {0.1F, 0.2F, -0.1F, 0.3F, 0.5F, 0.3F, -0.2F, 0.1F, -0.3F, 0, 0, 0.7F}},
                                random_kernel(6, 6, 1, false)};
  for (const PixelType type : kTypes) {
    for (const int width : {1, 5, 31, 33, 64, 150}) {
      for (const int channels : {1, 3}) {
        const Image source = random_image({width, 11, channels, type}, static_cast<unsigned>(width + channels));
        for (const NumberGrid& kernel : kernels) {
          for (const bool normalize : {false, true}) {
            const ConvolveOptions options{.kernel = kernel, .normalize = normalize};
            azulejo::Run reference;
            reference.testing.reference = true;
            const Image expected = convolve(source, options, reference);
            for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
              hwy::SetSupportedTargetsForTest(target);
              hwy::GetChosenTarget().Update(target);
              const Image result = convolve(source, options);
              for (int y = 0; y < 11; ++y) {
                ASSERT_EQ(std::memcmp(result.any().row(y), expected.any().row(y), expected.info().row_bytes()), 0)
                    << hwy::TargetName(target) << ", " << to_string(type) << ", width " << width << ", " << channels
                    << " channels, kernel " << &kernel - kernels << ", row " << y;
              }
            }
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().DeInit();
          }
        }
      }
    }
  }
}

NumberGrid large_kernel(bool averages) {
  NumberGrid kernel = random_kernel(35, 33, 5, false);
  for (float& weight : kernel.values) weight = averages ? std::fabs(weight) : weight;
  return kernel;
}

/// Kernels that are applied by Fourier transforms of blocks of 256 × 256 pixels.
TEST(Convolve, IsTheDefinitionForLargeKernels) {
  const NumberGrid kernel = large_kernel(false);
  double squares = 0;
  for (const float weight : kernel.values) squares += double{weight} * double{weight};
  for (const PixelType type : kTypes) {
    for (const bool correlate : {false, true}) {
      const Image source = random_image({291, 270, type == PixelType::U8 ? 3 : 1, type}, 8);
      const ConvolveOptions options{
          .kernel = kernel, .correlate = correlate, .scale = 0.001F, .offset = 0.3F, .border = Border::Reflect};
      const Image result = convolve(source, options);
      const double full = full_range(type);
      // 2⁻²⁰ · 16 · 384 / √(35 + 33) of √Σw², the header's bound, and rounding.
      const double tolerance =
          full * (0x1p-16 * 384 / std::sqrt(68) * std::sqrt(squares) * 0.001) + (type == PixelType::F32 ? 0 : 0.5);
      for (const auto& [x, y] :
           {std::pair{0, 0}, {255, 255}, {256, 255}, {255, 256}, {290, 269}, {120, 77}, {9, 260}}) {
        const int c = x % source.channels();
        double expected = weighed(source, options, x, y, c) * full;
        if (type != PixelType::F32) expected = std::clamp(expected, 0.0, full);
        ASSERT_NEAR(value_at(result, x, y, c), expected, tolerance) << to_string(type) << ": " << x << ", " << y;
      }
    }
  }
}

TEST(Convolve, LeavesConstantsToTheLastBitByLargeKernels) {
  for (const PixelType type : kTypes) {
    const Image source = constant_image({40, 30, 1, type}, 0.7123F);
    const Image result = convolve(source, {.kernel = large_kernel(true), .normalize = true});
    for (int y = 0; y < 30; ++y) {
      ASSERT_EQ(std::memcmp(result.any().row(y), source.any().row(y), source.info().row_bytes()), 0);
    }
  }
}

TEST(Convolve, ByLargeKernelsIsTheSameHoweverItIsDivided) {
  for (const AlphaState alpha : {AlphaState::None, AlphaState::Straight}) {
    const Image source =
        random_image({300, 263, alpha == AlphaState::None ? 1 : 4, PixelType::F32, ColorState::Srgb, alpha}, 3);
    const ConvolveOptions options{.kernel = large_kernel(true), .normalize = true};
    const Image expected = convolve(source, options);
    const auto expect_same = [&](const azulejo::Run& run, const std::string& how) {
      const Image result = convolve(source, options, run);
      for (int y = 0; y < 263; ++y) {
        ASSERT_EQ(std::memcmp(result.any().row(y), expected.any().row(y), expected.info().row_bytes()), 0) << how;
      }
    };
    azulejo::Run run;
    run.threads = 3;
    run.testing = {.tile_width = 170, .tile_height = 99};
    expect_same(run, "tiles");
    run.testing.reference = true;
    expect_same(run, "reference");
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(target);
      expect_same({}, hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
}

TEST(Convolve, RefusesWhatHasNoMeaning) {
  const Image source(8, 8, 1);
  const auto refused = [&](const NumberGrid& kernel, bool normalize) {
    ConvolveOptions options;
    options.kernel = kernel;
    options.normalize = normalize;
    try {
      convolve(source, options);
    } catch (const Error& error) {
      return error.kind() == Error::Argument;
    }
    return false;
  };
  EXPECT_TRUE(refused({}, false));
  EXPECT_TRUE(refused({1, 256, std::vector<float>(256, 1.0F)}, false));
  EXPECT_TRUE(refused({1, 3, {1, 1}}, false));
  EXPECT_TRUE(refused({1, 2, {1, -1}}, true));
}

}  // namespace
}  // namespace azulejo
