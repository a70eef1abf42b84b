#include "azulejo/io/tga.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr int kLargestSide = 65535;
constexpr std::size_t kLongestPacket = 128;

bool matches(std::span<const std::byte> head, std::string_view) { return parse_tga_header(head).has_value(); }

ImageInfo storable(const ImageInfo& info, const WriteOptions&) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(Error::Unsupported,
                fmt::format("TGA can't hold {} channels without alpha; TIFF and OpenEXR can", info.channels));
  }
  ImageInfo result = info;
  result.type = PixelType::U8;
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  if (info.alpha != AlphaState::None) result.alpha = AlphaState::Straight;
  return result;
}

/// Run-length encoded from the top; gray with alpha has 16 bits a pixel.
class TgaEncoder : public Encoder {
 public:
  TgaEncoder(Output& output, const ImageInfo& info);
  void write(const ConstAnyView& rows) override;
  void finish() override {}

 private:
  void store_row(const std::uint8_t* source);
  void pack_row();
  bool same(std::size_t a, std::size_t b) const {
    return std::memcmp(&row_[a * pixel_], &row_[b * pixel_], pixel_) == 0;
  }

  Output& output_;
  std::size_t width_;
  std::size_t pixel_;              ///< bytes, as many as channels
  std::vector<std::uint8_t> row_;  ///< in the file's order: blue, green, red, alpha
  std::vector<std::uint8_t> packets_;
};

TgaEncoder::TgaEncoder(Output& output, const ImageInfo& info)
    : output_(output),
      width_(static_cast<std::size_t>(info.width)),
      pixel_(info.pixel_bytes()),
      row_(info.row_bytes()) {
  if (info.width > kLargestSide || info.height > kLargestSide) {
    throw Error(Error::Unsupported, fmt::format("{}: TGA holds at most {} pixels a side, the image has {}×{}",
                                                output.name(), kLargestSide, info.width, info.height));
  }
  constexpr std::uint8_t kColorRuns = 10;
  constexpr std::uint8_t kGrayRuns = 11;
  constexpr std::uint8_t kFromTop = 0x20;
  std::array<std::uint8_t, TgaHeader::kBytes> header{};
  const auto low = [](int value) { return static_cast<std::uint8_t>(value & 255); };
  header[2] = info.color_channels() == 1 ? kGrayRuns : kColorRuns;
  header[12] = low(info.width);
  header[13] = low(info.width >> 8);
  header[14] = low(info.height);
  header[15] = low(info.height >> 8);
  header[16] = low(8 * info.channels);
  header[17] = static_cast<std::uint8_t>(kFromTop | (info.alpha == AlphaState::None ? 0 : 8));
  output_.write(std::as_bytes(std::span(header)));
}

void TgaEncoder::store_row(const std::uint8_t* source) {
  std::copy_n(source, row_.size(), row_.begin());
  if (pixel_ < 3) return;
  for (std::size_t at = 0; at < row_.size(); at += pixel_) std::swap(row_[at], row_[at + 2]);
}

/// Packets of a repeated pixel or of different ones; none reaches into the next row.
void TgaEncoder::pack_row() {
  packets_.clear();
  for (std::size_t x = 0; x < width_;) {
    std::size_t count = 1;
    const bool repeat = x + 1 < width_ && same(x, x + 1);
    const auto goes_on = [&](std::size_t at) { return repeat ? same(x, at) : at + 1 >= width_ || !same(at, at + 1); };
    while (x + count < width_ && count < kLongestPacket && goes_on(x + count)) ++count;
    packets_.push_back(static_cast<std::uint8_t>(count - 1 + (repeat ? kLongestPacket : 0)));
    const auto first = row_.begin() + static_cast<std::ptrdiff_t>(x * pixel_);
    packets_.insert(packets_.end(), first, first + static_cast<std::ptrdiff_t>((repeat ? 1 : count) * pixel_));
    x += count;
  }
}

void TgaEncoder::write(const ConstAnyView& rows) {
  for (int y = 0; y < rows.height(); ++y) {
    store_row(rows.as<std::uint8_t>().row(y));
    pack_row();
    output_.write(std::as_bytes(std::span(packets_)));
  }
}

std::unique_ptr<Encoder> encode(Output& output, const ImageInfo& info, const Metadata&, const WriteOptions&,
                                const Run&) {
  return std::make_unique<TgaEncoder>(output, info);
}

}  // namespace

extern const Codec kTgaCodec;
const Codec kTgaCodec{"tga", {"tga", "icb", "vda", "vst"}, matches, decode_tga, storable, encode};

}  // namespace azulejo
