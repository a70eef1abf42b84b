#include "azulejo/modelling/cotangents.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/modelling/cotangents_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/math/arctangent_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void AnglesOfCotangents(float* values, std::size_t count) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto one = hn::Set(d, 1.0F);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::StoreU(atan2_deterministic(d, one, hn::LoadU(d, values + i)), d, values + i);
  }
  if (i == count) return;
  HWY_ALIGN float rest[HWY_MAX_BYTES / sizeof(float)] = {};
  for (std::size_t k = i; k < count; ++k) rest[k - i] = values[k];
  hn::Store(atan2_deterministic(d, one, hn::Load(d, rest)), d, rest);
  for (std::size_t k = i; k < count; ++k) values[k] = rest[k - i];
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(AnglesOfCotangents);

void angles_of_cotangents(float* values, std::size_t count) { HWY_DYNAMIC_DISPATCH(AnglesOfCotangents)(values, count); }

}  // namespace azulejo::kernels
#endif
