#include "azulejo/imaging/detail_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/detail_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;

struct Weights {
  explicit Weights(const DetailWeights& weights)
      : base(hn::Set(FloatTag(), weights.base)),
        gain(hn::Set(FloatTag(), weights.gain)),
        threshold(hn::Set(FloatTag(), weights.threshold)) {}

  HWY_INLINE Floats operator()(Floats s, Floats g) const {
    const auto difference = hn::Sub(s, g);
    const auto d = hn::IfThenZeroElse(hn::Lt(hn::Abs(difference), threshold), difference);
    return hn::Add(hn::Mul(base, s), hn::Mul(gain, d));
  }

  Floats base;
  Floats gain;
  Floats threshold;
};

void DetailF32(float* s, const float* g, std::size_t count, const DetailWeights& weights) {
  const FloatTag d;
  const Weights detailed_of(weights);
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(detailed_of(hn::LoadU(d, s + i), hn::LoadU(d, g + i)), d, s + i);
  if (i == count) return;
  HWY_ALIGN float rest[2][HWY_MAX_BYTES / sizeof(float)] = {};
  std::copy_n(s + i, count - i, rest[0]);
  std::copy_n(g + i, count - i, rest[1]);
  hn::Store(detailed_of(hn::Load(d, rest[0]), hn::Load(d, rest[1])), d, rest[0]);
  std::copy_n(rest[0], count - i, s + i);
}

/// A vector of f32 of bytes and of levels in 1/64.
HWY_INLINE Floats FromBytes(const std::uint8_t* s) {
  const hn::RebindToSigned<FloatTag> di;
  return hn::ConvertTo(FloatTag(), hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::uint8_t, FloatTag>(), s)));
}
HWY_INLINE Floats FromLevels(const std::int16_t* g) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  return hn::Mul(hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::int16_t, FloatTag>(), g))),
                 hn::Set(d, 1.0F / 64));
}

/// Calls f(s, g, result) for whole vectors; the rest goes through padded memory.
template <class Result, class F>
HWY_INLINE void ForVectors(const std::uint8_t* s, const std::int16_t* g, std::size_t count, Result* result,
                           const F& f) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) f(s + i, g + i, result + i);
  if (i == count) return;
  std::uint8_t bytes[HWY_MAX_BYTES] = {};
  std::int16_t levels[HWY_MAX_BYTES] = {};
  Result results[HWY_MAX_BYTES];
  std::copy_n(s + i, count - i, bytes);
  std::copy_n(g + i, count - i, levels);
  f(bytes, levels, results);
  std::copy_n(results, count - i, result + i);
}

void DetailBytes(const std::uint8_t* s, const std::int16_t* g, std::size_t count, const DetailWeights& weights,
                 std::uint8_t* result) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const hn::Rebind<std::uint8_t, FloatTag> d8;
  const Weights detailed_of(weights);
  ForVectors(s, g, count, result,
             [&](const std::uint8_t* bytes, const std::int16_t* levels, std::uint8_t* to) HWY_ATTR {
               const auto value = detailed_of(FromBytes(bytes), FromLevels(levels));
               const auto inside = hn::Min(hn::Max(value, hn::Zero(d)), hn::Set(d, 255.0F));
               hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(di, hn::Add(inside, hn::Set(d, 0.5F)))), d8, to);
             });
}

void DetailBytesToFloats(const std::uint8_t* s, const std::int16_t* g, std::size_t count, const DetailWeights& weights,
                         float scale, float* result) {
  const FloatTag d;
  const Weights detailed_of(weights);
  ForVectors(s, g, count, result, [&](const std::uint8_t* bytes, const std::int16_t* levels, float* to) HWY_ATTR {
    hn::StoreU(hn::Mul(detailed_of(FromBytes(bytes), FromLevels(levels)), hn::Set(d, scale)), d, to);
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(DetailF32);
HWY_EXPORT(DetailBytes);
HWY_EXPORT(DetailBytesToFloats);

void detail_row(float* s, const float* g, std::size_t count, const DetailWeights& weights) {
  HWY_DYNAMIC_DISPATCH(DetailF32)(s, g, count, weights);
}
void detail_row(const std::uint8_t* s, const std::int16_t* g, std::size_t count, const DetailWeights& weights,
                std::uint8_t* result) {
  HWY_DYNAMIC_DISPATCH(DetailBytes)(s, g, count, weights, result);
}
void detail_row(const std::uint8_t* s, const std::int16_t* g, std::size_t count, const DetailWeights& weights,
                float scale, float* result) {
  HWY_DYNAMIC_DISPATCH(DetailBytesToFloats)(s, g, count, weights, scale, result);
}

}  // namespace azulejo::kernels
#endif
