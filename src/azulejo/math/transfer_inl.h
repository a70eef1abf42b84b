// transfer.h for vectors: the same bytes. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_MATH_TRANSFER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_TRANSFER_INL_H
#undef AZULEJO_MATH_TRANSFER_INL_H
#else
#define AZULEJO_MATH_TRANSFER_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

template <class D, class V>
HWY_INLINE V exp2_deterministic(D d, V p) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto whole = hn::Floor(hn::Add(p, hn::Set(d, 0.5F)));
  const auto f = hn::Sub(p, whole);
  auto sum = hn::Set(d, 1.5252734e-5F);
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 1.5403530e-4F));
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 1.3333558e-3F));
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 9.6181291e-3F));
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 5.5504109e-2F));
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 2.4022651e-1F));
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 6.9314718e-1F));
  sum = hn::Add(hn::Mul(sum, f), hn::Set(d, 1.0F));
  const auto exponent = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
  return hn::Mul(sum, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

template <class D, class V>
HWY_INLINE V log2_deterministic(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3F3504F3)));
  const auto m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const auto one = hn::Set(d, 1.0F);
  const auto s = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const auto square = hn::Mul(s, s);
  auto sum = hn::Set(d, 0.32059889F);
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 0.41219858F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 0.57707802F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 0.96179669F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 2.8853901F));
  return hn::Add(hn::ConvertTo(d, exponent), hn::Mul(s, sum));
}

template <class D, class V>
HWY_INLINE V srgb_to_linear(D d, V encoded) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto x = hn::Abs(encoded);
  const auto base = hn::Div(hn::Add(x, hn::Set(d, 0.055F)), hn::Set(d, 1.055F));
  const auto power = exp2_deterministic(d, hn::Mul(hn::Set(d, 2.4F), log2_deterministic(d, base)));
  const auto curve = hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e9F)), hn::CopySign(power, encoded), encoded);
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.04045F)), curve, hn::Div(encoded, hn::Set(d, 12.92F)));
}

template <class D, class V>
HWY_INLINE V linear_to_srgb(D d, V linear) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto x = hn::Abs(linear);
  const auto root = exp2_deterministic(d, hn::Mul(hn::Set(d, 1.0F / 2.4F), log2_deterministic(d, x)));
  const auto power = hn::Sub(hn::Mul(hn::Set(d, 1.055F), root), hn::Set(d, 0.055F));
  const auto curve = hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e9F)), hn::CopySign(power, linear), linear);
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.0031308F)), curve, hn::Mul(linear, hn::Set(d, 12.92F)));
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
