#include <algorithm>
#include <filesystem>
#include <string>

#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

using Bytes = std::vector<std::byte>;

Metadata rich_metadata() {
  Metadata metadata;
  metadata.density_x = 11811;
  metadata.density_y = 5906;
  metadata.exif = {'I', 'I', 42, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const std::string packet = "<x:xmpmeta xmlns:x='adobe:ns:meta/'/>";
  metadata.xmp.assign(packet.begin(), packet.end());
  metadata.text = {{"Comment", "azulejos são belos"}, {"Title", "two words"}};
  return metadata;
}

/// Where the chunk `type` begins (its length), counted from the start of the file.
std::size_t chunk_place(const Bytes& png, const std::string& type) {
  const auto wanted = as_bytes(type);
  const auto found = std::search(png.begin(), png.end(), wanted.begin(), wanted.end());
  EXPECT_NE(found, png.end()) << type;
  return static_cast<std::size_t>(found - png.begin()) - 4;
}

TEST(Png, WhatIsWrittenIsRead) {
  for (const PixelType type : {PixelType::U8, PixelType::U16}) {
    for (const int channels : {1, 2, 3, 4}) {
      const AlphaState alpha = channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
      const Image image = random_image({61, 23, channels, type, ColorState::Srgb, alpha}, 5);
      for (const int level : {0, 3, 9}) {
        const Image back = read_image(encode_image(image, "png", {.compression_level = level}), "a.png");
        EXPECT_EQ(back.info(), image.info());
        EXPECT_TRUE(same_pixels(image, back)) << channels << " channels, level " << level;
      }
    }
  }
}

TEST(Png, MetadataIsKept) {
  Image image = random_image({3, 2, 3}, 1);
  image.set_metadata(rich_metadata());
  EXPECT_EQ(read_image(encode_image(image, "png"), "a.png").metadata(), rich_metadata());
}

TEST(Png, BlocksOfManyRowsHaveTheSameBytesForAnyThreadCount) {
  // More rows than the writer packs at once: noise, and what repeats across the borders of its blocks.
  Image image = random_image({1000, 6000, 1, PixelType::U8, ColorState::Srgb, AlphaState::None}, 3);
  for (int y = 0; y < image.height(); ++y) {
    if (y % 3 != 0) std::fill_n(image.view<std::uint8_t>().row(y), 700, static_cast<std::uint8_t>(y / 100));
  }
  for (const int level : {0, 3}) {
    const WriteOptions options = {.compression_level = level};
    const Bytes one = encode_image(image, "png", options, azulejo::Run{.threads = 1});
    EXPECT_EQ(one, encode_image(image, "png", options, azulejo::Run{.threads = 2}));
    EXPECT_EQ(one, encode_image(image, "png", options, azulejo::Run{.threads = 7}));
    EXPECT_TRUE(same_pixels(read_image(one, "a.png"), image)) << level;
  }
}

TEST(Png, TextsThatCannotBeWrittenAreLeftOut) {
  Image image = random_image({3, 2, 3}, 1);
  Metadata metadata;
  metadata.text = {{"", "a"}, {" ", "b"}, {std::string(80, 'k'), "c"}, {"naïve", "d"}, {"Good", "é"}};
  image.set_metadata(metadata);
  const auto back = read_image(encode_image(image, "png"), "a.png").metadata().text;
  EXPECT_EQ(back, (std::map<std::string, std::string>{{"Good", "é"}}));
}

TEST(Png, MetadataBehindThePixelsIsFound) {
  Image image = random_image({3, 2, 3}, 1);
  image.set_metadata(rich_metadata());
  const Bytes png = encode_image(image, "png");
  const std::size_t pixels = chunk_place(png, "IDAT");
  const std::size_t end = chunk_place(png, "IEND");
  const std::size_t header = 8 + 25;  // signature and IHDR stay first
  const auto part = [&](std::size_t from, std::size_t to) { return std::span(png).subspan(from, to - from); };
  Bytes moved;
  for (const auto piece : {part(0, header), part(pixels, end), part(header, pixels), part(end, png.size())}) {
    moved.insert(moved.end(), piece.begin(), piece.end());
  }
  Warnings warnings;
  const Image back = read_image(moved, "moved.png", {}, warnings.run());
  EXPECT_EQ(back.metadata().exif, rich_metadata().exif);
  EXPECT_EQ(back.metadata().xmp, rich_metadata().xmp);
  EXPECT_EQ(back.metadata().text, rich_metadata().text);
}

TEST(Png, ChecksumsAreChecked) {
  const Bytes png = encode_image(random_image({9, 9, 1}, 1), "png");
  for (const char* chunk : {"IHDR", "sRGB", "IDAT", "IEND"}) {
    Bytes damaged = png;
    const std::size_t at = chunk_place(png, chunk);
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | std::to_integer<std::size_t>(png[at + i]);
    damaged[at + 8 + length] ^= std::byte{1};
    EXPECT_EQ(kind_of_error([&] { read_image(damaged, "damaged.png"); }), Error::Data) << chunk;
  }
}

TEST(Png, ASizeThatCannotBeInTheFileIsRefusedBeforeItIsAllocated) {
  // The header of 60000×60000 gray pixels, its checksum right, before the chunks of a small image.
  const Bytes small = encode_image(random_image({9, 9, 1}, 1), "png");
  const std::string header("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\xEA\x60\0\0\xEA\x60\x08\0\0\0\0\xA5\xB9\x2A\x9E", 33);
  Bytes lie(as_bytes(header).begin(), as_bytes(header).end());
  lie.insert(lie.end(), small.begin() + static_cast<std::ptrdiff_t>(header.size()), small.end());
  EXPECT_EQ(kind_of_error([&] { image_file(lie, "lie.png"); }), Error::Data);
  azulejo::Run limited;
  limited.limits.pixels = 1'000'000;
  EXPECT_EQ(kind_of_error([&] { image_file(lie, "lie.png", {}, limited); }), Error::Resource);
}

TEST(Png, WarningsAndErrorsNameTheFile) {
  const Bytes png = encode_image(random_image({9, 9, 1}, 1), "png");
  try {
    read_image(std::span(png).first(png.size() - 20), "cut.png");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("cut.png: "), 0U) << error.what();
    EXPECT_NE(std::string(error.what()).find("byte"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(Png, WhatTheFormatCannotHold) {
  const Image flow = random_image({4, 4, 2, PixelType::F32, ColorState::Data, AlphaState::None}, 1);
  EXPECT_EQ(kind_of_error([&] { encode_image(flow, "png"); }), Error::Unsupported);
}

TEST(Png, FloatsBecomeSixteenBits) {
  Image image(1, 1, 1, PixelType::F32);
  image.view<float>()(0, 0) = 1.5F;
  Warnings warnings;
  const Image back = read_image(encode_image(image, "png", {}, warnings.run()), "a.png");
  EXPECT_EQ(back.type(), PixelType::U16);
  EXPECT_EQ(back.view<std::uint16_t>()(0, 0), 65535);
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_NE(warnings.lines[0].find("clipped"), std::string::npos);
  EXPECT_EQ(read_image(encode_image(image, "png", {.type = PixelType::U8}), "a.png").type(), PixelType::U8);
}

/// Depths have infinities where nothing is: stretching leaves them white, and there is nothing to warn of.
TEST(Png, StretchedFloatsMayBeInfinite) {
  Image image(3, 1, 1, PixelType::F32);
  image.view<float>()(0, 0) = 2;
  image.view<float>()(1, 0) = 4;
  image.view<float>()(2, 0) = std::numeric_limits<float>::infinity();
  Warnings warnings;
  const Image back = read_image(encode_image(image, "png", {.normalize = true}, warnings.run()), "a.png");
  const ImageView<const std::uint16_t> pixels = std::as_const(back).view<std::uint16_t>();
  EXPECT_EQ(pixels(0, 0), 0);
  EXPECT_EQ(pixels(1, 0), 65535);
  EXPECT_EQ(pixels(2, 0), 65535);
  EXPECT_TRUE(warnings.lines.empty());
}

// ---- PngSuite, by Willem van Schaik ----

class PngSuite : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder())) GTEST_SKIP() << "skipped: " << folder() << " absent";
  }
  static std::filesystem::path folder() { return shared_images() / "png_suite"; }
  static std::string path(const std::string& name) { return (folder() / (name + ".png")).string(); }
  static Image read(const std::string& name) { return read_image(path(name)); }
};

/// Its names say what a file holds: seventh letter and on "0g01": color type 0, gray, one bit.
TEST_F(PngSuite, NamesSayWhatTheFilesHold) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".png" || name == "PngSuite" || name[0] == 'x') continue;
    SCOPED_TRACE(name);
    const int color_type = name[4] - '0';
    const int bits = std::stoi(name.substr(6, 2));
    const bool transparent = name[0] == 't' && !name.starts_with("tp0");
    const ImageFile file = image_file(entry.path().string());
    EXPECT_EQ(file.bits, bits);
    EXPECT_EQ(file.info.type, bits == 16 ? PixelType::U16 : PixelType::U8);
    EXPECT_EQ(file.info.color_channels(), color_type == 0 || color_type == 4 ? 1 : 3);
    const bool alpha = color_type == 4 || color_type == 6 || transparent;
    EXPECT_EQ(file.info.alpha, alpha ? AlphaState::Straight : AlphaState::None);
    EXPECT_EQ(file.encoding.find("interlaced") != std::string::npos, name[3] == 'i');
    EXPECT_EQ(file.streamed, name[3] != 'i');
    const int side = name[0] == 's' && std::isdigit(name[1]) != 0 ? std::stoi(name.substr(1, 2)) : 32;
    const bool narrow = name.starts_with("cdf") || name.starts_with("cds");
    EXPECT_EQ(file.info.width, narrow ? 8 : side);
    ++files;
  }
  EXPECT_GT(files, 150);
}

TEST_F(PngSuite, InterlacedIsTheSameImage) {
  int pairs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    const std::string name = entry.path().stem().string();
    if (name[3] != 'i' || name[0] == 'x') continue;
    std::string plain = name;
    plain[3] = 'n';
    if (!std::filesystem::exists(path(plain))) continue;
    EXPECT_TRUE(same_pixels(read(name), read(plain))) << name;
    ++pairs;
  }
  EXPECT_GE(pairs, 30);
}

TEST_F(PngSuite, EveryOneIsReadOrRefusedAsItsNameSays) {
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() != ".png") continue;
    const std::string file = entry.path().string();
    if (entry.path().filename().string()[0] == 'x') {
      EXPECT_EQ(kind_of_error([&] { read_image(file); }), Error::Data) << file;
    } else {
      Warnings warnings;
      EXPECT_NO_THROW(read_image(file, {}, warnings.run())) << file;
      EXPECT_TRUE(warnings.lines.empty()) << warnings.lines.front();
    }
  }
}

TEST_F(PngSuite, CompressionAndChunkingChangeNothing) {
  for (const char* name : {"z03n2c08", "z06n2c08", "z09n2c08"}) EXPECT_TRUE(same_pixels(read("z00n2c08"), read(name)));
  for (const char* name : {"oi2n0g16", "oi4n0g16", "oi9n0g16"}) EXPECT_TRUE(same_pixels(read("oi1n0g16"), read(name)));
  for (const char* name : {"oi2n2c16", "oi4n2c16", "oi9n2c16"}) EXPECT_TRUE(same_pixels(read("oi1n2c16"), read(name)));
  EXPECT_TRUE(same_pixels(read("oi1n0g16"), read("basn0g16")));
  EXPECT_TRUE(same_pixels(read("oi1n2c16"), read("basn2c16")));
}

/// The part of the gamma pictures above the number that is written into each.
Image top_of(const Image& image) {
  ImageInfo info = image.info();
  info.height = 20;
  Image top(info);
  copy_pixels(image.any().crop(info.rect()), top.any());
  return top;
}

TEST_F(PngSuite, FilesOfDifferentGammaLookTheSame) {
  // g03 … g25: one picture, stored with gamma 0.35 … 2.5. Half a step of 8 linear bits (g10) is 0.5 / 255 · 12.92 =
  // 0.025 in the shadows once encoded; the darkest step of gamma 2.5 is (1 / 255)^0.4 = 0.109 of light, 0.366 encoded.
  for (const char* kind : {"n0g16", "n2c08", "n3p04"}) {
    const Image wanted = top_of(read(std::string("g05") + kind));
    for (const char* gamma : {"g03", "g04", "g07", "g10", "g25"}) {
      const std::string name = std::string(gamma) + kind;
      const bool coarse = name.starts_with("g25");
      EXPECT_LT(largest_difference(top_of(read(name)), wanted), coarse ? 0.366F : 0.03F) << name;
    }
    const Image stored = top_of(read_image(path(std::string("g25") + kind), {.convert_profile = false}));
    EXPECT_GT(largest_difference(stored, wanted), 0.4F) << "as stored it looks different";
  }
}

TEST_F(PngSuite, GrayLevelsFillTheRange) {
  const ReadOptions stored = {.convert_profile = false};
  const Image one = read_image(path("basn0g01"), stored);
  EXPECT_EQ(one.view<std::uint8_t>()(0, 0), 255);
  EXPECT_EQ(one.view<std::uint8_t>()(31, 31), 0);
  // basn0g04: 4×4 blocks of rising levels, 17 apart on the range of 8 bits.
  const Image four = read_image(path("basn0g04"), stored);
  for (int x = 0; x < 32; ++x) EXPECT_EQ(four.view<std::uint8_t>()(x, 0) % 17, 0);
  EXPECT_EQ(four.view<std::uint8_t>()(4, 0), 17);
}

TEST_F(PngSuite, DensityIsInPixelsPerMetre) {
  EXPECT_EQ(image_file(path("cdun2c08")).metadata.density_x, 1000);
  EXPECT_EQ(image_file(path("cdfn2c08")).metadata.density_x, 0) << "a ratio only";
}

TEST_F(PngSuite, TextIsKept) {
  const Metadata metadata = image_file(path("ct1n0g04")).metadata;
  ASSERT_TRUE(metadata.text.contains("Title"));
  EXPECT_EQ(metadata.text.at("Title"), "PngSuite");
  EXPECT_EQ(image_file(path("ctzn0g04")).metadata.text.at("Title"), "PngSuite");
}

}  // namespace
}  // namespace azulejo
