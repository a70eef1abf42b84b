#include "azulejo/io/bmp.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kFileHeader = 14;
constexpr std::uint32_t kWindowsHeader = 40;
constexpr std::uint32_t kAlphaHeader = 108;  // the first that programs agree to read alpha from
constexpr std::uint32_t kMasks = 3;
constexpr std::uint32_t kSrgb = 0x73524742;  // "sRGB"
constexpr std::uint32_t kGrays = 256;
constexpr int kRowGroup = 64;  // rows that are turned over at once

bool matches(std::span<const std::byte> head, std::string_view) {
  // Byte 15 on is the size of the next header: small, so its upper half is 0.
  return head.size() >= 18 && head[0] == std::byte{'B'} && head[1] == std::byte{'M'} && head[15] == std::byte{0} &&
         head[16] == std::byte{0} && head[17] == std::byte{0};
}

ImageInfo storable(const ImageInfo& info, const WriteOptions&) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(Error::Unsupported,
                fmt::format("BMP can't hold {} channels without alpha; TIFF and OpenEXR can", info.channels));
  }
  ImageInfo result = info;
  result.type = PixelType::U8;
  if (info.alpha != AlphaState::None) {
    result.channels = 4;
    result.alpha = AlphaState::Straight;
  }
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  return result;
}

class BmpEncoder : public Encoder {
 public:
  BmpEncoder(Output& output, const ImageInfo& info, const Metadata& metadata);
  int row_group() const override { return kRowGroup; }
  void write(const ConstAnyView& rows) override;
  void finish() override { output_.seek(pixels_at_ + row_bytes_ * static_cast<std::uint64_t>(info_.height)); }

 private:
  void put(std::uint32_t value, int bytes = 4);
  void put_masks();
  void put_palette();
  void turn_over(const ConstAnyView& rows);

  Output& output_;
  ImageInfo info_;
  std::uint32_t pixels_at_ = 0;
  std::uint64_t row_bytes_ = 0;
  int next_row_ = 0;
  std::vector<std::uint8_t> bytes_;
};

BmpEncoder::BmpEncoder(Output& output, const ImageInfo& info, const Metadata& metadata)
    : output_(output), info_(info), row_bytes_((info.row_bytes() + 3) / 4 * 4) {
  const bool alpha = info.channels == 4;
  const std::uint32_t header = alpha ? kAlphaHeader : kWindowsHeader;
  pixels_at_ = kFileHeader + header + (info.channels == 1 ? 4 * kGrays : 0);
  const std::uint64_t pixels = row_bytes_ * static_cast<std::uint64_t>(info.height);
  if (pixels_at_ + pixels > UINT_MAX) {
    throw Error(Error::Unsupported, fmt::format("{}: BMP holds at most 4 GB, the image takes {} bytes", output.name(),
                                                pixels_at_ + pixels));
  }
  const auto density = [](float value) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 1e9F)));
  };
  put('B' | 'M' << 8, 2);
  put(static_cast<std::uint32_t>(pixels_at_ + pixels));
  put(0);
  put(pixels_at_);
  put(header);
  put(static_cast<std::uint32_t>(info.width));
  put(static_cast<std::uint32_t>(info.height));
  put(1, 2);
  put(8 * static_cast<std::uint32_t>(info.channels), 2);
  put(alpha ? kMasks : 0);
  put(static_cast<std::uint32_t>(pixels));
  put(density(metadata.density_x));
  put(density(metadata.density_y));
  put(info.channels == 1 ? kGrays : 0);
  put(0);
  if (alpha) put_masks();
  if (info.channels == 1) put_palette();
  output_.write(std::as_bytes(std::span(bytes_)));
}

void BmpEncoder::put(std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void BmpEncoder::put_masks() {
  for (const std::uint32_t mask : {0xFF0000U, 0xFF00U, 0xFFU, 0xFF000000U, kSrgb}) put(mask);
  constexpr int kEndpointsAndGammas = 12;
  for (int i = 0; i < kEndpointsAndGammas; ++i) put(0);
}

void BmpEncoder::put_palette() {
  for (std::uint32_t gray = 0; gray < kGrays; ++gray) put(gray * 0x010101U);
}

/// Rows into bytes_, the last one first, red and blue exchanged.
void BmpEncoder::turn_over(const ConstAnyView& rows) {
  bytes_.assign(row_bytes_ * static_cast<std::size_t>(rows.height()), 0);
  std::uint8_t* result = bytes_.data();
  for (int y = rows.height() - 1; y >= 0; --y, result += row_bytes_) {
    const std::uint8_t* source = rows.as<std::uint8_t>().row(y);
    std::copy_n(source, info_.row_bytes(), result);
    if (info_.channels == 1) continue;
    for (std::size_t at = 0; at < info_.row_bytes(); at += info_.pixel_bytes()) std::swap(result[at], result[at + 2]);
  }
}

void BmpEncoder::write(const ConstAnyView& rows) {
  for (int y = 0; y < rows.height(); y += kRowGroup) {
    const int count = std::min(kRowGroup, rows.height() - y);
    turn_over(rows.crop({0, y, rows.width(), count}));
    next_row_ += count;
    output_.seek(pixels_at_ + row_bytes_ * static_cast<std::uint64_t>(info_.height - next_row_));
    output_.write(std::as_bytes(std::span(bytes_)));
  }
}

std::unique_ptr<Encoder> encode(Output& output, const ImageInfo& info, const Metadata& metadata, const WriteOptions&,
                                const Run&) {
  return std::make_unique<BmpEncoder>(output, info, metadata);
}

}  // namespace

extern const Codec kBmpCodec;
const Codec kBmpCodec{"bmp", {"bmp", "dib"}, matches, decode_bmp, storable, encode};

}  // namespace azulejo
