// Every reader against cut and flipped files: any bytes give a value or an Error, and what is missing is said.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/io_testing.h"

namespace azulejo {
namespace {

using Bytes = std::vector<std::byte>;

struct Sample {
  std::string name;
  Bytes bytes;
};

constexpr std::size_t kPlaces = 500;  ///< of cuts in files too large for all, and of flips

Image small_image(int channels, PixelType type) {
  const AlphaState alpha = channels % 2 == 0 ? AlphaState::Straight : AlphaState::None;
  return random_image({11, 9, channels, type, ColorState::Srgb, alpha}, 9);
}

Sample written(const std::string& format, const Image& image, const WriteOptions& options = {}) {
  return {format + " " + options.compression + (options.tile > 0 ? " tiles" : "") + " " + describe(image.info()),
          encode_image(image, format, options)};
}

/// A tiny file of each format that is written, in the forms whose decoding differs.
std::vector<Sample> written_samples() {
  std::vector<Sample> samples;
  for (const char* format : {"png", "jpg", "tif", "exr", "ppm", "pgm", "pam", "pfm", "hdr", "webp", "bmp", "tga"}) {
    samples.push_back(written(format, small_image(3, PixelType::U8)));
  }
  for (const char* format : {"png", "tif", "webp", "tga", "exr"})
    samples.push_back(written(format, small_image(4, PixelType::U8)));
  for (const char* format : {"png", "tif", "pam"}) samples.push_back(written(format, small_image(2, PixelType::U16)));
  samples.push_back(written("jpg", small_image(1, PixelType::U8)));
  samples.push_back(written("webp", small_image(3, PixelType::U8), {.lossless = true}));
  for (const char* compression : {"none", "lzw", "packbits", "zstd"}) {
    samples.push_back(written("tif", small_image(3, PixelType::U16), {.compression = compression}));
  }
  samples.push_back(written("tif", small_image(3, PixelType::F32), {.tile = 16}));
  for (const char* compression : {"none", "piz", "rle"}) {
    samples.push_back(written("exr", small_image(3, PixelType::F32), {.compression = compression}));
  }
  samples.push_back(written("exr", small_image(3, PixelType::F32), {.tile = 16}));
  return samples;
}

/// What azulejo doesn't write: other forms, and pictures with more to them.
std::vector<Sample> shared_samples() {
  std::vector<Sample> samples;
  for (const char* name : {"png_suite/basi6a16.png",
                           "png_suite/tbbn3p08.png",
                           "png_suite/basn0g01.png",
                           "png_suite/s07i3p02.png",
                           "png_suite/ctzn0g04.png",
                           "png_suite/cs5n3p08.png",
                           "jpeg/pil_sample_cmyk.jpg",
                           "jpeg/exif_gps.jpg",
                           "jpeg/testorig_rot270_420_fastdct_q75_prog_rst100.jpg",
                           "jpeg/testorig_transpose_440_q90_ari_rst1.jpg",
                           "jpeg/testorig_vflip_410_q10_baseline.jpg",
                           "tiff/jello.tif",
                           "tiff/depth/flower-palette-04.tif",
                           "tiff/depth/flower-rgb-planar-10.tif",
                           "tiff/zackthecat.tif",
                           "exr/t01.exr",
                           "hdr_env/rgbr4x4.hdr",
                           "hdr_env/old-rle.hdr",
                           "bmp/g04rle.bmp",
                           "bmp/g08rle.bmp",
                           "bmp/g01bg.bmp",
                           "tga/ctc24.tga",
                           "tga/ccm8.tga",
                           "netpbm/hopper_1bit.pbm",
                           "netpbm/hopper_1bit_plain.pbm",
                           "netpbm/hopper_8bit_plain.pgm"}) {
    std::ifstream file(shared_images() / name, std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(file)), {});
    const auto bytes = as_bytes(content);
    if (file) samples.push_back({name, Bytes(bytes.begin(), bytes.end())});
  }
  return samples;
}

/// What came of reading damaged bytes.
struct Attempt {
  Image image;  ///< empty: an Error
  bool warned = false;
};

Attempt attempt(std::span<const std::byte> bytes, const std::string& name) {
  Attempt result;
  azulejo::Run run;
  run.limits.pixels = std::int64_t{1} << 22;
  run.limits.memory_bytes = std::int64_t{1} << 28;
  run.limits.temporary_bytes = std::int64_t{1} << 28;
  run.warn = [&](const std::string& line) {
    result.warned = true;
    EXPECT_EQ(line.find('\n'), std::string::npos) << name << ": " << line;
  };
  try {
    result.image = read_image(bytes, name, {}, run);
  } catch (const Error& error) {
    EXPECT_NE(error.kind(), Error::Cancelled) << name;
    EXPECT_NE(error.kind(), Error::Argument) << name << ": the caller did nothing wrong: " << error.what();
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.find(name), 0U) << "names the file: " << line;
  } catch (const std::exception& other) {
    ADD_FAILURE() << name << ": not an Error: " << other.what();
  }
  return result;
}

/// A cut file gives the whole picture, or says that it doesn't.
void expect_honest_cuts(const Sample& sample) {
  SCOPED_TRACE(sample.name);
  const Attempt whole = attempt(sample.bytes, sample.name);
  ASSERT_FALSE(whole.image.empty()) << "the sample itself";
  const std::size_t size = sample.bytes.size();
  const std::size_t cuts = std::min(size, size < 4096 ? size : kPlaces);
  for (std::size_t i = 0; i < cuts; ++i) {
    const std::size_t length = size * i / cuts;
    const Attempt cut = attempt(std::span(sample.bytes).first(length), sample.name);
    if (cut.image.empty() || cut.warned) continue;
    ASSERT_TRUE(same_pixels(cut.image, whole.image)) << "silently, after " << length << " of " << size << " bytes";
  }
}

void survive_flips(const Sample& sample, unsigned seed) {
  SCOPED_TRACE(sample.name + ", seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    Bytes bytes = sample.bytes;
    // Half of the flips go to the first bytes, where headers are.
    const std::size_t reach = i % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 256);
    for (std::size_t flips = 1 + random() % 3; flips > 0; --flips) {
      bytes[random() % reach] ^= static_cast<std::byte>(1U << (random() % 8));
    }
    attempt(bytes, sample.name);
  }
}

TEST(Corruption, CutFilesAreNeverASilentSuccess) {
  for (const Sample& sample : written_samples()) expect_honest_cuts(sample);
}

TEST(Corruption, FlippedBitsGiveAValueOrAnError) {
  unsigned seed = 1;
  for (const Sample& sample : written_samples()) survive_flips(sample, seed++);
}

TEST(Corruption, CutSharedSamples) {
  const std::vector<Sample> samples = shared_samples();
  if (samples.empty()) GTEST_SKIP() << "skipped: " << shared_images() << " absent";
  for (const Sample& sample : samples) expect_honest_cuts(sample);
}

TEST(Corruption, FlippedSharedSamples) {
  const std::vector<Sample> samples = shared_samples();
  if (samples.empty()) GTEST_SKIP() << "skipped: " << shared_images() << " absent";
  unsigned seed = 1000;
  for (const Sample& sample : samples) survive_flips(sample, seed++);
}

}  // namespace
}  // namespace azulejo
