// How it is fast. A vector holds neighbouring values of a row. The columns of a window are sorted once for all windows
// that they are in, into rows of least, second … greatest values; a window's median then comes from those rows, loaded
// at each of its columns, by a network whose every step is known to the compiler. The smallest windows are faster without
// a detour by memory: their rows are sorted, which come from three loads.
#include "azulejo/imaging/median_kernels.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "azulejo/imaging/median_network.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/median_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/rank_key_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <int kSide>
struct Networks {
  static constexpr auto kColumn = sorting_network<kSide>();
  static constexpr auto kWindow = median_network<kSide>();
};

/// One step; a place that is met for the first time is loaded.
template <Exchange kStep, class V, class Load>
HWY_INLINE void Apply(V* HWY_RESTRICT values, const Load& load) {
  V& a = values[kStep.a];
  V& b = values[kStep.b];
  if constexpr (kStep.first_a) a = load.template At<kStep.a>();
  if constexpr (kStep.first_b) b = load.template At<kStep.b>();
  const V low = hn::Min(a, b);
  const V high = hn::Max(a, b);
  if constexpr (kStep.low) a = low;
  if constexpr (kStep.high) b = high;
}

template <const auto& kNet, std::size_t kFirst, class V, class Load, std::size_t... I>
HWY_INLINE void ApplySteps(V* HWY_RESTRICT values, const Load& load, std::index_sequence<I...>) {
  (Apply<kNet.steps[kFirst + I]>(values, load), ...);
}

/// All steps from kFirst on, some at a time: compilers limit the length of an expression.
template <const auto& kNet, std::size_t kFirst = 0, class V, class Load>
HWY_INLINE void ApplyAll(V* HWY_RESTRICT values, const Load& load) {
  constexpr std::size_t kCount = std::min<std::size_t>(64, static_cast<std::size_t>(kNet.count) - kFirst);
  ApplySteps<kNet, kFirst>(values, load, std::make_index_sequence<kCount>());
  if constexpr (kFirst + kCount < static_cast<std::size_t>(kNet.count)) ApplyAll<kNet, kFirst + kCount>(values, load);
}

/// Values by their row and column in a tile of values.
template <class D, int kSide>
struct WindowLoad {
  const hn::TFromD<D>* first;
  std::ptrdiff_t stride;
  std::ptrdiff_t tap;
  template <int kPlace>
  HWY_INLINE hn::Vec<D> At() const {
    return hn::LoadU(D(), first + (kPlace / kSide) * stride + (kPlace % kSide) * tap);
  }
};

template <int kSide, class D, std::size_t... I>
HWY_INLINE void SortColumns(D d, const hn::TFromD<D>* from, std::ptrdiff_t stride, hn::TFromD<D>* HWY_RESTRICT sorted,
                            std::ptrdiff_t sorted_stride, std::index_sequence<I...>) {
  constexpr const auto& kOrder = Networks<kSide>::kColumn.order;
  static constexpr auto kNet = Networks<kSide>::kColumn.net;
  hn::Vec<D> values[kSide];
  ApplyAll<kNet>(values, WindowLoad<D, 1>{from, stride, 0});
  (hn::StoreU(values[kOrder[static_cast<int>(I)]], d, sorted + static_cast<std::ptrdiff_t>(I) * sorted_stride), ...);
}

template <int kSide, class D>
HWY_INLINE hn::Vec<D> MedianOfWindow(D, const hn::TFromD<D>* sorted, std::ptrdiff_t stride, std::ptrdiff_t tap) {
  hn::Vec<D> values[kSide * kSide];
  ApplyAll<Networks<kSide>::kWindow>(values, WindowLoad<D, kSide>{sorted, stride, tap});
  return values[Networks<kSide>::kWindow.result];
}

/// f(i) for whole vectors that make up count ≥ lanes values; the last one is moved back.
template <class F>
HWY_INLINE void ForVectors(std::ptrdiff_t count, std::ptrdiff_t lanes, const F& f) {
  std::ptrdiff_t i = 0;
  for (; i + lanes <= count; i += lanes) f(i);
  if (i < count) f(count - lanes);
}

/// Keys of a tile's values and the values around it, and where the results go. Strides in values.
template <class T>
struct KeyTile {
  const RankKey<T>* source;
  std::ptrdiff_t source_stride;
  T* result;
  std::ptrdiff_t result_stride;
  std::ptrdiff_t count;  ///< values of a row of results
  std::ptrdiff_t tap;    ///< from a value to that of the next pixel
  int height;
};

/// At least a vector of results in a row.
template <int kSide, class T>
void Windows(const KeyTile<T>& tile, Scratch& scratch) {
  using Key = RankKey<T>;
  constexpr std::ptrdiff_t kCacheBytes = 24 << 10;  // of sorted columns: they stay in the first-level cache
  const hn::ScalableTag<Key> d;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  const std::ptrdiff_t margin = (kSide - 1) * tile.tap;
  const std::ptrdiff_t fitting = kCacheBytes / (kSide * static_cast<std::ptrdiff_t>(sizeof(Key))) - margin;
  const std::ptrdiff_t panel = std::max(fitting / lanes * lanes, 4 * lanes);
  const std::ptrdiff_t stride = (std::min(panel, tile.count) + margin + 2 * lanes) / lanes * lanes;
  Key* const sorted = scratch.take<Key>(static_cast<std::size_t>(kSide * stride));
  for (std::ptrdiff_t left = 0; left < tile.count; left += panel) {
    // The last panel is moved back where it would be shorter than a vector.
    const std::ptrdiff_t begin = std::min(left, tile.count - lanes);
    const std::ptrdiff_t values = std::min(panel, tile.count - begin);
    for (int y = 0; y < tile.height; ++y) {
      const Key* const source = tile.source + y * tile.source_stride + begin;
      T* const result = tile.result + y * tile.result_stride + begin;
      ForVectors(values + margin, lanes, [&](std::ptrdiff_t i) HWY_ATTR {
        SortColumns<kSide>(d, source + i, tile.source_stride, sorted + i, stride, std::make_index_sequence<kSide>());
      });
      ForVectors(values, lanes, [&](std::ptrdiff_t i) HWY_ATTR {
        StoreKeys(d, MedianOfWindow<kSide>(d, sorted + i, stride, tile.tap), result + i);
      });
    }
  }
}

/// The three values beside each other in each of the windows' rows, in ascending order.
template <class V>
struct Triple {
  V low;
  V middle;
  V high;
};

template <class D>
HWY_INLINE Triple<hn::Vec<D>> SortedTriple(D d, const hn::TFromD<D>* from, std::ptrdiff_t tap) {
  const auto a = hn::LoadU(d, from);
  const auto b = hn::LoadU(d, from + tap);
  const auto c = hn::LoadU(d, from + 2 * tap);
  const auto low = hn::Min(a, b);
  const auto high = hn::Max(a, b);
  const auto rest = hn::Min(high, c);
  return {hn::Min(low, rest), hn::Max(low, rest), hn::Max(high, c)};
}

/// What two rows contribute to windows that they are both in.
template <class V>
struct TwoRows {
  V low;  ///< the greater of the least values
  V middle_low;
  V middle_high;
  V high;  ///< the lesser of the greatest
};

template <class V>
HWY_INLINE TwoRows<V> Joined(const Triple<V>& a, const Triple<V>& b) {
  return {hn::Max(a.low, b.low), hn::Min(a.middle, b.middle), hn::Max(a.middle, b.middle), hn::Min(a.high, b.high)};
}

template <class V>
HWY_INLINE V MedianOf(V a, V b, V c) {
  return hn::Max(hn::Min(a, b), hn::Min(hn::Max(a, b), c));
}

/// The middle one of the greatest of the low values, the median of the middle ones, the least of the high ones.
template <class V>
HWY_INLINE V MedianOf(const TwoRows<V>& two, const Triple<V>& third) {
  const V middle = hn::Max(two.middle_low, hn::Min(two.middle_high, third.middle));
  return MedianOf(hn::Max(two.low, third.low), middle, hn::Min(two.high, third.high));
}

/// Windows of 3 × 3, at least four rows: four windows below each other at once share all that can be shared.
template <class T>
void SmallWindows(const KeyTile<T>& tile) {
  using Key = RankKey<T>;
  constexpr int kRows = 4;
  const hn::ScalableTag<Key> d;
  for (int top = 0; top < tile.height; top += kRows) {
    const int y = std::min(top, tile.height - kRows);
    const Key* const source = tile.source + y * tile.source_stride;
    T* const result = tile.result + y * tile.result_stride;
    ForVectors(tile.count, static_cast<std::ptrdiff_t>(hn::Lanes(d)), [&](std::ptrdiff_t i) HWY_ATTR {
      const auto row = [&](int r) HWY_ATTR { return SortedTriple(d, source + r * tile.source_stride + i, tile.tap); };
      const auto store = [&](int r, hn::Vec<decltype(d)> median)
                             HWY_ATTR { StoreKeys(d, median, result + r * tile.result_stride + i); };
      const auto second = row(1);
      const auto third = row(2);
      const auto upper = Joined(second, third);
      store(0, MedianOf(upper, row(0)));
      const auto fourth = row(3);
      store(1, MedianOf(upper, fourth));
      const auto lower = Joined(fourth, row(4));
      store(2, MedianOf(lower, third));
      store(3, MedianOf(lower, row(5)));
    });
  }
}

template <int kSide, class T>
void AnyWindows(const KeyTile<T>& tile, Scratch& scratch) {
  if (kSide == 3 && tile.height >= 4) return SmallWindows(tile);
  Windows<kSide>(tile, scratch);
}

/// Rows shorter than a vector go through padded memory, as floats do to become keys.
template <int kSide, class T>
void Median(const WindowTile<T>& tile, std::ptrdiff_t tap, Scratch& scratch) {
  using Key = RankKey<T>;
  const hn::ScalableTag<Key> d;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  const std::ptrdiff_t count = tile.width * tap;
  const bool narrow = count < lanes;
  KeyTile<T> keys{nullptr, tile.source_stride, tile.result, tile.result_stride, count, tap, tile.height};
  if constexpr (std::is_same_v<T, Key>) keys.source = tile.source;
  if (narrow || !std::is_same_v<T, Key>) {
    const std::ptrdiff_t used = (tile.width + kSide - 1) * tap;
    const std::ptrdiff_t stride = (std::max(used, lanes + (kSide - 1) * tap) + lanes - 1) / lanes * lanes;
    Key* const copy = scratch.take<Key>(static_cast<std::size_t>(stride * (tile.height + kSide - 1)));
    for (int y = 0; y < tile.height + kSide - 1; ++y) {
      const T* const from = tile.source + y * tile.source_stride;
      Key* const to = copy + y * stride;
      std::ptrdiff_t i = 0;
      for (; i + lanes <= used; i += lanes) hn::Store(LoadKeys(d, from + i), d, to + i);
      for (; i < used; ++i) to[i] = rank_key(from[i]);
      std::fill(to + used, to + stride, Key{0});
    }
    keys.source = copy;
    keys.source_stride = stride;
  }
  if (!narrow) return AnyWindows<kSide>(keys, scratch);
  keys.result = scratch.take<T>(static_cast<std::size_t>(lanes * tile.height));
  keys.result_stride = lanes;
  keys.count = lanes;
  AnyWindows<kSide>(keys, scratch);
  for (int y = 0; y < tile.height; ++y) {
    std::copy_n(keys.result + y * lanes, count, tile.result + y * tile.result_stride);
  }
}

template <class T>
void ByNetwork(const WindowTile<T>& tile, int channels, int radius, Scratch& scratch) {
  static_assert(kNetworkRadius == 4);
  switch (radius) {
    case 1: return Median<3>(tile, channels, scratch);
    case 2: return Median<5>(tile, channels, scratch);
    case 3: return Median<7>(tile, channels, scratch);
    default: return Median<9>(tile, channels, scratch);
  }
}

void NetworkU8(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch) {
  ByNetwork(tile, channels, radius, scratch);
}
void NetworkU16(const WindowTile<std::uint16_t>& tile, int channels, int radius, Scratch& scratch) {
  ByNetwork(tile, channels, radius, scratch);
}
void NetworkF32(const WindowTile<float>& tile, int channels, int radius, Scratch& scratch) {
  ByNetwork(tile, channels, radius, scratch);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(NetworkU8);
HWY_EXPORT(NetworkU16);
HWY_EXPORT(NetworkF32);

void median_by_network(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(NetworkU8)(tile, channels, radius, scratch);
}
void median_by_network(const WindowTile<std::uint16_t>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(NetworkU16)(tile, channels, radius, scratch);
}
void median_by_network(const WindowTile<float>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(NetworkF32)(tile, channels, radius, scratch);
}

}  // namespace azulejo::kernels
#endif
