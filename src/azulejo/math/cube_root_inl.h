// cube_root.h for vectors: the same bytes. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_MATH_CUBE_ROOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_CUBE_ROOT_INL_H
#undef AZULEJO_MATH_CUBE_ROOT_INL_H
#else
#define AZULEJO_MATH_CUBE_ROOT_INL_H
#endif

#include <hwy/highway.h>

#include "azulejo/math/truncate_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

template <class D, class V>
HWY_INLINE V cbrt_deterministic(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto third = hn::Mul(hn::ConvertTo(d, hn::BitCast(di, x)), hn::Set(d, 0.333333343F));
  const auto guess = hn::BitCast(d, hn::Sub(hn::Set(di, 0x548E0000), Truncated(third)));
  const auto h = hn::Mul(hn::Mul(x, guess), hn::Mul(guess, guess));
  auto factor = hn::Add(hn::Mul(hn::Set(d, 0.472044045F), h), hn::Set(d, -1.19769229F));
  factor = hn::Add(hn::Mul(factor, h), hn::Set(d, 1.73335913F));
  const auto y = hn::Mul(guess, factor);
  const auto root = hn::Mul(hn::Mul(x, y), y);
  const auto rest = hn::Sub(hn::Set(d, 1.0F), hn::Mul(root, y));
  return hn::Add(root, hn::Mul(root, hn::Mul(rest, hn::Set(d, 0.666666687F))));
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
