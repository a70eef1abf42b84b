// Layouts: Microsoft, "Bitmap Storage" and "Bitmap Header Types"; IBM, "OS/2 Presentation Manager Bitmap Formats".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cstring>
#include <utility>

#include "azulejo/io/bmp.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/decoded_size.h"

namespace azulejo {
namespace {

enum Compression : std::uint32_t { Plain = 0, Rle8 = 1, Rle4 = 2, Masks = 3, MasksWithAlpha = 6 };

constexpr std::size_t kFileHeader = 14;
constexpr std::size_t kCoreHeader = 12;     // OS/2 1.x: 16-bit sizes, palette of 3 bytes
constexpr std::size_t kOs2Header = 64;      // its compressions 3 and 4 mean something else
constexpr std::size_t kWindowsHeader = 40;  // masks follow it; later headers contain them
constexpr std::size_t kLargestHeader = 124;
constexpr std::uint32_t kEmbeddedProfile = 0x4D424544;  // "MBED"
constexpr std::uint64_t kLargestProfile = std::uint64_t{64} << 20;

/// One colour's bits in a 16- or 32-bit pixel.
struct Field {
  std::uint32_t mask = 0;
  int shift = 0;
  std::uint32_t most = 0;

  std::uint8_t value(std::uint32_t pixel) const {
    if (most == 0) return 0;
    return static_cast<std::uint8_t>((std::uint64_t{(pixel & mask) >> shift} * 255 + most / 2) / most);
  }
};

/// The fields of all headers, those that a header lacks 0.
struct BmpHeader {
  std::size_t size = 0;
  std::uint64_t pixels_at = 0;
  std::int64_t width = 0;
  std::int64_t height = 0;  ///< positive: stored from the bottom
  int bits = 0;
  std::uint32_t compression = Plain;
  std::uint32_t density_x = 0;
  std::uint32_t density_y = 0;
  std::uint32_t colors = 0;
  std::array<Field, 4> fields{};  ///< red, green, blue, alpha
  std::uint64_t profile_at = 0;   ///< 0: none
  std::uint64_t profile_bytes = 0;
};

std::uint32_t number(const std::array<std::uint8_t, kLargestHeader>& bytes, std::size_t at, std::size_t size = 4) {
  std::uint32_t result = 0;
  for (std::size_t i = 0; i < size; ++i) result |= std::uint32_t{bytes[at + i]} << (8 * i);
  return result;
}

Field make_field(const ByteReader& reader, std::uint32_t mask, int bits) {
  if (mask == 0) return {};
  const int shift = std::countr_zero(mask);
  const std::uint32_t most = mask >> shift;
  if ((most & (most + 1)) != 0 || (bits < 32 && mask >> bits != 0)) {
    throw reader.error(Error::Data, fmt::format("mask {:#x} of a {}-bit pixel is not one run of its bits", mask, bits));
  }
  return {mask, shift, most};
}

/// Masks stand after the 40 bytes of the first Windows header, or in the header where it is longer.
void read_fields(ByteReader& reader, BmpHeader& header, const std::array<std::uint8_t, kLargestHeader>& bytes) {
  std::array<std::uint32_t, 4> masks{0xFF0000, 0xFF00, 0xFF, 0};
  if (header.bits == 16) masks = {0x7C00, 0x3E0, 0x1F, 0};
  const bool alpha = header.compression == MasksWithAlpha || header.size >= kWindowsHeader + 16;
  if (header.compression == Masks || header.compression == MasksWithAlpha) {
    for (std::size_t i = 0; i < (alpha ? 4 : 3); ++i) {
      masks[i] = header.size > kWindowsHeader ? number(bytes, kWindowsHeader + 4 * i) : reader.le32();
    }
  }
  for (std::size_t i = 0; i < masks.size(); ++i) header.fields[i] = make_field(reader, masks[i], header.bits);
}

void check_layout(const ByteReader& reader, const BmpHeader& header) {
  const int bits = header.bits;
  if (bits != 1 && bits != 2 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32) {
    throw reader.error(Error::Data, fmt::format("{} bits a pixel; 1, 2, 4, 8, 16, 24 or 32 expected", bits));
  }
  const std::uint32_t kind = header.compression;
  const bool masks = kind == Masks || kind == MasksWithAlpha;
  if ((kind != Plain && kind != Rle8 && kind != Rle4 && !masks) || (header.size == kOs2Header && masks)) {
    throw reader.error(Error::Unsupported, fmt::format("compression {}", kind));
  }
  if ((kind == Rle8 && bits != 8) || (kind == Rle4 && bits != 4) || (masks && bits != 16 && bits != 32)) {
    throw reader.error(Error::Data, fmt::format("compression {} of {} bits a pixel", kind, bits));
  }
}

/// Leaves the reader at the palette.
BmpHeader read_header(ByteReader& reader) {
  BmpHeader header;
  if (reader.byte() != 'B' || reader.byte() != 'M') throw reader.error(Error::Data, "no \"BM\" at the start");
  reader.seek(10);
  header.pixels_at = reader.le32();
  header.size = reader.le32();
  if (header.size != kCoreHeader && (header.size < 16 || header.size > kLargestHeader)) {
    throw reader.error(Error::Unsupported, fmt::format("a header of {} bytes", header.size));
  }
  std::array<std::uint8_t, kLargestHeader> bytes{};
  reader.seek(kFileHeader);
  reader.read(std::span(bytes).first(header.size));
  const bool core = header.size == kCoreHeader;
  header.width = core ? std::int64_t{number(bytes, 4, 2)} : static_cast<std::int32_t>(number(bytes, 4));
  header.height = core ? std::int64_t{number(bytes, 6, 2)} : static_cast<std::int32_t>(number(bytes, 8));
  header.bits = static_cast<int>(number(bytes, core ? 10 : 14, 2));
  if (!core) {
    header.compression = number(bytes, 16);
    header.density_x = number(bytes, 24);
    header.density_y = number(bytes, 28);
    header.colors = number(bytes, 32);
  }
  check_layout(reader, header);
  if (header.bits == 16 || header.bits == 32) read_fields(reader, header, bytes);
  if (header.size == kLargestHeader && number(bytes, 56) == kEmbeddedProfile) {
    header.profile_at = kFileHeader + number(bytes, 112);
    header.profile_bytes = number(bytes, 116);
  }
  return header;
}

class BmpDecoder : public Decoder {
 public:
  BmpDecoder(const std::shared_ptr<const Input>& input, const Run& run);
  bool streams() const override { return !run_lengths(); }
  void read(const AnyView& rows) override;

 private:
  bool run_lengths() const { return bmp_.compression == Rle8 || bmp_.compression == Rle4; }
  void check_size(const Run& run);
  void read_palette();
  void read_profile(const Run& run);
  void describe();
  std::uint64_t row_bits() const {
    return static_cast<std::uint64_t>(bmp_.width) * static_cast<std::uint64_t>(bmp_.bits);
  }
  std::uint64_t row_bytes() const { return (row_bits() + 31) / 32 * 4; }
  void unpack_row(std::uint8_t* result) const;
  void put_color(unsigned index, std::int64_t x, std::int64_t y, std::uint8_t* result) const;
  void read_run_lengths(const AnyView& rows);
  void read_escape(const AnyView& rows, std::uint8_t code);
  void put_run(const AnyView& rows, unsigned index);

  ByteReader reader_;
  std::shared_ptr<const Input> input_;
  BmpHeader bmp_;
  bool from_top_ = false;
  std::vector<std::array<std::uint8_t, 3>> palette_;
  std::vector<std::uint8_t> row_;
  int channels_ = 3;
  int next_row_ = 0;
  std::int64_t x_ = 0;  ///< where the next run goes; y_ counts scan lines as stored
  std::int64_t y_ = 0;
};

BmpDecoder::BmpDecoder(const std::shared_ptr<const Input>& input, const Run& run) : reader_(input), input_(input) {
  bmp_ = read_header(reader_);
  check_size(run);
  if (bmp_.bits <= 8) read_palette();
  read_profile(run);
  describe();
  if (run_lengths() && from_top_) {
    warn(run, fmt::format("{}: run lengths from the top, which the format does not allow", input_->name()));
  }
}

void BmpDecoder::check_size(const Run& run) {
  from_top_ = bmp_.height < 0;
  bmp_.height = std::abs(bmp_.height);
  check_decoded_size(input_->name(), static_cast<std::uint64_t>(std::max<std::int64_t>(bmp_.width, 0)),
                     static_cast<std::uint64_t>(bmp_.height), run);
  if (bmp_.pixels_at < reader_.position()) {
    throw reader_.error(Error::Data, fmt::format("pixels at byte {}, inside the header", bmp_.pixels_at));
  }
  if (run_lengths()) return;
  // The padding of the last row may be missing.
  const std::uint64_t last = (row_bits() + 7) / 8;
  const std::uint64_t end = bmp_.pixels_at + row_bytes() * static_cast<std::uint64_t>(bmp_.height - 1) + last;
  if (end > reader_.size()) {
    throw reader_.error(Error::Data, fmt::format("pixels up to byte {} in a file of {}", end, reader_.size()));
  }
}

void BmpDecoder::read_palette() {
  const std::uint64_t all = std::uint64_t{1} << bmp_.bits;
  const std::uint64_t entry = bmp_.size == kCoreHeader ? 3 : 4;
  const std::uint64_t room = (bmp_.pixels_at - reader_.position()) / entry;
  if (bmp_.colors > room) {
    throw reader_.error(Error::Data, fmt::format("a palette of {} colours in the place of {}", bmp_.colors, room));
  }
  palette_.resize(std::min({bmp_.colors == 0 ? all : bmp_.colors, all, room}));
  if (palette_.empty()) throw reader_.error(Error::Data, "no palette");
  for (auto& color : palette_) {
    std::array<std::uint8_t, 4> bytes{};
    reader_.read(std::span(bytes).first(entry));
    color = {bytes[2], bytes[1], bytes[0]};
  }
  const auto gray = [](const auto& color) { return color[0] == color[1] && color[1] == color[2]; };
  if (std::all_of(palette_.begin(), palette_.end(), gray)) channels_ = 1;
}

void BmpDecoder::read_profile(const Run& run) {
  if (bmp_.profile_at == 0 || bmp_.profile_bytes == 0) return;
  if (bmp_.profile_bytes > kLargestProfile || bmp_.profile_at + bmp_.profile_bytes > reader_.size()) {
    warn(run, fmt::format("{}: the profile lies outside the file and is ignored", input_->name()));
    return;
  }
  header_.icc.resize(bmp_.profile_bytes);
  reader_.seek(bmp_.profile_at);
  reader_.read(std::span(header_.icc));
}

void BmpDecoder::describe() {
  if (bmp_.fields[3].mask != 0) channels_ = 4;
  ImageFile& file = header_.file;
  file.format = "bmp";
  file.info = {static_cast<int>(bmp_.width),
               static_cast<int>(bmp_.height),
               channels_,
               PixelType::U8,
               ColorState::Srgb,
               channels_ == 4 ? AlphaState::Straight : AlphaState::None};
  file.stored_width = file.info.width;
  file.stored_height = file.info.height;
  file.bits = palette_.empty() && bmp_.bits == 16 ? 5 : std::min(bmp_.bits, 8);
  file.encoding = fmt::format("{} bits a pixel{}{}", bmp_.bits, palette_.empty() ? "" : ", palette",
                              run_lengths() ? ", run lengths" : "");
  file.metadata.density_x = bmp_.density_x > INT_MAX ? 0.0F : static_cast<float>(bmp_.density_x);
  file.metadata.density_y = bmp_.density_y > INT_MAX ? 0.0F : static_cast<float>(bmp_.density_y);
}

void BmpDecoder::put_color(unsigned index, std::int64_t x, std::int64_t y, std::uint8_t* result) const {
  if (index >= palette_.size()) {
    throw Error(Error::Data, fmt::format("{}: pixel ({}, {}): colour {} of a palette of {}", input_->name(), x, y,
                                         index, palette_.size()));
  }
  std::copy_n(palette_[index].begin(), channels_, result);
}

/// row_ into pixels.
void BmpDecoder::unpack_row(std::uint8_t* result) const {
  const std::uint8_t* source = row_.data();
  for (std::int64_t x = 0; x < bmp_.width; ++x, result += channels_) {
    if (bmp_.bits <= 8) {
      const auto bit = static_cast<unsigned>(x * bmp_.bits % 8);
      const unsigned byte = source[x * bmp_.bits / 8];
      const unsigned bits = static_cast<unsigned>(bmp_.bits);
      put_color(byte >> (8 - bits - bit) & ((1U << bits) - 1), x, next_row_, result);
    } else if (bmp_.bits == 24) {
      result[0] = source[3 * x + 2];
      result[1] = source[3 * x + 1];
      result[2] = source[3 * x];
    } else {
      std::uint32_t pixel = 0;
      for (int i = 0; i < bmp_.bits / 8; ++i) pixel |= std::uint32_t{source[x * (bmp_.bits / 8) + i]} << (8 * i);
      for (int i = 0; i < channels_; ++i) result[i] = bmp_.fields[static_cast<std::size_t>(i)].value(pixel);
    }
  }
}

void BmpDecoder::read(const AnyView& rows) {
  if (run_lengths()) {
    read_run_lengths(rows);
    return;
  }
  row_.resize((row_bits() + 7) / 8);
  for (int y = 0; y < rows.height(); ++y, ++next_row_) {
    const std::int64_t stored = from_top_ ? next_row_ : bmp_.height - 1 - next_row_;
    const std::uint64_t offset = bmp_.pixels_at + row_bytes() * static_cast<std::uint64_t>(stored);
    if (input_->read(offset, std::as_writable_bytes(std::span(row_))) != row_.size()) {
      throw Error(Error::Data, fmt::format("{}: row {}: the file ends too early", input_->name(), next_row_));
    }
    unpack_row(rows.as<std::uint8_t>().row(y));
  }
}

/// Pairs of a count and a colour; a count of 0 escapes. Pixels that are skipped have the palette's first colour.
void BmpDecoder::read_run_lengths(const AnyView& rows) {
  for (int y = 0; y < rows.height(); ++y) {
    for (int x = 0; x < rows.width(); ++x) put_color(0, x, y, &rows.as<std::uint8_t>()(x, y));
  }
  constexpr std::uint8_t kEndOfImage = 1;
  reader_.seek(bmp_.pixels_at);
  while (true) {
    const std::uint8_t count = reader_.byte();
    const std::uint8_t value = reader_.byte();
    if (count == 0 && value == kEndOfImage) return;
    if (count == 0) {
      read_escape(rows, value);
      continue;
    }
    for (unsigned i = 0; i < count; ++i) {
      put_run(rows, bmp_.compression == Rle8 ? value : i % 2 == 0 ? value >> 4U : value & 15U);
    }
  }
}

/// 0: end of line; 2: move right and on; n > 2: n colours, padded to two bytes.
void BmpDecoder::read_escape(const AnyView& rows, std::uint8_t code) {
  if (code == 0) {
    x_ = 0;
    ++y_;
  } else if (code == 2) {
    x_ += reader_.byte();
    y_ += reader_.byte();
  } else if (bmp_.compression == Rle8) {
    for (unsigned i = 0; i < code; ++i) put_run(rows, reader_.byte());
    if (code % 2 != 0) reader_.skip(1);
  } else {
    unsigned pair = 0;
    for (unsigned i = 0; i < code; ++i) {
      if (i % 2 == 0) pair = reader_.byte();
      put_run(rows, i % 2 == 0 ? pair >> 4 : pair & 15);
    }
    if ((code + 1) / 2 % 2 != 0) reader_.skip(1);
  }
}

/// The next pixel of a run. Writers fill the last byte of an odd row of 4-bit pixels.
void BmpDecoder::put_run(const AnyView& rows, unsigned index) {
  const bool padding = bmp_.compression == Rle4 && x_ == bmp_.width && x_ % 2 == 1;
  if ((x_ >= bmp_.width && !padding) || y_ >= bmp_.height) {
    throw reader_.error(
        Error::Data, fmt::format("a run reaches pixel ({}, {}) of an image of {}×{}", x_, y_, bmp_.width, bmp_.height));
  }
  const std::int64_t y = from_top_ ? y_ : bmp_.height - 1 - y_;
  if (!padding) put_color(index, x_, y, &rows.as<std::uint8_t>()(static_cast<int>(x_), static_cast<int>(y)));
  ++x_;
}

}  // namespace

std::unique_ptr<Decoder> decode_bmp(std::shared_ptr<const Input> input, const ReadOptions&, const Run& run) {
  return std::make_unique<BmpDecoder>(input, run);
}

}  // namespace azulejo
