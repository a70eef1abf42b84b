// Compiled once for every vector target: included by *_simd.cpp after <hwy/highway.h>.
#if defined(AZULEJO_IMAGING_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_ROWS_INL_H
#undef AZULEJO_IMAGING_ROWS_INL_H
#else
#define AZULEJO_IMAGING_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "azulejo/data/view.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;

/// Stored values as f32, not scaled.
template <class T>
HWY_INLINE V LoadStored(const T* source) {
  if constexpr (std::is_same_v<T, float>) {
    return hn::LoadU(D(), source);
  } else {
    return hn::ConvertTo(D(), hn::PromoteTo(DI(), hn::LoadU(hn::Rebind<T, D>(), source)));
  }
}

/// Whole numbers within T's range.
template <class T>
HWY_INLINE void StoreWhole(hn::Vec<DI> whole, T* result) {
  const hn::Rebind<T, D> dt;
  hn::StoreU(hn::DemoteTo(dt, whole), dt, result);
}

template <class T>
HWY_INLINE hn::Vec<DI> Rounded(V value) {
  const D d;
  const V positive =
      hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), hn::Min(value, hn::Set(d, full_range(kPixelTypeOf<T>))));
  return hn::ConvertTo(DI(), hn::Add(positive, hn::Set(d, 0.5F)));
}

template <class T>
HWY_INLINE void StoreRounded(V value, T* result) {
  if constexpr (std::is_same_v<T, float>) {
    hn::StoreU(value, D(), result);
  } else {
    StoreWhole(Rounded<T>(value), result);
  }
}

/// Calls f(i) for whole vectors of values, and for the rest through a buffer: f reads `from`, writes `to`.
template <class From, class To, class F>
HWY_INLINE void ForVectors(const From* from, To* to, std::size_t count, F f) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) f(from + i, to + i);
  if (i == count) return;
  HWY_ALIGN From buffer_from[HWY_MAX_BYTES / 4] = {};
  HWY_ALIGN To buffer_to[HWY_MAX_BYTES / 4];
  std::memcpy(buffer_from, from + i, (count - i) * sizeof(From));
  f(buffer_from, buffer_to);
  std::memcpy(to + i, buffer_to, (count - i) * sizeof(To));
}

/// The alpha of each value's pixel, and which values are alpha.
template <int kChannels>
struct AlphaOf {
  AlphaOf() {
    const D d;
    HWY_ALIGN float pattern[HWY_MAX_BYTES / 4];
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) pattern[i] = i % kChannels == kChannels - 1 ? 1.0F : 0.0F;
    is_alpha = hn::Gt(hn::Load(d, pattern), hn::Zero(d));
  }
  HWY_INLINE V operator()(V v) const {
    if constexpr (kChannels == 2) {
      return hn::DupOdd(v);
    } else {
      return hn::Broadcast<3>(v);
    }
  }
  hn::Mask<D> is_alpha;
};

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
