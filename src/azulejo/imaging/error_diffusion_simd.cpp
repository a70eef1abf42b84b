#include "azulejo/imaging/error_diffusion_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/error_diffusion_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::size_t DiffusionRows() { return hn::Lanes(hn::ScalableTag<float>()); }

// At step t, lane r is at value t − 2 · period · r of its row: what it needs of the row above was computed before, at
// steps t − period (above right), t − 2 period (above) and t − 3 period (above left), in the lane before it.
void DiffuseBand(const DiffusionBand& band) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  constexpr std::size_t kSlots = 16;  // more than 3 periods
  const std::size_t lanes = hn::Lanes(d);
  const auto period = static_cast<std::ptrdiff_t>(band.period);
  const auto count = static_cast<std::ptrdiff_t>(band.count);
  const auto lag = 2 * period;
  HWY_ALIGN float errors[kSlots * HWY_MAX_BYTES / sizeof(float)] = {};  // of each lane
  HWY_ALIGN float uppers[kSlots * HWY_MAX_BYTES / sizeof(float)] = {};  // of the lane before
  const auto slot = [&](float* ring, std::ptrdiff_t t) {
    return ring + (static_cast<std::size_t>(t) % kSlots) * lanes;
  };
  for (std::ptrdiff_t t = -3 * period; t < 0; ++t) *slot(uppers, t) = band.above[t + lag];

  HWY_ALIGN std::int32_t numbers[HWY_MAX_BYTES / sizeof(std::int32_t)];
  for (std::size_t r = 0; r < lanes; ++r) numbers[r] = r == 0 ? 0 : static_cast<std::int32_t>(r) - 1;
  const auto before = hn::SetTableIndices(d, numbers);
  const auto lane = hn::Iota(di, 0);
  const auto first = hn::RebindMask(d, hn::Eq(lane, hn::Zero(di)));
  const auto places =
      hn::Mul(lane, hn::Set(di, static_cast<std::int32_t>(band.stride) - static_cast<std::int32_t>(lag)));
  const auto behind = hn::Mul(lane, hn::Set(di, static_cast<std::int32_t>(lag)));
  const auto end = hn::Set(di, static_cast<std::int32_t>(count));
  const auto right = hn::Set(di, static_cast<std::int32_t>(count - period - 1));
  const auto left = hn::Set(di, static_cast<std::int32_t>(period));
  const auto last = hn::Set(d, band.last);
  HWY_ALIGN float levels[HWY_MAX_BYTES / sizeof(float)];

  const std::ptrdiff_t steps = count + lag * static_cast<std::ptrdiff_t>(lanes - 1);
  for (std::ptrdiff_t t = 0; t < steps; ++t) {
    const auto at = hn::Sub(hn::Set(di, static_cast<std::int32_t>(t)), behind);
    const auto amount = hn::GatherIndex(d, band.rows + t, places);
    const auto received_left = hn::Add(hn::Mul(hn::Set(d, 7.0F), hn::Load(d, slot(errors, t - period))),
                                       hn::Load(d, slot(uppers, t - 3 * period)));
    auto down = hn::Add(hn::Set(d, 5.0F), hn::IfThenElseZero(hn::RebindMask(d, hn::Lt(at, left)), hn::Set(d, 3.0F)));
    down = hn::Add(down, hn::IfThenElseZero(hn::RebindMask(d, hn::Gt(at, right)), hn::Set(d, 8.0F)));
    const auto received_above = hn::Add(hn::Mul(down, hn::Load(d, slot(uppers, t - 2 * period))),
                                        hn::Mul(hn::Set(d, 3.0F), hn::Load(d, slot(uppers, t - period))));
    const auto received = hn::Add(received_left, received_above);
    const auto wanted = hn::Add(amount, hn::Mul(received, hn::Set(d, 1.0F / 16.0F)));
    const auto below = hn::Floor(wanted);
    const auto up = hn::Ge(hn::Sub(wanted, below), hn::Set(d, 0.5F));
    const auto level = hn::Min(hn::Max(hn::Add(below, hn::IfThenElseZero(up, hn::Set(d, 1.0F))), hn::Zero(d)), last);
    const auto number = hn::Eq(amount, amount);
    const auto inside = hn::And(hn::Gt(at, hn::Set(di, -1)), hn::Lt(at, end));
    auto error = hn::IfThenElseZero(number, hn::Sub(wanted, level));
    error = hn::IfThenElseZero(hn::RebindMask(d, inside), error);
    float* const mine = slot(errors, t);
    hn::Store(error, d, mine);
    const float above = t + lag < count + period ? band.above[t + lag] : 0.0F;
    hn::Store(hn::IfThenElse(first, hn::Set(d, above), hn::TableLookupLanes(error, before)), d, slot(uppers, t));

    hn::Store(hn::IfThenElse(number, level, amount), d, levels);
    const std::ptrdiff_t from = t < count ? 0 : (t - count) / lag + 1;
    const std::ptrdiff_t to = std::min(static_cast<std::ptrdiff_t>(band.height) - 1, t / lag);
    float* place = band.rows + from * static_cast<std::ptrdiff_t>(band.stride) + (t - lag * from);
    for (std::ptrdiff_t r = from; r <= to; ++r, place += static_cast<std::ptrdiff_t>(band.stride) - lag) {
      *place = levels[r];
    }
    const std::ptrdiff_t done = t - lag * static_cast<std::ptrdiff_t>(lanes - 1);
    if (done >= 0) band.above[done] = mine[lanes - 1];
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(DiffusionRows);
HWY_EXPORT(DiffuseBand);

std::size_t diffusion_rows() { return HWY_DYNAMIC_DISPATCH(DiffusionRows)(); }
void diffuse_band(const DiffusionBand& band) { HWY_DYNAMIC_DISPATCH(DiffuseBand)(band); }

}  // namespace azulejo::kernels
#endif
