// Compiled once for every vector target: included by *_simd.cpp after <hwy/highway.h>.
#if defined(AZULEJO_IMAGING_RANK_KEY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_RANK_KEY_INL_H
#undef AZULEJO_IMAGING_RANK_KEY_INL_H
#else
#define AZULEJO_IMAGING_RANK_KEY_INL_H
#endif

#include <hwy/highway.h>

#include "azulejo/imaging/rank_key.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

/// A vector of keys, of the values from an address on.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> LoadKeys(D d, const hwy::HWY_NAMESPACE::TFromD<D>* from) {
  return hwy::HWY_NAMESPACE::LoadU(d, from);
}
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> LoadKeys(D d, const float* from) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto bits = hn::BitCast(d, hn::LoadU(hn::RebindToFloat<D>(), from));
  const auto magnitude = hn::Set(d, 0x7FFFFFFF);
  const auto key = hn::Xor(bits, hn::And(hn::BroadcastSignBit(bits), magnitude));
  return hn::IfThenElse(hn::Gt(hn::And(bits, magnitude), hn::Set(d, 0x7F800000)), magnitude, key);
}

/// The values that have these keys, written from an address on.
template <class D>
HWY_INLINE void StoreKeys(D d, hwy::HWY_NAMESPACE::Vec<D> keys, hwy::HWY_NAMESPACE::TFromD<D>* to) {
  hwy::HWY_NAMESPACE::StoreU(keys, d, to);
}
template <class D>
HWY_INLINE void StoreKeys(D d, hwy::HWY_NAMESPACE::Vec<D> keys, float* to) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto bits = hn::Xor(keys, hn::And(hn::BroadcastSignBit(keys), hn::Set(d, 0x7FFFFFFF)));
  hn::StoreU(hn::BitCast(hn::RebindToFloat<D>(), bits), hn::RebindToFloat<D>(), to);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
