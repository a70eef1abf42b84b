#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "azulejo/data/view.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

/// What happens to colors beside alpha, so that rows may be weighted and summed.
enum class RowAlpha : std::uint8_t {
  Plain,    ///< nothing: no alpha, or premultiplied and summed as stored
  Weigh,    ///< straight alpha: colors are multiplied by alpha on loading, divided on storing
  Unweigh,  ///< premultiplied, linear light: divided before the transfer curve, multiplied behind it, both ways
};

/// How rows of stored pixels become rows of f32 and back.
///
/// In a loaded row, channels stay interleaved and in their order.
/// Alpha is in stored units (u8: 0–255, u16: 0–65535, f32: 0–1), whatever the light.
/// Colors are in stored units if `curve` is false, else linear light, 0–1; with Weigh and Unweigh times alpha (in its
/// stored units). So an encoded u8 row holds exact integers, and a weighted sum is rounded once, by store_row.
struct RowFormat {
  PixelType type = PixelType::U8;
  int channels = 1;
  bool curve = false;  ///< sRGB is decoded on loading and encoded on storing
  RowAlpha alpha = RowAlpha::Plain;

  std::size_t values(int pixels) const { return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(channels); }
};

/// The format with which pixels of this kind are summed in this light. Curves apply to ColorState::Srgb only.
RowFormat row_format(const ImageInfo& info, Light light);

/// What intensity 1 is in a loaded row, where alpha is 1.
float row_unit(const RowFormat& format);

/// Stored pixels as f32.
///
/// source  `pixels` pixels; nothing beyond is read
/// row     format.values(pixels) values; nothing beyond is written
/// Curves  u8: a table of correctly rounded values; u16 and f32: srgb_to_linear of math/transfer.h
/// NaN     passes; a NaN alpha makes the pixel's colors NaN
void load_row(const RowFormat& format, const std::byte* source, int pixels, float* row);

/// The way back: divides by alpha, encodes, rounds half up, saturates.
///
/// row     as from load_row; nothing beyond is read
/// result  `pixels` pixels; nothing beyond is written
/// Alpha   colors of a pixel whose alpha becomes 0 (f32: is 0) become 0
/// Curves  u8: linear light is compared with 255 thresholds, exact to the last bit of the f32 value;
///         u16 and f32: linear_to_srgb of math/transfer.h
/// NaN     0 in integers; f32: passes
void store_row(const RowFormat& format, const float* row, int pixels, std::byte* result);

/// The same bytes by the plain scalar definition.
void load_row_reference(const RowFormat& format, const std::byte* source, int pixels, float* row);
void store_row_reference(const RowFormat& format, const float* row, int pixels, std::byte* result);

/// A value in stored units, rounded half up and saturated; NaN is 0 in integers.
template <class T>
T rounded(float value) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    constexpr float kTop = full_range(kPixelTypeOf<T>);
    const float clamped = value > 0.0F ? std::min(value, kTop) : 0.0F;
    return static_cast<T>(static_cast<int>(clamped + 0.5F));
  }
}

/// Tables of the curve for u8.
struct ByteCurve {
  static constexpr std::uint32_t kLowest = 0x39000000;  ///< bits of 2⁻¹³, which is below the first threshold
  static constexpr std::size_t kBuckets = 13 * 128;     ///< octaves up to 1 × upper seven bits of the mantissa

  float linear[256];  ///< linear light of a stored value
  /// For f32 bits b in [kLowest, bits of 1): (encode[(b − kLowest) >> 16] + (b & 65535)) >> 16 is the stored value.
  /// A bucket holds at most one threshold; its entry is the value below it, times 65536, plus 65536 minus the
  /// lower bits of the threshold.
  std::uint32_t encode[kBuckets];
};
const ByteCurve& byte_curve();

/// Linear light as the nearest u8; NaN is 0.
std::uint8_t encode_byte(const ByteCurve& curve, float linear);

}  // namespace azulejo
