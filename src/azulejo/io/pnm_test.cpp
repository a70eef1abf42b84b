#include <string>

#include <gtest/gtest.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

Image read_text(const std::string& text) { return read_image(as_bytes(text), "text.pnm"); }

template <class T>
std::vector<int> values(const Image& image) {
  std::vector<int> result;
  for (int y = 0; y < image.height(); ++y) {
    const T* const row = image.view<T>().row(y);
    result.insert(result.end(), row, row + image.width() * image.channels());
  }
  return result;
}

TEST(Pnm, PlainGrayIsScaledToFullRange) {
  const Image image = read_text("P2 # a comment\n# another\n3 2\n15\n0 1 2\n\t13 14 15\n");
  EXPECT_EQ(image.info(), (ImageInfo{3, 2, 1, PixelType::U8, ColorState::Srgb, AlphaState::None}));
  EXPECT_EQ(values<std::uint8_t>(image), (std::vector<int>{0, 17, 34, 221, 238, 255}));
}

TEST(Pnm, TheLastPlainNumberMayEndWithTheFile) {
  EXPECT_EQ(values<std::uint8_t>(read_text("P2 2 1 255 12 34")), (std::vector<int>{12, 34}));
  EXPECT_EQ(kind_of_error([] { read_text("P2 3 1 255 12 34"); }), Error::Data);
}

TEST(Pnm, BitsAreBlack) {
  EXPECT_EQ(values<std::uint8_t>(read_text("P1 3 1 101")), (std::vector<int>{0, 255, 0}));
  EXPECT_EQ(values<std::uint8_t>(read_text(std::string("P4 10 1\n\x80\x40", 10))),
            (std::vector<int>{0, 255, 255, 255, 255, 255, 255, 255, 255, 0}));
}

TEST(Pnm, SixteenBitsHaveTheHighByteFirst) {
  const std::string text("P5 2 1 65535\n\x01\x02\xFF\xFE", 17);
  EXPECT_EQ(values<std::uint16_t>(read_text(text)), (std::vector<int>{0x0102, 0xFFFE}));
  // 10 bits: 1023 is full range, 341 a third of it.
  const std::string deep("P5 2 1 1023\n\x03\xFF\x01\x55", 16);
  EXPECT_EQ(values<std::uint16_t>(read_text(deep)), (std::vector<int>{65535, 21845}));
}

TEST(Pnm, SamplesAboveTheMaximumAreRefused) {
  EXPECT_EQ(kind_of_error([] { read_text("P5 1 1 100\n\x65"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("P2 1 1 100 101"); }), Error::Data);
}

TEST(Pnm, PamSaysItsAlpha) {
  const std::string text = "P7\n# c\nWIDTH 1\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\nabcd";
  const Image image = read_text(text);
  EXPECT_EQ(image.info(), (ImageInfo{1, 1, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}));
  EXPECT_EQ(values<std::uint8_t>(image), (std::vector<int>{'a', 'b', 'c', 'd'}));
}

TEST(Pnm, FloatsGoFromTheBottomUpInEitherByteOrder) {
  const std::string big("Pf 1 2 1.0\n\x3F\x80\x00\x00\x40\x00\x00\x00", 19);  // 1, above it 2
  const std::string little("Pf 1 2 -1.0\n\x00\x00\x80\x3F\x00\x00\x00\x40", 20);
  for (const std::string& text : {big, little}) {
    const Image image = read_text(text);
    EXPECT_EQ(image.info().color, ColorState::Linear);
    EXPECT_EQ(image.view<float>()(0, 0), 2);
    EXPECT_EQ(image.view<float>()(0, 1), 1);
  }
}

TEST(Pnm, HeadersThatLieAreRefusedBeforeAnythingIsAllocated) {
  EXPECT_EQ(kind_of_error([] { read_text("P5 100000 100000 255\nabc"); }), Error::Resource);
  EXPECT_EQ(kind_of_error([] { read_text("P5 30000 30000 255\nabc"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("P5 0 10 255\nabc"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("P5 10 -1 255\nabc"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("P5 1 1 70000\nabc"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("P5 99999999999999999999 1 255\nabc"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("Pf 1 1 0\nabcd"); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_text("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 7\nMAXVAL 255\nENDHDR\nabcdefg"); }),
            Error::Unsupported);
}

TEST(Pnm, WhatIsWrittenIsRead) {
  struct Case {
    const char* format;
    int channels;
    PixelType type;
  };
  const Case cases[] = {{"pgm", 1, PixelType::U8},  {"pgm", 1, PixelType::U16}, {"ppm", 3, PixelType::U8},
                        {"ppm", 3, PixelType::U16}, {"pam", 1, PixelType::U8},  {"pam", 2, PixelType::U16},
                        {"pam", 3, PixelType::U16}, {"pam", 4, PixelType::U8},  {"pfm", 1, PixelType::F32},
                        {"pfm", 3, PixelType::F32}};
  for (const Case& each : cases) {
    const AlphaState alpha = each.channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
    const ColorState color = each.type == PixelType::F32 ? ColorState::Linear : ColorState::Srgb;
    const Image image = random_image({37, 41, each.channels, each.type, color, alpha}, 3);
    const Image back = read_image(encode_image(image, each.format), each.format);
    EXPECT_EQ(back.info(), image.info()) << each.format;
    EXPECT_TRUE(same_pixels(image, back)) << each.format;
  }
}

}  // namespace
}  // namespace azulejo
