// sine.h for vectors: the same bytes. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_MATH_SINE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_SINE_INL_H
#undef AZULEJO_MATH_SINE_INL_H
#else
#define AZULEJO_MATH_SINE_INL_H
#endif

#include <hwy/highway.h>

#include "azulejo/math/truncate_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

template <class D, class V>
HWY_INLINE void sine_cosine_of_turns(D d, V turns, V& sine_of, V& cosine_of) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto next = [d](V sum, V x, float constant) HWY_ATTR { return hn::Add(hn::Mul(sum, x), hn::Set(d, constant)); };
  const V quarters = hn::Floor(next(hn::Set(d, 4.0F), turns, 0.5F));
  const V f = hn::Sub(turns, hn::Mul(hn::Set(d, 0.25F), quarters));
  const V square = hn::Mul(f, f);
  V sine = hn::Set(d, 42.0586940F);
  sine = next(sine, square, -76.7058597F);
  sine = next(sine, square, 81.6052493F);
  sine = next(sine, square, -41.3417022F);
  sine = next(sine, square, 6.28318531F);
  sine = hn::Mul(sine, f);
  V cosine = hn::Set(d, 60.2446414F);
  cosine = next(cosine, square, -85.4568172F);
  cosine = next(cosine, square, 64.9393940F);
  cosine = next(cosine, square, -19.7392088F);
  cosine = next(cosine, square, 1.0F);
  const auto quadrant = Truncated(quarters);
  const auto two = hn::Set(di, 2);
  const auto swap = hn::RebindMask(d, hn::TestBit(quadrant, hn::Set(di, 1)));
  const V s = hn::IfThenElse(swap, cosine, sine);
  const V c = hn::IfThenElse(swap, sine, cosine);
  sine_of = hn::IfThenElse(hn::RebindMask(d, hn::TestBit(quadrant, two)), hn::Neg(s), s);
  const auto after = hn::Add(quadrant, hn::Set(di, 1));
  cosine_of = hn::IfThenElse(hn::RebindMask(d, hn::TestBit(after, two)), hn::Neg(c), c);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
