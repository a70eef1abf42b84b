// Floats as whole numbers. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_MATH_TRUNCATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_TRUNCATE_INL_H
#undef AZULEJO_MATH_TRUNCATE_INL_H
#else
#define AZULEJO_MATH_TRUNCATE_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

/// The whole part of floats within the range of 32 bits; of others, anything. ConvertTo does the same and saturates,
/// which takes five instructions more.
template <class V>
HWY_INLINE auto Truncated(V v) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<hn::DFromV<V>> di;
#if HWY_TARGET == HWY_AVX3
  if constexpr (sizeof(V) == 64) return hn::Vec<decltype(di)>{_mm512_cvttps_epi32(v.raw)};
#endif
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  if constexpr (sizeof(V) == 32) return hn::Vec<decltype(di)>{_mm256_cvttps_epi32(v.raw)};
#endif
#if HWY_ARCH_X86
  if constexpr (sizeof(V) == 16) return hn::Vec<decltype(di)>{_mm_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(di, v);
#endif
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
