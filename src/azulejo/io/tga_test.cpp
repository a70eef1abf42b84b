#include <gtest/gtest.h>

#include "azulejo/io/codec_testing.h"

namespace azulejo {
namespace {

ImageInfo kind(int width, int height, int channels) {
  return {width,         height,           channels,
          PixelType::U8, ColorState::Srgb, channels % 2 == 0 ? AlphaState::Straight : AlphaState::None};
}

/// A file of 2×2 pixels.
std::vector<std::byte> file(int type, int bits, int descriptor, std::initializer_list<int> rest) {
  const int palette = type == 1 || type == 9 ? 1 : 0;
  std::vector<std::byte> result =
      bytes_of({0, palette, type, 1, 0, palette * 2, 0, palette * 24, 0, 0, 0, 0, 2, 0, 2, 0, bits, descriptor});
  const std::vector<std::byte> more = bytes_of(rest);
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

TEST(Tga, RoundTripsAreExact) {
  for (int channels = 1; channels <= 4; ++channels) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {300, 2}}) {
      Image image = random_image(kind(width, height, channels), 7);
      // A row of runs longer than a packet.
      std::fill_n(image.view<std::uint8_t>().row(0), image.info().row_bytes() * 9 / 10, std::uint8_t{9});
      const Image back = read_image(encode_image(image, "tga"), "back.tga");
      EXPECT_EQ(back.info(), image.info());
      EXPECT_TRUE(same_pixels(back, image)) << describe(image.info());
    }
  }
}

TEST(Tga, AllCorners) {
  constexpr int kRight = 16;
  constexpr int kTop = 32;
  const auto values = [](int descriptor) { return u8_values(read_image(file(3, 8, descriptor, {1, 2, 3, 4}), "x")); };
  EXPECT_EQ(values(kTop), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(values(0), (std::vector<int>{3, 4, 1, 2}));
  EXPECT_EQ(values(kTop | kRight), (std::vector<int>{2, 1, 4, 3}));
  EXPECT_EQ(values(kRight), (std::vector<int>{4, 3, 2, 1}));
}

TEST(Tga, RunsMayCrossRows) {
  const auto values = [](int descriptor) {
    return u8_values(read_image(file(11, 8, descriptor, {0x82, 5, 0x00, 6}), "x"));
  };
  EXPECT_EQ(values(32), (std::vector<int>{5, 5, 5, 6}));
  EXPECT_EQ(values(0), (std::vector<int>{5, 6, 5, 5}));
  EXPECT_EQ(u8_values(read_image(file(11, 8, 32, {0x02, 5, 6, 7, 0x80, 8}), "x")), (std::vector<int>{5, 6, 7, 8}));
}

TEST(Tga, PalettesStartAtTheirFirstIndex) {
  // Entries 1 and 2: blue, green, red.
  EXPECT_EQ(u8_values(read_image(file(1, 8, 32, {3, 2, 1, 6, 5, 4, 1, 2, 2, 1}), "x")),
            (std::vector<int>{1, 2, 3, 4, 5, 6, 4, 5, 6, 1, 2, 3}));
  EXPECT_EQ(kind_of_error([] { read_image(file(1, 8, 32, {3, 2, 1, 6, 5, 4, 1, 2, 3, 1}), "x"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_image(file(1, 8, 32, {3, 2, 1, 6, 5, 4, 0, 2, 2, 1}), "x"); }), Error::Data);
}

TEST(Tga, AttributeBitsSayWhetherThereIsAlpha) {
  const auto bytes = [](int descriptor) {
    return file(2, 32, descriptor, {3, 2, 1, 9, 3, 2, 1, 9, 3, 2, 1, 9, 3, 2, 1, 9});
  };
  EXPECT_EQ(read_image(bytes(32), "x").info(), kind(2, 2, 3));
  const Image image = read_image(bytes(32 | 8), "x");
  EXPECT_EQ(image.info(), kind(2, 2, 4));
  EXPECT_EQ(u8_values(image.clone())[3], 9);
}

TEST(Tga, FiveBitsAreScaledToFullRange) {
  // Red 31, green 16, blue 1: 255, 16 · 255 / 31 = 131.6, 8.2.
  const Image image = read_image(file(2, 16, 32, {0x01, 0x7E, 0x01, 0x7E, 0x01, 0x7E, 0x01, 0x7E}), "x");
  EXPECT_EQ(u8_values(image), (std::vector<int>{255, 132, 8, 255, 132, 8, 255, 132, 8, 255, 132, 8}));
}

TEST(Tga, CutsAreNoticed) {
  expect_cuts_noticed(encode_image(random_image(kind(3, 2, 4), 1), "tga"));
  expect_cuts_noticed(file(1, 8, 0, {3, 2, 1, 6, 5, 4, 1, 2, 2, 1}));
  expect_cuts_noticed(file(11, 8, 0, {0x82, 5, 0x00, 6}));
  expect_flips_survived(file(9, 8, 0, {3, 2, 1, 6, 5, 4, 0x82, 1, 0, 2}), 500, 11);
  expect_flips_survived(encode_image(random_image(kind(3, 2, 4), 1), "tga"), 500, 12);
}

TEST(Tga, SamplesThatAreTheSamePictureReadTheSame) {
  const auto folder = shared_images() / "tga";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: " << folder << " absent";
  const auto read = [&](const char* name) { return read_image((folder / name).string()); };
  EXPECT_TRUE(same_pixels(read("utc24.tga"), read("ctc24.tga")));
  EXPECT_TRUE(same_pixels(read("utc32.tga"), read("ctc32.tga")));
  EXPECT_TRUE(same_pixels(read("utc24.tga"), read("utc32.tga")));
  EXPECT_TRUE(same_pixels(read("utc16.tga"), read("ctc16.tga")));
  EXPECT_TRUE(same_pixels(read("ucm8.tga"), read("ccm8.tga")));
}

TEST(Tga, SamplesOpenOrAreRefusedForAReason) {
  int files = 0;
  const std::vector<std::string> good = refused_samples("tga", ".tga", files);
  const std::vector<std::string> broken = refused_samples("broken", ".tga", files);
  if (files == 0) GTEST_SKIP() << "skipped: sample images absent";
  EXPECT_EQ(good, std::vector<std::string>{});
  EXPECT_EQ(broken, std::vector<std::string>{"cross_scan_line_truncated.tga"});
}

}  // namespace
}  // namespace azulejo
