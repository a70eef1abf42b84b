#include <gtest/gtest.h>

#include <map>

#include "azulejo/io/codec_testing.h"

namespace azulejo {
namespace {

/// LZW as GIF has it. The table is cleared when it is full, or never again.
class TestLzw {
 public:
  TestLzw(int literal_bits, bool clears) : literal_bits_(literal_bits), clears_(clears) {
    put(1U << literal_bits);
    reset();
  }

  std::vector<std::byte> encode(const std::vector<int>& pixels) {
    std::vector<int> string;
    for (const int pixel : pixels) {
      string.push_back(pixel);
      if (string.size() == 1 || table_.contains(string)) continue;
      const std::vector<int> known(string.begin(), string.end() - 1);
      put(code(known));
      if (next_ < 4096) {
        table_[string] = next_++;
        // The reader is an entry behind: it knows this one after the next code.
        if (next_ - 1 == 1U << bits_ && bits_ < 12) ++bits_;
      } else if (clears_) {
        put(1U << literal_bits_);
        reset();
      }
      string = {pixel};
    }
    put(code(string));
    put((1U << literal_bits_) + 1);
    if (held_ > 0) bytes_.push_back(static_cast<std::byte>(bit_buffer_));
    return blocks();
  }

 private:
  void reset() {
    table_.clear();
    next_ = (1U << literal_bits_) + 2;
    bits_ = literal_bits_ + 1;
  }
  unsigned code(const std::vector<int>& string) {
    return string.size() == 1 ? static_cast<unsigned>(string[0]) : table_.at(string);
  }
  void put(unsigned value) {
    bit_buffer_ |= value << held_;
    for (held_ += bits_; held_ >= 8; held_ -= 8, bit_buffer_ >>= 8) {
      bytes_.push_back(static_cast<std::byte>(bit_buffer_ & 255));
    }
  }
  std::vector<std::byte> blocks() const {
    std::vector<std::byte> result = bytes_of({literal_bits_});
    for (std::size_t at = 0; at < bytes_.size(); at += 255) {
      const std::size_t size = std::min<std::size_t>(255, bytes_.size() - at);
      result.push_back(static_cast<std::byte>(size));
      result.insert(result.end(), &bytes_[at], &bytes_[at] + size);
    }
    result.push_back(std::byte{0});
    return result;
  }

  int literal_bits_;
  bool clears_;
  int bits_ = literal_bits_ + 1;
  unsigned next_ = 0;
  std::map<std::vector<int>, unsigned> table_;
  unsigned bit_buffer_ = 0;
  int held_ = 0;
  std::vector<std::byte> bytes_;
};

struct TestFrame {
  Rect rect;
  std::vector<int> pixels;
  int transparent = -1;
  bool interlaced = false;
  bool clears = true;
};

/// A palette of 2^bits colours (i, 255 − i, i / 2).
std::vector<std::byte> file(int width, int height, int bits, const std::vector<TestFrame>& frames) {
  std::vector<std::byte> result = bytes_of(
      {'G', 'I', 'F', '8', '9', 'a', width & 255, width >> 8, height & 255, height >> 8, 0x80 | (bits - 1), 0, 0});
  const auto append = [&](const std::vector<std::byte>& more) {
    result.insert(result.end(), more.begin(), more.end());
  };
  for (int i = 0; i < 1 << bits; ++i) append(bytes_of({i, 255 - i, i / 2}));
  for (const TestFrame& frame : frames) {
    if (frame.transparent >= 0) append(bytes_of({0x21, 0xF9, 4, 1, 0, 0, frame.transparent, 0}));
    const Rect& r = frame.rect;
    append(bytes_of({0x2C, r.x & 255, r.x >> 8, r.y & 255, r.y >> 8, r.width & 255, r.width >> 8, r.height & 255,
                     r.height >> 8, frame.interlaced ? 0x40 : 0}));
    append(TestLzw(std::max(bits, 2), frame.clears).encode(frame.pixels));
  }
  append(bytes_of({0x3B}));
  return result;
}

/// Red is the index.
std::vector<int> reds(const Image& image) {
  std::vector<int> result;
  const std::vector<int> values = u8_values(image);
  for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(image.channels()))
    result.push_back(values[i]);
  return result;
}

std::vector<int> random_pixels(std::size_t count, int colors, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> pixels(count);
  for (int& each : pixels) each = static_cast<int>(random() % static_cast<unsigned>(colors));
  return pixels;
}

TEST(Gif, ReadsWhatLzwStores) {
  for (const int bits : {1, 2, 5, 8}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {301, 97}}) {
      for (const bool clears : {true, false}) {
        const std::vector<int> pixels =
            random_pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1 << bits, 5);
        const Image image = read_image(
            file(width, height, bits, {{.rect = {0, 0, width, height}, .pixels = pixels, .clears = clears}}), "x");
        EXPECT_EQ(image.info(), (ImageInfo{width, height, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}));
        EXPECT_EQ(reds(image), pixels) << bits << " bits, " << width << "×" << height << (clears ? "" : ", full table");
      }
    }
  }
}

TEST(Gif, RepeatsUseTheCodeThatIsNotYetKnown) {
  const std::vector<int> pixels(500, 3);
  EXPECT_EQ(reds(read_image(file(50, 10, 2, {{.rect = {0, 0, 50, 10}, .pixels = pixels}}), "x")), pixels);
}

TEST(Gif, InterlacedRowsArePutInOrder) {
  // 10 rows of one pixel come as 0, 8; 4; 2, 6; 1, 3, 5, 7, 9.
  const Image image = read_image(
      file(1, 10, 4, {{.rect = {0, 0, 1, 10}, .pixels = {0, 8, 4, 2, 6, 1, 3, 5, 7, 9}, .interlaced = true}}), "x");
  EXPECT_EQ(reds(image), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(Gif, TransparencyAndWhatTheFrameLeavesFreeIsAlpha) {
  Image image = read_image(file(2, 1, 2, {{.rect = {0, 0, 2, 1}, .pixels = {1, 2}, .transparent = 2}}), "x");
  EXPECT_EQ(u8_values(image), (std::vector<int>{1, 254, 0, 255, 2, 253, 1, 0}));
  EXPECT_EQ(image.info().alpha, AlphaState::Straight);
  image = read_image(file(3, 2, 2, {{.rect = {1, 1, 1, 1}, .pixels = {3}}}), "x");
  EXPECT_EQ(u8_values(image),
            (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 252, 1, 255, 0, 0, 0, 0}));
}

TEST(Gif, LaterFramesAreAWarning) {
  const TestFrame frame{.rect = {0, 0, 1, 1}, .pixels = {1}};
  Warnings warnings;
  EXPECT_EQ(reds(read_image(file(1, 1, 2, {frame, frame, frame}), "x", {}, warnings.run())), std::vector<int>{1});
  EXPECT_EQ(warnings.lines, std::vector<std::string>{"x: the first of 3 frames is read"});
}

TEST(Gif, MissingPixelsAreRefused) {
  EXPECT_EQ(kind_of_error([] {
              read_image(file(2, 2, 2, {{.rect = {0, 0, 2, 2}, .pixels = {1, 2, 3}}}), "x");
            }),
            Error::Data);
}

TEST(Gif, CutsAreNoticed) {
  const std::vector<std::byte> bytes = file(5, 4, 3, {{.rect = {0, 0, 5, 4}, .pixels = random_pixels(20, 8, 1)}});
  expect_cuts_noticed(bytes);
  expect_flips_survived(bytes, 1000, 11);
}

}  // namespace
}  // namespace azulejo
