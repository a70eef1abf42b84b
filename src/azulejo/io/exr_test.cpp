#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "azulejo/io/codec_testing.h"
#include "azulejo/io/exr_stream.h"

namespace azulejo {
namespace {

ImageInfo kind(int width, int height, int channels, ColorState color = ColorState::Linear) {
  return {width,    height,
          channels, PixelType::F32,
          color,    color == ColorState::Linear && channels % 2 == 0 ? AlphaState::Premultiplied : AlphaState::None};
}

/// A file as OpenEXR itself writes it.
std::vector<std::byte> file_by(const std::function<void(Imf::OStream&)>& write) {
  std::vector<std::byte> bytes;
  const auto output = memory_output(bytes, "test.exr");
  ExrOutputStream stream(*output);
  write(stream);
  return bytes;
}

/// A value for each place and channel.
float value(int x, int y, std::size_t channel) {
  return static_cast<float>(x + 10 * y) + 1000 * static_cast<float>(channel);
}

/// A frame buffer over `values`, one float a pixel and channel, filled with value().
Imf::FrameBuffer frame_buffer(const Imf::Header& header, std::vector<std::vector<float>>& values) {
  const Imath::Box2i& window = header.dataWindow();
  const int width = window.max.x - window.min.x + 1;
  Imf::FrameBuffer buffer;
  values.clear();
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
    std::vector<float>& plane = values.emplace_back();
    for (int y = window.min.y; y <= window.max.y; ++y) {
      for (int x = window.min.x; x <= window.max.x; ++x) plane.push_back(value(x, y, values.size() - 1));
    }
    char* base = reinterpret_cast<char*>(plane.data() - (window.min.x + std::ptrdiff_t{width} * window.min.y));
    buffer.insert(at.name(), Imf::Slice(Imf::FLOAT, base, 4, 4 * static_cast<std::size_t>(width)));
  }
  return buffer;
}

std::vector<std::byte> scan_lines(const Imf::Header& header) {
  return file_by([&](Imf::OStream& stream) {
    std::vector<std::vector<float>> values;
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame_buffer(header, values));
    file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
  });
}

Imf::Header header_with(int width, int height, const std::vector<const char*>& channels) {
  Imf::Header header(width, height);
  for (const char* each : channels) header.channels().insert(each, Imf::Channel(Imf::FLOAT));
  return header;
}

/// Channel of the image equals value(x, y, channel of the file) everywhere.
void expect_values(const Image& image, int channel, std::size_t of_file) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      ASSERT_EQ(image.view<float>()(x, y, channel), value(x, y, of_file)) << x << ", " << y << ", " << channel;
    }
  }
}

TEST(Exr, RoundTripsAreExact) {
  for (const int tile : {0, 16}) {
    for (const char* compression : {"", "none", "rle", "zip", "piz"}) {
      for (int channels = 1; channels <= 4; ++channels) {
        for (const auto& [width, height] : {std::pair{1, 1}, {17, 3}, {5, 70}}) {
          for (const ColorState color : {ColorState::Linear, ColorState::Data}) {
            const Image image = random_image(kind(width, height, channels, color), 3);
            const auto bytes = encode_image(image, "exr", {.compression = compression, .tile = tile, .type = {}});
            const Image back = read_image(bytes, "back.exr");
            EXPECT_EQ(back.info(), image.info());
            EXPECT_TRUE(same_pixels(back, image)) << compression << ' ' << tile << ' ' << describe(image.info());
          }
        }
      }
    }
  }
}

TEST(Exr, HalfRoundsToElevenBits) {
  const Image image = random_image(kind(33, 9, 3), 3);
  const auto bytes = encode_image(image, "exr", {.compression = {}, .type = PixelType::U16});
  const Image back = read_image(bytes, "back.exr");
  EXPECT_EQ(image_file(bytes, "back.exr").bits, 16);
  // Values below 1 have steps of at most 2^-11: rounding moves them by half of that.
  EXPECT_LE(largest_difference(image, back), std::ldexp(1.0F, -12));
  EXPECT_GT(largest_difference(image, back), 0);
}

TEST(Exr, HalfWarnsOfOverflow) {
  Image image(kind(1, 1, 1));
  image.view<float>()(0, 0) = 1e6F;
  Warnings warnings;
  encode_image(image, "exr", {.compression = {}, .type = PixelType::U8}, warnings.run());
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST(Exr, SpecialValuesAreKept) {
  Image image(kind(4, 1, 1));
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<float> values{infinite, -infinite, -0.5F, 1e-42F};
  std::copy(values.begin(), values.end(), image.view<float>().row(0));
  EXPECT_TRUE(same_pixels(read_image(encode_image(image, "exr"), "x"), image));
}

TEST(Exr, DensityAndTextAreKept) {
  Image image = random_image(kind(2, 2, 3), 7);
  image.set_metadata({.density_x = 4000, .density_y = 2000, .exif = {}, .xmp = {}, .text = {{"comments", "tiles"}}});
  const Image back = read_image(encode_image(image, "exr"), "x");
  EXPECT_NEAR(back.metadata().density_x, 4000, 0.01F);
  EXPECT_NEAR(back.metadata().density_y, 2000, 0.01F);
  EXPECT_EQ(back.metadata().text, image.metadata().text);
}

TEST(Exr, LayersAreChosenByName) {
  // Sorted by OpenEXR: A, B, G, R, Z, diffuse.B, diffuse.G, diffuse.R, normal.X, normal.Y, normal.Z.
  const auto bytes = scan_lines(header_with(
      5, 4, {"R", "G", "B", "A", "Z", "diffuse.R", "diffuse.G", "diffuse.B", "normal.X", "normal.Y", "normal.Z"}));
  const auto read = [&](const char* layer) { return read_image(bytes, "x", {.layer = layer}); };
  const Image main = read("");
  EXPECT_EQ(main.info(), kind(5, 4, 4));
  expect_values(main, 0, 3);
  expect_values(main, 3, 0);
  const Image diffuse = read("diffuse");
  EXPECT_EQ(diffuse.info(), kind(5, 4, 3));
  expect_values(diffuse, 0, 7);
  const Image normal = read("normal");
  EXPECT_EQ(normal.info(), kind(5, 4, 3, ColorState::Data));
  expect_values(normal, 2, 10);
  const Image depth = read("Z");
  EXPECT_EQ(depth.info(), kind(5, 4, 1, ColorState::Data));
  expect_values(depth, 0, 4);
  EXPECT_EQ(kind_of_error([&] { read("specular"); }), Error::Argument);
  EXPECT_EQ(image_file(bytes, "x").layers, (std::vector<std::string>{"diffuse", "normal", "Z"}));
}

TEST(Exr, TheOnlyLayerIsTheImage) {
  Warnings warnings;
  Image image = read_image(scan_lines(header_with(2, 2, {"only.R", "only.G", "only.B"})), "x", {}, warnings.run());
  EXPECT_EQ(image.info(), kind(2, 2, 3));
  EXPECT_TRUE(warnings.lines.empty());
  image = read_image(scan_lines(header_with(2, 2, {"a.Y", "b.Y"})), "x", {}, warnings.run());
  EXPECT_EQ(image.info(), kind(2, 2, 1));
  EXPECT_EQ(warnings.lines.size(), 1U);
}

TEST(Exr, PartsAreLayers) {
  const auto bytes = file_by([](Imf::OStream& stream) {
    std::vector<Imf::Header> headers;
    for (const char* name : {"beauty", "depth"}) {
      headers.push_back(header_with(3, 2, {headers.empty() ? "Y" : "Z"}));
      headers.back().setName(name);
      headers.back().setType(Imf::SCANLINEIMAGE);
    }
    Imf::MultiPartOutputFile file(stream, headers.data(), 2, false, 0);
    for (int part = 0; part < 2; ++part) {
      std::vector<std::vector<float>> values;
      Imf::OutputPart output(file, part);
      output.setFrameBuffer(frame_buffer(headers[static_cast<std::size_t>(part)], values));
      output.writePixels(2);
    }
  });
  EXPECT_EQ(image_file(bytes, "x").layers, (std::vector<std::string>{"beauty", "depth"}));
  EXPECT_EQ(read_image(bytes, "x").info(), kind(3, 2, 1));
  const Image depth = read_image(bytes, "x", {.layer = "depth"});
  EXPECT_EQ(depth.info(), kind(3, 2, 1, ColorState::Data));
  expect_values(depth, 0, 0);
}

TEST(Exr, TheImageIsTheDisplayWindow) {
  for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
    Imf::Header header = header_with(6, 5, {"Y"});
    header.dataWindow() = {{-2, 1}, {3, 7}};
    header.lineOrder() = order;
    const auto bytes = file_by([&](Imf::OStream& stream) {
      std::vector<std::vector<float>> values;
      Imf::OutputFile file(stream, header, 0);
      file.setFrameBuffer(frame_buffer(header, values));
      file.writePixels(7);
    });
    const Image image = read_image(bytes, "x");
    ASSERT_EQ(image.info(), kind(6, 5, 1));
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 6; ++x) {
        EXPECT_EQ(image.view<float>()(x, y), x <= 3 && y >= 1 ? value(x, y, 0) : 0) << x << ", " << y;
      }
    }
  }
}

TEST(Exr, TilesOfAllLevelsAndOrders) {
  for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y}) {
      Imf::Header header = header_with(37, 21, {"R", "G", "B"});
      header.setTileDescription(Imf::TileDescription(16, 8, mode));
      header.lineOrder() = order;
      const auto bytes = file_by([&](Imf::OStream& stream) {
        std::vector<std::vector<float>> values;
        Imf::TiledOutputFile file(stream, header, 0);
        file.setFrameBuffer(frame_buffer(header, values));
        for (int level_y = 0; level_y < file.numYLevels(); ++level_y) {
          for (int level_x = 0; level_x < file.numXLevels(); ++level_x) {
            if (!file.isValidLevel(level_x, level_y)) continue;
            file.writeTiles(0, file.numXTiles(level_x) - 1, 0, file.numYTiles(level_y) - 1, level_x, level_y);
          }
        }
      });
      const Image image = read_image(bytes, "x");
      ASSERT_EQ(image.info(), kind(37, 21, 3));
      for (int channel = 0; channel < 3; ++channel)
        expect_values(image, channel, static_cast<std::size_t>(2 - channel));
    }
  }
}

TEST(Exr, IntegersThatFloatsCannotHoldAreAWarning) {
  for (const unsigned number : {16777215U, 16777217U}) {
    const auto bytes = file_by([&](Imf::OStream& stream) {
      Imf::Header header(1, 1);
      header.channels().insert("id", Imf::Channel(Imf::UINT));
      unsigned pixel = number;
      Imf::FrameBuffer buffer;
      buffer.insert("id", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(&pixel), 4, 4));
      Imf::OutputFile file(stream, header, 0);
      file.setFrameBuffer(buffer);
      file.writePixels(1);
    });
    Warnings warnings;
    const Image image = read_image(bytes, "x", {}, warnings.run());
    EXPECT_EQ(image.view<float>()(0, 0), static_cast<float>(number));
    EXPECT_EQ(warnings.lines.size(), number == 16777215U ? 0U : 1U);
  }
}

std::vector<std::byte> rgba_file(const Imf::Header& header, Imf::RgbaChannels channels, const Imf::Rgba& color) {
  return file_by([&](Imf::OStream& stream) {
    const int width = header.dataWindow().max.x + 1;
    const int height = header.dataWindow().max.y + 1;
    const std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(width * height), color);
    Imf::RgbaOutputFile file(stream, header, channels, 0);
    file.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(width));
    file.writePixels(height);
  });
}

TEST(Exr, LuminanceAndChromaBecomeRgb) {
  for (const bool alpha : {false, true}) {
    const auto bytes =
        rgba_file(Imf::Header(10, 8), alpha ? Imf::WRITE_YCA : Imf::WRITE_YC, {0.5F, 0.25F, 0.75F, 0.5F});
    const Image image = read_image(bytes, "x");
    ASSERT_EQ(image.info(), kind(10, 8, alpha ? 4 : 3));
    for (int y = 0; y < 8; ++y) {
      // Y, RY and BY are halves of their own, chroma kept to few bits: 1/128 of the value.
      EXPECT_NEAR(image.view<float>()(4, y, 0), 0.5F, 0.5F / 128);
      EXPECT_NEAR(image.view<float>()(4, y, 1), 0.25F, 0.5F / 128);
      EXPECT_NEAR(image.view<float>()(4, y, 2), 0.75F, 0.75F / 128);
    }
  }
}

TEST(Exr, OtherPrimariesBecomeRec709) {
  // Rec. 2020, whose white is the same D65. Its red in Rec. 709 (ITU-R BT.2087, inverted): 1.6605, −0.1246, −0.0182.
  Imf::Header header(2, 2);
  Imf::addChromaticities(header, {{0.708F, 0.292F}, {0.170F, 0.797F}, {0.131F, 0.046F}, {0.3127F, 0.3290F}});
  const auto bytes = rgba_file(header, Imf::WRITE_RGB, {1, 0, 0, 1});
  Warnings warnings;
  const Image image = read_image(bytes, "x", {}, warnings.run());
  EXPECT_NEAR(image.view<float>()(1, 1, 0), 1.6605F, 1e-3F);
  EXPECT_NEAR(image.view<float>()(1, 1, 1), -0.1246F, 1e-3F);
  EXPECT_NEAR(image.view<float>()(1, 1, 2), -0.0182F, 1e-3F);
  EXPECT_EQ(warnings.lines.size(), 1U);
  EXPECT_EQ(read_image(bytes, "x", {.layer = {}, .convert_profile = false}).view<float>()(1, 1, 0), 1);
}

TEST(Exr, WhiteStaysWhiteUnderAnotherWhitePoint) {
  Imf::Header header(1, 1);
  Imf::addChromaticities(header, {{0.64F, 0.33F}, {0.30F, 0.60F}, {0.15F, 0.06F}, {0.3457F, 0.3585F}});  // D50
  const Image image = read_image(rgba_file(header, Imf::WRITE_RGB, {1, 1, 1, 1}), "x");
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(image.view<float>()(0, 0, i), 1, 1e-5F);
}

TEST(Exr, CutsAreNoticed) {
  for (const int tile : {0, 2}) {
    const auto bytes =
        encode_image(random_image(kind(3, 4, 3), 1), "exr", {.compression = {}, .tile = tile, .type = {}});
    expect_cuts_noticed(bytes);
    expect_flips_survived(bytes, 1000, 11);
  }
}

TEST(Exr, SizesAreCheckedBeforeMemoryIsTaken) {
  azulejo::Run run;
  run.limits.pixels = 1000;
  const auto bytes = scan_lines(header_with(40, 40, {"Y"}));
  EXPECT_EQ(kind_of_error([&] { read_image(bytes, "x", {}, run); }), Error::Resource);
  Imf::Header header = header_with(4, 4, {"Y"});
  header.setTileDescription(Imf::TileDescription(8192, 8192, Imf::ONE_LEVEL));
  const auto tiled = file_by([&](Imf::OStream& stream) {
    std::vector<std::vector<float>> values;
    Imf::TiledOutputFile file(stream, header, 0);
    file.setFrameBuffer(frame_buffer(header, values));
    file.writeTile(0, 0);
  });
  run.limits.memory_bytes = 1 << 20;
  EXPECT_EQ(kind_of_error([&] { read_image(tiled, "x", {}, run); }), Error::Resource);
}

TEST(Exr, SamplesOpenOrAreRefusedForAReason) {
  int files = 0;
  const std::vector<std::string> good = refused_samples("exr", ".exr", files);
  refused_samples("broken/exr", ".exr", files);
  if (files == 0) GTEST_SKIP() << "skipped: sample images absent";
  EXPECT_EQ(good, std::vector<std::string>{});
}

}  // namespace
}  // namespace azulejo
