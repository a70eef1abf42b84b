// transfer.h for vectors: the same bytes. Compiled once for every vector target: included by *_simd.cpp after
// <hwy/highway.h>.
#if defined(AZULEJO_MATH_TRANSFER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_TRANSFER_INL_H
#undef AZULEJO_MATH_TRANSFER_INL_H
#else
#define AZULEJO_MATH_TRANSFER_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

template <class D, class V>
HWY_INLINE V polynomial(D, V, V sum) {
  return sum;
}
/// ((sum · x + first) · x + next) …
template <class D, class V, class... Rest>
HWY_INLINE V polynomial(D d, V x, V sum, float first, Rest... rest) {
  namespace hn = hwy::HWY_NAMESPACE;
  return polynomial(d, x, hn::Add(hn::Mul(sum, x), hn::Set(d, first)), rest...);
}

template <class D, class V>
HWY_INLINE V exp2_deterministic(D d, V p) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const V whole = hn::Floor(hn::Add(p, hn::Set(d, 0.5F)));
  const V sum = polynomial(d, hn::Sub(p, whole), hn::Set(d, 1.5252734e-5F), 1.5403530e-4F, 1.3333558e-3F, 9.6181291e-3F,
                           5.5504109e-2F, 2.4022651e-1F, 6.9314718e-1F, 1.0F);
  const auto exponent = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
  return hn::Mul(sum, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

template <class D, class V>
HWY_INLINE V log2_deterministic(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3F3504F3)));
  const V m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const V s = hn::Div(hn::Sub(m, hn::Set(d, 1.0F)), hn::Add(m, hn::Set(d, 1.0F)));
  const V sum =
      polynomial(d, hn::Mul(s, s), hn::Set(d, 0.32059889F), 0.41219858F, 0.57707802F, 0.96179669F, 2.8853901F);
  return hn::Add(hn::ConvertTo(d, exponent), hn::Mul(s, sum));
}

/// An sRGB-encoded intensity as linear light.
template <class D, class V>
HWY_INLINE V srgb_to_linear(D d, V encoded) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V x = hn::Abs(encoded);
  const V base = hn::Div(hn::Add(x, hn::Set(d, 0.055F)), hn::Set(d, 1.055F));
  const V power = exp2_deterministic(d, hn::Mul(hn::Set(d, 2.4F), log2_deterministic(d, base)));
  const V curved = hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e9F)), hn::CopySign(power, encoded), encoded);
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.04045F)), curved, hn::Div(encoded, hn::Set(d, 12.92F)));
}

/// Linear light as an sRGB-encoded intensity.
template <class D, class V>
HWY_INLINE V linear_to_srgb(D d, V linear) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V x = hn::Abs(linear);
  const V power = exp2_deterministic(d, hn::Mul(hn::Set(d, 1.0F / 2.4F), log2_deterministic(d, x)));
  const V value = hn::Sub(hn::Mul(hn::Set(d, 1.055F), power), hn::Set(d, 0.055F));
  const V curved = hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e9F)), hn::CopySign(value, linear), linear);
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.0031308F)), curved, hn::Mul(linear, hn::Set(d, 12.92F)));
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
