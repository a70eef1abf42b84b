#include "azulejo/io/pnm.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"

namespace azulejo {
namespace {

bool is_space(int byte) { return byte == ' ' || (byte >= '\t' && byte <= '\r'); }

class PnmDecoder final : public Decoder {
 public:
  PnmDecoder(const std::shared_ptr<const Input>& input, const Run& run);
  void read(const AnyView& rows) override;

 private:
  void read_row(const AnyView& rows, int y);
  void read_plain_row(const AnyView& rows, int y);
  void read_raw_row(const AnyView& rows, int y);
  void read_bits(std::uint8_t* row);
  void read_floats(float* row);
  std::uint32_t plain_sample();
  std::uint32_t plain_bit();
  std::uint32_t scaled(std::uint32_t sample) const;

  PnmHeader pnm_;
  ByteReader reader_;
  std::vector<std::uint16_t> scale_;  ///< full-range value of each sample
  std::vector<std::uint8_t> raw_;
  int next_row_ = 0;
};

PnmDecoder::PnmDecoder(const std::shared_ptr<const Input>& input, const Run& run)
    : pnm_(read_pnm_header(input, run)), reader_(input, pnm_.pixels) {
  const bool deep = pnm_.info.type == PixelType::U16;
  ImageFile& file = header_.file;
  file.info = pnm_.info;
  file.stored_width = pnm_.info.width;
  file.stored_height = pnm_.info.height;
  file.bits = pnm_.floats() ? 32 : static_cast<int>(std::bit_width(pnm_.maximum));
  file.format = pnm_.floats()             ? "pfm"
                : pnm_.kind == '7'        ? "pam"
                : pnm_.bits()             ? "pbm"
                : pnm_.info.channels == 3 ? "ppm"
                                          : "pgm";
  file.encoding = pnm_.floats()  ? (pnm_.little_endian ? "raw, little-endian" : "raw, big-endian")
                  : pnm_.plain() ? "plain"
                                 : "raw";
  if (pnm_.floats()) {
    if (pnm_.scale != 1) file.metadata.text.emplace("scale", fmt::format("{}", pnm_.scale));
    return;
  }
  file.encoding += fmt::format(", maximum {}", pnm_.maximum);
  scale_.resize(std::size_t{pnm_.maximum} + 1);
  const std::uint64_t full = deep ? 65535 : 255;
  for (std::uint64_t i = 0; i <= pnm_.maximum; ++i) {
    scale_[i] = static_cast<std::uint16_t>((i * full * 2 + pnm_.maximum) / (std::uint64_t{pnm_.maximum} * 2));
  }
}

void PnmDecoder::read(const AnyView& rows) {
  for (int y = 0; y < rows.height(); ++y, ++next_row_) read_row(rows, y);
}

void PnmDecoder::read_row(const AnyView& rows, int y) {
  if (pnm_.kind == '4') {
    read_bits(rows.as<std::uint8_t>().row(y));
  } else if (pnm_.plain()) {
    read_plain_row(rows, y);
  } else if (pnm_.floats()) {
    read_floats(rows.as<float>().row(y));
  } else {
    read_raw_row(rows, y);
  }
}

std::uint32_t PnmDecoder::scaled(std::uint32_t sample) const {
  if (sample > pnm_.maximum) {
    throw reader_.error(Error::Data,
                        fmt::format("row {}: a sample is {}, the maximum {}", next_row_, sample, pnm_.maximum));
  }
  return scale_[sample];
}

void PnmDecoder::read_plain_row(const AnyView& rows, int y) {
  const std::size_t samples = static_cast<std::size_t>(pnm_.info.width) * static_cast<std::size_t>(pnm_.info.channels);
  visit(rows, [&](auto view) {
    using T = std::remove_reference_t<decltype(*view.data)>;
    T* const row = view.row(y);
    for (std::size_t i = 0; i < samples; ++i)
      row[i] = static_cast<T>(scaled(pnm_.bits() ? plain_bit() : plain_sample()));
  });
}

/// A decimal number between blanks; the last one may end with the file.
std::uint32_t PnmDecoder::plain_sample() {
  int byte = reader_.byte();
  while (is_space(byte)) byte = reader_.byte();
  std::uint32_t value = 0;
  for (; byte >= '0' && byte <= '9'; byte = reader_.byte()) {
    value = std::min<std::uint32_t>(value * 10 + static_cast<std::uint32_t>(byte - '0'), 100'000);
    if (reader_.at_end()) return value;
  }
  if (!is_space(byte)) throw reader_.error(Error::Data, fmt::format("row {}: a number expected", next_row_));
  return value;
}

/// PBM's digits need no blanks between them; 1 is black.
std::uint32_t PnmDecoder::plain_bit() {
  int byte = reader_.byte();
  while (is_space(byte)) byte = reader_.byte();
  if (byte != '0' && byte != '1') throw reader_.error(Error::Data, fmt::format("row {}: 0 or 1 expected", next_row_));
  return byte == '0' ? 1 : 0;
}

void PnmDecoder::read_bits(std::uint8_t* row) {
  raw_.resize(static_cast<std::size_t>(pnm_.raw_row_bytes()));
  reader_.read(std::span(raw_));
  const auto width = static_cast<std::size_t>(pnm_.info.width);
  for (std::size_t x = 0; x < width; ++x) row[x] = (raw_[x / 8] & (0x80U >> (x % 8))) != 0 ? 0 : 255;
}

void PnmDecoder::read_raw_row(const AnyView& rows, int y) {
  const std::size_t samples = static_cast<std::size_t>(pnm_.info.width) * static_cast<std::size_t>(pnm_.info.channels);
  const std::span<std::byte> bytes(rows.row(y), pnm_.info.row_bytes());
  reader_.read(bytes);
  if (pnm_.info.type == PixelType::U8) {
    if (pnm_.maximum == 255) return;
    auto* const row = reinterpret_cast<std::uint8_t*>(bytes.data());
    for (std::size_t i = 0; i < samples; ++i) row[i] = static_cast<std::uint8_t>(scaled(row[i]));
    return;
  }
  std::uint16_t* const row = rows.as<std::uint16_t>().row(y);
  for (std::size_t i = 0; i < samples; ++i) {
    const auto sample =
        std::to_integer<std::uint32_t>(bytes[2 * i]) << 8U | std::to_integer<std::uint32_t>(bytes[2 * i + 1]);
    row[i] = static_cast<std::uint16_t>(scaled(sample));
  }
}

/// PFM keeps its rows from the bottom up.
void PnmDecoder::read_floats(float* row) {
  const std::uint64_t bytes = pnm_.raw_row_bytes();
  const auto from_bottom = static_cast<std::uint64_t>(pnm_.info.height - 1 - next_row_);
  reader_.seek(pnm_.pixels + from_bottom * bytes);
  const std::span<std::byte> result(reinterpret_cast<std::byte*>(row), static_cast<std::size_t>(bytes));
  reader_.read(result);
  if (pnm_.little_endian == (std::endian::native == std::endian::little)) return;
  for (std::size_t i = 0; i < result.size(); i += 4)
    std::reverse(result.begin() + static_cast<std::ptrdiff_t>(i), result.begin() + static_cast<std::ptrdiff_t>(i) + 4);
}

}  // namespace

std::unique_ptr<Decoder> decode_pnm(std::shared_ptr<const Input> input, const ReadOptions& /*options*/,
                                    const Run& run) {
  return std::make_unique<PnmDecoder>(input, run);
}

}  // namespace azulejo
