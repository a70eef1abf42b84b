#include <webp/encode.h>
#include <webp/mux.h>

#include <gtest/gtest.h>

#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

const WriteOptions kLossless{.lossless = true};

Image decoded(std::span<const std::byte> bytes, const azulejo::Run& run = {}) {
  return read_image(bytes, "test.webp", {}, run);
}

TEST(Webp, LosslessIsExact) {
  for (const int side : {1, 2, 17, 64}) {
    for (const int channels : {3, 4}) {
      const AlphaState alpha = channels == 4 ? AlphaState::Straight : AlphaState::None;
      const Image image = random_image({side, side + 1, channels, PixelType::U8, ColorState::Srgb, alpha}, 3);
      const Image back = decoded(encode_image(image, "webp", kLossless));
      EXPECT_TRUE(same_pixels(image, back)) << side << ' ' << channels;
      EXPECT_EQ(back.info().alpha, alpha);
    }
  }
}

TEST(Webp, GrayComesBackAsEqualColors) {
  const Image image = random_image({9, 5, 1}, 4);
  const Image back = decoded(encode_image(image, "webp", kLossless));
  ASSERT_EQ(back.channels(), 3);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(back.view<std::uint8_t>()(4, 3, c), image.view<std::uint8_t>()(4, 3));
  }
}

TEST(Webp, LossyIsNear) {
  Image image(64, 48, 3);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 3; ++c) image.view<std::uint8_t>()(x, y, c) = static_cast<std::uint8_t>(40 + 2 * x + y);
    }
  }
  // A gray ramp has no colour to subsample; what is left is quantization in steps of a few levels and the
  // rounding of YUV in 16–235, where a level is 255/219.
  EXPECT_LE(largest_difference(image, decoded(encode_image(image, "webp", {.quality = 95}))), 6.0F / 255);
}

TEST(Webp, MetadataComesBack) {
  Image image = random_image({8, 8, 3}, 5);
  Metadata metadata;
  metadata.exif = {'I', 'I', 42, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  metadata.xmp = {'<', 'x', '/', '>'};
  image.set_metadata(metadata);
  for (const bool lossless : {false, true}) {
    EXPECT_EQ(decoded(encode_image(image, "webp", {.lossless = lossless})).metadata(), metadata);
  }
}

TEST(Webp, ACutFileIsNeverSilent) {
  const Image image = random_image({20, 20, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, 6);
  for (const bool lossless : {false, true}) {
    const std::vector<std::byte> whole = encode_image(image, "webp", {.lossless = lossless});
    for (std::size_t size = 12; size < whole.size(); ++size) {
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

TEST(Webp, FlippedBitsGiveAPictureOrAnErrorAndPrintNothing) {
  const std::vector<std::byte> whole =
      encode_image(random_image({32, 32, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}, 8), "webp");
  std::mt19937 random(9);
  ::testing::internal::CaptureStderr();
  for (int i = 0; i < 500; ++i) {
    std::vector<std::byte> bytes = whole;
    bytes[12 + random() % (bytes.size() - 12)] ^= static_cast<std::byte>(1U << random() % 8);
    azulejo::Run run;
    run.limits.pixels = 1 << 20;
    try {
      decoded(bytes, run);
    } catch (const Error&) {
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Webp, OfAnAnimationTheFirstFrameIsRead) {
  const Image frame = random_image({4, 2, 3}, 10);
  const std::vector<std::byte> still = encode_image(frame, "webp", kLossless);
  const WebPData data{reinterpret_cast<const std::uint8_t*>(still.data()), still.size()};
  WebPMux* mux = WebPMuxNew();
  WebPMuxFrameInfo info{};
  info.bitstream = data;
  info.x_offset = 2;
  info.y_offset = 4;
  info.duration = 100;
  info.id = WEBP_CHUNK_ANMF;
  ASSERT_EQ(WebPMuxPushFrame(mux, &info, 1), WEBP_MUX_OK);
  ASSERT_EQ(WebPMuxPushFrame(mux, &info, 1), WEBP_MUX_OK);
  const WebPMuxAnimParams parameters{0, 0};
  ASSERT_EQ(WebPMuxSetAnimationParams(mux, &parameters), WEBP_MUX_OK);
  ASSERT_EQ(WebPMuxSetCanvasSize(mux, 8, 8), WEBP_MUX_OK);
  WebPData animation{};
  ASSERT_EQ(WebPMuxAssemble(mux, &animation), WEBP_MUX_OK);
  Warnings warnings;
  const Image image = decoded(std::as_bytes(std::span(animation.bytes, animation.size)), warnings.run());
  WebPDataClear(&animation);
  WebPMuxDelete(mux);

  EXPECT_EQ(warnings.lines.size(), 1U);
  EXPECT_EQ(image.info(), (ImageInfo{8, 8, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight}));
  const auto pixels = image.view<std::uint8_t>();
  EXPECT_EQ(pixels(0, 0, 3), 0);
  EXPECT_EQ(pixels(2, 4, 3), 255);
  EXPECT_EQ(pixels(5, 5, 1), frame.view<std::uint8_t>()(3, 1, 1));
}

TEST(Webp, LimitsHold) {
  const std::vector<std::byte> bytes = encode_image(random_image({32, 32, 3}, 11), "webp", kLossless);
  azulejo::Run run;
  run.limits.pixels = 32 * 32 - 1;
  EXPECT_EQ(kind_of_error([&] { decoded(bytes, run); }), Error::Resource);
  EXPECT_EQ(kind_of_error([] { encode_image(Image(16384, 1, 3), "webp"); }), Error::Argument);
}

}  // namespace
}  // namespace azulejo
