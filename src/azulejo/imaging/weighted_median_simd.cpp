// How it is fast. The bits of the median are found one after the other, the highest first: a bit is set if what is below the
// value that it would make weighs less than half. Nothing is sorted, and all values of a vector go the same way.
#include "azulejo/imaging/weighted_median_kernels.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "azulejo/imaging/rank_key.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/weighted_median_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The vectors of a tap.
template <class K>
struct Tap {
  std::ptrdiff_t place;
  K weight;
};

/// The order of T in integers with a sign, at least as wide, in which weights are added up, too.
template <class T, class K>
K SignedKey(T value) {
  if constexpr (std::is_same_v<T, float>) {
    return rank_key(value);
  } else if constexpr (sizeof(T) == sizeof(K)) {
    return static_cast<K>(value ^ (T{1} << (8 * sizeof(T) - 1)));
  } else {
    return static_cast<K>(value);
  }
}
template <class T, class K>
T ValueOf(K key) {
  if constexpr (std::is_same_v<T, float>) {
    return ranked_value<float>(key);
  } else if constexpr (sizeof(T) == sizeof(K)) {
    return static_cast<T>(key ^ std::numeric_limits<K>::min());
  } else {
    return static_cast<T>(key);
  }
}

/// kTogether vectors of medians, from the keys of the first tap's rows and columns on.
template <class T, class K, int kTogether>
HWY_INLINE void Medians(const K* HWY_RESTRICT keys, const Tap<K>* HWY_RESTRICT taps, std::size_t count, K half,
                        K* HWY_RESTRICT medians) {
  const hn::ScalableTag<K> d;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  constexpr int kBits = 8 * static_cast<int>(sizeof(T));
  const K lowest = sizeof(T) == sizeof(K) ? std::numeric_limits<K>::min() : K{0};
  hn::Vec<decltype(d)> median[kTogether];
  for (auto& each : median) each = hn::Set(d, lowest);
  for (int bit = kBits - 1; bit >= 0; --bit) {
    // The highest bit of a key as wide as its type makes it not negative.
    const auto raise = hn::Set(d, static_cast<K>(std::make_unsigned_t<K>{1} << bit));
    hn::Vec<decltype(d)> candidate[kTogether];
    hn::Vec<decltype(d)> below[kTogether];
    for (int v = 0; v < kTogether; ++v) {
      candidate[v] = hn::Xor(median[v], raise);
      below[v] = hn::Zero(d);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto weight = hn::Set(d, taps[k].weight);
      for (int v = 0; v < kTogether; ++v) {
        const auto less = hn::Lt(hn::LoadU(d, keys + taps[k].place + v * lanes), candidate[v]);
        below[v] = hn::Add(below[v], hn::IfThenElseZero(less, weight));
      }
    }
    for (int v = 0; v < kTogether; ++v) {
      median[v] = hn::IfThenElse(hn::Lt(below[v], hn::Set(d, half)), candidate[v], median[v]);
    }
  }
  for (int v = 0; v < kTogether; ++v) hn::StoreU(median[v], d, medians + v * lanes);
}

template <class T, class K>
void Tile(const WindowTile<T>& tile, std::ptrdiff_t channels, const WeightedWindow& window, Scratch& scratch) {
  constexpr int kTogether = 4;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(hn::ScalableTag<K>()));
  const std::ptrdiff_t used = (tile.width + window.columns - 1) * channels;
  const std::ptrdiff_t count = tile.width * channels;
  const std::ptrdiff_t stride = used + kTogether * lanes;
  K* const keys = scratch.take<K>(static_cast<std::size_t>(stride * (tile.height + window.rows - 1)));
  for (int y = 0; y < tile.height + window.rows - 1; ++y) {
    const T* const from = tile.source + y * tile.source_stride;
    K* const to = keys + y * stride;
    for (std::ptrdiff_t i = 0; i < used; ++i) to[i] = SignedKey<T, K>(from[i]);
    std::fill(to + used, to + stride, K{0});
  }
  Tap<K>* const taps = scratch.take<Tap<K>>(window.taps.size());
  for (std::size_t k = 0; k < window.taps.size(); ++k) {
    const WeightedTap& tap = window.taps[k];
    taps[k] = {tap.dy * stride + tap.dx * channels, static_cast<K>(tap.weight)};
  }
  // The median is at least what has less than half of the weight below it.
  const auto half = static_cast<K>((window.total + 1) / 2);
  K* const medians = scratch.take<K>(static_cast<std::size_t>(kTogether * lanes));
  for (int y = 0; y < tile.height; ++y) {
    T* const result = tile.result + y * tile.result_stride;
    for (std::ptrdiff_t i = 0; i < count; i += kTogether * lanes) {
      Medians<T, K, kTogether>(keys + y * stride + i, taps, window.taps.size(), half, medians);
      const std::ptrdiff_t some = std::min(kTogether * lanes, count - i);
      for (std::ptrdiff_t k = 0; k < some; ++k) result[i + k] = ValueOf<T, K>(medians[k]);
    }
  }
}

void WeightedU8(const WindowTile<std::uint8_t>& tile, int channels, const WeightedWindow& window, Scratch& scratch) {
  window.total <= 127 ? Tile<std::uint8_t, std::int8_t>(tile, channels, window, scratch)
                      : Tile<std::uint8_t, std::int16_t>(tile, channels, window, scratch);
}
void WeightedU16(const WindowTile<std::uint16_t>& tile, int channels, const WeightedWindow& window, Scratch& scratch) {
  Tile<std::uint16_t, std::int16_t>(tile, channels, window, scratch);
}
void WeightedF32(const WindowTile<float>& tile, int channels, const WeightedWindow& window, Scratch& scratch) {
  Tile<float, std::int32_t>(tile, channels, window, scratch);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(WeightedU8);
HWY_EXPORT(WeightedU16);
HWY_EXPORT(WeightedF32);

void weighted_median_tile(const WindowTile<std::uint8_t>& tile, int channels, const WeightedWindow& window,
                          Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(WeightedU8)(tile, channels, window, scratch);
}
void weighted_median_tile(const WindowTile<std::uint16_t>& tile, int channels, const WeightedWindow& window,
                          Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(WeightedU16)(tile, channels, window, scratch);
}
void weighted_median_tile(const WindowTile<float>& tile, int channels, const WeightedWindow& window, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(WeightedF32)(tile, channels, window, scratch);
}

}  // namespace azulejo::kernels
#endif
