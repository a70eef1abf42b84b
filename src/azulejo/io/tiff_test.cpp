#include <tiffio.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/io/codec.h"
#include "azulejo/io/io_testing.h"
#include "azulejo/io/tiff.h"
#include "azulejo/io/tiff_file.h"

namespace azulejo {
namespace {

Image decoded(std::span<const std::byte> bytes, const azulejo::Run& run = {}, int page = 0) {
  return read_image(bytes, "test.tif", {.page = page}, run);
}

AlphaState alpha_for(int channels) { return channels % 2 == 0 ? AlphaState::Straight : AlphaState::None; }

/// Makes what azulejo's own encoder doesn't write: strips of given bytes under given tags.
struct Maker {
  unsigned width = 1;
  unsigned height = 1;
  unsigned bits = 8;
  unsigned samples = 1;
  unsigned photometric = PHOTOMETRIC_MINISBLACK;
  unsigned format = SAMPLEFORMAT_UINT;
  unsigned planar = PLANARCONFIG_CONTIG;
  unsigned compression = COMPRESSION_NONE;
  std::vector<std::uint16_t> extra = {};
  std::vector<std::uint16_t> red = {}, green = {}, blue = {};
  unsigned orientation = 1;

  /// A page for each element of `pages`, whose elements are the strips: one, or one a plane.
  std::vector<std::byte> make_pages(const std::vector<std::vector<std::vector<std::uint8_t>>>& pages) const {
    std::vector<std::byte> bytes;
    const auto output = memory_output(bytes, "made");
    TiffFile file(*output, false);
    for (const auto& strips : pages) {
      set_tags(file.handle());
      for (std::size_t i = 0; i < strips.size(); ++i) {
        std::vector<std::uint8_t> strip = strips[i];
        EXPECT_GT(TIFFWriteEncodedStrip(file.handle(), static_cast<std::uint32_t>(i), strip.data(),
                                        static_cast<tmsize_t>(strip.size())),
                  0);
      }
      TIFFWriteDirectory(file.handle());
    }
    TIFFSetDirectory(file.handle(), 0);
    file.close();
    return bytes;
  }
  std::vector<std::byte> make(const std::vector<std::uint8_t>& strip) const { return make_pages({{strip}}); }

 private:
  void set_tags(TIFF* tiff) const {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, planar);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, orientation);
    if (compression == COMPRESSION_JPEG) TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    if (!extra.empty()) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, static_cast<unsigned>(extra.size()), extra.data());
    if (!red.empty()) TIFFSetField(tiff, TIFFTAG_COLORMAP, red.data(), green.data(), blue.data());
  }
};

template <class T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

template <class T>
std::vector<T> values(const Image& image) {
  std::vector<T> result;
  for (int y = 0; y < image.height(); ++y) {
    const T* row = image.view<T>().row(y);
    result.insert(result.end(), row, row + image.width() * image.channels());
  }
  return result;
}

TEST(Tiff, EveryTypeCompressionAndLayoutIsExact) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
    for (const int channels : {1, 2, 3, 4}) {
      for (const char* compression : {"none", "lzw", "deflate", "packbits", "zstd"}) {
        for (const int tile : {0, 16, 32}) {
          const Image image = random_image({67, 35, channels, type, ColorState::Srgb, alpha_for(channels)}, 1);
          const auto bytes = encode_image(image, "tif", {.compression = compression, .tile = tile});
          const Image back = decoded(bytes);
          EXPECT_TRUE(same_pixels(image, back)) << compression << ' ' << tile << ' ' << describe(image.info());
          EXPECT_EQ(back.info(), image.info());
        }
      }
    }
  }
}

TEST(Tiff, SmallAndOddSizesAreExact) {
  for (const int width : {1, 2, 15, 16, 17}) {
    for (const int height : {1, 16, 33}) {
      const Image image = random_image({width, height, 3, PixelType::U16}, 2);
      for (const int tile : {0, 16}) {
        EXPECT_TRUE(same_pixels(image, decoded(encode_image(image, "tif", {.tile = tile})))) << width << "×" << height;
      }
    }
  }
}

TEST(Tiff, BytesDoNotDependOnThreadsOrOnHowRowsAreGiven) {
  const Image image = random_image({300, 200, 3}, 3);
  for (const int tile : {0, 64}) {
    const WriteOptions options{.compression = "deflate", .tile = tile};
    azulejo::Run one;
    one.threads = 1;
    const std::vector<std::byte> expected = encode_image(image, "tif", options, one);
    azulejo::Run many;
    many.threads = 7;
    EXPECT_EQ(encode_image(image, "tif", options, many), expected);
    for (const int step : {1, 7, 64, 150}) {
      std::vector<std::byte> bytes;
      const auto output = memory_output(bytes, "rows");
      const auto encoder = kTiffCodec.encode(*output, image.info(), {}, options, many);
      for (int y = 0; y < 200; y += step) {
        encoder->write(image.any().crop({0, y, 300, std::min(step, 200 - y)}));
      }
      encoder->finish();
      EXPECT_EQ(bytes, expected) << step;
    }
  }
}

TEST(Tiff, RowsComeInAnyPortions) {
  // Large enough for several threads where all of it is asked for.
  const Image image = random_image({400, 300, 3}, 4);
  for (const int tile : {0, 32}) {
    const std::vector<std::byte> bytes = encode_image(image, "tif", {.compression = "lzw", .tile = tile});
    for (const int step : {1, 5, 32, 40, 300}) {
      azulejo::Run run;
      run.threads = 3;
      const auto decoder = kTiffCodec.decode(memory_input(bytes, "rows.tif"), {}, run);
      Image back(image.info());
      for (int y = 0; y < 300; y += step) decoder->read(back.any().crop({0, y, 400, std::min(step, 300 - y)}));
      EXPECT_TRUE(same_pixels(image, back)) << tile << ' ' << step;
    }
  }
}

TEST(Tiff, AHugeCompressedStripIsReadByRows) {
  // One strip of 36 MB, more than is unpacked at once.
  const Maker maker{.width = 6000, .height = 6000, .compression = COMPRESSION_LZW};
  std::vector<std::uint8_t> strip(6000U * 6000U);
  for (std::size_t i = 0; i < strip.size(); ++i) strip[i] = static_cast<std::uint8_t>(i / 6000 + i % 6000);
  const std::vector<std::byte> bytes = maker.make(strip);
  const auto decoder = kTiffCodec.decode(memory_input(bytes, "strip.tif"), {}, {});
  EXPECT_EQ(decoder->row_group(), 1);
  Image image(decoder->header().file.info);
  decoder->read(image.any());
  EXPECT_EQ(values<std::uint8_t>(image), strip);
}

TEST(Tiff, SmallIntegersAreScaledToFullRange) {
  // 12 bits, most significant first: 0, 4095, 2048, 1.
  EXPECT_EQ(values<std::uint16_t>(decoded(Maker{.width = 4, .bits = 12}.make({0x00, 0x0F, 0xFF, 0x80, 0x00, 0x01}))),
            (std::vector<std::uint16_t>{0, 65535, 32776, 16}));
  EXPECT_EQ(values<std::uint8_t>(decoded(Maker{.width = 4, .bits = 2}.make({0b00011011}))),
            (std::vector<std::uint8_t>{0, 85, 170, 255}));
  EXPECT_EQ(values<std::uint8_t>(decoded(Maker{.width = 4, .bits = 1}.make({0b10100000}))),
            (std::vector<std::uint8_t>{255, 0, 255, 0}));
}

TEST(Tiff, ZeroMayBeWhite) {
  const Maker maker{.width = 3, .photometric = PHOTOMETRIC_MINISWHITE};
  EXPECT_EQ(values<std::uint8_t>(decoded(maker.make({0, 1, 255}))), (std::vector<std::uint8_t>{255, 254, 0}));
}

TEST(Tiff, LargeIntegersBecomeFloatsAndSayWhereTheyWereRounded) {
  const Maker maker{.width = 3, .bits = 32};
  Warnings exact;
  const Image halves = decoded(maker.make(bytes_of<std::uint32_t>({0, 1U << 31U, 1})), exact.run());
  EXPECT_EQ(values<float>(halves),
            (std::vector<float>{0.0F, static_cast<float>(2147483648.0 / 4294967295.0), 1 / 4294967295.0F}));
  EXPECT_TRUE(exact.lines.empty());
  Warnings rounded;
  EXPECT_EQ(values<float>(decoded(maker.make(bytes_of<std::uint32_t>({0xFFFFFFFF, 0, 0})), rounded.run()))[0], 1.0F);
  EXPECT_EQ(rounded.lines.size(), 1U);
}

TEST(Tiff, SignedIntegersAndFloatsAreKeptAsTheyAre) {
  const Maker heights{.width = 3, .bits = 16, .format = SAMPLEFORMAT_INT};
  const Image sea = decoded(heights.make(bytes_of<std::int16_t>({-32768, -5, 8848})));
  EXPECT_EQ(values<float>(sea), (std::vector<float>{-32768, -5, 8848}));
  EXPECT_EQ(sea.info().color, ColorState::Data);

  // binary16: 1, −2, the least subnormal, infinity.
  const Maker halves{.width = 4, .bits = 16, .format = SAMPLEFORMAT_IEEEFP};
  EXPECT_EQ(values<float>(decoded(halves.make(bytes_of<std::uint16_t>({0x3C00, 0xC000, 0x0001, 0x7C00})))),
            (std::vector<float>{1, -2, std::ldexp(1.0F, -24), HUGE_VALF}));

  const Maker doubles{.width = 2, .bits = 64, .format = SAMPLEFORMAT_IEEEFP};
  Warnings warnings;
  EXPECT_EQ(values<float>(decoded(doubles.make(bytes_of<double>({0.5, 0.1})), warnings.run())),
            (std::vector<float>{0.5F, 0.1F}));
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST(Tiff, PalettesAreEightBitsWhereThatIsEnough) {
  Maker maker{.width = 4, .bits = 2, .photometric = PHOTOMETRIC_PALETTE};
  maker.red = {0, 0x0100, 0x8000, 0xFF00};
  maker.green = {0xFF00, 0, 0, 0};
  maker.blue = {0, 0, 0, 0x1200};
  const std::vector<std::uint8_t> indices{0b00011011};
  EXPECT_EQ(values<std::uint8_t>(decoded(maker.make(indices))),
            (std::vector<std::uint8_t>{0, 255, 0, 1, 0, 0, 128, 0, 0, 255, 0, 18}));
  maker.red[1] = 0x0123;
  EXPECT_EQ(values<std::uint16_t>(decoded(maker.make(indices)))[3], 0x0123);
}

TEST(Tiff, PlanesAreInterleaved) {
  const Maker maker{.width = 2, .samples = 3, .photometric = PHOTOMETRIC_RGB, .planar = PLANARCONFIG_SEPARATE};
  EXPECT_EQ(values<std::uint8_t>(decoded(maker.make_pages({{{1, 2}, {3, 4}, {5, 6}}}))),
            (std::vector<std::uint8_t>{1, 3, 5, 2, 4, 6}));
}

TEST(Tiff, AlphaKeepsItsKind) {
  Maker maker{.samples = 4, .photometric = PHOTOMETRIC_RGB, .extra = {EXTRASAMPLE_ASSOCALPHA}};
  EXPECT_EQ(decoded(maker.make({1, 2, 3, 4})).info().alpha, AlphaState::Premultiplied);
  maker.extra = {EXTRASAMPLE_UNASSALPHA};
  EXPECT_EQ(decoded(maker.make({1, 2, 3, 4})).info().alpha, AlphaState::Straight);
  maker.extra = {EXTRASAMPLE_UNSPECIFIED};
  Warnings warnings;
  EXPECT_EQ(decoded(maker.make({1, 2, 3, 4}), warnings.run()).info().alpha, AlphaState::Straight);
  EXPECT_EQ(warnings.lines.size(), 1U);
  for (const AlphaState alpha : {AlphaState::Straight, AlphaState::Premultiplied}) {
    const Image image = random_image({5, 5, 4, PixelType::U8, ColorState::Srgb, alpha}, 5);
    EXPECT_EQ(decoded(encode_image(image, "tif")).info(), image.info());
  }
}

TEST(Tiff, MoreSamplesAreLeftOutWithAWarning) {
  const Maker maker{.width = 2, .samples = 5, .photometric = PHOTOMETRIC_RGB, .extra = {0, 0}};
  Warnings warnings;
  const Image image = decoded(maker.make({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), warnings.run());
  EXPECT_EQ(values<std::uint8_t>(image), (std::vector<std::uint8_t>{1, 2, 3, 6, 7, 8}));
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST(Tiff, CmykIsFullInkAt255) {
  const Maker maker{.samples = 4, .photometric = PHOTOMETRIC_SEPARATED};
  const std::vector<std::byte> bytes = maker.make({255, 0, 7, 9});
  const auto decoder = kTiffCodec.decode(memory_input(bytes, "cmyk.tif"), {}, {});
  EXPECT_TRUE(decoder->header().cmyk);
  Image stored(decoder->header().file.info);
  decoder->read(stored.any());
  EXPECT_EQ(values<std::uint8_t>(stored), (std::vector<std::uint8_t>{255, 0, 7, 9}));
  EXPECT_EQ(decoded(bytes).channels(), 3);
}

TEST(Tiff, JpegInsideIsRead) {
  Maker maker{.width = 32, .height = 16, .samples = 3, .photometric = PHOTOMETRIC_YCBCR};
  maker.compression = COMPRESSION_JPEG;
  std::vector<std::uint8_t> strip(32 * 16 * 3);
  for (std::size_t i = 0; i < strip.size(); ++i) strip[i] = static_cast<std::uint8_t>(i / 3 % 32 * 4 + 60);
  const Image image = decoded(maker.make(strip));
  // A gray ramp at the default quality of 75: steps of the lowest coefficients are below 10.
  const std::vector<std::uint8_t> got = values<std::uint8_t>(image);
  for (std::size_t i = 0; i < strip.size(); ++i) ASSERT_NEAR(got[i], strip[i], 10) << i;
}

TEST(Tiff, FaxIsRead) {
  for (const unsigned compression :
       std::initializer_list<unsigned>{COMPRESSION_CCITTFAX3, COMPRESSION_CCITTFAX4, COMPRESSION_CCITTRLE}) {
    Maker maker{.width = 16, .height = 2, .bits = 1, .photometric = PHOTOMETRIC_MINISWHITE};
    maker.compression = compression;
    const Image image = decoded(maker.make({0xF0, 0x0F, 0x00, 0xFF}));
    EXPECT_EQ(image.view<std::uint8_t>()(0, 0), 0);
    EXPECT_EQ(image.view<std::uint8_t>()(4, 0), 255);
    EXPECT_EQ(image.view<std::uint8_t>()(15, 1), 0);
  }
}

TEST(Tiff, PagesAreCountedAndChosen) {
  const std::vector<std::byte> bytes = Maker{}.make_pages({{{10}}, {{20}}, {{30}}});
  EXPECT_EQ(image_file(bytes, "pages.tif").pages, 3);
  for (int page = 0; page < 3; ++page) {
    EXPECT_EQ(values<std::uint8_t>(decoded(bytes, {}, page))[0], 10 * (page + 1));
  }
  EXPECT_EQ(kind_of_error([&] { decoded(bytes, {}, 3); }), Error::Argument);
  EXPECT_EQ(kind_of_error([&] { decoded(bytes, {}, -1); }), Error::Argument);
}

TEST(Tiff, AChainOfPagesThatComesBackToItselfEnds) {
  std::vector<std::byte> bytes = Maker{}.make(std::vector<std::uint8_t>{10});
  const std::uint64_t first = tiff_pages(*memory_input(bytes, "loop.tif")).at(0);
  const auto entries = std::to_integer<std::size_t>(bytes[first]);
  for (std::size_t i = 0; i < 4; ++i) bytes[first + 2 + 12 * entries + i] = static_cast<std::byte>(first >> (8 * i));
  EXPECT_EQ(image_file(bytes, "loop.tif").pages, 1);
}

TEST(Tiff, OrientationIsApplied) {
  const Maker maker{.width = 2, .orientation = 2};
  EXPECT_EQ(values<std::uint8_t>(decoded(maker.make({1, 2}))), (std::vector<std::uint8_t>{2, 1}));
}

TEST(Tiff, MetadataComesBack) {
  Image image = random_image({4, 4, 1}, 6);
  Metadata metadata;
  metadata.density_x = 300 / 0.0254F;
  metadata.density_y = 150 / 0.0254F;
  metadata.xmp = {'<', 'x', '/', '>'};
  metadata.text["ImageDescription"] = "a tile";
  metadata.text["Artist"] = "nobody";
  image.set_metadata(metadata);
  const Image back = decoded(encode_image(image, "tif"));
  EXPECT_NEAR(back.metadata().density_x, metadata.density_x, 0.01F);
  EXPECT_NEAR(back.metadata().density_y, metadata.density_y, 0.01F);
  EXPECT_EQ(back.metadata().xmp, metadata.xmp);
  EXPECT_EQ(back.metadata().text, metadata.text);
}

TEST(Tiff, ACutFileIsNeverSilentAndPrintsNothing) {
  const Image image = random_image({20, 20, 3}, 7);
  ::testing::internal::CaptureStderr();
  for (const char* compression : {"none", "lzw", "deflate"}) {
    const std::vector<std::byte> whole = encode_image(image, "tif", {.compression = compression});
    for (std::size_t size = 8; size < whole.size(); ++size) {
      Warnings warnings;
      try {
        decoded(std::span(whole).first(size), warnings.run());
        EXPECT_FALSE(warnings.lines.empty()) << compression << " cut at byte " << size << " of " << whole.size();
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Data) << error.what();
      }
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Tiff, FlippedBitsGiveAPictureOrAnErrorAndPrintNothing) {
  std::mt19937 random(8);
  azulejo::Run run;
  run.limits.pixels = 1 << 20;
  run.limits.memory_bytes = 1 << 24;
  ::testing::internal::CaptureStderr();
  for (const int tile : {0, 16}) {
    const std::vector<std::byte> whole =
        encode_image(random_image({40, 40, 3}, 9), "tif", {.compression = "lzw", .tile = tile});
    for (int i = 0; i < 1000; ++i) {
      std::vector<std::byte> bytes = whole;
      // Half of the flips hit the directory, at the end.
      const std::size_t from = i % 2 == 0 ? 0 : bytes.size() - 300;
      bytes[from + random() % (bytes.size() - from)] ^= static_cast<std::byte>(1U << random() % 8);
      try {
        decoded(bytes, run);
      } catch (const Error&) {
      }
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Tiff, LimitsHold) {
  const std::vector<std::byte> bytes = encode_image(random_image({64, 64, 3}, 10), "tif", {.tile = 64});
  azulejo::Run pixels;
  pixels.limits.pixels = 64 * 64 - 1;
  EXPECT_EQ(kind_of_error([&] { decoded(bytes, pixels); }), Error::Resource);
  azulejo::Run memory;
  memory.limits.memory_bytes = 64 * 64;
  EXPECT_EQ(kind_of_error([&] { kTiffCodec.decode(memory_input(bytes, "tile.tif"), {}, memory); }), Error::Resource);
}

TEST(Tiff, WrongOptionsAreRefused) {
  const Image image = random_image({8, 8, 1}, 11);
  EXPECT_EQ(kind_of_error([&] { encode_image(image, "tif", {.tile = 17}); }), Error::Argument);
  EXPECT_EQ(kind_of_error([&] { encode_image(image, "tif", {.compression = "zip"}); }), Error::Argument);
  EXPECT_EQ(kind_of_error([&] { encode_image(image, "tif", {.compression_level = 10}); }), Error::Argument);
}

TEST(Tiff, DepthsOfTheSampleSetAgree) {
  const auto folder = shared_images() / "tiff" / "depth";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: the sample images are absent";
  const auto read = [&](const std::string& name) { return read_image((folder / name).string()); };
  for (const std::string kind : {"minisblack", "rgb-contig", "rgb-planar"}) {
    const Image best = read("flower-" + kind + "-32.tif");
    for (const int bits : {8, 10, 12, 14, 16, 24}) {
      // Rounded or cut to so many bits; the files of 24 bits were made of 8.
      const float step = 1.0F / static_cast<float>((1 << (bits == 24 ? 8 : bits)) - 1);
      const std::string name = "flower-" + kind + (bits < 10 ? "-0" : "-") + std::to_string(bits) + ".tif";
      EXPECT_LE(largest_difference(best, read(name)), 1.5F * step) << name;
    }
  }
  for (const std::string bits : {"02", "04", "08", "10", "12", "14", "16", "24", "32"}) {
    EXPECT_TRUE(same_pixels(read("flower-rgb-contig-" + bits + ".tif"), read("flower-rgb-planar-" + bits + ".tif")));
  }
}

}  // namespace
}  // namespace azulejo
