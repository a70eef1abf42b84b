// Layout: Truevision, "TGA File Format Specification, Version 2.0".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "azulejo/io/byte_reader.h"
#include "azulejo/io/decoded_size.h"
#include "azulejo/io/tga.h"

namespace azulejo {
namespace {

enum Kind { kPalette = 1, kColor = 2, kGray = 3 };

constexpr std::string_view kSignature{"TRUEVISION-XFILE.\0", 18};
constexpr std::uint64_t kFooterBytes = 26;
constexpr std::uint64_t kAttributesType = 494;  // in the extension area
constexpr int kLongestRun = 128;

using Pixel = std::array<std::uint8_t, 4>;

class TgaDecoder : public Decoder {
 public:
  TgaDecoder(const std::shared_ptr<const Input>& input, const Run& run);
  bool streams() const override { return tga_.from_top || !tga_.runs(); }
  void read(const AnyView& rows) override;

 private:
  void check_size(const Run& run);
  AlphaState alpha_state();
  void read_palette();
  void describe(AlphaState alpha);
  std::uint64_t stored_bytes() const { return (static_cast<std::uint64_t>(tga_.bits) + 7) / 8; }
  Pixel read_color(int bits);
  Pixel read_pixel();
  Pixel next_pixel();

  ByteReader reader_;
  TgaHeader tga_;
  std::vector<Pixel> palette_;
  std::uint64_t pixels_at_ = 0;
  bool alpha_ = false;
  int next_row_ = 0;
  int run_left_ = 0;  ///< of a packet, which may go on in the next row
  bool run_repeats_ = false;
  Pixel run_pixel_{};
};

TgaDecoder::TgaDecoder(const std::shared_ptr<const Input>& input, const Run& run) : reader_(input) {
  std::array<std::byte, TgaHeader::kBytes> head{};
  reader_.read(head);
  const std::optional<TgaHeader> header = parse_tga_header(head);
  if (!header) throw reader_.error(Error::Data, "no Targa header");
  tga_ = *header;
  if (tga_.interleaved) throw reader_.error(Error::Unsupported, "interleaved rows");
  const AlphaState alpha = alpha_state();
  alpha_ = alpha != AlphaState::None;
  reader_.seek(TgaHeader::kBytes + static_cast<std::uint64_t>(tga_.id_bytes));
  if (tga_.has_palette) read_palette();
  pixels_at_ = reader_.position();
  check_size(run);
  describe(alpha);
  if (tga_.kind() == kColor && tga_.bits == 32 && tga_.attribute_bits == 0) {
    warn(run,
         fmt::format("{}: the header counts no alpha bits: the fourth byte of each pixel is ignored", reader_.name()));
  }
}

void TgaDecoder::check_size(const Run& run) {
  const auto pixels = static_cast<std::uint64_t>(tga_.width) * static_cast<std::uint64_t>(tga_.height);
  check_decoded_size(reader_.name(), static_cast<std::uint64_t>(tga_.width), static_cast<std::uint64_t>(tga_.height),
                     run);
  const std::uint64_t least =
      tga_.runs() ? (pixels + kLongestRun - 1) / kLongestRun * (1 + stored_bytes()) : pixels * stored_bytes();
  if (pixels_at_ + least > reader_.size()) {
    throw reader_.error(Error::Data, fmt::format("pixels need {} bytes in a file of {}", least, reader_.size()));
  }
}

/// What the attribute bits are: the extension area of newer files says it, others mean alpha.
AlphaState TgaDecoder::alpha_state() {
  const int color_bits = tga_.has_palette && tga_.kind() == kPalette ? tga_.palette_bits : tga_.bits;
  const bool room = tga_.kind() == kGray ? tga_.bits == 16 : color_bits == 16 || color_bits == 32;
  if (tga_.attribute_bits == 0 || !room) return AlphaState::None;
  if (reader_.size() < TgaHeader::kBytes + kFooterBytes) return AlphaState::Straight;
  reader_.seek(reader_.size() - kFooterBytes);
  const std::uint32_t extension = reader_.le32();
  reader_.skip(4);
  std::string signature(kSignature.size(), ' ');
  reader_.read(std::as_writable_bytes(std::span(signature)));
  if (signature != kSignature || extension == 0 || extension + kAttributesType >= reader_.size()) {
    return AlphaState::Straight;
  }
  reader_.seek(extension + kAttributesType);
  constexpr std::uint8_t kAlpha = 3;
  constexpr std::uint8_t kPremultiplied = 4;
  const std::uint8_t type = reader_.byte();
  return type == kAlpha ? AlphaState::Straight : type == kPremultiplied ? AlphaState::Premultiplied : AlphaState::None;
}

void TgaDecoder::read_palette() {
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(tga_.palette_size) * ((static_cast<unsigned>(tga_.palette_bits) + 7) / 8);
  if (tga_.kind() != kPalette) {
    reader_.skip(bytes);
    return;
  }
  palette_.resize(static_cast<std::size_t>(tga_.palette_size));
  for (Pixel& each : palette_) each = read_color(tga_.palette_bits);
}

void TgaDecoder::describe(AlphaState alpha) {
  ImageFile& file = header_.file;
  const int colors = tga_.kind() == kGray ? 1 : 3;
  file.format = "tga";
  file.info = {tga_.width, tga_.height, colors + (alpha_ ? 1 : 0), PixelType::U8, ColorState::Srgb, alpha};
  file.stored_width = tga_.width;
  file.stored_height = tga_.height;
  const int color_bits = tga_.kind() == kPalette ? tga_.palette_bits : tga_.bits;
  file.bits = tga_.kind() != kGray && color_bits <= 16 ? 5 : 8;
  constexpr std::array<const char*, 4> kNames{"", "palette", "colour", "gray"};
  file.encoding = fmt::format("{}, {} bits a pixel{}", kNames[static_cast<std::size_t>(tga_.kind())], tga_.bits,
                              tga_.runs() ? ", run lengths" : "");
}

/// Red, green, blue, alpha of 15, 16, 24 or 32 bits.
Pixel TgaDecoder::read_color(int bits) {
  if (bits <= 16) {
    const unsigned word = reader_.le16();
    const auto wide = [](unsigned five) { return static_cast<std::uint8_t>((five * 255 + 15) / 31); };
    return {wide(word >> 10 & 31), wide(word >> 5 & 31), wide(word & 31),
            static_cast<std::uint8_t>(word >> 15 != 0 ? 255 : 0)};
  }
  Pixel result{};
  for (const std::size_t i : {2U, 1U, 0U}) result[i] = reader_.byte();
  result[3] = bits == 32 ? reader_.byte() : std::uint8_t{255};
  return result;
}

Pixel TgaDecoder::read_pixel() {
  if (tga_.kind() == kColor) return read_color(tga_.bits);
  if (tga_.kind() == kGray) {
    const std::uint8_t gray = reader_.byte();
    return {gray, tga_.bits == 16 ? reader_.byte() : std::uint8_t{255}, 0, 0};
  }
  const int index = tga_.bits == 8 ? reader_.byte() : reader_.le16();
  const int at = index - tga_.palette_first;
  if (at < 0 || at >= tga_.palette_size) {
    throw reader_.error(Error::Data, fmt::format("colour {} of a palette from {} to {}", index, tga_.palette_first,
                                                 tga_.palette_first + tga_.palette_size - 1));
  }
  return palette_[static_cast<std::size_t>(at)];
}

Pixel TgaDecoder::next_pixel() {
  if (!tga_.runs()) return read_pixel();
  if (run_left_ == 0) {
    const int packet = reader_.byte();
    run_repeats_ = packet >= kLongestRun;
    run_left_ = packet % kLongestRun + 1;
    if (run_repeats_) run_pixel_ = read_pixel();
  }
  --run_left_;
  return run_repeats_ ? run_pixel_ : read_pixel();
}

void TgaDecoder::read(const AnyView& rows) {
  const int channels = rows.info.channels;
  const std::uint64_t row_bytes = static_cast<std::uint64_t>(tga_.width) * stored_bytes();
  if (tga_.runs() && next_row_ == 0) reader_.seek(pixels_at_);
  for (int i = 0; i < rows.height(); ++i, ++next_row_) {
    // Plain rows are found by their place; run lengths come in the order of the file.
    const int stored = tga_.from_top ? next_row_ : tga_.height - 1 - next_row_;
    if (!tga_.runs()) reader_.seek(pixels_at_ + row_bytes * static_cast<std::uint64_t>(stored));
    std::uint8_t* row = rows.as<std::uint8_t>().row(tga_.runs() && !tga_.from_top ? stored : i);
    for (int x = 0; x < tga_.width; ++x) {
      const Pixel pixel = next_pixel();
      const int at = tga_.from_right ? tga_.width - 1 - x : x;
      std::copy_n(pixel.begin(), channels, row + static_cast<std::ptrdiff_t>(at) * channels);
    }
  }
}

}  // namespace

std::optional<TgaHeader> parse_tga_header(std::span<const std::byte> head) {
  if (head.size() < TgaHeader::kBytes) return std::nullopt;
  const auto byte = [&](std::size_t at) { return static_cast<int>(head[at]); };
  const auto word = [&](std::size_t at) { return byte(at) | byte(at + 1) << 8; };
  const TgaHeader header{.id_bytes = byte(0),
                         .has_palette = byte(1) == 1,
                         .type = byte(2),
                         .palette_first = word(3),
                         .palette_size = word(5),
                         .palette_bits = byte(7),
                         .width = word(12),
                         .height = word(14),
                         .bits = byte(16),
                         .attribute_bits = byte(17) & 15,
                         .from_right = (byte(17) & 16) != 0,
                         .from_top = (byte(17) & 32) != 0,
                         .interleaved = byte(17) >> 6 != 0};
  const auto one_of = [](int value, auto... allowed) { return ((value == allowed) || ...); };
  const int kind = header.kind();
  const bool fits = (kind == kPalette && header.has_palette && one_of(header.bits, 8, 16)) ||
                    (kind == kColor && one_of(header.bits, 15, 16, 24, 32)) ||
                    (kind == kGray && one_of(header.bits, 8, 16));
  const bool palette_fits =
      !header.has_palette || (header.palette_size > 0 && one_of(header.palette_bits, 15, 16, 24, 32));
  if (byte(1) > 1 || header.type > 11 || !fits || !palette_fits || header.width == 0 || header.height == 0) {
    return std::nullopt;
  }
  return header;
}

std::unique_ptr<Decoder> decode_tga(std::shared_ptr<const Input> input, const ReadOptions&, const Run& run) {
  return std::make_unique<TgaDecoder>(input, run);
}

}  // namespace azulejo
