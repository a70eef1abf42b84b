// Stored values as vectors of f32 and back. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_IMAGING_STORED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_STORED_INL_H
#undef AZULEJO_IMAGING_STORED_INL_H
#else
#define AZULEJO_IMAGING_STORED_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "azulejo/imaging/rows.h"
#include "azulejo/math/truncate_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using WholeTag = hn::ScalableTag<std::int32_t>;

/// Stored values as f32, not scaled.
template <class VT>
HWY_INLINE hn::Vec<FloatTag> Widened(VT stored) {
  if constexpr (std::is_same_v<hn::TFromV<VT>, float>) {
    return stored;
  } else {
    return hn::ConvertTo(FloatTag(), hn::PromoteTo(WholeTag(), stored));
  }
}

template <class T>
HWY_INLINE hn::Vec<FloatTag> LoadStored(const T* source) {
  return Widened(hn::LoadU(hn::Rebind<T, FloatTag>(), source));
}

/// Half up, saturated, as whole numbers; NaN is 0.
template <class T>
HWY_INLINE hn::Vec<WholeTag> Rounded(hn::Vec<FloatTag> value) {
  const FloatTag d;
  const auto positive =
      hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), hn::Min(value, hn::Set(d, full_range(kPixelTypeOf<T>))));
  return Truncated(hn::Add(positive, hn::Set(d, 0.5F)));
}

/// Whole numbers within T's range, as T.
template <class T>
HWY_INLINE auto NarrowedWhole(hn::Vec<WholeTag> whole) {
  const hn::Rebind<T, FloatTag> dt;
#if HWY_TARGET == HWY_AVX3
  if constexpr (sizeof(T) == 1) {
    return hn::Vec<decltype(dt)>{_mm512_cvtepi32_epi8(whole.raw)};
  } else {
    return hn::Vec<decltype(dt)>{_mm512_cvtepi32_epi16(whole.raw)};
  }
#else
  return hn::DemoteTo(dt, whole);
#endif
}

/// As stored: rounded, or f32 as it is.
template <class T>
HWY_INLINE auto Narrowed(hn::Vec<FloatTag> value) {
  if constexpr (std::is_same_v<T, float>) {
    return value;
  } else {
    return NarrowedWhole<T>(Rounded<T>(value));
  }
}

template <class T>
HWY_INLINE void StoreWhole(hn::Vec<WholeTag> whole, T* result) {
  hn::StoreU(NarrowedWhole<T>(whole), hn::Rebind<T, FloatTag>(), result);
}

template <class T>
HWY_INLINE void StoreRounded(hn::Vec<FloatTag> value, T* result) {
  hn::StoreU(Narrowed<T>(value), hn::Rebind<T, FloatTag>(), result);
}

/// encode_byte, as whole numbers.
HWY_INLINE auto EncodeByte(const ByteCurve& curve, hn::Vec<FloatTag> linear) {
  const FloatTag d;
  const WholeTag di;
  const auto low = hn::BitCast(d, hn::Set(di, static_cast<std::int32_t>(ByteCurve::kLowest)));
  const auto high = hn::BitCast(d, hn::Set(di, 0x3F7FFFFF));
  const auto clamped = hn::IfThenElse(hn::Gt(linear, low), hn::Min(linear, high), low);
  const auto bits = hn::BitCast(di, clamped);
  const auto bucket = hn::ShiftRight<16>(hn::Sub(bits, hn::Set(di, static_cast<std::int32_t>(ByteCurve::kLowest))));
  const auto entry = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(curve.encode), bucket);
  return hn::ShiftRight<16>(hn::Add(entry, hn::And(bits, hn::Set(di, 65535))));
}

/// Calls f(i) for whole vectors of values, and for the rest through a buffer: f reads `from`, writes `to`.
template <class From, class To, class F>
HWY_INLINE void ForVectors(const From* from, To* to, std::size_t count, F f) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) f(from + i, to + i);
  if (i == count) return;
  HWY_ALIGN From buffer_from[HWY_MAX_BYTES / 4] = {};
  HWY_ALIGN To buffer_to[HWY_MAX_BYTES / 4];
  std::memcpy(buffer_from, from + i, (count - i) * sizeof(From));
  f(buffer_from, buffer_to);
  std::memcpy(to + i, buffer_to, (count - i) * sizeof(To));
}

/// The table of linear light looked up for vectors of bytes. Gathering is slower than one value after the other; where
/// two vectors hold 32 entries, eight permutations and a choice by the upper bits are twice as fast.
struct DecodeBytes {
#if HWY_TARGET == HWY_AVX3
  HWY_INLINE explicit DecodeBytes(const ByteCurve& curve) {
    for (int k = 0; k < 16; ++k) table[k] = _mm512_loadu_ps(curve.linear + 16 * k);
  }
  HWY_INLINE hn::Vec<FloatTag> operator()(hn::Vec<WholeTag> bytes) const {
    const __m512i index = bytes.raw;
    const auto pick = [&](int k) HWY_ATTR { return _mm512_permutex2var_ps(table[2 * k], index, table[2 * k + 1]); };
    const __mmask16 bit5 = _mm512_test_epi32_mask(index, _mm512_set1_epi32(32));
    const __mmask16 bit6 = _mm512_test_epi32_mask(index, _mm512_set1_epi32(64));
    const __mmask16 bit7 = _mm512_test_epi32_mask(index, _mm512_set1_epi32(128));
    const __m512 low = _mm512_mask_blend_ps(bit6, _mm512_mask_blend_ps(bit5, pick(0), pick(1)),
                                            _mm512_mask_blend_ps(bit5, pick(2), pick(3)));
    const __m512 high = _mm512_mask_blend_ps(bit6, _mm512_mask_blend_ps(bit5, pick(4), pick(5)),
                                             _mm512_mask_blend_ps(bit5, pick(6), pick(7)));
    return hn::Vec<FloatTag>{_mm512_mask_blend_ps(bit7, low, high)};
  }
  __m512 table[16];
#else
  HWY_INLINE explicit DecodeBytes(const ByteCurve& curve) : linear(curve.linear) {}
  HWY_INLINE hn::Vec<FloatTag> operator()(hn::Vec<WholeTag> bytes) const {
    HWY_ALIGN std::int32_t index[HWY_MAX_BYTES / 4];
    HWY_ALIGN float light[HWY_MAX_BYTES / 4];
    hn::Store(bytes, WholeTag(), index);
    for (std::size_t k = 0; k < hn::Lanes(FloatTag()); ++k) light[k] = linear[index[k]];
    return hn::Load(FloatTag(), light);
  }
  const float* linear;
#endif
};

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
