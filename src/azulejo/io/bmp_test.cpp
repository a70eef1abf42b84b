#include <gtest/gtest.h>

#include "azulejo/io/codec_testing.h"

namespace azulejo {
namespace {

ImageInfo kind(int width, int height, int channels) {
  return {width,         height,           channels,
          PixelType::U8, ColorState::Srgb, channels == 4 ? AlphaState::Straight : AlphaState::None};
}

/// A 40-byte header and a palette of black, gray, white and red before `pixels`.
std::vector<std::byte> palette_file(int width, int height, int bits, int compression,
                                    std::initializer_list<int> pixels) {
  const int at = 14 + 40 + 16;
  std::vector<std::byte> file = bytes_of({'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, at, 0, 0, 0, 40, 0, 0, 0});
  const auto put = [&](int value, int bytes) {
    for (int i = 0; i < bytes; ++i) file.push_back(static_cast<std::byte>(value >> (8 * i)));
  };
  put(width, 4);
  put(height, 4);
  put(1, 2);
  put(bits, 2);
  put(compression, 4);
  put(0, 4);
  put(2835, 4);
  put(5670, 4);
  put(4, 4);
  put(0, 4);
  for (const int color : {0x000000, 0x808080, 0xFFFFFF, 0xFF0000}) put(color, 4);
  for (const int each : pixels) put(each, 1);
  return file;
}

/// Palette indices of an image of palette_file.
std::vector<int> indices(const Image& image) {
  std::vector<int> result;
  const std::vector<int> values = u8_values(image);
  const auto step = static_cast<std::size_t>(image.channels());
  for (std::size_t i = 0; i < values.size(); i += step) {
    result.push_back(values[i] == 0 ? 0 : values[i] == 128 ? 1 : values[i + 1] == 255 ? 2 : 3);
  }
  return result;
}

TEST(Bmp, RoundTripsAreExact) {
  for (const int channels : {1, 3, 4}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {3, 2}, {5, 131}}) {
      const Image image = random_image(kind(width, height, channels), 7);
      const Image back = read_image(encode_image(image, "bmp"), "back.bmp");
      EXPECT_EQ(back.info(), image.info());
      EXPECT_TRUE(same_pixels(back, image)) << describe(image.info());
    }
  }
}

TEST(Bmp, DensityIsKept) {
  Image image = random_image(kind(2, 2, 3), 7);
  image.set_metadata({.density_x = 2835, .density_y = 5670, .exif = {}, .xmp = {}, .text = {}});
  const Image back = read_image(encode_image(image, "bmp"), "back.bmp");
  EXPECT_EQ(back.metadata().density_x, 2835);
  EXPECT_EQ(back.metadata().density_y, 5670);
}

TEST(Bmp, PalettesOfAllDepths) {
  // Two rows of padding to 4 bytes, the lower one first.
  EXPECT_EQ(indices(read_image(palette_file(3, 2, 1, 0, {0xA0, 0, 0, 0, 0x60, 0, 0, 0}), "1")),
            (std::vector<int>{0, 1, 1, 1, 0, 1}));
  EXPECT_EQ(indices(read_image(palette_file(3, 2, 2, 0, {0x1B, 0, 0, 0, 0xE4, 0, 0, 0}), "2")),
            (std::vector<int>{3, 2, 1, 0, 1, 2}));
  EXPECT_EQ(indices(read_image(palette_file(3, 1, 4, 0, {0x12, 0x30, 0, 0}), "4")), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(indices(read_image(palette_file(3, -2, 8, 0, {1, 2, 3, 0, 3, 2, 1, 0}), "8")),
            (std::vector<int>{1, 2, 3, 3, 2, 1}));
}

TEST(Bmp, AColorOutsideOfThePaletteIsRefused) {
  EXPECT_EQ(kind_of_error([] { read_image(palette_file(1, 1, 8, 0, {4, 0, 0, 0}), "x"); }), Error::Data);
}

TEST(Bmp, RunLengths) {
  // Three of colour 1; end of line; absolute 3, 2, 1 with padding; end.
  EXPECT_EQ(indices(read_image(palette_file(3, 2, 8, 1, {3, 1, 0, 0, 0, 3, 3, 2, 1, 0, 0, 1}), "8")),
            (std::vector<int>{3, 2, 1, 1, 1, 1}));
  // 4 bits: a run alternates its two colours; delta by (1, 1); what is skipped has colour 0.
  EXPECT_EQ(indices(read_image(palette_file(4, 2, 4, 2, {3, 0x12, 0, 2, 0, 1, 1, 0x30, 0, 1}), "4")),
            (std::vector<int>{0, 0, 0, 3, 1, 2, 1, 0}));
  EXPECT_EQ(indices(read_image(palette_file(5, 1, 4, 2, {0, 5, 0x12, 0x31, 0x20, 0, 0, 1}), "4")),
            (std::vector<int>{1, 2, 3, 1, 2}));
  // A run of 4 bits may fill the last byte of an odd row.
  EXPECT_EQ(indices(read_image(palette_file(3, 1, 4, 2, {4, 0x12, 0, 1}), "4")), (std::vector<int>{1, 2, 1}));
}

TEST(Bmp, RunsBeyondTheImageAreRefused) {
  EXPECT_EQ(kind_of_error([] { read_image(palette_file(3, 1, 8, 1, {4, 1, 0, 1}), "x"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_image(palette_file(3, 1, 8, 1, {0, 2, 0, 1, 1, 1, 0, 1}), "x"); }), Error::Data);
}

TEST(Bmp, CutsAreNoticed) {
  // The last row's padding may be missing.
  expect_cuts_noticed(encode_image(random_image(kind(3, 2, 3), 1), "bmp"), {}, 3);
  expect_cuts_noticed(encode_image(random_image(kind(3, 2, 4), 1), "bmp"));
  expect_cuts_noticed(palette_file(3, 2, 8, 1, {3, 1, 0, 0, 0, 3, 3, 2, 1, 0, 0, 1}));
  expect_flips_survived(palette_file(3, 2, 8, 1, {3, 1, 0, 0, 0, 3, 3, 2, 1, 0, 0, 1}), 500, 11);
  expect_flips_survived(encode_image(random_image(kind(3, 2, 4), 1), "bmp"), 500, 12);
}

TEST(Bmp, SamplesThatAreTheSamePictureReadTheSame) {
  const auto folder = shared_images() / "bmp";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: " << folder << " absent";
  const auto read = [&](const char* name) { return read_image((folder / name).string()); };
  EXPECT_TRUE(same_pixels(read("g04.bmp"), read("g04rle.bmp")));
  EXPECT_TRUE(same_pixels(read("g24.bmp"), read("g32def.bmp")));
  EXPECT_TRUE(same_pixels(read("g24.bmp"), read("g32bf.bmp")));
  EXPECT_TRUE(same_pixels(read("g16def555.bmp"), read("g16bf555.bmp")));
  for (const char* name : {"g08rle.bmp", "g08offs.bmp", "g08os2.bmp", "g08p256.bmp", "g08s0.bmp"}) {
    EXPECT_TRUE(same_pixels(read("g08.bmp"), read(name))) << name;
  }
}

TEST(Bmp, SamplesOpenOrAreRefusedForAReason) {
  int files = 0;
  const std::vector<std::string> good = refused_samples("bmp", ".bmp", files);
  const std::vector<std::string> broken = refused_samples("broken/bmp", ".bmp", files);
  if (files == 0) GTEST_SKIP() << "skipped: sample images absent";
  EXPECT_EQ(good, std::vector<std::string>{});
  EXPECT_EQ(broken,
            (std::vector<std::string>{"badbitcount.bmp", "badpalettesize.bmp", "badrle.bmp", "pal8badindex.bmp"}));
}

}  // namespace
}  // namespace azulejo
