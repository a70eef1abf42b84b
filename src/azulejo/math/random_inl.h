// Vector version of math/random.h: the same words. Included by kernels once for each vector target, after
// <hwy/highway.h>.
#if defined(AZULEJO_MATH_RANDOM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_MATH_RANDOM_INL_H
#undef AZULEJO_MATH_RANDOM_INL_H
#else
#define AZULEJO_MATH_RANDOM_INL_H
#endif

#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Both halves of a · factor, for lanes of 32 bits.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void MulWide(D d, V a, V factor, V& high, V& low) {
  const hn::RepartitionToWide<D> d64;
  const auto even = hn::MulEven(a, factor);
  const auto odd = hn::MulEven(hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(d64, a))), factor);
  high = hn::OddEven(hn::BitCast(d, odd), hn::BitCast(d, hn::ShiftRight<32>(even)));
  low = hn::OddEven(hn::BitCast(d, hn::ShiftLeft<32>(odd)), hn::BitCast(d, even));
}

/// philox: D of std::uint32_t; the four words of counters (a, b, c, d) take their place.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void Philox(D d, V& c0, V& c1, V& c2, V& c3, std::uint32_t key0, std::uint32_t key1) {
  const V factor0 = hn::Set(d, 0xD2511F53U);
  const V factor2 = hn::Set(d, 0xCD9E8D57U);
  for (int round = 0; round < 10; ++round) {
    V high0 = c0;
    V low0 = c0;
    V high2 = c2;
    V low2 = c2;
    MulWide(d, c0, factor0, high0, low0);
    MulWide(d, c2, factor2, high2, low2);
    c0 = hn::Xor(hn::Xor(high2, c1), hn::Set(d, key0));
    c1 = low2;
    c2 = hn::Xor(hn::Xor(high0, c3), hn::Set(d, key1));
    c3 = low0;
    key0 += 0x9E3779B9;
    key1 += 0xBB67AE85;
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
