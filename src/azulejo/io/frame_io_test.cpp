#include "azulejo/io/frame_io.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 37;
constexpr int kHeight = 21;

/// Every value another, some negative, one infinite.
Image data(int channels, ColorState color = ColorState::Data) {
  Image image({kWidth, kHeight, channels, PixelType::F32, color, AlphaState::None});
  const auto view = image.view<float>();
  for (int y = 0; y < kHeight; ++y) {
    for (int i = 0; i < kWidth * channels; ++i) view.row(y)[i] = static_cast<float>(1000 * y + i - 77) * 0.37F;
  }
  view.row(3)[5] = std::numeric_limits<float>::infinity();
  return image;
}

Frame test_frame() {
  Frame frame;
  Image color({kWidth, kHeight, 4, PixelType::U8, ColorState::Srgb, AlphaState::Straight});
  const auto view = color.view<std::uint8_t>();
  for (int y = 0; y < kHeight; ++y) {
    for (int i = 0; i < kWidth * 4; ++i) view.row(y)[i] = static_cast<std::uint8_t>(31 * y + 7 * i);
  }
  frame.layers.push_back({"color", std::move(color)});
  frame.layers.push_back({"depth", data(1)});
  frame.layers.push_back({"normal", data(3)});
  frame.layers.push_back({"position", data(3)});
  frame.layers.push_back({"uv", data(2)});
  frame.layers.push_back({"albedo", data(3, ColorState::Linear)});
  frame.layers.push_back({"object_id", data(1)});
  frame.camera = Json::object().set("fov_y", 0.5).set("depth", "along the view axis");
  return frame;
}

class FrameIo : public testing::TestWithParam<int> {
 protected:
  FrameIo() {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::ranges::replace(name, '/', '-');
    path_ = (fs::path(testing::TempDir()) / ("frame-io-" + name + ".exr")).string();
  }
  ~FrameIo() override { fs::remove(path_); }
  std::string path_;
};

INSTANTIATE_TEST_SUITE_P(LinesAndTiles, FrameIo, testing::Values(0, 16));

TEST_P(FrameIo, EveryLayerIsReadBackByItsName) {
  const Frame frame = test_frame();
  WriteOptions options;
  options.tile = GetParam();
  write_frame(frame, path_, options);
  for (const Frame::Layer& layer : frame.layers) {
    if (layer.name == "color") continue;
    ReadOptions read;
    read.layer = layer.name;
    const Image image = read_image(path_, read);
    ASSERT_EQ(image.info(), layer.image.info()) << layer.name << ": " << describe(image.info());
    const auto got = image.view<float>();
    const auto expected = layer.image.view<float>();
    for (int y = 0; y < kHeight; ++y) {
      for (int i = 0; i < kWidth * image.channels(); ++i) {
        ASSERT_EQ(got.row(y)[i], expected.row(y)[i]) << layer.name << ", row " << y << ", value " << i;
      }
    }
  }
}

TEST_P(FrameIo, TheColorIsTheMainImageLinearAndPremultiplied) {
  const Frame frame = test_frame();
  WriteOptions options;
  options.tile = GetParam();
  write_frame(frame, path_, options);
  const Image image = read_image(path_);
  EXPECT_EQ(image.info(),
            (ImageInfo{kWidth, kHeight, 4, PixelType::F32, ColorState::Linear, AlphaState::Premultiplied}));
  const auto source = frame.layers[0].image.view<std::uint8_t>();
  for (int x = 0; x < kWidth; ++x) {
    const float alpha = static_cast<float>(source(x, 9, 3)) / 255;
    EXPECT_NEAR(image.view<float>()(x, 9, 3), alpha, 1e-6);
    // Within the rounding of a product of two floats below 1, and of the curve's own tolerance.
    EXPECT_NEAR(image.view<float>()(x, 9, 1), srgb_to_linear(static_cast<float>(source(x, 9, 1)) / 255) * alpha, 3e-6);
  }
}

TEST_F(FrameIo, TellsTheLayersAndTheCamera) {
  write_frame(test_frame(), path_);
  const ImageFile file = image_file(path_);
  for (const char* layer : {"depth", "normal", "position", "uv", "albedo", "object_id"}) {
    EXPECT_NE(std::find(file.layers.begin(), file.layers.end(), layer), file.layers.end()) << layer;
  }
  const auto camera = std::find_if(file.metadata.text.begin(), file.metadata.text.end(),
                                   [](const auto& each) { return each.first == "camera"; });
  ASSERT_NE(camera, file.metadata.text.end());
  EXPECT_EQ(Json::parse(camera->second, "camera")["fov_y"].number(), 0.5);
}

TEST_F(FrameIo, AFrameOfOneLayerNeedsNoColor) {
  Frame frame;
  frame.layers.push_back({"depth", data(1)});
  write_frame(frame, path_);
  EXPECT_EQ(read_image(path_).view<float>()(1, 0), frame.layers[0].image.view<float>()(1, 0));
}

TEST_F(FrameIo, RefusesWhatOneFileCannotHold) {
  const auto refused = [&](Frame frame) {
    try {
      write_frame(frame, path_);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Argument);
      EXPECT_FALSE(fs::exists(path_));
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_NE(refused({}).find("without layers"), std::string::npos);
  for (const char* name : {"", "a.b", "color"}) {
    Frame frame = test_frame();
    frame.layers.push_back({name, data(1)});
    EXPECT_NE(refused(std::move(frame)).find("a name of its own without dots"), std::string::npos) << name;
  }
  Frame sizes = test_frame();
  sizes.layers.push_back({"small", Image(3, 3, 1)});
  EXPECT_NE(refused(std::move(sizes)).find("expected 37 × 21"), std::string::npos);
}

TEST_F(FrameIo, LeavesNothingWhereItCannotWrite) {
  EXPECT_THROW(write_frame(test_frame(), "/nowhere/at/all.exr"), Error);
  WriteOptions options;
  options.compression = "lzw";
  EXPECT_THROW(write_frame(test_frame(), path_, options), Error);
  EXPECT_FALSE(fs::exists(path_));
}

}  // namespace
}  // namespace azulejo
