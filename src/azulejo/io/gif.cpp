// Layout and LZW: CompuServe, "Graphics Interchange Format, Version 89a". Decoded here, not by stb: that one takes
// pixels that are missing for transparent ones and gives up on tables that stay full for long.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "azulejo/io/byte_reader.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/decoded_size.h"

namespace azulejo {
namespace {

constexpr std::uint8_t kImageBlock = 0x2C;
constexpr std::uint8_t kExtensionBlock = 0x21;
constexpr std::uint8_t kTrailer = 0x3B;
constexpr std::uint8_t kGraphicControl = 0xF9;
constexpr std::uint8_t kComment = 0xFE;
constexpr std::size_t kLongestComment = 1 << 16;

using Palette = std::vector<std::array<std::uint8_t, 3>>;

bool matches(std::span<const std::byte> head, std::string_view) {
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  return text.starts_with("GIF87a") || text.starts_with("GIF89a");
}

/// Codes of a growing number of bits, from blocks of up to 255 bytes.
class CodeReader {
 public:
  explicit CodeReader(ByteReader& reader) : reader_(reader) {}
  unsigned read(int bits) {
    while (held_ < bits) {
      if (block_left_ == 0) {
        block_left_ = reader_.byte();
        if (block_left_ == 0) throw reader_.error(Error::Data, "the image's data end too early");
      }
      bits_ |= unsigned{reader_.byte()} << held_;
      held_ += 8;
      --block_left_;
    }
    const unsigned code = bits_ & ((1U << bits) - 1);
    bits_ >>= bits;
    held_ -= bits;
    return code;
  }

 private:
  ByteReader& reader_;
  unsigned bits_ = 0;
  int held_ = 0;
  int block_left_ = 0;
};

/// The strings that LZW codes stand for, one pixel at a time through `put`.
class Lzw {
 public:
  Lzw(ByteReader& reader, int literal_bits) : reader_(reader), codes_(reader), literal_bits_(literal_bits) { clear(); }

  /// Calls put(index) for the next `count` pixels; what is left of a string waits for the next call.
  template <class Put>
  void decode(std::size_t count, Put&& put) {
    while (true) {
      for (; !string_.empty() && count > 0; --count, string_.pop_back()) put(string_.back());
      if (count == 0) return;
      const unsigned code = codes_.read(bits_);
      if (code == clear_code()) {
        clear();
        continue;
      }
      if (code == clear_code() + 1)
        throw reader_.error(Error::Data, fmt::format("{} pixels of a row are missing", count));
      expand(code);
    }
  }

 private:
  static constexpr unsigned kMostCodes = 4096;
  static constexpr int kMostBits = 12;
  static constexpr unsigned kNone = kMostCodes;

  unsigned clear_code() const { return 1U << literal_bits_; }
  void clear() {
    next_ = clear_code() + 2;
    bits_ = literal_bits_ + 1;
    last_ = kNone;
  }

  /// The string of a code into string_, reversed, and the table's next entry.
  void expand(unsigned code) {
    if (code > next_ || (last_ == kNone && code >= clear_code())) {
      throw reader_.error(Error::Data, fmt::format("code {} of a table of {}", code, next_));
    }
    string_.clear();
    const bool known = code < next_;
    for (unsigned at = known ? code : last_;; at = prefix_[at]) {
      string_.push_back(at < clear_code() ? static_cast<std::uint8_t>(at) : suffix_[at]);
      if (at < clear_code()) break;
    }
    const std::uint8_t first = string_.back();
    if (!known) string_.insert(string_.begin(), first);
    if (last_ != kNone && next_ < kMostCodes) {
      prefix_[next_] = static_cast<std::uint16_t>(last_);
      suffix_[next_] = first;
      ++next_;
      if (next_ == 1U << bits_ && bits_ < kMostBits) ++bits_;
    }
    last_ = code;
  }

  ByteReader& reader_;
  CodeReader codes_;
  int literal_bits_;
  int bits_ = 0;
  unsigned next_ = 0;
  unsigned last_ = kNone;
  std::array<std::uint16_t, kMostCodes> prefix_{};
  std::array<std::uint8_t, kMostCodes> suffix_{};
  std::vector<std::uint8_t> string_;
};

/// Rows of a frame in the order of the file.
std::vector<int> row_order(int height, bool interlaced) {
  std::vector<int> order;
  order.reserve(static_cast<std::size_t>(height));
  if (!interlaced) {
    for (int y = 0; y < height; ++y) order.push_back(y);
    return order;
  }
  constexpr std::array<std::pair<int, int>, 4> kPasses{{{0, 8}, {4, 8}, {2, 4}, {1, 2}}};
  for (const auto& [start, step] : kPasses) {
    for (int y = start; y < height; y += step) order.push_back(y);
  }
  return order;
}

class GifDecoder : public Decoder {
 public:
  GifDecoder(std::shared_ptr<const Input> input, const Run& run);
  bool streams() const override { return false; }
  void read(const AnyView& rows) override;

 private:
  void find_first_frame(const Run& run);
  void read_extension();
  void read_frame_header(const Run& run);
  void skip_blocks();
  int count_frames(const Run& run);
  void describe(int frames);
  Palette read_palette(unsigned flags);
  void put_pixel(unsigned index, std::uint8_t* result) const;

  ByteReader reader_;
  int width_ = 0;
  int height_ = 0;
  Rect frame_;
  Palette palette_;
  int transparent_ = -1;
  bool interlaced_ = false;
  std::uint64_t data_at_ = 0;
};

GifDecoder::GifDecoder(std::shared_ptr<const Input> input, const Run& run) : reader_(std::move(input)) {
  std::array<std::byte, 6> magic{};
  reader_.read(magic);
  if (!matches(magic, "")) throw reader_.error(Error::Data, "no \"GIF89a\" at the start");
  width_ = reader_.le16();
  height_ = reader_.le16();
  const unsigned flags = reader_.byte();
  reader_.skip(2);
  palette_ = read_palette(flags);
  find_first_frame(run);
  const int frames = count_frames(run);
  if (frames > 1) warn(run, fmt::format("{}: the first of {} frames is read", reader_.name(), frames));
  describe(frames);
}

Palette GifDecoder::read_palette(unsigned flags) {
  Palette palette;
  if ((flags & 0x80) == 0) return palette;
  palette.resize(std::size_t{2} << (flags & 7));
  for (auto& color : palette) reader_.read(std::span(color));
  return palette;
}

void GifDecoder::skip_blocks() {
  while (const std::uint8_t size = reader_.byte()) reader_.skip(size);
}

void GifDecoder::find_first_frame(const Run& run) {
  while (true) {
    const std::uint8_t block = reader_.byte();
    if (block == kImageBlock) {
      read_frame_header(run);
      return;
    }
    if (block != kExtensionBlock) throw reader_.error(Error::Data, fmt::format("block {:#x} before an image", block));
    read_extension();
  }
}

void GifDecoder::read_extension() {
  const std::uint8_t kind = reader_.byte();
  if (kind == kGraphicControl) {
    const std::uint8_t size = reader_.byte();
    if (size != 4) throw reader_.error(Error::Data, fmt::format("a graphic control of {} bytes, not 4", size));
    const unsigned flags = reader_.byte();
    reader_.skip(2);
    const std::uint8_t index = reader_.byte();
    transparent_ = (flags & 1) != 0 ? index : -1;
  } else if (kind == kComment) {
    std::string& comment = header_.file.metadata.text["Comment"];
    while (const std::uint8_t size = reader_.byte()) {
      std::string part(size, ' ');
      reader_.read(std::as_writable_bytes(std::span(part)));
      if (comment.size() < kLongestComment) comment += part;
    }
    return;
  }
  skip_blocks();
}

/// The canvas holds the logical screen and the frame, which some files put outside of it.
void GifDecoder::read_frame_header(const Run& run) {
  frame_.x = reader_.le16();
  frame_.y = reader_.le16();
  frame_.width = reader_.le16();
  frame_.height = reader_.le16();
  if (frame_.empty()) throw reader_.error(Error::Data, "an empty image");
  const unsigned flags = reader_.byte();
  interlaced_ = (flags & 0x40) != 0;
  if (Palette local = read_palette(flags); !local.empty()) palette_ = std::move(local);
  if (palette_.empty()) throw reader_.error(Error::Data, "no palette");
  if (frame_.right() > width_ || frame_.bottom() > height_) {
    warn(run, fmt::format("{}: the image reaches out of its screen of {}×{}", reader_.name(), width_, height_));
    width_ = std::max(width_, frame_.right());
    height_ = std::max(height_, frame_.bottom());
  }
  check_decoded_size(reader_.name(), static_cast<std::uint64_t>(width_), static_cast<std::uint64_t>(height_), run);
  data_at_ = reader_.position();
}

/// Walks to the end of the file. What is wrong after the first frame is a warning only.
int GifDecoder::count_frames(const Run& run) {
  int frames = 1;
  reader_.skip(1);
  skip_blocks();
  try {
    for (std::uint8_t block = reader_.byte(); block != kTrailer; block = reader_.byte()) {
      if (block == kImageBlock) {
        ++frames;
        reader_.skip(8);
        read_palette(reader_.byte());
      } else if (block != kExtensionBlock) {
        throw reader_.error(Error::Data, fmt::format("block {:#x} after an image", block));
      }
      reader_.skip(1);
      skip_blocks();
    }
  } catch (const Error& problem) {
    if (problem.kind() != Error::Data) throw;
    warn(run, problem.what());
  }
  return frames;
}

void GifDecoder::describe(int frames) {
  const bool gray = std::all_of(palette_.begin(), palette_.end(),
                                [](const auto& color) { return color[0] == color[1] && color[1] == color[2]; });
  const bool alpha = transparent_ >= 0 || frame_.width < width_ || frame_.height < height_;
  ImageFile& file = header_.file;
  file.format = "gif";
  file.info = {width_,        height_,          (gray ? 1 : 3) + (alpha ? 1 : 0),
               PixelType::U8, ColorState::Srgb, alpha ? AlphaState::Straight : AlphaState::None};
  file.stored_width = width_;
  file.stored_height = height_;
  file.encoding = fmt::format("palette of {}{}{}", palette_.size(), interlaced_ ? ", interlaced" : "",
                              frames > 1 ? fmt::format(", {} frames", frames) : "");
}

void GifDecoder::put_pixel(unsigned index, std::uint8_t* result) const {
  const ImageInfo& info = header_.file.info;
  const bool transparent = static_cast<int>(index) == transparent_;
  if (index >= palette_.size() && !transparent) {
    throw reader_.error(Error::Data, fmt::format("colour {} of a palette of {}", index, palette_.size()));
  }
  if (index < palette_.size()) std::copy_n(palette_[index].begin(), info.color_channels(), result);
  if (info.alpha != AlphaState::None) result[info.color_channels()] = transparent ? 0 : 255;
}

void GifDecoder::read(const AnyView& rows) {
  const ImageView<std::uint8_t> image = rows.as<std::uint8_t>();
  for (int y = 0; y < image.height; ++y) std::fill_n(image.row(y), rows.info.row_bytes(), std::uint8_t{0});
  reader_.seek(data_at_);
  const int literal_bits = reader_.byte();
  if (literal_bits < 2 || literal_bits > 8) {
    throw reader_.error(Error::Data, fmt::format("codes of {} bits, 2 to 8 expected", literal_bits));
  }
  const std::vector<int> order = row_order(frame_.height, interlaced_);
  Lzw lzw(reader_, literal_bits);
  const ImageView<std::uint8_t> frame = image.crop(frame_);
  for (const int y : order) {
    std::uint8_t* pixel = frame.row(y);
    lzw.decode(static_cast<std::size_t>(frame_.width), [&](unsigned index) {
      put_pixel(index, pixel);
      pixel += frame.channels;
    });
  }
}

std::unique_ptr<Decoder> decode(std::shared_ptr<const Input> input, const ReadOptions&, const Run& run) {
  return std::make_unique<GifDecoder>(std::move(input), run);
}

}  // namespace

extern const Codec kGifCodec;
const Codec kGifCodec{"gif", {"gif"}, matches, decode, nullptr, nullptr};

}  // namespace azulejo
