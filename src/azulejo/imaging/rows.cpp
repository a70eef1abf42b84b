#include "azulejo/imaging/rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

/// The transfer curve in double precision; additions, multiplications and divisions only.
double exact_linear(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  const double x = (encoded + 0.055) / 1.055;
  // x^2.4 = x² · (x²)^(1/5); the root by Newton's method, from above.
  const double square = x * x;
  double root = 1;
  for (int i = 0; i < 40; ++i) {
    const double fourth = root * root * root * root;
    root -= (root * fourth - square) / (5 * fourth);
  }
  return square * root;
}

ByteCurve make_byte_curve() {
  ByteCurve curve{};
  for (int k = 0; k < 256; ++k) curve.linear[k] = static_cast<float>(exact_linear(k / 255.0));
  int next = 1;  // the value above the next threshold
  for (std::uint32_t bucket = 0; bucket < ByteCurve::kBuckets; ++bucket) {
    const std::uint32_t first = ByteCurve::kLowest + (bucket << 16);
    curve.encode[bucket] = static_cast<std::uint32_t>(next - 1) << 16;
    if (next > 255) continue;
    const double exact = exact_linear((next - 0.5) / 255.0);
    auto threshold = static_cast<float>(exact);
    if (static_cast<double>(threshold) < exact)
      threshold = std::bit_cast<float>(std::bit_cast<std::uint32_t>(threshold) + 1);
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(threshold);
    if (bits >= first && bits < first + 65536) {
      curve.encode[bucket] += 65536 - (bits - first);
      ++next;
    }
  }
  return curve;
}

template <class T>
float decoded(float stored) {
  if constexpr (std::is_same_v<T, std::uint8_t>) return byte_curve().linear[static_cast<int>(stored)];
  if constexpr (std::is_same_v<T, std::uint16_t>) return srgb_to_linear(stored / 65535.0F);
  return srgb_to_linear(stored);
}

template <class T>
T encoded(float linear) {
  if constexpr (std::is_same_v<T, std::uint8_t>) return encode_byte(byte_curve(), linear);
  return rounded<T>(linear_to_srgb(linear) * full_range(kPixelTypeOf<T>));
}

template <class T>
void load_pixel(const RowFormat& format, const T* source, float* row) {
  const int last = format.channels - 1;
  const bool has_alpha = format.alpha != RowAlpha::Plain;
  const auto alpha = static_cast<float>(source[last]);
  for (int c = 0; c < format.channels; ++c) {
    const auto stored = static_cast<float>(source[c]);
    if (has_alpha && c == last) {
      row[c] = alpha;
    } else if (format.alpha == RowAlpha::Unweigh) {
      row[c] = srgb_to_linear(alpha == 0.0F ? 0.0F : stored / alpha) * alpha;
    } else {
      const float light = format.curve ? decoded<T>(stored) : stored;
      row[c] = has_alpha ? light * alpha : light;
    }
  }
}

template <class T>
void store_pixel(const RowFormat& format, const float* row, T* result) {
  const int last = format.channels - 1;
  const bool has_alpha = format.alpha != RowAlpha::Plain;
  const float alpha = row[last];
  const bool hidden = std::is_floating_point_v<T> ? alpha == 0.0F : alpha < 0.5F;
  for (int c = 0; c < format.channels; ++c) {
    if (has_alpha && c == last) {
      result[c] = rounded<T>(alpha);
      continue;
    }
    const float light = !has_alpha ? row[c] : hidden ? 0.0F : row[c] / alpha;
    if (format.alpha == RowAlpha::Unweigh) {
      result[c] = rounded<T>(linear_to_srgb(light) * alpha);
    } else {
      result[c] = format.curve ? encoded<T>(light) : rounded<T>(light);
    }
  }
}

}  // namespace

const ByteCurve& byte_curve() {
  static const ByteCurve curve = make_byte_curve();
  return curve;
}

std::uint8_t encode_byte(const ByteCurve& curve, float linear) {
  constexpr std::uint32_t kBelowOne = 0x3F7FFFFF;
  const float low = std::bit_cast<float>(ByteCurve::kLowest);
  const float high = std::bit_cast<float>(kBelowOne);
  const float clamped = linear > low ? std::min(linear, high) : low;
  const auto bits = std::bit_cast<std::uint32_t>(clamped);
  return static_cast<std::uint8_t>((curve.encode[(bits - ByteCurve::kLowest) >> 16] + (bits & 65535)) >> 16);
}

RowFormat row_format(const ImageInfo& info, Light light) {
  RowFormat format{info.type, info.channels, light == Light::Linear && info.color == ColorState::Srgb, RowAlpha::Plain};
  if (info.alpha == AlphaState::Straight) format.alpha = RowAlpha::Weigh;
  if (info.alpha == AlphaState::Premultiplied && format.curve) format.alpha = RowAlpha::Unweigh;
  return format;
}

float row_unit(const RowFormat& format) {
  const float full = full_range(format.type);
  return (format.curve ? 1.0F : full) * (format.alpha != RowAlpha::Plain ? full : 1.0F);
}

void load_row_reference(const RowFormat& format, const std::byte* source, int pixels, float* row) {
  visit_type(format.type, [&](auto zero) {
    using T = decltype(zero);
    for (std::size_t i = 0; i < format.values(pixels); i += static_cast<std::size_t>(format.channels)) {
      load_pixel(format, reinterpret_cast<const T*>(source) + i, row + i);
    }
  });
}

void store_row_reference(const RowFormat& format, const float* row, int pixels, std::byte* result) {
  visit_type(format.type, [&](auto zero) {
    using T = decltype(zero);
    for (std::size_t i = 0; i < format.values(pixels); i += static_cast<std::size_t>(format.channels)) {
      store_pixel(format, row + i, reinterpret_cast<T*>(result) + i);
    }
  });
}

}  // namespace azulejo
