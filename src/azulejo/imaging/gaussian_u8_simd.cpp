// How it is fast. Taps at equal distances are added in 16 bits, the sums of neighbouring distances interleaved, and one
// instruction multiplies and adds the pairs: four taps of a whole vector of 16-bit values take eight instructions. Both
// passes write rows and differ in nothing but the distance of the taps.
#include "azulejo/imaging/gaussian_kernels.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/gaussian_u8_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using ShortTag = hn::ScalableTag<std::int16_t>;
using IntTag = hn::RepartitionToWide<ShortTag>;
using Shorts = hn::Vec<ShortTag>;
using Ints = hn::Vec<IntTag>;

constexpr int kRows = 32;  ///< rows that go through both passes together

HWY_INLINE std::ptrdiff_t Lanes() { return static_cast<std::ptrdiff_t>(hn::Lanes(ShortTag())); }

/// Sums of 2 · Lanes() values, in the order of the interleaved pairs.
struct Sums {
  Ints low[2];
  Ints high[2];

  /// Adds a · (the lower half of `weights`) + b · (the upper half).
  HWY_INLINE void Add(std::size_t i, Shorts a, Shorts b, Shorts weights) {
    const ShortTag d;
    const IntTag di;
    low[i] = hn::ReorderWidenMulAccumulate(di, hn::InterleaveLower(d, a, b), weights, low[i], low[i]);
    high[i] = hn::ReorderWidenMulAccumulate(di, hn::InterleaveUpper(d, a, b), weights, high[i], high[i]);
  }
  template <int kShift>
  HWY_INLINE Shorts Rounded(std::size_t i) const {
    return hn::ReorderDemote2To(ShortTag(), hn::ShiftRight<kShift>(low[i]), hn::ShiftRight<kShift>(high[i]));
  }
};

/// The weights of the taps at distances k and k + 1.
HWY_INLINE Shorts WeightPair(const std::int16_t* weights, std::ptrdiff_t k) {
  std::int32_t pair;
  std::memcpy(&pair, weights + k, sizeof(pair));
  return hn::BitCast(ShortTag(), hn::Set(IntTag(), pair));
}

/// 2 · Lanes() results of one pass, those from `center` on.
template <int kShift, bool kAligned>
HWY_INLINE Sums Smooth(const std::int16_t* HWY_RESTRICT center, std::ptrdiff_t tap,
                       const std::int16_t* HWY_RESTRICT weights, std::ptrdiff_t radius) {
  const ShortTag d;
  const auto load = [](const std::int16_t* from)
                        HWY_ATTR { return kAligned ? hn::Load(ShortTag(), from) : hn::LoadU(ShortTag(), from); };
  const auto both = [&](std::ptrdiff_t offset, std::size_t i) HWY_ATTR {
    const std::int16_t* const at = center + static_cast<std::ptrdiff_t>(i) * Lanes();
    return hn::Add(load(at - offset), load(at + offset));
  };
  const Ints half = hn::Set(IntTag(), 1 << (kShift - 1));
  Sums sums{{half, half}, {half, half}};
  const Shorts first = WeightPair(weights, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    sums.Add(i, load(center + static_cast<std::ptrdiff_t>(i) * Lanes()), both(tap, i), first);
  }
  std::ptrdiff_t k = 2;
  std::ptrdiff_t offset = 2 * tap;
  for (; k < radius; k += 2, offset += 2 * tap) {
    const Shorts pair = WeightPair(weights, k);
    for (std::size_t i = 0; i < 2; ++i) sums.Add(i, both(offset, i), both(offset + tap, i), pair);
  }
  if (k == radius) {
    const Shorts last = WeightPair(weights, k);
    for (std::size_t i = 0; i < 2; ++i) sums.Add(i, both(offset, i), hn::Zero(d), last);
  }
  return sums;
}

/// Both passes over bands of kRows rows.
class Passes {
 public:
  Passes(const GaussianTile<std::uint8_t>& tile, int channels, const std::int16_t* weights, int radius,
         Scratch& scratch)
      : tile_(tile),
        weights_(weights),
        radius_(radius),
        tap_(channels),
        step_(2 * Lanes()),
        values_(std::ptrdiff_t{tile.width} * channels),
        columns_(values_ + 2 * radius_ * tap_),
        stride_((columns_ + step_ - 1) / step_ * step_) {
    panel_ = scratch.take<std::int16_t>(static_cast<std::size_t>((kRows + 2 * radius_) * step_));
    between_ = scratch.take<std::int16_t>(static_cast<std::size_t>(kRows * stride_));
  }

  void Run() {
    for (int y = 0; y < tile_.height; y += kRows) {
      const int rows = std::min(kRows, tile_.height - y);
      for (std::ptrdiff_t x = 0; x < columns_; x += step_) {
        FillPanel(y, rows, x);
        FirstPass(rows, x);
      }
      for (int i = 0; i < rows; ++i) SecondPass(y + i, between_ + i * stride_);
    }
  }

 private:
  /// The columns from x on as 16-bit values. Behind the last column stands anything.
  void FillPanel(int y, int rows, std::ptrdiff_t x) {
    const ShortTag d;
    const hn::Rebind<std::uint8_t, ShortTag> d8;
    const std::ptrdiff_t lanes = Lanes();
    const std::ptrdiff_t count = std::min(step_, columns_ - x);
    const std::uint8_t* from = tile_.source + y * tile_.source_stride + x;
    std::int16_t* to = panel_;
    for (std::ptrdiff_t i = 0; i < rows + 2 * radius_; ++i, from += tile_.source_stride, to += step_) {
      if (count == step_) {
        hn::Store(hn::PromoteTo(d, hn::LoadU(d8, from)), d, to);
        hn::Store(hn::PromoteTo(d, hn::LoadU(d8, from + lanes)), d, to + lanes);
      } else {
        std::copy_n(from, count, to);
      }
    }
  }

  void FirstPass(int rows, std::ptrdiff_t x) {
    const ShortTag d;
    const std::ptrdiff_t step = step_;
    const std::ptrdiff_t radius = radius_;
    const std::int16_t* const weights = weights_;
    const std::int16_t* center = panel_ + radius * step;
    std::int16_t* to = between_ + x;
    for (int i = 0; i < rows; ++i, center += step, to += stride_) {
      const Sums sums = Smooth<kGaussianFirstShift, true>(center, step, weights, radius);
      hn::Store(sums.Rounded<kGaussianFirstShift>(0), d, to);
      hn::Store(sums.Rounded<kGaussianFirstShift>(1), d, to + Lanes());
    }
  }

  void SecondPass(int y, const std::int16_t* row) {
    std::uint8_t* const to = tile_.result + y * tile_.result_stride;
    const std::int16_t* const center = row + radius_ * tap_;
    std::ptrdiff_t x = 0;
    for (; x + step_ <= values_; x += step_) Write(center + x, to + x);
    if (x == values_) return;
    if (values_ >= step_) return Write(center + values_ - step_, to + values_ - step_);
    std::uint8_t rest[HWY_MAX_BYTES];
    Write(center, rest);
    std::copy_n(rest, values_, to);
  }
  HWY_INLINE void Write(const std::int16_t* center, std::uint8_t* to) const {
    const hn::Rebind<std::uint8_t, ShortTag> d8;
    const Sums sums = Smooth<kGaussianSecondShift, false>(center, tap_, weights_, radius_);
    hn::StoreU(hn::DemoteTo(d8, sums.Rounded<kGaussianSecondShift>(0)), d8, to);
    hn::StoreU(hn::DemoteTo(d8, sums.Rounded<kGaussianSecondShift>(1)), d8, to + Lanes());
  }

  const GaussianTile<std::uint8_t> tile_;
  const std::int16_t* const weights_;
  const std::ptrdiff_t radius_;
  const std::ptrdiff_t tap_;      ///< values from a tap of the second pass to the next
  const std::ptrdiff_t step_;     ///< values computed at once
  const std::ptrdiff_t values_;   ///< of a row of the result
  const std::ptrdiff_t columns_;  ///< values of a row of the source
  const std::ptrdiff_t stride_;   ///< of between_
  std::int16_t* panel_;           ///< rows of step_ values: the source
  std::int16_t* between_;         ///< the first pass's results
};

void GaussianFixed(const GaussianTile<std::uint8_t>& tile, int channels, const std::int16_t* weights, int radius,
                   Scratch& scratch) {
  Passes(tile, channels, weights, radius, scratch).Run();
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(GaussianFixed);

void gaussian_tile(const GaussianTile<std::uint8_t>& tile, int channels, const std::int16_t* weights, int radius,
                   Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(GaussianFixed)(tile, channels, weights, radius, scratch);
}

}  // namespace azulejo::kernels
#endif
