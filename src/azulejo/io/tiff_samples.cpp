#include "azulejo/io/tiff_samples.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace azulejo {
namespace {

/// Unsigned numbers of any width packed from the most significant bit on, as TIFF packs odd widths.
class BitReader {
 public:
  BitReader(const std::uint8_t* bytes, unsigned bits) : next_(bytes), bits_(bits) {}
  std::uint32_t get() {
    while (held_ < bits_) {
      buffer_ = buffer_ << 8U | *next_++;
      held_ += 8;
    }
    held_ -= bits_;
    return static_cast<std::uint32_t>(buffer_ >> held_ & ((std::uint64_t{1} << bits_) - 1));
  }

 private:
  const std::uint8_t* next_;
  unsigned bits_;
  std::uint64_t buffer_ = 0;
  unsigned held_ = 0;
};

template <class T>
T at(const std::uint8_t* packed, std::size_t index) {
  T value;
  std::memcpy(&value, packed + index * sizeof(T), sizeof(T));
  return value;
}

std::uint32_t triple_at(const std::uint8_t* packed, std::size_t index) {
  const std::uint8_t* bytes = packed + 3 * index;
  const bool little = std::endian::native == std::endian::little;
  return std::uint32_t{bytes[little ? 0 : 2]} | std::uint32_t{bytes[1]} << 8U |
         std::uint32_t{bytes[little ? 2 : 0]} << 16U;
}

/// IEEE 754 binary16.
float half_to_float(std::uint16_t half) {
  const float sign = (half & 0x8000U) != 0 ? -1.0F : 1.0F;
  const int exponent = half >> 10U & 0x1F;
  const auto fraction = static_cast<float>(half & 0x3FFU);
  if (exponent == 0x1F) return fraction == 0 ? sign * HUGE_VALF : NAN;
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(fraction + 1024.0F, exponent - 25);
}

/// Whether an integer has more significant bits than a float keeps.
bool loses_digits(std::uint64_t value) {
  return value != 0 && (value >> static_cast<unsigned>(std::countr_zero(value))) >= (std::uint64_t{1} << 24U);
}

std::uint64_t magnitude(std::int64_t value) {
  return value < 0 ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value);
}

std::int64_t signed_at(const std::uint8_t* packed, std::size_t index, unsigned bits) {
  switch (bits) {
    case 8: return at<std::int8_t>(packed, index);
    case 16: return at<std::int16_t>(packed, index);
    case 32: return at<std::int32_t>(packed, index);
    default: return at<std::int64_t>(packed, index);
  }
}

std::uint64_t unsigned_at(const std::uint8_t* packed, std::size_t index, unsigned bits) {
  return bits == 24   ? triple_at(packed, index)
         : bits == 32 ? at<std::uint32_t>(packed, index)
                      : at<std::uint64_t>(packed, index);
}

float float_at(const std::uint8_t* packed, std::size_t index, unsigned bits, bool& inexact) {
  if (bits == 16) return half_to_float(at<std::uint16_t>(packed, index));
  if (bits == 32) return at<float>(packed, index);
  const auto value = at<double>(packed, index);
  const auto rounded = static_cast<float>(value);
  if (static_cast<double>(rounded) != value && !std::isnan(value)) inexact = true;
  return rounded;
}

/// CIE XYZ to linear RGB of BT.709's primaries, with the equal-energy white that LogLuv files are made for.
/// Source: Larson, LogLuv Encoding for Full-Gamut, High-Dynamic Range Images, 1998
void xyz_to_rgb(const float* xyz, float* rgb) {
  rgb[0] = 2.690F * xyz[0] - 1.276F * xyz[1] - 0.414F * xyz[2];
  rgb[1] = -1.022F * xyz[0] + 1.978F * xyz[1] + 0.044F * xyz[2];
  rgb[2] = 0.061F * xyz[0] - 0.224F * xyz[1] + 1.163F * xyz[2];
}

}  // namespace

PixelType tiff_pixel_type(const TiffSamples& samples) {
  if (!samples.palette.empty()) {
    for (const std::uint16_t each : samples.palette) {
      if (each > 255) return PixelType::U16;
    }
    return PixelType::U8;
  }
  if (samples.kind != TiffSamples::Kind::Unsigned || samples.bits > 16) return PixelType::F32;
  return samples.bits > 8 ? PixelType::U16 : PixelType::U8;
}

bool tiff_samples_readable(const TiffSamples& samples) {
  const unsigned bits = samples.bits;
  switch (samples.kind) {
    case TiffSamples::Kind::Float: return bits == 16 || bits == 32 || bits == 64;
    case TiffSamples::Kind::Signed: return bits == 8 || bits == 16 || bits == 32 || bits == 64;
    default: return (bits >= 1 && bits <= 32) || bits == 64;
  }
}

void TiffRows::unpack_floats(const std::uint8_t* packed, std::size_t samples, float* result) {
  const unsigned bits = samples_.bits;
  if (samples_.kind == TiffSamples::Kind::Float) {
    for (std::size_t i = 0; i < samples; ++i) result[i] = float_at(packed, i, bits, inexact_);
  } else if (samples_.kind == TiffSamples::Kind::Signed) {
    for (std::size_t i = 0; i < samples; ++i) {
      const std::int64_t value = signed_at(packed, i, bits);
      inexact_ = inexact_ || loses_digits(magnitude(value));
      result[i] = static_cast<float>(value);
    }
  } else {
    const double scale = 1.0 / (std::ldexp(1.0, static_cast<int>(bits)) - 1.0);
    const bool whole_bytes = bits == 24 || bits == 32 || bits == 64;
    BitReader reader(packed, bits);
    for (std::size_t i = 0; i < samples; ++i) {
      const std::uint64_t value = whole_bytes ? unsigned_at(packed, i, bits) : reader.get();
      inexact_ = inexact_ || loses_digits(value);
      result[i] = static_cast<float>(static_cast<double>(value) * scale);
    }
  }
  if (samples_.invert) {
    for (std::size_t i = 0; i < samples; ++i) result[i] = 1.0F - result[i];
  }
}

template <class T>
void TiffRows::unpack(const std::uint8_t* packed, std::size_t samples, T* result) {
  if constexpr (std::is_same_v<T, float>) {
    unpack_floats(packed, samples, result);
  } else {
    constexpr std::uint32_t kFull = sizeof(T) == 1 ? 255 : 65535;
    if (samples_.bits == 8 * sizeof(T)) {
      std::memcpy(result, packed, samples * sizeof(T));
    } else {
      const std::uint32_t largest = (1U << samples_.bits) - 1;
      BitReader reader(packed, samples_.bits);
      for (std::size_t i = 0; i < samples; ++i) {
        result[i] = static_cast<T>((reader.get() * kFull + largest / 2) / largest);
      }
    }
    if (samples_.invert) {
      for (std::size_t i = 0; i < samples; ++i) result[i] = static_cast<T>(kFull - result[i]);
    }
  }
}

void TiffRows::unpack_indices(const std::uint8_t* packed, std::size_t samples, std::uint16_t* result) const {
  if (samples_.bits == 16) {
    std::memcpy(result, packed, samples * sizeof(std::uint16_t));
  } else {
    BitReader reader(packed, samples_.bits);
    for (std::size_t i = 0; i < samples; ++i) result[i] = static_cast<std::uint16_t>(reader.get());
  }
}

template <class T>
void TiffRows::convert_to(const std::uint8_t* packed, std::size_t pixels, int first, int count, T* result) {
  const std::size_t stored = samples_.stored;
  const auto channels = static_cast<std::size_t>(info_.channels);
  const auto wanted = static_cast<std::size_t>(count);
  if (!samples_.palette.empty()) {
    row_.resize(pixels * stored * sizeof(std::uint16_t));
    auto* indices = reinterpret_cast<std::uint16_t*>(row_.data());
    unpack_indices(packed, pixels * stored, indices);
    for (std::size_t i = 0; i < 3 * pixels; ++i) {
      result[i] = static_cast<T>(samples_.palette[3U * indices[i / 3 * stored] + i % 3]);
    }
    return;
  }
  if (stored == channels && wanted == channels && !samples_.xyz) return unpack(packed, pixels * stored, result);
  row_.resize(pixels * stored * sizeof(T));
  T* row = reinterpret_cast<T*>(row_.data());
  unpack(packed, pixels * stored, row);
  if constexpr (std::is_same_v<T, float>) {
    if (samples_.xyz) {
      for (std::size_t i = 0; i < pixels; ++i) xyz_to_rgb(row + i * stored, result + i * channels);
      return;
    }
  }
  result += first;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < wanted; ++c) result[i * channels + c] = row[i * stored + c];
  }
}

void TiffRows::convert(const std::uint8_t* packed, std::size_t pixels, int first, int count, std::byte* result) {
  visit_type(info_.type,
             [&](auto zero) { convert_to(packed, pixels, first, count, reinterpret_cast<decltype(zero)*>(result)); });
}

}  // namespace azulejo
