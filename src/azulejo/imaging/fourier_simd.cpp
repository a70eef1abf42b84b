// How it is fast. A vector holds the same place of several sequences, so that nothing is ever shuffled.
#include "azulejo/imaging/fourier_kernels.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/fourier_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<FloatTag>;

constexpr std::size_t kLanes = 16;

struct Complex {
  Floats re;
  Floats im;
};

HWY_INLINE Complex operator+(Complex a, Complex b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE Complex operator-(Complex a, Complex b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }
/// −i · a
HWY_INLINE Complex Turned(Complex a) { return {a.im, hn::Neg(a.re)}; }
HWY_INLINE Complex Scaled(Complex a, Floats factor) { return {hn::Mul(a.re, factor), hn::Mul(a.im, factor)}; }
HWY_INLINE Complex Times(Complex a, const float* factor) {
  const FloatTag d;
  const Floats re = hn::Set(d, factor[0]);
  const Floats im = hn::Set(d, factor[1]);
  return {hn::Sub(hn::Mul(a.re, re), hn::Mul(a.im, im)), hn::Add(hn::Mul(a.re, im), hn::Mul(a.im, re))};
}

template <int kRadix>
HWY_INLINE void Butterfly(const Complex* a, const float* factors, Complex* b) {
  if constexpr (kRadix == 2) {
    b[0] = a[0] + a[1];
    b[1] = Times(a[0] - a[1], factors);
  } else if constexpr (kRadix == 3) {
    const FloatTag d;
    const Complex sum = a[1] + a[2];
    const Complex turned = Scaled(Turned(a[1] - a[2]), hn::Set(d, 0.866025404F));
    const Complex rest = a[0] - Scaled(sum, hn::Set(d, 0.5F));
    b[0] = a[0] + sum;
    b[1] = Times(rest + turned, factors);
    b[2] = Times(rest - turned, factors + 2);
  } else if constexpr (kRadix == 5) {
    const FloatTag d;
    const Floats cos1 = hn::Set(d, 0.309016994F);
    const Floats cos2 = hn::Set(d, -0.809016994F);
    const Floats sin1 = hn::Set(d, 0.951056516F);
    const Floats sin2 = hn::Set(d, 0.587785252F);
    const Complex sum1 = a[1] + a[4];
    const Complex sum2 = a[2] + a[3];
    const Complex turned1 = Turned(a[1] - a[4]);
    const Complex turned2 = Turned(a[2] - a[3]);
    const Complex even1 = a[0] + (Scaled(sum1, cos1) + Scaled(sum2, cos2));
    const Complex even2 = a[0] + (Scaled(sum1, cos2) + Scaled(sum2, cos1));
    const Complex odd1 = Scaled(turned1, sin1) + Scaled(turned2, sin2);
    const Complex odd2 = Scaled(turned1, sin2) - Scaled(turned2, sin1);
    b[0] = a[0] + (sum1 + sum2);
    b[1] = Times(even1 + odd1, factors);
    b[2] = Times(even2 + odd2, factors + 2);
    b[3] = Times(even2 - odd2, factors + 4);
    b[4] = Times(even1 - odd1, factors + 6);
  } else {
    const Complex even_sum = a[0] + a[2];
    const Complex even_difference = a[0] - a[2];
    const Complex odd_sum = a[1] + a[3];
    const Complex odd_difference = Turned(a[1] - a[3]);
    b[0] = even_sum + odd_sum;
    b[1] = Times(even_difference + odd_difference, factors);
    b[2] = Times(even_sum - odd_sum, factors + 2);
    b[3] = Times(even_difference - odd_difference, factors + 4);
  }
}

template <int kRadix>
void Stage(const FourierStage& stage, const float* HWY_RESTRICT from_re, const float* HWY_RESTRICT from_im,
           float* HWY_RESTRICT to_re, float* HWY_RESTRICT to_im) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto m = static_cast<std::size_t>(stage.n / kRadix);
  const std::size_t run = static_cast<std::size_t>(stage.stride) * kLanes;
  const float* factors = stage.factors;
  for (std::size_t p = 0; p < m; ++p, factors += 2 * (kRadix - 1)) {
    for (std::size_t q = 0; q < run; q += lanes) {
      Complex a[kRadix];
      Complex b[kRadix];
      for (std::size_t k = 0; k < kRadix; ++k) {
        const std::size_t at = (p + k * m) * run + q;
        a[k] = {hn::LoadU(d, from_re + at), hn::LoadU(d, from_im + at)};
      }
      Butterfly<kRadix>(a, factors, b);
      for (std::size_t j = 0; j < kRadix; ++j) {
        const std::size_t at = (kRadix * p + j) * run + q;
        hn::StoreU(b[j].re, d, to_re + at);
        hn::StoreU(b[j].im, d, to_im + at);
      }
    }
  }
}

void Stages(const FourierStage& stage, const float* from_re, const float* from_im, float* to_re, float* to_im) {
  if (stage.radix == 5) return Stage<5>(stage, from_re, from_im, to_re, to_im);
  if (stage.radix == 4) return Stage<4>(stage, from_re, from_im, to_re, to_im);
  if (stage.radix == 3) return Stage<3>(stage, from_re, from_im, to_re, to_im);
  Stage<2>(stage, from_re, from_im, to_re, to_im);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Stages);

void fourier_stage(const FourierStage& stage, const float* from_re, const float* from_im, float* to_re, float* to_im) {
  HWY_DYNAMIC_DISPATCH(Stages)(stage, from_re, from_im, to_re, to_im);
}

}  // namespace azulejo::kernels
#endif
