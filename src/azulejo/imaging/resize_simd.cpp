#include <algorithm>
#include <cstdint>

#include "azulejo/imaging/resize_kernels.h"
#include "azulejo/imaging/resize_taps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/resize_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

/// Σ weights[t] · rows[t][i …] for kVectors vectors.
template <std::size_t kVectors>
HWY_INLINE void SumAt(const float* const* rows, const float* weights, int count, std::size_t i, V (&sum)[kVectors]) {
  const D d;
  V weight = hn::Set(d, weights[0]);
  for (std::size_t v = 0; v < kVectors; ++v) sum[v] = hn::Mul(weight, hn::LoadU(d, rows[0] + i + v * kLanes));
  for (int t = 1; t < count; ++t) {
    weight = hn::Set(d, weights[t]);
    const float* const row = rows[t] + i;
    for (std::size_t v = 0; v < kVectors; ++v)
      sum[v] = hn::Add(sum[v], hn::Mul(weight, hn::LoadU(d, row + v * kLanes)));
  }
}

/// Calls f(i, sums) for all values: four vectors at a time, then one.
template <class F>
HWY_INLINE void ForSums(const float* const* rows, const float* weights, int count, std::size_t values, F f) {
  std::size_t i = 0;
  for (; i + 4 * kLanes <= values; i += 4 * kLanes) {
    V sum[4];
    SumAt(rows, weights, count, i, sum);
    for (std::size_t v = 0; v < 4; ++v) f(i + v * kLanes, sum[v]);
  }
  for (; i < values; i += kLanes) {
    V sum[1];
    SumAt(rows, weights, count, i, sum);
    f(i, sum[0]);
  }
}

void SumRows(const float* const* rows, const float* weights, int count, float* result, std::size_t values) {
  ForSums(rows, weights, count, values, [&](std::size_t i, V sum) HWY_ATTR { hn::StoreU(sum, D(), result + i); });
}

void AddRows(const float* const* rows, const float* weights, int count, float* total, float* compensation,
             std::size_t values) {
  const D d;
  ForSums(rows, weights, count, values, [&](std::size_t i, V sum) HWY_ATTR {
    const V before = hn::LoadU(d, total + i);
    const V corrected = hn::Sub(sum, hn::LoadU(d, compensation + i));
    const V after = hn::Add(before, corrected);
    hn::StoreU(hn::Sub(hn::Sub(after, before), corrected), d, compensation + i);
    hn::StoreU(after, d, total + i);
  });
}

/// Column and channel of each value of a block of interleaved values, counted from the column where it begins.
struct Pattern {
  HWY_ALIGN std::int32_t column[kLanes];
  HWY_ALIGN std::int32_t channel[kLanes];
};

/// Enlarges kRows rows. For each tap, a vector of result values comes from source values that lie within one vector's
/// length, so a tap is one load and one permutation.
template <int kChannels, int kRows>
void EnlargeSome(const Columns& columns, const float* const* rows, float* const* results) {
  const D d;
  const DI di;
  constexpr int kPhases = kChannels == 3 ? 3 : 1;
  Pattern patterns[kPhases];
  for (int phase = 0; phase < kPhases; ++phase) {
    const int begin = phase * static_cast<int>(kLanes) % kChannels;
    for (int lane = 0; lane < static_cast<int>(kLanes); ++lane) {
      patterns[phase].column[lane] = (begin + lane) / kChannels;
      patterns[phase].channel[lane] = (begin + lane) % kChannels;
    }
  }
  const std::size_t values = static_cast<std::size_t>(columns.count) * kChannels;
  int phase = 0;
  for (std::size_t i = 0; i < values; i += kLanes) {
    const std::size_t x = i / kChannels;
    const Pattern& pattern = patterns[phase];
    const auto column = hn::SetTableIndices(d, pattern.column);
    const auto channel = hn::Load(di, pattern.channel);
    phase = phase + 1 == kPhases ? 0 : phase + 1;
    // Where the values of the first tap lie, from `base` on.
    auto source = hn::LoadU(di, columns.first + x);
    if constexpr (kChannels > 1) {
      source = hn::BitCast(di, hn::TableLookupLanes(hn::BitCast(d, source), column));
      source = hn::Add(hn::Mul(source, hn::Set(di, kChannels)), channel);
    }
    // The lowest of them: the first value's, or channel 0 of the next pixel where that has the same window.
    const int* const first = columns.first + x;
    const std::int32_t base = first[0] * kChannels + (first[1] == first[0] ? 0 : pattern.channel[0]);
    const auto indices = hn::IndicesFromVec(d, hn::Sub(source, hn::Set(di, base)));
    const std::ptrdiff_t offset = base - std::ptrdiff_t{columns.source_begin} * kChannels;
    V sum[kRows];
    for (int t = 0; t < columns.taps; ++t) {
      V weight = hn::LoadU(d, columns.by_tap + t * columns.by_tap_stride + x);
      if constexpr (kChannels > 1) weight = hn::TableLookupLanes(weight, column);
      for (int r = 0; r < kRows; ++r) {
        const V value = hn::TableLookupLanes(hn::LoadU(d, rows[r] + offset + t * kChannels), indices);
        sum[r] = t == 0 ? hn::Mul(weight, value) : hn::Add(sum[r], hn::Mul(weight, value));
      }
    }
    for (int r = 0; r < kRows; ++r) hn::StoreU(sum[r], d, results[r] + i);
  }
}

template <int kChannels>
void EnlargeRows(const Columns& columns, const float* const* rows, int row_count, float* const* results) {
  int r = 0;
  for (; r + 4 <= row_count; r += 4) EnlargeSome<kChannels, 4>(columns, rows + r, results + r);
  for (; r < row_count; ++r) EnlargeSome<kChannels, 1>(columns, rows + r, results + r);
}

void EnlargeColumns(const Columns& columns, const float* const* rows, int row_count, float* const* results) {
  switch (columns.channels) {
    case 1: return EnlargeRows<1>(columns, rows, row_count, results);
    case 2: return EnlargeRows<2>(columns, rows, row_count, results);
    case 3: return EnlargeRows<3>(columns, rows, row_count, results);
    default: return EnlargeRows<4>(columns, rows, row_count, results);
  }
}

/// A vector of four neighbouring values of each of kLanes / 4 rows: rows[0], rows[4], ….
template <class DV>
HWY_INLINE hn::Vec<DV> LoadBlocks(DV d, const float* const* rows, std::size_t i) {
  if constexpr (hn::MaxLanes(DV()) <= 4) {
    return hn::LoadU(d, rows[0] + i);
  } else {
    const hn::Half<DV> half;
    return hn::Combine(d, LoadBlocks(half, rows + hn::MaxLanes(half), i), LoadBlocks(half, rows, i));
  }
}

template <class DV>
HWY_INLINE void StoreBlocks(DV d, hn::Vec<DV> v, float* const* rows, std::size_t i) {
  if constexpr (hn::MaxLanes(DV()) <= 4) {
    hn::StoreU(v, d, rows[0] + i);
  } else {
    const hn::Half<DV> half;
    StoreBlocks(half, hn::LowerHalf(half, v), rows, i);
    StoreBlocks(half, hn::UpperHalf(half, v), rows + hn::MaxLanes(half), i);
  }
}

/// Transposes the four-by-four blocks of 128 bits.
HWY_INLINE void TransposeBlocks(V& a, V& b, V& c, V& e) {
  const D d;
  const hn::Repartition<double, D> dd;
  const auto ab_low = hn::BitCast(dd, hn::InterleaveLower(d, a, b));
  const auto ab_high = hn::BitCast(dd, hn::InterleaveUpper(d, a, b));
  const auto ce_low = hn::BitCast(dd, hn::InterleaveLower(d, c, e));
  const auto ce_high = hn::BitCast(dd, hn::InterleaveUpper(d, c, e));
  a = hn::BitCast(d, hn::InterleaveLower(dd, ab_low, ce_low));
  b = hn::BitCast(d, hn::InterleaveUpper(dd, ab_low, ce_low));
  c = hn::BitCast(d, hn::InterleaveLower(dd, ab_high, ce_high));
  e = hn::BitCast(d, hn::InterleaveUpper(dd, ab_high, ce_high));
}

/// panel[i · kLanes + r] = rows[r][i]
void RowsToPanel(const float* const* rows, std::size_t values, float* panel) {
  const D d;
  for (std::size_t i = 0; i < values; i += 4) {
    V a = LoadBlocks(d, rows, i);
    V b = LoadBlocks(d, rows + 1, i);
    V c = LoadBlocks(d, rows + 2, i);
    V e = LoadBlocks(d, rows + 3, i);
    TransposeBlocks(a, b, c, e);
    hn::Store(a, d, panel + (i + 0) * kLanes);
    hn::Store(b, d, panel + (i + 1) * kLanes);
    hn::Store(c, d, panel + (i + 2) * kLanes);
    hn::Store(e, d, panel + (i + 3) * kLanes);
  }
}

void PanelToRows(const float* panel, std::size_t values, float* const* rows) {
  const D d;
  for (std::size_t i = 0; i < values; i += 4) {
    V a = hn::Load(d, panel + (i + 0) * kLanes);
    V b = hn::Load(d, panel + (i + 1) * kLanes);
    V c = hn::Load(d, panel + (i + 2) * kLanes);
    V e = hn::Load(d, panel + (i + 3) * kLanes);
    TransposeBlocks(a, b, c, e);
    StoreBlocks(d, a, rows, i);
    StoreBlocks(d, b, rows + 1, i);
    StoreBlocks(d, c, rows + 2, i);
    StoreBlocks(d, e, rows + 3, i);
  }
}

/// Sums of `count` products for kColumns result pixels; values of a panel, kLanes rows at a time.
template <int kChannels, int kColumns>
HWY_INLINE void SumPanel(const float* const (&from)[kColumns], const float* const (&weights)[kColumns], int count,
                         V (&sum)[kColumns][kChannels]) {
  const D d;
  for (int t = 0; t < count; ++t) {
    for (int x = 0; x < kColumns; ++x) {
      const V weight = hn::Set(d, weights[x][t]);
      for (int c = 0; c < kChannels; ++c) {
        const V product = hn::Mul(weight, hn::Load(d, from[x] + static_cast<std::size_t>(t * kChannels + c) * kLanes));
        sum[x][c] = t == 0 ? product : hn::Add(sum[x][c], product);
      }
    }
  }
}

template <int kChannels, int kColumns>
HWY_INLINE void ShrinkSome(const Columns& columns, const float* panel, int x, float* result) {
  const D d;
  const float* from[kColumns];
  const float* weights[kColumns];
  V sum[kColumns][kChannels];
  for (int k = 0; k < kColumns; ++k) {
    from[k] = panel + static_cast<std::ptrdiff_t>(columns.first[x + k] - columns.source_begin) * kChannels *
                          static_cast<std::ptrdiff_t>(kLanes);
    weights[k] = columns.weights + static_cast<std::ptrdiff_t>(x + k) * columns.taps;
  }
  SumPanel<kChannels, kColumns>(from, weights, columns.taps, sum);
  for (int k = 0; k < kColumns; ++k) {
    for (int c = 0; c < kChannels; ++c)
      hn::Store(sum[k][c], d, result + static_cast<std::size_t>((x + k) * kChannels + c) * kLanes);
  }
}

/// One result pixel with more than kTapBlock taps.
template <int kChannels>
HWY_INLINE void ShrinkByBlocks(const Columns& columns, const float* panel, int x, float* result) {
  const D d;
  V total[kChannels];
  V compensation[kChannels];
  for (int c = 0; c < kChannels; ++c) total[c] = compensation[c] = hn::Zero(d);
  const int first = columns.first[x];
  const int end = first + columns.taps;
  for (int from = first; from < end;) {
    const int to = std::min(from / kTapBlock * kTapBlock + kTapBlock, end);
    const float* const place[1] = {panel + static_cast<std::ptrdiff_t>(from - columns.source_begin) * kChannels *
                                               static_cast<std::ptrdiff_t>(kLanes)};
    const float* const weights[1] = {columns.weights + static_cast<std::ptrdiff_t>(x) * columns.taps + (from - first)};
    V sum[1][kChannels];
    SumPanel<kChannels, 1>(place, weights, to - from, sum);
    for (int c = 0; c < kChannels; ++c) {
      const V corrected = hn::Sub(sum[0][c], compensation[c]);
      const V after = hn::Add(total[c], corrected);
      compensation[c] = hn::Sub(hn::Sub(after, total[c]), corrected);
      total[c] = after;
    }
    from = to;
  }
  for (int c = 0; c < kChannels; ++c)
    hn::Store(total[c], d, result + static_cast<std::size_t>(x * kChannels + c) * kLanes);
}

template <int kChannels>
void ShrinkPanel(const Columns& columns, const float* panel, float* result) {
  constexpr int kTogether = kChannels == 1 ? 4 : 2;  // independent sums hide the latency of additions
  int x = 0;
  if (columns.taps <= kTapBlock) {
    for (; x + kTogether <= columns.count; x += kTogether) ShrinkSome<kChannels, kTogether>(columns, panel, x, result);
    for (; x < columns.count; ++x) ShrinkSome<kChannels, 1>(columns, panel, x, result);
  } else {
    for (; x < columns.count; ++x) ShrinkByBlocks<kChannels>(columns, panel, x, result);
  }
}

std::size_t Padded(int pixels, int channels) {
  return (static_cast<std::size_t>(pixels) * static_cast<std::size_t>(channels) + 3) / 4 * 4;
}

void ShrinkColumns(const Columns& columns, const float* const* rows, int row_count, float* panel,
                   float* const* results) {
  const std::size_t source_values = Padded(columns.source_count, columns.channels);
  const std::size_t result_values = Padded(columns.count, columns.channels);
  float* const result = panel + source_values * kLanes;
  for (int r = 0; r < row_count; r += static_cast<int>(kLanes)) {
    RowsToPanel(rows + r, source_values, panel);
    switch (columns.channels) {
      case 1: ShrinkPanel<1>(columns, panel, result); break;
      case 2: ShrinkPanel<2>(columns, panel, result); break;
      case 3: ShrinkPanel<3>(columns, panel, result); break;
      default: ShrinkPanel<4>(columns, panel, result); break;
    }
    PanelToRows(result, result_values, results + r);
  }
}

/// The sums of neighbouring u16 lanes, plus 2, divided by 4.
HWY_INLINE hn::Vec<hn::Rebind<std::uint8_t, DI>> QuarterOfPairs(hn::Vec<hn::Repartition<std::uint16_t, DI>> v) {
  const DI di;
  const auto pairs = hn::BitCast(di, v);
  const auto sum = hn::Add(hn::And(pairs, hn::Set(di, 0xFFFF)), hn::ShiftRight<16>(pairs));
  return hn::DemoteTo(hn::Rebind<std::uint8_t, DI>(), hn::ShiftRight<2>(hn::Add(sum, hn::Set(di, 2))));
}

/// kLanes result pixels.
template <int kChannels>
HWY_INLINE void HalveSome(const std::uint16_t* sums, std::uint8_t* result) {
  const hn::Repartition<std::uint16_t, DI> du;
  const hn::Rebind<std::uint8_t, DI> db;
  hn::Vec<decltype(du)> a, b, c, e;
  if constexpr (kChannels == 1) {
    hn::StoreU(QuarterOfPairs(hn::LoadU(du, sums)), db, result);
  } else if constexpr (kChannels == 2) {
    hn::LoadInterleaved2(du, sums, a, b);
    hn::StoreInterleaved2(QuarterOfPairs(a), QuarterOfPairs(b), db, result);
  } else if constexpr (kChannels == 3) {
    hn::LoadInterleaved3(du, sums, a, b, c);
    hn::StoreInterleaved3(QuarterOfPairs(a), QuarterOfPairs(b), QuarterOfPairs(c), db, result);
  } else {
    hn::LoadInterleaved4(du, sums, a, b, c, e);
    hn::StoreInterleaved4(QuarterOfPairs(a), QuarterOfPairs(b), QuarterOfPairs(c), QuarterOfPairs(e), db, result);
  }
}

template <int kChannels>
void HalvePairs(const std::uint16_t* sums, std::size_t count, std::uint8_t* result) {
  std::size_t x = 0;
  for (; x + kLanes <= count; x += kLanes) HalveSome<kChannels>(sums + 2 * x * kChannels, result + x * kChannels);
  for (std::size_t i = x * kChannels; i < count * kChannels; ++i) {
    const std::size_t left = i + i / kChannels * kChannels;
    result[i] = static_cast<std::uint8_t>((sums[left] + sums[left + kChannels] + 2) / 4);
  }
}

void HalveRows(const std::uint8_t* upper, const std::uint8_t* lower, int count, int channels, std::uint16_t* sums,
               std::uint8_t* result) {
  const hn::Repartition<std::uint16_t, DI> du;
  const hn::Rebind<std::uint8_t, decltype(du)> db;
  const auto pixels = static_cast<std::size_t>(count);
  const std::size_t values = 2 * pixels * static_cast<std::size_t>(channels);
  std::size_t i = 0;
  for (; i + 2 * kLanes <= values; i += 2 * kLanes) {
    hn::StoreU(hn::Add(hn::PromoteTo(du, hn::LoadU(db, upper + i)), hn::PromoteTo(du, hn::LoadU(db, lower + i))), du,
               sums + i);
  }
  for (; i < values; ++i) sums[i] = static_cast<std::uint16_t>(upper[i] + lower[i]);
  switch (channels) {
    case 1: return HalvePairs<1>(sums, pixels, result);
    case 2: return HalvePairs<2>(sums, pixels, result);
    case 3: return HalvePairs<3>(sums, pixels, result);
    default: return HalvePairs<4>(sums, pixels, result);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(SumRows);
HWY_EXPORT(AddRows);
HWY_EXPORT(EnlargeColumns);
HWY_EXPORT(ShrinkColumns);
HWY_EXPORT(HalveRows);

void prefetch(const std::byte* memory, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; i += 64) hwy::Prefetch(memory + i);
}

void sum_rows(const float* const* rows, const float* weights, int count, float* result, std::size_t values) {
  HWY_DYNAMIC_DISPATCH(SumRows)(rows, weights, count, result, values);
}

void add_rows(const float* const* rows, const float* weights, int count, float* total, float* compensation,
              std::size_t values) {
  HWY_DYNAMIC_DISPATCH(AddRows)(rows, weights, count, total, compensation, values);
}

void enlarge_columns(const Columns& columns, const float* const* rows, int row_count, float* const* results) {
  HWY_DYNAMIC_DISPATCH(EnlargeColumns)(columns, rows, row_count, results);
}

void shrink_columns(const Columns& columns, const float* const* rows, int row_count, float* panel,
                    float* const* results) {
  HWY_DYNAMIC_DISPATCH(ShrinkColumns)(columns, rows, row_count, panel, results);
}

void halve_rows(const std::uint8_t* upper, const std::uint8_t* lower, int count, int channels, std::uint16_t* sums,
                std::uint8_t* result) {
  HWY_DYNAMIC_DISPATCH(HalveRows)(upper, lower, count, channels, sums, result);
}

std::size_t panel_values(const Columns& columns) {
  const auto values = [&](int pixels) {
    return (static_cast<std::size_t>(pixels) * static_cast<std::size_t>(columns.channels) + 3) / 4 * 4;
  };
  return (values(columns.source_count) + values(columns.count)) * kPanelRows;
}

}  // namespace azulejo::kernels
#endif
