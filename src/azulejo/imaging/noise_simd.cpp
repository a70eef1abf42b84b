#include "azulejo/imaging/noise_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/noise_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/stored_inl.h"
#include "azulejo/math/normal_inl.h"
#include "azulejo/math/random_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void NoiseWords(const NoiseBits& place, std::uint32_t* words) {
  const hn::ScalableTag<std::uint32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  static_assert(4 * HWY_MAX_BYTES / sizeof(std::uint32_t) <= kNoiseRoom);
  for (std::size_t b = 0; b < place.blocks; b += lanes) {
    auto c0 = hn::Iota(d, static_cast<std::uint32_t>(place.first_block + b));
    auto c1 = hn::Set(d, place.row);
    auto c2 = hn::Zero(d);
    auto c3 = hn::Zero(d);
    Philox(d, c0, c1, c2, c3, place.seed, 0);
    hn::StoreInterleaved4(c0, c1, c2, c3, d, words + 4 * b);
  }
}

void NoiseDeviates(const std::uint32_t* words, std::size_t count, float* deviates) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(NormalDeviate(d, hn::LoadU(du, words + i)), d, deviates + i);
  noise_normal_reference(words + i, count - i, deviates + i);
}

template <class T>
void AddRow(const NoiseRow<T>& row) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);  // a multiple of every period
  HWY_ALIGN float marks[HWY_MAX_BYTES / sizeof(float)];
  for (std::size_t k = 0; k < lanes; ++k) {
    marks[k] = row.period > 0 && (static_cast<int>(k) + 1) % row.period == 0 ? 1.0F : 0.0F;
  }
  const auto is_alpha = hn::Gt(hn::Load(d, marks), hn::Zero(d));
  const auto base = hn::Set(d, row.base);
  const auto factor = hn::Set(d, row.factor);
  std::size_t i = 0;
  for (; i + lanes <= row.count; i += lanes) {
    const auto v = LoadStored(row.source + i);
    const auto change = hn::Mul(hn::LoadU(d, row.deviates + i), hn::Add(base, hn::Mul(factor, v)));
    StoreRounded(hn::IfThenElse(is_alpha, v, hn::Add(v, change)), row.result + i);
  }
  noise_add_reference(row, i);
}

void AddBytes(const NoiseRow<std::uint8_t>& row) { AddRow(row); }
void AddWords(const NoiseRow<std::uint16_t>& row) { AddRow(row); }
void AddFloats(const NoiseRow<float>& row) { AddRow(row); }

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(NoiseWords);
HWY_EXPORT(NoiseDeviates);
HWY_EXPORT(AddBytes);
HWY_EXPORT(AddWords);
HWY_EXPORT(AddFloats);

void noise_bits(const NoiseBits& place, std::uint32_t* words) { HWY_DYNAMIC_DISPATCH(NoiseWords)(place, words); }
void noise_normal(const std::uint32_t* words, std::size_t count, float* deviates) {
  HWY_DYNAMIC_DISPATCH(NoiseDeviates)(words, count, deviates);
}
void noise_add(const NoiseRow<std::uint8_t>& row) { HWY_DYNAMIC_DISPATCH(AddBytes)(row); }
void noise_add(const NoiseRow<std::uint16_t>& row) { HWY_DYNAMIC_DISPATCH(AddWords)(row); }
void noise_add(const NoiseRow<float>& row) { HWY_DYNAMIC_DISPATCH(AddFloats)(row); }

}  // namespace azulejo::kernels
#endif
