// How it is fast. A lane holds two neighboring bytes as halves of 16 bits, so one instruction weighs both and adds
// them, and what was loaded serves all rows of results that read it.
#include "azulejo/imaging/convolve_bytes.h"

#include <cstring>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/convolve_bytes_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using ShortTag = hn::Repartition<std::int16_t, IntTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Shorts = hn::Vec<ShortTag>;

/// Vectors of a row at once: as many sums as there are registers for.
constexpr int kVectors = HWY_MAX_BYTES == 64 ? 4 : 2;

HWY_INLINE Ints WeighedPairs(Shorts pairs, Shorts weights) {
#if HWY_TARGET == HWY_AVX3
  return Ints{_mm512_madd_epi16(pairs.raw, weights.raw)};
#elif HWY_TARGET == HWY_AVX2
  return Ints{_mm256_madd_epi16(pairs.raw, weights.raw)};
#elif HWY_TARGET == HWY_SSE4
  return Ints{_mm_madd_epi16(pairs.raw, weights.raw)};
#else
  const IntTag d;
  const Ints even = hn::Mul(hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::BitCast(d, pairs))),
                            hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::BitCast(d, weights))));
  const Ints odd = hn::Mul(hn::ShiftRight<16>(hn::BitCast(d, pairs)), hn::ShiftRight<16>(hn::BitCast(d, weights)));
  return hn::Add(even, odd);
#endif
}

/// Values as whole numbers from 0 to 255, cut.
HWY_INLINE Ints Cut(Floats value) {
  const FloatTag d;
  const Floats inside = hn::Min(hn::Max(value, hn::Zero(d)), hn::Set(d, 255.0F));
#if HWY_TARGET == HWY_AVX3
  return Ints{_mm512_cvttps_epi32(inside.raw)};  // ConvertTo would look for what is too large
#else
  return hn::ConvertTo(IntTag(), inside);
#endif
}

template <int kWide>
HWY_INLINE void Write(const Floats* values, float* to) {
#pragma GCC unroll 4
  for (int v = 0; v < kWide; ++v) hn::StoreU(values[v], FloatTag(), to + v * static_cast<int>(hn::Lanes(FloatTag())));
}
template <int kWide>
HWY_INLINE void Write(const Floats* values, std::uint8_t* to) {
#if HWY_TARGET == HWY_AVX3
  if constexpr (kWide == 4) {
    // Packing leaves four bytes of each vector side by side in each block: a 4 × 4 matrix of such words.
    const __m512i first = _mm512_packs_epi32(Cut(values[0]).raw, Cut(values[1]).raw);
    const __m512i second = _mm512_packs_epi32(Cut(values[2]).raw, Cut(values[3]).raw);
    const __m512i order = _mm512_set_epi32(15, 11, 7, 3, 14, 10, 6, 2, 13, 9, 5, 1, 12, 8, 4, 0);
    _mm512_storeu_si512(to, _mm512_permutexvar_epi32(order, _mm512_packus_epi16(first, second)));
    return;
  }
#endif
  const hn::Rebind<std::uint8_t, FloatTag> d8;
#pragma GCC unroll 4
  for (int v = 0; v < kWide; ++v) {
    hn::StoreU(hn::DemoteTo(d8, Cut(values[v])), d8, to + v * static_cast<int>(hn::Lanes(d8)));
  }
}

/// kWide vectors of each of kRows rows, from value i on.
template <int kRows, int kWide, class T>
HWY_INLINE void Block(const PairTaps& taps, const std::uint32_t* const* HWY_RESTRICT source, std::ptrdiff_t i,
                      T* const* HWY_RESTRICT results) {
  const FloatTag d;
  const IntTag di;
  const ShortTag dw;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  Ints sum[kRows][kWide];
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 4
    for (int v = 0; v < kWide; ++v) sum[r][v] = hn::Zero(di);
  }
  for (const PairStep& step : taps.steps) {
    const auto* const from = reinterpret_cast<const std::int32_t*>(source[step.row] + i + step.offset);
    Shorts pairs[kWide];
#pragma GCC unroll 4
    for (int v = 0; v < kWide; ++v) pairs[v] = hn::BitCast(dw, hn::LoadU(di, from + v * lanes));
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      if (kRows > 1 && (step.outputs & (1U << r)) == 0) continue;
      const Shorts weights = hn::BitCast(dw, hn::Set(di, step.weights[r]));
#pragma GCC unroll 4
      for (int v = 0; v < kWide; ++v) sum[r][v] = hn::Add(sum[r][v], WeighedPairs(pairs[v], weights));
    }
  }
  const Floats scale = hn::Set(d, taps.scale);
  const Floats offset = hn::Set(d, taps.offset);
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) {
    Floats values[kWide];
#pragma GCC unroll 4
    for (int v = 0; v < kWide; ++v) values[v] = hn::Add(hn::Mul(hn::ConvertTo(d, sum[r][v]), scale), offset);
    Write<kWide>(values, results[r] + i);
  }
}

template <int kRows, class T>
void Rows(const PairTaps& taps, const std::uint32_t* const* source, std::ptrdiff_t count, T* const* results) {
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(FloatTag()));
  if (count < lanes) {
    for (int r = 0; r < kRows; ++r) {
      for (std::ptrdiff_t i = 0; i < count; ++i) {
        const float value = convolved(taps, source, r, i);
        if constexpr (std::is_same_v<T, float>) {
          results[r][i] = value;
        } else {
          results[r][i] = cut_to_byte(value);
        }
      }
    }
    return;
  }
  std::ptrdiff_t i = 0;
  for (; i + kVectors * lanes <= count; i += kVectors * lanes) Block<kRows, kVectors>(taps, source, i, results);
  for (; i + lanes <= count; i += lanes) Block<kRows, 1>(taps, source, i, results);
  if (i < count) Block<kRows, 1>(taps, source, count - lanes, results);
}

void PairBytes(const std::uint8_t* source, std::ptrdiff_t tap, std::size_t count, std::uint32_t* pairs) {
  const hn::RebindToUnsigned<FloatTag> du;
  const hn::Rebind<std::uint8_t, FloatTag> d8;
  // Whole vectors: there is room behind the pairs.
  for (std::size_t i = 0; i < count; i += hn::Lanes(du)) {
    const auto first = hn::PromoteTo(du, hn::LoadU(d8, source + i));
    const auto second = hn::PromoteTo(du, hn::LoadU(d8, source + static_cast<std::ptrdiff_t>(i) + tap));
    hn::StoreU(hn::Or(first, hn::ShiftLeft<16>(second)), du, pairs + i);
  }
}

/// Sums of a column of bytes in 16 bits.
HWY_INLINE void Columns(std::span<const std::int16_t> column, const std::uint8_t* const* source, std::ptrdiff_t count,
                        std::int16_t* between) {
  const ShortTag d;
  const hn::Rebind<std::uint8_t, ShortTag> d8;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  const auto sum = [&](std::ptrdiff_t x) HWY_ATTR {
    Shorts first = hn::Zero(d);
    Shorts second = hn::Zero(d);
    std::size_t a = 0;
    for (; a + 1 < column.size(); a += 2) {
      const auto value = hn::PromoteTo(d, hn::LoadU(d8, source[a] + x));
      const auto next = hn::PromoteTo(d, hn::LoadU(d8, source[a + 1] + x));
      first = hn::Add(first, hn::Mul(value, hn::Set(d, column[a])));
      second = hn::Add(second, hn::Mul(next, hn::Set(d, column[a + 1])));
    }
    if (a < column.size()) {
      first = hn::Add(first, hn::Mul(hn::PromoteTo(d, hn::LoadU(d8, source[a] + x)), hn::Set(d, column[a])));
    }
    hn::StoreU(hn::Add(first, second), d, between + x);
  };
  std::ptrdiff_t x = 0;
  for (; x + lanes <= count; x += lanes) sum(x);
  if (x == count) return;
  if (count >= lanes) return sum(count - lanes);
  for (; x < count; ++x) {
    int total = 0;
    for (std::size_t a = 0; a < column.size(); ++a) total += column[a] * source[a][x];
    between[x] = static_cast<std::int16_t>(total);
  }
}

/// Pairs of neighbors come about by interleaving, which leaves the sums in an order that packing puts right.
void ConvolveFactors(std::span<const std::int16_t> column, std::span<const std::int16_t> row, const PairTaps& taps,
                     std::ptrdiff_t tap, const std::uint8_t* const* source, std::int16_t* between, std::size_t count,
                     std::uint8_t* result) {
  const ShortTag d;
  const IntTag di;
  const FloatTag df;
  const hn::Rebind<std::uint8_t, ShortTag> d8;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  const auto values = static_cast<std::ptrdiff_t>(count);
  Columns(column, source, values + tap * (static_cast<std::ptrdiff_t>(row.size()) - (row.back() == 0 ? 2 : 1)),
          between);
  const Floats scale = hn::Set(df, taps.scale);
  const Floats offset = hn::Set(df, taps.offset);
  const auto sums = [&](std::ptrdiff_t x) HWY_ATTR {
    Ints lower = hn::Zero(di);
    Ints upper = hn::Zero(di);
    const std::int16_t* from = between + x;
    for (std::size_t c = 0; c < row.size(); c += 2, from += 2 * tap) {
      std::int32_t both;
      std::memcpy(&both, &row[c], sizeof both);
      const Shorts weights = hn::BitCast(d, hn::Set(di, both));
      const Shorts first = hn::LoadU(d, from);
      const Shorts second = hn::LoadU(d, from + tap);
      lower = hn::Add(lower, WeighedPairs(hn::InterleaveLower(d, first, second), weights));
      upper = hn::Add(upper, WeighedPairs(hn::InterleaveUpper(d, first, second), weights));
    }
    const Ints low = Cut(hn::Add(hn::Mul(hn::ConvertTo(df, lower), scale), offset));
    const Ints high = Cut(hn::Add(hn::Mul(hn::ConvertTo(df, upper), scale), offset));
    return hn::DemoteTo(d8, hn::ReorderDemote2To(d, low, high));
  };
  std::ptrdiff_t x = 0;
  for (; x + lanes <= values; x += lanes) hn::StoreU(sums(x), d8, result + x);
  if (x == values) return;
  if (values >= lanes) return hn::StoreU(sums(values - lanes), d8, result + values - lanes);
  std::uint8_t rest[HWY_MAX_BYTES / 2];
  hn::StoreU(sums(0), d8, rest);
  std::memcpy(result, rest, count);
}

void ConvolveToBytes(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                     std::uint8_t* const* results) {
  const auto values = static_cast<std::ptrdiff_t>(count);
  return rows == 1 ? Rows<1>(taps, source, values, results) : Rows<kByteRows>(taps, source, values, results);
}
void ConvolveToFloats(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                      float* const* results) {
  const auto values = static_cast<std::ptrdiff_t>(count);
  return rows == 1 ? Rows<1>(taps, source, values, results) : Rows<kByteRows>(taps, source, values, results);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(PairBytes);
HWY_EXPORT(ConvolveToBytes);
HWY_EXPORT(ConvolveToFloats);
HWY_EXPORT(ConvolveFactors);

void pair_bytes(const std::uint8_t* source, std::ptrdiff_t tap, std::size_t count, std::uint32_t* pairs) {
  HWY_DYNAMIC_DISPATCH(PairBytes)(source, tap, count, pairs);
}
void convolve_pairs(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                    std::uint8_t* const* results) {
  HWY_DYNAMIC_DISPATCH(ConvolveToBytes)(taps, source, rows, count, results);
}
void convolve_pairs(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                    float* const* results) {
  HWY_DYNAMIC_DISPATCH(ConvolveToFloats)(taps, source, rows, count, results);
}

void convolve_factors(std::span<const std::int16_t> column, std::span<const std::int16_t> row, const PairTaps& taps,
                      std::ptrdiff_t tap, const std::uint8_t* const* source, std::int16_t* between, std::size_t count,
                      std::uint8_t* result) {
  HWY_DYNAMIC_DISPATCH(ConvolveFactors)(column, row, taps, tap, source, between, count, result);
}

}  // namespace azulejo::kernels
#endif
