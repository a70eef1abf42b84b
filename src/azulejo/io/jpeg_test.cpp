#include "azulejo/io/jpeg.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/io/codec.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

/// Waves, as smooth as photographs are at this scale.
Image smooth_image(int width, int height, int channels) {
  Image image(width, height, channels);
  const auto view = image.view<std::uint8_t>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const double wave = std::sin(0.05 * x + c) + std::cos(0.04 * y - c);
        view(x, y, c) = static_cast<std::uint8_t>(std::lround(128 + 55 * wave));
      }
    }
  }
  return image;
}

/// Makes what azulejo's own encoder doesn't write.
struct Maker {
  bool progressive = false;
  bool arithmetic = false;
  unsigned restart = 0;

  std::vector<std::byte> make(const Image& image) const {
    jpeg_compress_struct codec{};
    jpeg_error_mgr errors{};
    codec.err = jpeg_std_error(&errors);
    jpeg_create_compress(&codec);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = static_cast<JDIMENSION>(image.width());
    codec.image_height = static_cast<JDIMENSION>(image.height());
    codec.input_components = image.channels();
    codec.in_color_space = image.channels() == 1 ? JCS_GRAYSCALE : image.channels() == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, 95, TRUE);
    codec.arith_code = arithmetic ? TRUE : FALSE;
    codec.restart_interval = restart;
    if (progressive) jpeg_simple_progression(&codec);
    jpeg_start_compress(&codec, TRUE);
    for (int y = 0; y < image.height(); ++y) {
      auto* row = const_cast<JSAMPROW>(image.view<std::uint8_t>().row(y));
      jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    const auto written = std::as_bytes(std::span(bytes, size));
    std::vector<std::byte> result(written.begin(), written.end());
    jpeg_destroy_compress(&codec);
    std::free(bytes);
    return result;
  }
};

Image decoded(std::span<const std::byte> bytes, const azulejo::Run& run = {}) {
  return read_image(bytes, "test.jpg", {}, run);
}

// At quality q the steps of libjpeg's tables are at most 255·(2 − q/50) for q ≥ 50; a smooth picture has its energy
// in the first few coefficients, whose steps are at most 2 at 98 and 3 at 95: errors of half a step in a few of 64
// coefficients, and of colours that are half as wide where they are subsampled, stay below 5/255.
constexpr float kTolerance = 5.0F / 255;

TEST(Jpeg, SmoothPicturesComeBackWithinTheQuantization) {
  for (const int channels : {1, 3}) {
    for (const int side : {1, 7, 8, 33, 100}) {
      const Image image = smooth_image(side, side + 3, channels);
      const Image back = decoded(encode_image(image, "jpg", {.quality = 98}));
      EXPECT_EQ(back.info(), image.info());
      EXPECT_LE(largest_difference(image, back), kTolerance) << side;
    }
  }
}

TEST(Jpeg, EveryProcessGivesTheSamePicture) {
  const Image image = smooth_image(65, 49, 3);
  for (const bool progressive : {false, true}) {
    for (const bool arithmetic : {false, true}) {
      for (const unsigned restart : {0U, 1U, 5U}) {
        const Maker maker{.progressive = progressive, .arithmetic = arithmetic, .restart = restart};
        const std::vector<std::byte> bytes = maker.make(image);
        EXPECT_LE(largest_difference(image, decoded(bytes)), kTolerance);
        const ImageFile file = image_file(bytes, "test.jpg");
        EXPECT_EQ(file.streamed, !progressive);
        EXPECT_EQ(file.encoding.find("arithmetic") != std::string::npos, arithmetic);
      }
    }
  }
}

TEST(Jpeg, CmykIsFullInkAt255) {
  Image ink(16, 16, 4);
  for (int y = 0; y < 16; ++y) std::memset(ink.any().row(y), 0, ink.info().row_bytes());
  // libjpeg marks its CMYK files as Adobe's, in which 255 is no ink: full ink in all four, then.
  const std::vector<std::byte> bytes = Maker{}.make(ink);
  const auto decoder = kJpegCodec.decode(memory_input(bytes, "cmyk.jpg"), {}, {});
  EXPECT_TRUE(decoder->header().cmyk);
  Image stored(decoder->header().file.info);
  decoder->read(stored.any());
  EXPECT_NEAR(stored.view<std::uint8_t>()(8, 8, 0), 255, 2);
  EXPECT_NEAR(stored.view<std::uint8_t>()(8, 8, 3), 255, 2);
  EXPECT_EQ(decoded(bytes).channels(), 3);
}

TEST(Jpeg, MetadataComesBack) {
  Image image = smooth_image(9, 9, 3);
  Metadata metadata;
  metadata.density_x = 300 / 0.0254F;
  metadata.density_y = 150 / 0.0254F;
  metadata.exif = {'I', 'I', 42, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  metadata.xmp = {'<', 'x', '/', '>'};
  metadata.text["comment"] = "a tile";
  image.set_metadata(metadata);
  const Image back = decoded(encode_image(image, "jpg"));
  EXPECT_NEAR(back.metadata().density_x, metadata.density_x, 0.01F);
  EXPECT_NEAR(back.metadata().density_y, metadata.density_y, 0.01F);
  EXPECT_EQ(back.metadata().exif, metadata.exif);
  EXPECT_EQ(back.metadata().xmp, metadata.xmp);
  EXPECT_EQ(back.metadata().text, metadata.text);
}

TEST(Jpeg, MetadataThatNoMarkerHoldsIsLeftOutWithAWarning) {
  Image image = smooth_image(9, 9, 1);
  Metadata metadata;
  metadata.exif.assign(70000, 0);
  image.set_metadata(metadata);
  Warnings warnings;
  const auto bytes = encode_image(image, "jpg", {}, warnings.run());
  EXPECT_EQ(warnings.lines.size(), 1U);
  EXPECT_TRUE(decoded(bytes).metadata().exif.empty());
}

TEST(Jpeg, ACutFileIsNeverSilent) {
  const Image image = smooth_image(40, 40, 3);
  for (const bool progressive : {false, true}) {
    const std::vector<std::byte> whole = Maker{.progressive = progressive}.make(image);
    for (std::size_t size = 3; size < whole.size(); ++size) {
      Warnings warnings;
      try {
        decoded(std::span(whole).first(size), warnings.run());
        EXPECT_FALSE(warnings.lines.empty()) << "cut at byte " << size;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Data) << error.what();
      }
    }
  }
}

TEST(Jpeg, BytesAfterTheEndAreIgnored) {
  const Image image = smooth_image(20, 20, 3);
  std::vector<std::byte> bytes = encode_image(image, "jpg");
  const Image before = decoded(bytes);
  bytes.resize(bytes.size() + 1000);
  Warnings warnings;
  EXPECT_TRUE(same_pixels(before, decoded(bytes, warnings.run())));
  EXPECT_TRUE(warnings.lines.empty());
}

TEST(Jpeg, DamageIsAnErrorOrAWarningAndPrintsNothing) {
  const std::vector<std::byte> whole = encode_image(smooth_image(64, 64, 3), "jpg");
  std::mt19937 random(7);
  ::testing::internal::CaptureStderr();
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> bytes = whole;
    bytes[2 + random() % (bytes.size() - 2)] ^= static_cast<std::byte>(1U << random() % 8);
    azulejo::Run run;
    run.limits.pixels = 1 << 20;
    try {
      decoded(bytes, run);
    } catch (const Error&) {
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Jpeg, HeadersAreHeldAgainstTheLimits) {
  std::vector<std::byte> bytes = Maker{.progressive = true}.make(smooth_image(64, 64, 3));
  azulejo::Run few_pixels;
  few_pixels.limits.pixels = 64 * 64 - 1;
  EXPECT_EQ(kind_of_error([&] { decoded(bytes, few_pixels); }), Error::Resource);
  azulejo::Run little_memory;
  little_memory.limits.memory_bytes = 64 * 64 * 2;
  EXPECT_EQ(kind_of_error([&] { decoded(bytes, little_memory); }), Error::Resource);
}

TEST(Jpeg, ThousandsOfScansAreRefused) {
  std::vector<std::byte> bytes = Maker{.progressive = true}.make(smooth_image(16, 16, 1));
  const auto is_scan = [&](std::size_t i) { return bytes[i] == std::byte{0xFF} && bytes[i + 1] == std::byte{0xDA}; };
  std::size_t last = bytes.size() - 2;
  while (!is_scan(last)) --last;
  const std::vector<std::byte> scan(bytes.begin() + static_cast<std::ptrdiff_t>(last), bytes.end() - 2);
  bytes.resize(bytes.size() - 2);
  for (int i = 0; i < 2000; ++i) bytes.insert(bytes.end(), scan.begin(), scan.end());
  EXPECT_EQ(kind_of_error([&] { decoded(bytes); }), Error::Data);
}

TEST(Jpeg, WrongOptionsAreRefused) {
  const Image image = smooth_image(8, 8, 1);
  EXPECT_EQ(kind_of_error([&] { encode_image(image, "jpg", {.quality = 0}); }), Error::Argument);
  EXPECT_EQ(kind_of_error([&] { encode_image(image, "jpg", {.quality = 101}); }), Error::Argument);
  EXPECT_EQ(kind_of_error([] { encode_image(Image(65501, 1, 1), "jpg"); }), Error::Argument);
}

TEST(Jpeg, OrientationsOfTheSampleSetGiveOnePicture) {
  const auto folder = shared_images() / "jpeg";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: the sample images are absent";
  // Each was turned and encoded by itself; means over the picture must agree.
  const auto mean = [](const Image& image, int x0, int y0) {
    double sum = 0;
    for (int y = y0; y < y0 + 300; ++y) {
      for (int x = x0; x < x0 + 300; ++x) sum += image.view<std::uint8_t>()(x, y, 1);
    }
    return sum / 90000;
  };
  const Image upright = read_image((folder / "Landscape_1.jpg").string());
  for (const char* name : {"Landscape_3.jpg", "Landscape_6.jpg", "Landscape_8.jpg"}) {
    const Image turned = read_image((folder / name).string());
    ASSERT_EQ(turned.info(), upright.info());
    for (const int x : {0, 700, 1400}) EXPECT_NEAR(mean(turned, x, 100), mean(upright, x, 100), 3) << name;
  }
}

}  // namespace
}  // namespace azulejo
