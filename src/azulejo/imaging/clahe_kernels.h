#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

/// How CLAHE keeps a tile's mapping, and maps with it.
///
/// u8        256 entries, 128 times the result of each value
/// u16, f32  1025 entries: the results, 0–1, at the ends of 1024 bins over 0–1
template <class T>
struct ClaheMapping {
  static constexpr bool kIsByte = sizeof(T) == 1;
  using Entry = std::conditional_t<kIsByte, std::int16_t, float>;
  static constexpr std::size_t kBins = kIsByte ? 256 : 1024;
  static constexpr std::size_t kEntries = kIsByte ? 256 : 1025;

  /// A value's place on the scale of bins. NaN is not asked for.
  static float place(T value) {
    if constexpr (std::is_same_v<T, float>) return (value > 0 ? (value < 1 ? value : 1.0F) : 0.0F) * 1024.0F;
    return (static_cast<float>(value) + 0.5F) * (static_cast<float>(kBins) / (full_range(kPixelTypeOf<T>) + 1.0F));
  }
  static std::size_t bin(T value) {
    if constexpr (kIsByte) return value;
    if constexpr (sizeof(T) == 2) return value / (65536 / kBins);
    return std::min(kBins - 1, static_cast<std::size_t>(place(value)));
  }
};

constexpr int kClaheUnit = 1 << 15;  ///< weights are parts of this, and less

/// a + (b − a) · weight / kClaheUnit: of entries of two mappings. Of bytes rounded to 1/128.
inline std::int16_t clahe_mix(std::int16_t a, std::int16_t b, int weight) {
  return static_cast<std::int16_t>(a + (((b - a) * weight + kClaheUnit / 2) >> 15));
}
inline float clahe_mix(float a, float b, int weight) {
  return a + (b - a) * (static_cast<float>(weight) * (1.0F / kClaheUnit));
}

/// What becomes of a byte of which the mappings left and right, mixed from above and below, are these entries.
inline std::uint8_t clahe_mapped(std::int16_t left, std::int16_t right, int weight) {
  return static_cast<std::uint8_t>((clahe_mix(left, right, weight) + 64) >> 7);
}

/// The same of other values; `left` and `right` are the entries at both ends of the value's bin.
template <class T>
T clahe_mapped(T value, const float left[2], const float right[2], int weight) {
  if (value != value) return value;
  const float part = ClaheMapping<T>::place(value) - static_cast<float>(ClaheMapping<T>::bin(value));
  const float low = clahe_mix(left[0], right[0], weight);
  const float high = clahe_mix(left[1], right[1], weight);
  const float mapped = low + (high - low) * part;
  if constexpr (std::is_same_v<T, float>) return mapped;
  return static_cast<T>(std::min(mapped * 65536.0F, 65535.0F));  // (u + ½) / 65536 stands for u, so ½ is in it
}

/// Maps the pixels between the centers of two tiles, in one row.
///
/// source   `count` values
/// tables   ClaheMapping<T>::kEntries of the tiles left above, right above, left below, right below
/// down     weight of those below
/// across   weights of those at the right, one a value
/// scratch  2 · kEntries entries
/// result   may be the source
template <class T>
struct ClaheStretch {
  const T* source;
  T* result;
  std::size_t count;
  const typename ClaheMapping<T>::Entry* tables[4];
  int down;
  const std::int16_t* across;
  typename ClaheMapping<T>::Entry* scratch;
};
void clahe_map(const ClaheStretch<std::uint8_t>& stretch);
void clahe_map(const ClaheStretch<std::uint16_t>& stretch);
void clahe_map(const ClaheStretch<float>& stretch);

/// The definition of both.
template <class T>
void clahe_map_reference(const ClaheStretch<T>& stretch) {
  const auto& tables = stretch.tables;
  for (std::size_t i = 0; i < stretch.count; ++i) {
    const T value = stretch.source[i];
    if (value != value) {
      stretch.result[i] = value;
      continue;
    }
    const std::size_t bin = ClaheMapping<T>::bin(value);
    const auto left = [&](std::size_t at) { return clahe_mix(tables[0][at], tables[2][at], stretch.down); };
    const auto right = [&](std::size_t at) { return clahe_mix(tables[1][at], tables[3][at], stretch.down); };
    if constexpr (sizeof(T) == 1) {
      stretch.result[i] = clahe_mapped(left(bin), right(bin), stretch.across[i]);
    } else {
      const float lefts[] = {left(bin), left(bin + 1)};
      const float rights[] = {right(bin), right(bin + 1)};
      stretch.result[i] = clahe_mapped(value, lefts, rights, stretch.across[i]);
    }
  }
}

/// color + (after − before) of straight color, saturated in integers.
template <class T>
T clahe_shifted(T color, T before, T after) {
  if constexpr (std::is_same_v<T, float>) {
    return color + (after - before);
  } else {
    const int top = static_cast<int>(full_range(kPixelTypeOf<T>));
    return static_cast<T>(std::clamp(color + (after - before), 0, top));
  }
}

/// Shifts the three colors of each pixel.
template <class T>
struct ClaheShift {
  const T* source;  ///< 3 or 4 channels; a fourth is copied
  const T* before;
  const T* after;
  T* result;  ///< may be the source
  std::size_t pixels;
  int channels;
};
void clahe_shift(const ClaheShift<std::uint8_t>& shift);
void clahe_shift(const ClaheShift<std::uint16_t>& shift);
void clahe_shift(const ClaheShift<float>& shift);

template <class T>
void clahe_shift_reference(const ClaheShift<T>& shift, std::size_t from = 0) {
  const auto channels = static_cast<std::size_t>(shift.channels);
  for (std::size_t i = from; i < shift.pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = i * channels + c;
      shift.result[at] = clahe_shifted(shift.source[at], shift.before[i], shift.after[i]);
    }
    if (channels == 4) shift.result[i * 4 + 3] = shift.source[i * 4 + 3];
  }
}

}  // namespace azulejo::kernels
