#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "azulejo/io/codec_testing.h"

namespace azulejo {
namespace {

ImageInfo kind(int width, int height) {
  return {width, height, 3, PixelType::F32, ColorState::Linear, AlphaState::None};
}

std::vector<std::byte> file(const std::string& resolution, const std::string& pixels) {
  const std::string text =
      "#?RADIANCE\nEXPOSURE=2.5\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + pixels;
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Gray RGBE pixels with the mantissas given and the exponent of 1/256.
std::string pixels(std::initializer_list<int> mantissas) {
  std::string result;
  for (const int each : mantissas) {
    const char gray = static_cast<char>(each);
    result += {gray, gray, gray, static_cast<char>(128)};
  }
  return result;
}

std::vector<int> mantissas(const Image& image) {
  std::vector<int> result;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      result.push_back(static_cast<int>(std::lround(image.view<float>()(x, y, 1) * 256)));
    }
  }
  return result;
}

TEST(Hdr, RoundTripsWithinHalfAStepOfTheMantissa) {
  // Widths with and without run lengths, rows that are one run and rows that are none.
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 2}, {8, 3}, {300, 5}, {33000, 1}}) {
    Image image = random_image(kind(width, height), 3);
    auto view = image.view<float>();
    std::fill_n(view.row(0), width * 3 * 2 / 3, 0.3F);
    for (int x = 0; x < width; ++x) view(x, height - 1, 0) *= std::ldexp(1.0F, x % 200 - 100);
    const Image back = read_image(encode_image(image, "hdr"), "back.hdr");
    ASSERT_EQ(back.info(), image.info());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float* a = image.view<float>().row(y) + 3 * x;
        const float* b = back.view<float>().row(y) + 3 * x;
        // The largest mantissa is at least 128, rounding at most 1/2 of a step (1 where 255.5 takes the next exponent).
        const float bound = std::max({a[0], a[1], a[2]}) / 256 * 1.01F;
        for (int i = 0; i < 3; ++i) ASSERT_LE(std::abs(a[i] - b[i]), bound) << width << " at " << x << ", " << y;
      }
    }
  }
}

TEST(Hdr, ValuesOfTheFormatAreExact) {
  Image image(kind(2, 1));
  const std::vector<float> values{1, 0.5F, 0.25F, 255 * std::ldexp(1.0F, 119), 0, std::ldexp(1.0F, 119)};
  std::copy(values.begin(), values.end(), image.view<float>().row(0));
  EXPECT_TRUE(same_pixels(read_image(encode_image(image, "hdr"), "back.hdr"), image));
}

TEST(Hdr, WhatTheFormatCannotHoldIsClippedWithAWarning) {
  Image image(kind(1, 1));
  const std::vector<float> values{-1, std::numeric_limits<float>::quiet_NaN(), 1};
  std::copy(values.begin(), values.end(), image.view<float>().row(0));
  Warnings warnings;
  const Image back = read_image(encode_image(image, "hdr", {}, warnings.run()), "back.hdr");
  EXPECT_EQ(warnings.lines.size(), 1U);
  EXPECT_EQ(back.view<float>()(0, 0, 0), 0);
  EXPECT_EQ(back.view<float>()(0, 0, 1), 0);
  EXPECT_EQ(back.view<float>()(0, 0, 2), 1);
}

TEST(Hdr, AllScanDirections) {
  const auto read = [](const char* resolution) {
    return mantissas(read_image(file(resolution, pixels({201, 202, 203, 204, 205, 206})), "x"));
  };
  EXPECT_EQ(read("-Y 2 +X 3"), (std::vector<int>{201, 202, 203, 204, 205, 206}));
  EXPECT_EQ(read("-Y 2 -X 3"), (std::vector<int>{203, 202, 201, 206, 205, 204}));
  EXPECT_EQ(read("+Y 2 +X 3"), (std::vector<int>{204, 205, 206, 201, 202, 203}));
  EXPECT_EQ(read("+Y 2 -X 3"), (std::vector<int>{206, 205, 204, 203, 202, 201}));
  EXPECT_EQ(read("+X 2 -Y 3"), (std::vector<int>{201, 204, 202, 205, 203, 206}));
  EXPECT_EQ(read("-X 2 -Y 3"), (std::vector<int>{204, 201, 205, 202, 206, 203}));
  EXPECT_EQ(read("-X 2 +Y 3"), (std::vector<int>{206, 203, 205, 202, 204, 201}));
  EXPECT_EQ(read("+X 2 +Y 3"), (std::vector<int>{203, 206, 202, 205, 201, 204}));
}

TEST(Hdr, OldRunLengths) {
  const std::string repeat_3 = "\1\1\1\3";
  EXPECT_EQ(mantissas(read_image(file("-Y 1 +X 5", pixels({200}) + repeat_3 + pixels({201})), "x")),
            (std::vector<int>{200, 200, 200, 200, 201}));
  // Two counts in a row are the bytes of one: 4 + 256.
  const std::vector<int> wide =
      mantissas(read_image(file("-Y 1 +X 262", pixels({200}) + "\1\1\1\4\1\1\1\1" + pixels({7})), "x"));
  EXPECT_EQ(std::count(wide.begin(), wide.end(), 200), 261);
  EXPECT_EQ(wide.back(), 7);
  EXPECT_EQ(kind_of_error([&] { read_image(file("-Y 1 +X 3", repeat_3 + pixels({1, 2})), "x"); }), Error::Data);
  EXPECT_EQ(kind_of_error([&] { read_image(file("-Y 1 +X 3", pixels({9}) + repeat_3), "x"); }), Error::Data);
}

TEST(Hdr, HeadersThatAreNotUnderstoodAreRefused) {
  const auto read = [](const std::string& text) { read_image(as_bytes(text), "x"); };
  EXPECT_EQ(kind_of_error([&] { read("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n"); }), Error::Unsupported);
  EXPECT_EQ(kind_of_error([&] { read("#?RADIANCE\n\n-Y 1 +X 1\nabcd"); }), Error::Data);
  for (const char* resolution : {"-Y 1 -Y 1", "-Y 1", "-Y +X 1", "-Y 0 +X 1", "-Y 1 +X 1 1", "-Y -1 +X 1", ""}) {
    EXPECT_EQ(kind_of_error([&] { read_image(file(resolution, "abcd"), "x"); }), Error::Data) << resolution;
  }
  EXPECT_EQ(kind_of_error([&] { read_image(file("-Y 1000000 +X 1000000", "abcd"), "x"); }), Error::Resource);
}

TEST(Hdr, ExposureIsKeptAsText) {
  const Image image = read_image(file("-Y 1 +X 1", pixels({200})), "x");
  EXPECT_EQ(image.metadata().text.at("EXPOSURE"), "2.5");
  const Image back = read_image(encode_image(image, "hdr"), "x");
  EXPECT_EQ(back.metadata().text.at("EXPOSURE"), "2.5");
}

TEST(Hdr, CutsAreNoticed) {
  const std::vector<std::byte> bytes = encode_image(random_image(kind(12, 3), 1), "hdr");
  expect_cuts_noticed(bytes);
  expect_cuts_noticed(file("-Y 1 +X 3", pixels({1, 2, 3})));
  expect_flips_survived(bytes, 500, 11);
}

TEST(Hdr, SamplesOpen) {
  int files = 0;
  const std::vector<std::string> refused = refused_samples("hdr_env", ".hdr", files);
  if (files == 0) GTEST_SKIP() << "skipped: sample images absent";
  EXPECT_EQ(refused, std::vector<std::string>{});
}

}  // namespace
}  // namespace azulejo
