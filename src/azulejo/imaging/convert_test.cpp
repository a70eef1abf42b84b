#include "azulejo/imaging/convert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"

namespace azulejo {
namespace {

template <class T>
Image row_of(std::initializer_list<T> values, int channels = 1) {
  Image image(static_cast<int>(values.size()) / channels, 1, channels, kPixelTypeOf<T>);
  std::copy(values.begin(), values.end(), image.view<T>().row(0));
  return image;
}

/// All values of 16 bits.
Image all_words() {
  Image image(65536, 1, 1, PixelType::U16);
  for (int v = 0; v < 65536; ++v) image.view<std::uint16_t>()(v, 0) = static_cast<std::uint16_t>(v);
  return image;
}

TEST(Convert, OfIntegersIsTheNearestOfAllValues) {
  const Image words = all_words();
  const Image bytes = convert(words);
  const Image floats = convert(words, {.type = PixelType::F32});
  for (int v = 0; v < 65536; ++v) {
    ASSERT_EQ(bytes.view<std::uint8_t>()(v, 0), (v + 128) / 257);  // v / 257, to the nearest; 257 is odd: no halves
    ASSERT_EQ(floats.view<float>()(v, 0), static_cast<float>(v / 65535.0));
  }
  const Image back = convert(floats, {.type = PixelType::U16});
  for (int v = 0; v < 65536; ++v) ASSERT_EQ(back.view<std::uint16_t>()(v, 0), v);
  const Image wide = convert(bytes, {.type = PixelType::U16});
  const Image unit = convert(bytes, {.type = PixelType::F32});
  const Image narrow = convert(unit);
  for (int v = 0; v < 65536; ++v) {
    const int byte = bytes.view<std::uint8_t>()(v, 0);
    ASSERT_EQ(wide.view<std::uint16_t>()(v, 0), byte * 257);
    ASSERT_EQ(unit.view<float>()(v, 0), static_cast<float>(byte / 255.0));
    ASSERT_EQ(narrow.view<std::uint8_t>()(v, 0), byte);
  }
}

TEST(Convert, OfFloatsRoundsHalfUpAndSaturates) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Image source = row_of<float>({-0.5F, 0, 0.5F, 1, 7, kInfinity, -kInfinity, std::nanf(""), 0.002F});
  const int bytes[] = {0, 0, 128, 255, 255, 255, 0, 0, 1};  // 127.5 and 0.51 are rounded up
  const int words[] = {0, 0, 32768, 65535, 65535, 65535, 0, 0, 131};
  const Image narrow = convert(source);
  const Image wide = convert(source, {.type = PixelType::U16});
  for (int x = 0; x < 9; ++x) {
    EXPECT_EQ(narrow.view<std::uint8_t>()(x, 0), bytes[x]) << x;
    EXPECT_EQ(wide.view<std::uint16_t>()(x, 0), words[x]) << x;
  }
}

TEST(Convert, TheStatesStayAndTheSameTypeIsACopy) {
  Image source = random_image(Image(23, 5, 4, PixelType::F32).info(), 3);
  source.set_states(ColorState::Linear, AlphaState::Premultiplied);
  const Image result = convert(source, {.type = PixelType::F32});
  EXPECT_EQ(result.info(), source.info());
  for (int i = 0; i < 92; ++i) EXPECT_EQ(result.view<float>().row(4)[i], source.view<float>().row(4)[i]);
  const ImageInfo bytes = convert(source).info();
  EXPECT_EQ(bytes.color, ColorState::Linear);
  EXPECT_EQ(bytes.alpha, AlphaState::Premultiplied);
}

TEST(Convert, NormalizingMakesTheSmallestAndTheLargestTheEnds) {
  const unsigned seed = 4;
  SCOPED_TRACE(seed);
  Image source = random_image(Image(61, 33, 3, PixelType::F32).info(), seed);
  for (int y = 0; y < 33; ++y) {
    for (int i = 0; i < 183; ++i) source.view<float>().row(y)[i] = source.view<float>().row(y)[i] * 40 - 17;
  }
  source.view<float>()(7, 7) = std::nanf("");
  float low = 1e9F;
  float high = -1e9F;
  for (int y = 0; y < 33; ++y) {
    for (int i = 0; i < 183; ++i) {
      const float value = source.view<float>().row(y)[i];
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const Image result = convert(source, {.type = PixelType::U16, .normalize = true});
  for (int y = 0; y < 33; ++y) {
    for (int i = 0; i < 183; ++i) {
      const double value = static_cast<double>(source.view<float>().row(y)[i]);
      const double exact = std::isnan(value) ? 0 : (value - double{low}) / (double{high} - double{low}) * 65535;
      // Half a step, and four roundings of 2⁻²⁴ of 65535.
      ASSERT_NEAR(result.view<std::uint16_t>().row(y)[i], exact, 0.5 + 4 * 65535.0 / (1 << 24));
    }
  }
}

TEST(Convert, NormalizingOfAConstantImageIsZero) {
  const Image source = row_of<std::uint8_t>({70, 70, 70});
  const Image result = convert(source, {.type = PixelType::F32, .normalize = true});
  for (int x = 0; x < 3; ++x) EXPECT_EQ(result.view<float>()(x, 0), 0);
}

TEST(Convert, NormalizingDoesNotSeeHiddenPixelsNorPremultiplication) {
  const Image straight = row_of<float>({0.2F, 1, 0.6F, 0.5F, 0.9F, 0}, 2);
  Image premultiplied = row_of<float>({0.2F, 1, 0.3F, 0.5F, 0, 0}, 2);
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  const ConvertOptions options{.type = PixelType::F32, .normalize = true};
  const Image a = convert(straight, options);
  const Image b = convert(premultiplied, options);
  const float alphas[] = {1, 0.5F, 0};
  for (int x = 0; x < 3; ++x) {
    EXPECT_EQ(a.view<float>()(x, 0, 1), alphas[x]);
    EXPECT_EQ(b.view<float>()(x, 0, 1), alphas[x]);
  }
  EXPECT_EQ(a.view<float>()(0, 0), 0);
  EXPECT_FLOAT_EQ(a.view<float>()(1, 0), 1);
  EXPECT_EQ(b.view<float>()(0, 0), 0);
  EXPECT_FLOAT_EQ(b.view<float>()(1, 0), 0.5F);
  EXPECT_EQ(b.view<float>()(2, 0), 0);
}

}  // namespace
}  // namespace azulejo
