#include "azulejo/io/shared_images_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

class SharedImages : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(shared_images())) GTEST_SKIP() << "skipped: " << shared_images() << " absent";
  }
  static Image read(const std::string& path) { return read_image((shared_images() / path).string()); }
  /// Root mean square of the differences, in units of full range.
  static double rms(const Image& a, const Image& b) {
    const auto value = [](const Image& image, int y, int i) {
      return visit(image.any(), [&](auto view) { return static_cast<double>(view.row(y)[i]); }) /
             static_cast<double>(full_range(image.type()));
    };
    EXPECT_EQ(a.width(), b.width());
    EXPECT_EQ(a.height(), b.height());
    EXPECT_EQ(a.channels(), b.channels());
    double sum = 0;
    for (int y = 0; y < a.height(); ++y) {
      for (int i = 0; i < a.width() * a.channels(); ++i) sum += std::pow(value(a, y, i) - value(b, y, i), 2);
    }
    return std::sqrt(sum / (static_cast<double>(a.height()) * a.width() * a.channels()));
  }
};

Outcome outcome_of(Error::Kind kind) { return kind == Error::Unsupported ? Outcome::Unsupported : Outcome::Data; }

TEST_F(SharedImages, GiveWhatTheTableSays) {
  for (const SharedImage& wanted : kSharedImages) {
    SCOPED_TRACE(wanted.path);
    const std::string path = (shared_images() / wanted.path).string();
    Warnings warnings;
    try {
      const Image image = read_image(path, {}, warnings.run());
      EXPECT_EQ(image.width(), wanted.width);
      EXPECT_EQ(image.height(), wanted.height);
      EXPECT_EQ(image.channels(), wanted.channels);
      EXPECT_EQ(image.type(), wanted.type);
      EXPECT_EQ(warnings.lines.empty() ? Outcome::Clean : Outcome::Warned, wanted.outcome);
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == Error::Data || error.kind() == Error::Unsupported) << error.what();
      EXPECT_EQ(outcome_of(error.kind()), wanted.outcome) << error.what();
      warnings.lines.emplace_back(error.what());
    }
    for (const std::string& line : warnings.lines) {
      EXPECT_EQ(line.find(path + ": "), 0U) << "names the file: " << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

TEST_F(SharedImages, AreAllInTheTable) {
  std::set<std::string> listed;
  for (const SharedImage& each : kSharedImages) listed.insert(each.path);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_images())) {
    if (!entry.is_regular_file()) continue;
    EXPECT_TRUE(listed.contains(std::filesystem::relative(entry.path(), shared_images()).string())) << entry.path();
  }
}

TEST_F(SharedImages, RowsAreThoseOfTheWhole) {
  for (const SharedImage& each : kSharedImages) {
    if (each.outcome == Outcome::Data || each.outcome == Outcome::Unsupported) continue;
    if (std::int64_t{each.width} * each.height > 1'000'000) continue;  // enough with the small ones
    SCOPED_TRACE(each.path);
    const Image whole = read(each.path);
    const auto source = open_image((shared_images() / each.path).string());
    EXPECT_EQ(source->info(), whole.info());
    EXPECT_EQ(source->metadata(), whole.metadata());
    Image rows(whole.info());
    const auto reader = source->rows({});
    for (int y = 0; y < whole.height(); y += 7) {
      reader->read(y, rows.any().crop({0, y, whole.width(), std::min(7, whole.height() - y)}));
    }
    EXPECT_TRUE(same_pixels(rows, whole));
  }
}

TEST_F(SharedImages, PairsThatAreTheSamePicture) {
  std::vector<std::pair<std::string, std::string>> pairs = {
      {"deep_integer/chessboard_GRAY_U16.tif", "deep_integer/chessboard_GRAY_U16B.tif"},  // byte orders
      {"netpbm/hopper_1bit.pbm", "netpbm/hopper_1bit_plain.pbm"},
      {"netpbm/hopper_8bit.pgm", "netpbm/hopper_8bit_plain.pgm"},
      {"jpeg/flower_q85_420.jpg", "jpeg/flower_q85_420_progr.jpg"},  // the same coefficients in another order
      {"tiff/quad-lzw.tif", "tiff/quad-tile.tif"},
      {"exr/vips_sample.exr", "exr/Rec709_YC.exr"},
      {"tga/utc24.tga", "tga/utc32.tga"},
      {"tga/utc24.tga", "tga/utc16.tga"},
      {"tga/utc24.tga", "tga/ucm8.tga"},
  };
  for (const char* kind : {"bw8", "cm8", "tc16", "tc24", "tc32"}) {  // run lengths and plain
    pairs.emplace_back(std::string("tga/c") + kind + ".tga", std::string("tga/u") + kind + ".tga");
  }
  for (const char* bits : {"02", "04", "08", "10", "12", "14", "16", "24", "32"}) {  // pixels and planes
    const std::string flower = "tiff/depth/flower-rgb-";
    pairs.emplace_back(flower + "contig-" + bits + ".tif", flower + "planar-" + bits + ".tif");
  }
  for (const char* bits : {"08", "16"}) {
    const std::string flower = "tiff/depth/flower-separated-";
    pairs.emplace_back(flower + "contig-" + bits + ".tif", flower + "planar-" + bits + ".tif");
  }
  for (const auto& [a, b] : pairs) EXPECT_TRUE(same_pixels(read(a), read(b))) << a << " " << b;
}

TEST_F(SharedImages, FewerBitsAreTheSamePictureCutShort) {
  // The flower's depths were made by dropping low bits: less than a step of the shallower one apart,
  // and half a step of 16 bits from rounding.
  for (const char* kind : {"minisblack", "rgb-contig"}) {
    const auto flower = [&](int bits) {
      return read(std::string("tiff/depth/flower-") + kind + (bits < 10 ? "-0" : "-") + std::to_string(bits) + ".tif");
    };
    const Image deep = flower(16);
    for (const int bits : {2, 4, 8, 10, 12, 14}) {
      EXPECT_LE(largest_difference(flower(bits), deep), 1.0F / (std::exp2(static_cast<float>(bits)) - 1) + 0.5F / 65535)
          << bits;
    }
    EXPECT_LE(largest_difference(flower(24), deep), 1 / 255.0F) << "8 bits of content";
    EXPECT_LE(largest_difference(flower(32), deep), 1 / 65535.0F) << "16 bits of content";
  }
  EXPECT_EQ(largest_difference(read("netpbm/hopper_16bit.pgm"), read("netpbm/hopper_8bit.pgm")), 0);
  EXPECT_EQ(largest_difference(read("deep_integer/flower_small.rgb.depth8.ppm"),
                               read("deep_integer/flower_small.rgb.depth16.ppm")),
            0);
  EXPECT_LE(largest_difference(read("deep_integer/flower_small.g.depth10.pgm"),
                               read("deep_integer/flower_small.g.depth16.pgm")),
            2.0F / 1023);
}

TEST_F(SharedImages, FloatMapsStandUpright) {
  // hopper.pfm holds 0–255 and was made from the photograph by another path: 5 of 255 apart at most.
  const Image floats = read("pfm/hopper.pfm");
  const Image bytes = read("netpbm/hopper_8bit.pgm");
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      ASSERT_NEAR(floats.view<float>()(x, y), static_cast<float>(bytes.view<std::uint8_t>()(x, y)), 5.01F);
    }
  }
}

TEST_F(SharedImages, LossyCodingStaysNearTheOriginal) {
  // Quality 85 of a photograph: about 41 dB, a root mean square of 0.9 %.
  const Image original = read("deep_integer/flower_small.rgb.depth8.ppm");
  EXPECT_LT(rms(read("jpeg/flower_small_q85_420_non_interleaved.jpg"), original), 0.01);
  EXPECT_LT(rms(read("jpeg/flower_small_q85_444_partially_interleaved.jpg"), original), 0.01);
  EXPECT_LT(rms(read("jpeg/flower_q85_420.jpg"), read("large/flower_foveon.png")), 0.01);
  EXPECT_LT(rms(read("jpeg/hopper_gray.jpg"), read("netpbm/hopper_8bit.pgm")), 0.01);
  EXPECT_LT(rms(read("exr/Rec709_YC.exr"), read("exr/Rec709.exr")), 0.03)
      << "half the colors, brighter than 1 at places";
}

TEST_F(SharedImages, ProfilesLeadToTheSameColors) {
  // One picture in linear Rec. 2020 (16 bits) and in sRGB (8 bits): steps of the 8 bits, and what was out of gamut.
  EXPECT_LT(
      rms(read("deep_integer/Nikon-D300-12bit_2020_g1_dt.png"), read("deep_integer/Nikon-D300-12bit_srgb8_dt.png")),
      0.005);
  const Image stored = read_image((shared_images() / "deep_integer/Nikon-D300-12bit_2020_g1_dt.png").string(),
                                  {.convert_profile = false});
  EXPECT_GT(rms(stored, read("deep_integer/Nikon-D300-12bit_srgb8_dt.png")), 0.05) << "or this test says nothing";
  EXPECT_LT(rms(read("jpeg/pil_sample_cmyk.jpg"), read("jpeg/pil_sample_rgb.jpg")), 0.04) << "CMYK of the same picture";
}

TEST_F(SharedImages, OrientedPhotographsStandUpright) {
  // The four were made from one photograph, each with its number written in the middle.
  const Image first = read("jpeg/Landscape_1.jpg");
  for (const char* other : {"jpeg/Landscape_3.jpg", "jpeg/Landscape_6.jpg", "jpeg/Landscape_8.jpg"}) {
    EXPECT_LT(rms(read(other), first), 0.05) << other;
  }
}

}  // namespace
}  // namespace azulejo
