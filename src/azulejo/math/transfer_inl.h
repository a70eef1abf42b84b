// Vector versions of math/transfer.h: the same operations in the same order, so the same bytes. Included by kernels
// once for each vector target, after <hwy/highway.h>.
#if defined(AZULEJO_MATH_TRANSFER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_TRANSFER_INL_H
#undef AZULEJO_MATH_TRANSFER_INL_H
#else
#define AZULEJO_MATH_TRANSFER_INL_H
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "azulejo/math/truncate_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// sum · x + constant, twice rounded.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Horner(D d, V sum, V x, float constant) {
  return hn::Add(hn::Mul(sum, x), hn::Set(d, constant));
}

/// exp2_deterministic
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2(D d, V p) {
  const hn::RebindToSigned<D> di;
  const V whole = hn::Floor(hn::Add(p, hn::Set(d, 0.5F)));
  const V f = hn::Sub(p, whole);
  V sum = hn::Set(d, 1.5252734e-5F);
  sum = Horner(d, sum, f, 1.5403530e-4F);
  sum = Horner(d, sum, f, 1.3333558e-3F);
  sum = Horner(d, sum, f, 9.6181291e-3F);
  sum = Horner(d, sum, f, 5.5504109e-2F);
  sum = Horner(d, sum, f, 2.4022651e-1F);
  sum = Horner(d, sum, f, 6.9314718e-1F);
  sum = Horner(d, sum, f, 1.0F);
  const auto exponent = hn::Add(Truncated(whole), hn::Set(di, 127));
  return hn::Mul(sum, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

/// log2_deterministic
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3F3504F3)));
  const V m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const V s = hn::Div(hn::Sub(m, hn::Set(d, 1.0F)), hn::Add(m, hn::Set(d, 1.0F)));
  const V square = hn::Mul(s, s);
  V sum = hn::Set(d, 0.32059889F);
  sum = Horner(d, sum, square, 0.41219858F);
  sum = Horner(d, sum, square, 0.57707802F);
  sum = Horner(d, sum, square, 0.96179669F);
  sum = Horner(d, sum, square, 2.8853901F);
  return hn::Add(hn::ConvertTo(d, exponent), hn::Mul(s, sum));
}

/// power_deterministic
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Power(D d, V x, float exponent) {
  const V p = hn::Mul(hn::Set(d, exponent), Log2(d, x));
  // Within what Exp2 takes, whatever x was.
  const V low = hn::Set(d, -125.0F);
  const V high = hn::Set(d, 127.4F);
  const V inside = hn::IfThenElse(hn::Gt(p, low), hn::IfThenElse(hn::Lt(p, high), p, high), low);
  const V power = hn::IfThenZeroElse(hn::Lt(p, low), Exp2(d, inside));
  const V finite = hn::IfThenElse(hn::Lt(x, hn::Set(d, 3e38F)), power, x);
  return hn::IfThenZeroElse(hn::Lt(x, hn::Set(d, 0x1p-126F)), finite);
}

/// srgb_to_linear
template <class D, class V = hn::Vec<D>>
HWY_INLINE V SrgbToLinear(D d, V encoded) {
  const V x = hn::Abs(encoded);
  const V base = hn::Div(hn::Add(x, hn::Set(d, 0.055F)), hn::Set(d, 1.055F));
  const V power = Exp2(d, hn::Mul(hn::Set(d, 2.4F), Log2(d, base)));
  const V beyond = hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e9F)), hn::CopySign(power, encoded), encoded);
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.04045F)), beyond, hn::Div(encoded, hn::Set(d, 12.92F)));
}

/// linear_to_srgb
template <class D, class V = hn::Vec<D>>
HWY_INLINE V LinearToSrgb(D d, V linear) {
  const V x = hn::Abs(linear);
  const V power = Exp2(d, hn::Mul(hn::Set(d, 1.0F / 2.4F), Log2(d, x)));
  const V curve = hn::Sub(hn::Mul(hn::Set(d, 1.055F), power), hn::Set(d, 0.055F));
  const V beyond = hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e9F)), hn::CopySign(curve, linear), linear);
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.0031308F)), beyond, hn::Mul(linear, hn::Set(d, 12.92F)));
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
