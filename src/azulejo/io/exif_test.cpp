#include "azulejo/io/exif.h"

#include <gtest/gtest.h>

namespace azulejo {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A directory with orientation 6, 300 dots per inch across and 118 a unit down.
Bytes little_endian_block(std::uint8_t unit) {
  return {'I',  'I',  42, 0, 8, 0, 0, 0, 4,    0,        //
          0x12, 0x01, 3,  0, 1, 0, 0, 0, 6,    0, 0, 0,  // orientation
          0x1A, 0x01, 5,  0, 1, 0, 0, 0, 62,   0, 0, 0,  // x resolution, at 62
          0x1B, 0x01, 5,  0, 1, 0, 0, 0, 70,   0, 0, 0,  // y resolution, at 70
          0x28, 0x01, 3,  0, 1, 0, 0, 0, unit, 0, 0, 0,  // unit
          0,    0,    0,  0,                             //
          0x2C, 0x01, 0,  0, 1, 0, 0, 0, 118,  0, 0, 0, 1, 0, 0, 0};
}

TEST(Exif, ReadsOrientationAndDensityInInches) {
  const ExifSummary summary = parse_exif(little_endian_block(2));
  EXPECT_EQ(summary.orientation, 6);
  EXPECT_NEAR(summary.density_x, 300 / 0.0254F, 0.01F);
  EXPECT_NEAR(summary.density_y, 118 / 0.0254F, 0.01F);
}

TEST(Exif, ReadsDensityInCentimetres) {
  EXPECT_FLOAT_EQ(parse_exif(little_endian_block(3)).density_y, 11800);
  EXPECT_EQ(parse_exif(little_endian_block(1)).density_x, 0) << "without a unit only the ratio is said";
}

TEST(Exif, ReadsBigEndian) {
  const Bytes block = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 0x01, 0x12, 0, 3, 0, 0, 0, 1, 0, 8, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(parse_exif(block).orientation, 8);
  Bytes reset = block;
  reset_exif_orientation(reset);
  EXPECT_EQ(parse_exif(reset).orientation, 1);
}

TEST(Exif, ResettingTouchesNothingElse) {
  Bytes block = little_endian_block(2);
  const Bytes before = block;
  reset_exif_orientation(block);
  EXPECT_EQ(parse_exif(block).orientation, 1);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < block.size(); ++i) changed += block[i] != before[i] ? 1 : 0;
  EXPECT_EQ(changed, 1U);
}

TEST(Exif, OrientationOutOfRangeIsNone) {
  Bytes block = little_endian_block(2);
  block[18] = 9;
  EXPECT_EQ(parse_exif(block).orientation, 1);
}

TEST(Exif, AnyBytesAreAllowed) {
  const Bytes whole = little_endian_block(2);
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut));
    parse_exif(part);
    reset_exif_orientation(part);
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes flipped = whole;
      flipped[i] = static_cast<std::uint8_t>(flipped[i] ^ (1U << bit));
      parse_exif(flipped);
      reset_exif_orientation(flipped);
    }
  }
}

}  // namespace
}  // namespace azulejo
