// Vector version of math/normal.h: the same operations in the same order, so the same bytes. Included by kernels once
// for each vector target, after <hwy/highway.h>.
#if defined(AZULEJO_MATH_NORMAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_NORMAL_INL_H
#undef AZULEJO_MATH_NORMAL_INL_H
#else
#define AZULEJO_MATH_NORMAL_INL_H
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// normal_deviate: D of float, bits of std::uint32_t.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V NormalDeviate(D d, hn::Vec<hn::RebindToUnsigned<D>> bits) {
  const hn::RebindToSigned<D> di;
  const auto word = hn::BitCast(di, bits);
  // Words from 2³¹ are negative here: all their bits are flipped.
  const auto flip = hn::ShiftRight<31>(word);
  const V share = hn::Mul(hn::Add(hn::ConvertTo(d, hn::Xor(word, flip)), hn::Set(d, 0.5F)), hn::Set(d, 0x1p-32F));
  const V one = hn::Set(d, 1.0F);
  const V x = hn::Sub(one, hn::Mul(hn::Set(d, 2.0F), share));
  const V w =
      hn::Mul(hn::Set(d, -0.693147181F), Log2(d, hn::Mul(hn::Mul(hn::Set(d, 4.0F), share), hn::Sub(one, share))));
  const auto central = hn::Lt(w, hn::Set(d, 5.0F));
  V v = hn::Sub(w, hn::Set(d, 2.5F));
  V p = hn::Set(d, 2.81022636e-08F);
  for (const float c : {3.43273939e-07F, -3.5233877e-06F, -4.39150654e-06F, 0.00021858087F, -0.00125372503F,
                        -0.00417768164F, 0.246640727F, 1.50140941F}) {
    p = hn::Add(hn::Mul(p, v), hn::Set(d, c));
  }
  if (!hn::AllTrue(d, central)) {  // one in 300
    v = hn::Sub(hn::Sqrt(w), hn::Set(d, 3.0F));
    V tail = hn::Set(d, -0.000200214257F);
    for (const float c : {0.000100950558F, 0.00134934322F, -0.00367342844F, 0.00573950773F, -0.0076224613F,
                          0.00943887047F, 1.00167406F, 2.83297682F}) {
      tail = hn::Add(hn::Mul(tail, v), hn::Set(d, c));
    }
    p = hn::IfThenElse(central, p, tail);
  }
  const V deviate = hn::Mul(hn::Mul(hn::Set(d, 1.41421356F), x), p);
  return hn::IfThenElse(hn::RebindMask(d, hn::Lt(word, hn::Zero(di))), deviate, hn::Neg(deviate));
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
