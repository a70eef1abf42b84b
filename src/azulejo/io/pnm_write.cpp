#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/pnm.h"

namespace azulejo {

extern const Codec kPpmCodec;
extern const Codec kPgmCodec;
extern const Codec kPbmCodec;
extern const Codec kPamCodec;
extern const Codec kPfmCodec;

namespace {

void write_text(Output& output, const std::string& text) { output.write(std::as_bytes(std::span(text))); }

/// Raw PGM, PPM and PAM: integers, the high byte first.
class IntegerEncoder final : public Encoder {
 public:
  IntegerEncoder(Output& output, const ImageInfo& info, bool pam) : output_(output) {
    const int maximum = info.type == PixelType::U16 ? 65535 : 255;
    if (pam) {
      constexpr const char* kKinds[] = {"", "GRAYSCALE", "GRAYSCALE_ALPHA", "RGB", "RGB_ALPHA"};
      const char* const kind = info.alpha == AlphaState::None && info.channels % 2 == 0 ? "" : kKinds[info.channels];
      write_text(output_, fmt::format("P7\nWIDTH {}\nHEIGHT {}\nDEPTH {}\nMAXVAL {}\nTUPLTYPE {}\nENDHDR\n", info.width,
                                      info.height, info.channels, maximum, kind));
    } else {
      write_text(output_,
                 fmt::format("P{}\n{} {}\n{}\n", info.channels == 1 ? 5 : 6, info.width, info.height, maximum));
    }
  }

  void write(const ConstAnyView& rows) override {
    const std::size_t bytes = rows.info.row_bytes();
    for (int y = 0; y < rows.height(); ++y) {
      const std::byte* const row = rows.row(y);
      if (rows.info.type == PixelType::U16 && std::endian::native == std::endian::little) {
        swapped_.resize(bytes);
        for (std::size_t i = 0; i < bytes; i += 2) {
          swapped_[i] = row[i + 1];
          swapped_[i + 1] = row[i];
        }
        output_.write(swapped_);
      } else {
        output_.write({row, bytes});
      }
    }
  }
  void finish() override {}

 private:
  Output& output_;
  std::vector<std::byte> swapped_;
};

/// PFM: floats of this machine's byte order, rows from the bottom up.
class FloatEncoder final : public Encoder {
 public:
  FloatEncoder(Output& output, const ImageInfo& info) : output_(output), info_(info) {
    const char* const scale = std::endian::native == std::endian::little ? "-1.0" : "1.0";
    write_text(output_,
               fmt::format("P{}\n{} {}\n{}\n", info.channels == 3 ? 'F' : 'f', info.width, info.height, scale));
    begin_ = output_.position();
  }

  void write(const ConstAnyView& rows) override {
    const std::size_t bytes = info_.row_bytes();
    for (int y = rows.height(); y-- > 0;) {
      if (y + 1 == rows.height()) {
        output_.seek(begin_ + static_cast<std::uint64_t>(info_.height - next_row_ - rows.height()) * bytes);
      }
      output_.write({rows.row(y), bytes});
    }
    next_row_ += rows.height();
  }
  void finish() override { output_.seek(output_.size()); }

 private:
  Output& output_;
  ImageInfo info_;
  std::uint64_t begin_ = 0;
  int next_row_ = 0;
};

template <char... kKinds>
bool begins(std::span<const std::byte> head, std::string_view /*name*/) {
  if (head.size() < 3 || std::to_integer<char>(head[0]) != 'P') return false;
  const auto after = std::to_integer<unsigned char>(head[2]);
  const bool separated = after == ' ' || (after >= '\t' && after <= '\r') || after == '#';
  return separated && ((std::to_integer<char>(head[1]) == kKinds) || ...);
}

ImageInfo as_integers(const ImageInfo& info, const WriteOptions& options) {
  ImageInfo result = info;
  result.type = options.type.value_or(info.type) == PixelType::U8 ? PixelType::U8 : PixelType::U16;
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  return result;
}

ImageInfo without_alpha(ImageInfo info, int channels) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(
        Error::Unsupported,
        fmt::format("this format can't hold {} channels without alpha; PAM, TIFF and OpenEXR can", info.channels));
  }
  info.alpha = AlphaState::None;
  info.channels = channels;
  return info;
}

ImageInfo storable_ppm(const ImageInfo& info, const WriteOptions& options) {
  return without_alpha(as_integers(info, options), 3);
}

ImageInfo storable_pgm(const ImageInfo& info, const WriteOptions& options) {
  return without_alpha(as_integers(info, options), 1);
}

ImageInfo storable_pam(const ImageInfo& info, const WriteOptions& options) {
  ImageInfo result = as_integers(info, options);
  if (result.alpha != AlphaState::None) result.alpha = AlphaState::Straight;
  return result;
}

ImageInfo storable_pfm(const ImageInfo& info, const WriteOptions& /*options*/) {
  ImageInfo result = without_alpha(info, info.color_channels() >= 3 ? 3 : 1);
  result.type = PixelType::F32;
  if (info.color == ColorState::Srgb) result.color = ColorState::Linear;
  return result;
}

std::unique_ptr<Encoder> encode_pnm(Output& output, const ImageInfo& info, const Metadata& /*metadata*/,
                                    const WriteOptions& /*options*/, const Run& /*run*/) {
  return std::make_unique<IntegerEncoder>(output, info, false);
}

std::unique_ptr<Encoder> encode_pam(Output& output, const ImageInfo& info, const Metadata& /*metadata*/,
                                    const WriteOptions& /*options*/, const Run& /*run*/) {
  return std::make_unique<IntegerEncoder>(output, info, true);
}

std::unique_ptr<Encoder> encode_pfm(Output& output, const ImageInfo& info, const Metadata& /*metadata*/,
                                    const WriteOptions& /*options*/, const Run& /*run*/) {
  return std::make_unique<FloatEncoder>(output, info);
}

}  // namespace

const Codec kPpmCodec = {"ppm", {"ppm", "pnm"}, begins<'3', '6'>, decode_pnm, storable_ppm, encode_pnm};
const Codec kPgmCodec = {"pgm", {"pgm"}, begins<'2', '5'>, decode_pnm, storable_pgm, encode_pnm};
const Codec kPbmCodec = {"pbm", {"pbm"}, begins<'1', '4'>, decode_pnm, nullptr, nullptr};
const Codec kPamCodec = {"pam", {"pam"}, begins<'7'>, decode_pnm, storable_pam, encode_pam};
const Codec kPfmCodec = {"pfm", {"pfm"}, begins<'f', 'F'>, decode_pnm, storable_pfm, encode_pfm};

}  // namespace azulejo
