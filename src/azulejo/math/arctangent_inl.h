// arctangent.h for vectors: the same bytes. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_MATH_ARCTANGENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_ARCTANGENT_INL_H
#undef AZULEJO_MATH_ARCTANGENT_INL_H
#else
#define AZULEJO_MATH_ARCTANGENT_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

template <class D, class V>
HWY_INLINE V atan2_deterministic(D d, V y, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto zero = hn::Zero(d);
  const auto across = hn::Abs(x);
  const auto up = hn::Abs(y);
  const auto steep = hn::Gt(up, across);
  const auto large = hn::IfThenElse(steep, up, across);
  const auto small = hn::IfThenElse(steep, across, up);
  const auto t = hn::Div(small, large);
  const auto square = hn::Mul(t, t);
  auto sum = hn::Set(d, 0.00283406419F);
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, -0.0160050299F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 0.0425876081F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, -0.0749544576F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 0.106367543F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, -0.142025709F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, 0.199924842F));
  sum = hn::Add(hn::Mul(sum, square), hn::Set(d, -0.333330661F));
  auto angle = hn::Add(hn::Mul(hn::Mul(sum, square), t), t);
  angle = hn::IfThenElse(steep, hn::Sub(hn::Set(d, 1.57079633F), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(hn::Set(d, 3.14159265F), angle), angle);
  angle = hn::IfThenElse(hn::Lt(y, zero), hn::Neg(angle), angle);
  return hn::IfThenElse(hn::Eq(large, zero), zero, angle);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
