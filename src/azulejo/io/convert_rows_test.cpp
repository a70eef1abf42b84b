#include "azulejo/io/convert_rows.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/data/image.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

constexpr ImageInfo kGray8 = {1, 1, 1, PixelType::U8, ColorState::Srgb, AlphaState::None};

ImageInfo with(ImageInfo info, PixelType type) {
  info.type = type;
  return info;
}

Image converted(const Image& source, ImageInfo result, const std::array<float, 3>& background = {1, 1, 1}) {
  result.width = source.width();
  result.height = source.height();
  Image image(result);
  RowConverter(source.info(), result, background).convert(source.any(), image.any());
  return image;
}

template <class T>
Image one_pixel(const ImageInfo& info, std::initializer_list<T> values) {
  Image image(info);
  std::copy(values.begin(), values.end(), image.view<T>().row(0));
  return image;
}

TEST(RowConverter, EveryByteSurvivesTheWayThroughSixteenBits) {
  Image bytes(256, 1, 1);
  for (int i = 0; i < 256; ++i) bytes.view<std::uint8_t>()(i, 0) = static_cast<std::uint8_t>(i);
  const Image words = converted(bytes, with(kGray8, PixelType::U16));
  for (int i = 0; i < 256; ++i) ASSERT_EQ(words.view<std::uint16_t>()(i, 0), i * 257);
  EXPECT_TRUE(same_pixels(bytes, converted(words, kGray8)));
}

TEST(RowConverter, SixteenBitsAreRoundedToTheNearestByte) {
  Image words(65536, 1, 1, PixelType::U16);
  for (int i = 0; i < 65536; ++i) words.view<std::uint16_t>()(i, 0) = static_cast<std::uint16_t>(i);
  const Image bytes = converted(words, kGray8);
  for (int i = 0; i < 65536; ++i) ASSERT_EQ(bytes.view<std::uint8_t>()(i, 0), (i + 128) / 257) << i;
  EXPECT_TRUE(same_pixels(words, converted(converted(words, with(kGray8, PixelType::F32)), words.info())));
}

TEST(RowConverter, ClampsAndCountsWhatDoesNotFit) {
  Image values(7, 1, 1, PixelType::F32);
  const float given[] = {-1, -0.001F, 0, 1, 1.0000001F, 2, std::numeric_limits<float>::quiet_NaN()};
  const int wanted[] = {0, 0, 0, 255, 255, 255, 0};
  std::copy(std::begin(given), std::end(given), values.view<float>().row(0));
  Image result(7, 1, 1);
  RowConverter converter(values.info(), result.info());
  converter.convert(values.any(), result.any());
  for (int i = 0; i < 7; ++i) EXPECT_EQ(result.view<std::uint8_t>()(i, 0), wanted[i]) << given[i];
  EXPECT_EQ(converter.clipped(), 3) << "−1, 2 and NaN; the others would have been rounded to what they became";
}

TEST(RowConverter, EncodesLinearLight) {
  const ImageInfo linear = {1, 1, 1, PixelType::F32, ColorState::Linear, AlphaState::None};
  // IEC 61966-2-1: half of the light is 0.735357 encoded.
  EXPECT_EQ(converted(one_pixel(linear, {0.5F}), kGray8).view<std::uint8_t>()(0, 0), 188);
  const Image back = converted(one_pixel<std::uint8_t>(kGray8, {188}), linear);
  EXPECT_NEAR(back.view<float>()(0, 0), 0.5029F, 1e-4F);
}

TEST(RowConverter, DataIsNoColor) {
  const ImageInfo data = {1, 1, 1, PixelType::F32, ColorState::Data, AlphaState::None};
  EXPECT_EQ(converted(one_pixel(data, {0.5F}), kGray8).view<std::uint8_t>()(0, 0), 128);
}

TEST(RowConverter, PremultipliedBecomesStraight) {
  const ImageInfo premultiplied = {1, 1, 4, PixelType::F32, ColorState::Srgb, AlphaState::Premultiplied};
  const ImageInfo straight = {1, 1, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight};
  const Image result = converted(one_pixel(premultiplied, {0.5F, 0.25F, 0.0F, 0.5F}), straight);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 0), 255);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 1), 128);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 3), 128);
  const Image nothing = converted(one_pixel(premultiplied, {0.0F, 0.0F, 0.0F, 0.0F}), straight);
  EXPECT_EQ(nothing.view<std::uint8_t>()(0, 0, 0), 0) << "without alpha there is no color";
  const Image back = converted(result, premultiplied);
  EXPECT_NEAR(back.view<float>()(0, 0, 0), 128 / 255.0F, 1e-6F);
}

TEST(RowConverter, LaysPixelsOverTheBackground) {
  const ImageInfo rgba = {1, 1, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight};
  const ImageInfo rgb = {1, 1, 3, PixelType::U8, ColorState::Srgb, AlphaState::None};
  const Image half = one_pixel<std::uint8_t>(rgba, {200, 0, 100, 51});  // a fifth
  const Image result = converted(half, rgb, {1, 0.5F, 0});
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 0), 244);  // 40 + 204
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 1), 102);  // 0 + 102
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 2), 20);   // 20 + 0
}

TEST(RowConverter, GrayAndColor) {
  const ImageInfo rgb = {1, 1, 3, PixelType::U8, ColorState::Srgb, AlphaState::None};
  const ImageInfo rgba = {1, 1, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight};
  const ImageInfo gray_alpha = {1, 1, 2, PixelType::U8, ColorState::Srgb, AlphaState::Straight};
  const Image gray = converted(one_pixel<std::uint8_t>(rgb, {255, 0, 0}), kGray8);
  EXPECT_EQ(gray.view<std::uint8_t>()(0, 0), 76);  // 0.299 · 255 = 76.2
  const Image full = converted(one_pixel<std::uint8_t>(kGray8, {7}), rgba);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(full.view<std::uint8_t>()(0, 0, c), c == 3 ? 255 : 7);
  const Image colored = converted(one_pixel<std::uint8_t>(gray_alpha, {9, 100}), rgba);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(colored.view<std::uint8_t>()(0, 0, c), c == 3 ? 100 : 9);
}

TEST(RowConverter, StretchesColorsNotAlpha) {
  const ImageInfo source = {1, 1, 2, PixelType::F32, ColorState::Srgb, AlphaState::Straight};
  ImageInfo target = source;
  target.type = PixelType::U8;
  Image result(target);
  RowConverter converter(source, target);
  converter.stretch(-2, 6);
  converter.convert(one_pixel(source, {2.0F, 1.0F}).any(), result.any());
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 0), 128);
  EXPECT_EQ(result.view<std::uint8_t>()(0, 0, 1), 255);
  EXPECT_EQ(converter.clipped(), 0);
}

TEST(RowConverter, RoundTripsOfEveryKindKeepIntegers) {
  for (const int channels : {1, 2, 3, 4}) {
    const AlphaState alpha = channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
    for (const PixelType type : {PixelType::U8, PixelType::U16}) {
      const Image image = random_image({13, 5, channels, type, ColorState::Srgb, alpha}, 7);
      ImageInfo wide = image.info();
      wide.type = PixelType::F32;
      EXPECT_TRUE(same_pixels(image, converted(converted(image, wide), image.info())));
      wide.color = ColorState::Linear;
      // The curve and its inverse are each within 10⁻⁶: enough for any byte, not for any 16 bits.
      if (type == PixelType::U16) continue;
      EXPECT_TRUE(same_pixels(image, converted(converted(image, wide), image.info())));
    }
  }
}

}  // namespace
}  // namespace azulejo
