// How it is fast. One instruction multiplies the pairs of 16-bit values in a vector by two weights and adds the products.
// A pair of neighbours lies in the reach of two neighbouring results, by different weights: it is loaded once and used
// twice. Along a row of one channel neighbours lie in pairs as they are, rows of more channels are taken apart, and
// pairs of rows are interleaved once for all results. Symmetric taps are not added first: that saves no instruction,
// as sums would have to be paired anew for each result, and takes twice the loads.
#include "azulejo/imaging/gaussian_kernels.h"

#include <algorithm>
#include <atomic>
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

constexpr int kRows = 32;  ///< rows that go through both passes together, even

HWY_INLINE std::ptrdiff_t ShortLanes() { return static_cast<std::ptrdiff_t>(hn::Lanes(ShortTag())); }

/// Sums of two neighbouring results from the same pairs of values, four vectors of pairs at once.
struct PairSums {
  Ints even[4];
  Ints odd[4];
};

/// The weights of a pair.
HWY_INLINE Shorts WeightPair(const std::int16_t* weights) {
  std::int32_t pair;
  std::memcpy(&pair, weights, sizeof(pair));
  return hn::BitCast(ShortTag(), hn::Set(IntTag(), pair));
}

/// One pass: radius + 1 times four vectors of pairs, each `step` values behind the one before.
template <int kShift>
HWY_INLINE PairSums SumPairs(const std::int16_t* HWY_RESTRICT pairs, std::ptrdiff_t step,
                             const std::int16_t* HWY_RESTRICT weights, std::ptrdiff_t radius) {
  const ShortTag d;
  const IntTag di;
  const Ints half = hn::Set(di, 1 << (kShift - 1));
  Ints even0 = half, even1 = half, even2 = half, even3 = half;
  Ints odd0 = half, odd1 = half, odd2 = half, odd3 = half;
  for (std::ptrdiff_t j = 0; j <= radius; ++j, pairs += step, weights += 2) {
    const Shorts values0 = hn::LoadU(d, pairs);
    const Shorts values1 = hn::LoadU(d, pairs + hn::Lanes(d));
    const Shorts values2 = hn::LoadU(d, pairs + 2 * hn::Lanes(d));
    const Shorts values3 = hn::LoadU(d, pairs + 3 * hn::Lanes(d));
    // GCC 12 thinks reading memory twice as cheap as a register: it can't across a fence (which is no instruction).
    std::atomic_signal_fence(std::memory_order_acq_rel);
    const Shorts even = WeightPair(weights + 1);
    const Shorts odd = WeightPair(weights);
    even0 = hn::ReorderWidenMulAccumulate(di, values0, even, even0, even0);
    even1 = hn::ReorderWidenMulAccumulate(di, values1, even, even1, even1);
    even2 = hn::ReorderWidenMulAccumulate(di, values2, even, even2, even2);
    even3 = hn::ReorderWidenMulAccumulate(di, values3, even, even3, even3);
    odd0 = hn::ReorderWidenMulAccumulate(di, values0, odd, odd0, odd0);
    odd1 = hn::ReorderWidenMulAccumulate(di, values1, odd, odd1, odd1);
    odd2 = hn::ReorderWidenMulAccumulate(di, values2, odd, odd2, odd2);
    odd3 = hn::ReorderWidenMulAccumulate(di, values3, odd, odd3, odd3);
  }
  const auto shifted = [](Ints sum) HWY_ATTR { return hn::ShiftRight<kShift>(sum); };
  return {{shifted(even0), shifted(even1), shifted(even2), shifted(even3)},
          {shifted(odd0), shifted(odd1), shifted(odd2), shifted(odd3)}};
}

/// Both passes over bands of kRows rows. Results are bytes, or levels with kGaussianLevelBits more.
template <class Result>
class FixedPasses {
 public:
  FixedPasses(const GaussianTile<std::uint8_t>& tile, Result* result, std::ptrdiff_t result_stride, int channels,
              const std::int16_t* weights, int radius, Scratch& scratch)
      : tile_(tile),
        result_(result),
        result_stride_(result_stride),
        weights_(weights),
        radius_(radius),
        channels_(channels),
        step_(2 * ShortLanes()),
        columns_((tile.width + 2 * radius_) * channels),
        stride_((columns_ + step_ - 1) / step_ * step_ + 2 * step_),
        plane_stride_(tile.width + 2 * radius_ + 3 * step_) {
    const auto take = [&scratch](std::ptrdiff_t count) {
      return scratch.take<std::int16_t>(static_cast<std::size_t>(count));
    };
    panel_ = take((kRows + 2 * radius_) * step_);
    between_ = take(kRows * stride_);
    if (channels == 1) return;
    planes_ = take(channels * plane_stride_);
    smoothed_ = scratch.take<Result>(static_cast<std::size_t>(channels * plane_stride_));
  }

  void Run() {
    for (int y = 0; y < tile_.height; y += kRows) {
      const int rows = std::min(kRows, tile_.height - y);
      for (std::ptrdiff_t x = 0; x < columns_; x += step_) {
        FillPanel(y, rows, x);
        FirstPass(rows, x);
      }
      for (int i = 0; i < rows; ++i) {
        Result* const to = result_ + (y + i) * result_stride_;
        if (channels_ == 1) {
          SecondPass(between_ + i * stride_, to);
        } else {
          SecondPassByPlanes(between_ + i * stride_, to);
        }
      }
    }
  }

 private:
  /// The columns from x on as 16-bit values, each with that of the next row: first those of all even rows.
  /// What lies behind the last row and column is anything.
  void FillPanel(int y, int rows, std::ptrdiff_t x) {
    const ShortTag d;
    const std::ptrdiff_t lanes = ShortLanes();
    const std::ptrdiff_t count = std::min(step_, columns_ - x);
    const std::ptrdiff_t source_rows = rows + 2 * radius_;
    const std::uint8_t* from = tile_.source + y * tile_.source_stride + x;
    std::int16_t* to = panel_;
    HWY_ALIGN std::uint8_t rest[2][HWY_MAX_BYTES];
    for (std::ptrdiff_t i = 0; i < source_rows; i += 2, from += 2 * tile_.source_stride, to += 2 * step_) {
      const std::uint8_t* row0 = from;
      const std::uint8_t* row1 = i + 1 < source_rows ? from + tile_.source_stride : from;
      if (count < step_) {
        std::memcpy(rest[0], row0, static_cast<std::size_t>(count));
        std::memcpy(rest[1], row1, static_cast<std::size_t>(count));
        row0 = rest[0];
        row1 = rest[1];
      }
      for (std::ptrdiff_t half = 0; half < 2; ++half) {
        const Shorts a = Promoted(row0 + half * lanes);
        const Shorts b = Promoted(row1 + half * lanes);
        hn::Store(hn::InterleaveLower(d, a, b), d, to + 2 * half * lanes);
        hn::Store(hn::InterleaveUpper(d, a, b), d, to + (2 * half + 1) * lanes);
      }
    }
  }
  HWY_INLINE static Shorts Promoted(const std::uint8_t* from) {
    return hn::PromoteTo(ShortTag(), hn::LoadU(hn::Rebind<std::uint8_t, ShortTag>(), from));
  }

  /// Two rows at once.
  void FirstPass(int rows, std::ptrdiff_t x) {
    const ShortTag d;
    const std::ptrdiff_t lanes = ShortLanes();
    const std::ptrdiff_t stride = stride_;
    const std::ptrdiff_t radius = radius_;
    const std::int16_t* const weights = weights_;
    const std::int16_t* pairs = panel_;
    std::int16_t* to = between_ + x;
    for (int i = 0; i < rows; i += 2, pairs += 4 * lanes, to += 2 * stride) {
      const PairSums sums = SumPairs<kGaussianFirstShift>(pairs, 4 * lanes, weights, radius);
      hn::Store(hn::ReorderDemote2To(d, sums.even[0], sums.even[1]), d, to);
      hn::Store(hn::ReorderDemote2To(d, sums.even[2], sums.even[3]), d, to + lanes);
      hn::Store(hn::ReorderDemote2To(d, sums.odd[0], sums.odd[1]), d, to + stride);
      hn::Store(hn::ReorderDemote2To(d, sums.odd[2], sums.odd[3]), d, to + stride + lanes);
    }
  }

  /// A row of one channel.
  void SecondPass(const std::int16_t* row, Result* to) const {
    const std::ptrdiff_t width = tile_.width;
    const std::ptrdiff_t block = 2 * step_;
    std::ptrdiff_t x = 0;
    for (; x + block <= width; x += block) Write(row + x, to + x);
    if (x == width) return;
    if (width >= block) return Write(row + width - block, to + width - block);
    Result rest[2 * HWY_MAX_BYTES];
    Write(row, rest);
    std::memcpy(to, rest, static_cast<std::size_t>(width) * sizeof(Result));
  }
  HWY_INLINE void Write(const std::int16_t* pairs, Result* to) const {
    constexpr bool kBytes = sizeof(Result) == 1;
    constexpr int kShift = kBytes ? kGaussianSecondShift : kGaussianWeightBits;
    const hn::Rebind<Result, ShortTag> dr;
    const PairSums sums = SumPairs<kShift>(pairs, 2, weights_, radius_);
    for (std::size_t i = 0; i < 4; ++i) {
      const Shorts both = hn::BitCast(ShortTag(), hn::Or(sums.even[i], hn::ShiftLeft<16>(sums.odd[i])));
      if constexpr (kBytes) {
        hn::StoreU(hn::DemoteTo(dr, both), dr, to + i * hn::Lanes(dr));
      } else {
        hn::StoreU(both, dr, to + i * hn::Lanes(dr));
      }
    }
  }

  /// A row of more channels: taken apart, so that neighbours stand beside each other, and put together again.
  void SecondPassByPlanes(const std::int16_t* row, Result* to) {
    const ShortTag d;
    const std::ptrdiff_t lanes = ShortLanes();
    std::int16_t* const plane = planes_;
    const std::ptrdiff_t stride = plane_stride_;
    for (std::ptrdiff_t x = 0; x < tile_.width + 2 * radius_; x += lanes) {
      Shorts v[4];
      if (channels_ == 2) {
        hn::LoadInterleaved2(d, row + 2 * x, v[0], v[1]);
      } else if (channels_ == 3) {
        hn::LoadInterleaved3(d, row + 3 * x, v[0], v[1], v[2]);
      } else {
        hn::LoadInterleaved4(d, row + 4 * x, v[0], v[1], v[2], v[3]);
      }
      for (std::ptrdiff_t c = 0; c < channels_; ++c) hn::StoreU(v[c], d, plane + c * stride + x);
    }
    for (std::ptrdiff_t c = 0; c < channels_; ++c) SecondPass(plane + c * stride, smoothed_ + c * stride);
    Interleave(to);
  }
  void Interleave(Result* to) const {
    const hn::ScalableTag<Result> d8;
    const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d8));
    const std::ptrdiff_t width = tile_.width;
    const Result* const from = smoothed_;
    const auto value = [&](std::ptrdiff_t x, std::ptrdiff_t c)
                           HWY_ATTR { return hn::LoadU(d8, from + c * plane_stride_ + x); };
    const auto write = [&](std::ptrdiff_t x, Result* at) HWY_ATTR {
      if (channels_ == 2) return hn::StoreInterleaved2(value(x, 0), value(x, 1), d8, at);
      if (channels_ == 3) return hn::StoreInterleaved3(value(x, 0), value(x, 1), value(x, 2), d8, at);
      return hn::StoreInterleaved4(value(x, 0), value(x, 1), value(x, 2), value(x, 3), d8, at);
    };
    std::ptrdiff_t x = 0;
    for (; x + lanes <= width; x += lanes) write(x, to + x * channels_);
    if (x == width) return;
    Result rest[4 * HWY_MAX_BYTES];
    write(x, rest);
    std::memcpy(to + x * channels_, rest, static_cast<std::size_t>((width - x) * channels_) * sizeof(Result));
  }

  const GaussianTile<std::uint8_t> tile_;
  Result* const result_;
  const std::ptrdiff_t result_stride_;
  const std::int16_t* const weights_;
  const std::ptrdiff_t radius_;
  const std::ptrdiff_t channels_;
  const std::ptrdiff_t step_;     ///< columns of the first pass computed at once
  const std::ptrdiff_t columns_;  ///< values of a row of the source
  const std::ptrdiff_t stride_;   ///< of between_
  const std::ptrdiff_t plane_stride_;
  std::int16_t* panel_;             ///< step_ columns of the source, two rows a row
  std::int16_t* between_;           ///< the first pass's results
  std::int16_t* planes_ = nullptr;  ///< one row of them, channel by channel
  Result* smoothed_ = nullptr;      ///< the same of the result
};

void GaussianFixed(const GaussianTile<std::uint8_t>& tile, int channels, const std::int16_t* weights, int radius,
                   Scratch& scratch) {
  FixedPasses<std::uint8_t>(tile, tile.result, tile.result_stride, channels, weights, radius, scratch).Run();
}
void GaussianLevels(const GaussianTile<std::uint8_t>& tile, std::int16_t* result, std::ptrdiff_t result_stride,
                    int channels, const std::int16_t* weights, int radius, Scratch& scratch) {
  FixedPasses<std::int16_t>(tile, result, result_stride, channels, weights, radius, scratch).Run();
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(GaussianFixed);
HWY_EXPORT(GaussianLevels);

void gaussian_tile(const GaussianTile<std::uint8_t>& tile, int channels, const std::int16_t* weights, int radius,
                   Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(GaussianFixed)(tile, channels, weights, radius, scratch);
}
void gaussian_levels(const GaussianTile<std::uint8_t>& tile, std::int16_t* result, std::ptrdiff_t result_stride,
                     int channels, const std::int16_t* weights, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(GaussianLevels)(tile, result, result_stride, channels, weights, radius, scratch);
}

}  // namespace azulejo::kernels
#endif
