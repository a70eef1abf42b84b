// How it is fast. Histograms are cumulative and in two parts: 16 counts of bytes up to the end of each sixteenth of the
// range, and in each sixteenth 16 counts of its bytes up to each value. So a byte enters a column's histogram by an
// addition of 16 ones and zeros to either part, and the place of the median is the number of sums that are less than half
// the window. A window's coarse part is the one before, plus a column, minus a column; of its fine parts only the one that
// the median is in is brought up to date, from where it was used before.
#include "azulejo/imaging/median_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/median_histogram_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::FixedTag<std::uint8_t, 16>;
using Shorts = hn::CappedTag<std::int16_t, 16>;

constexpr int kCounts = 16;  ///< of a part of a histogram
constexpr int kShorts = static_cast<int>(hn::MaxLanes(Shorts()));
constexpr int kVectors = kCounts / kShorts;
constexpr int kColumnBytes = kCounts * (kCounts + 1);  ///< of a column: its coarse part, then 16 fine ones
/// Columns of results that are computed together: the histograms of columns stay in the second-level cache.
constexpr int kStrip = 384;

/// 16 sums in 16 bits.
struct Sums {
  hn::Vec<Shorts> parts[kVectors];

  static HWY_INLINE Sums Load(const std::int16_t* from) {
    Sums sums;
    for (int i = 0; i < kVectors; ++i) sums.parts[i] = hn::Load(Shorts(), from + i * kShorts);
    return sums;
  }
  HWY_INLINE void Store(std::int16_t* to) const {
    for (int i = 0; i < kVectors; ++i) hn::StoreU(parts[i], Shorts(), to + i * kShorts);
  }
  HWY_INLINE void Add(const std::uint8_t* counts) {
    for (int i = 0; i < kVectors; ++i) parts[i] = hn::Add(parts[i], Promoted(counts, i));
  }
  HWY_INLINE void Subtract(const std::uint8_t* counts) {
    for (int i = 0; i < kVectors; ++i) parts[i] = hn::Sub(parts[i], Promoted(counts, i));
  }
  /// How many are below −`offset`.
  HWY_INLINE int Below(std::int16_t offset) const {
    const Shorts d;
    int count = 0;
    for (const auto& part : parts) {
      const auto below = hn::Lt(hn::Add(part, hn::Set(d, offset)), hn::Zero(d));
      count += static_cast<int>(hn::CountTrue(d, below));
    }
    return count;
  }

 private:
  static HWY_INLINE hn::Vec<Shorts> Promoted(const std::uint8_t* counts, int part) {
    return hn::PromoteTo(Shorts(), hn::Load(hn::Rebind<std::uint8_t, Shorts>(), counts + part * kShorts));
  }
};

/// The medians of strips of one channel.
class Histograms {
 public:
  Histograms(int radius, Scratch& scratch)
      : side_(2 * radius + 1),
        needed_(side_ * side_ / 2 + 1),
        columns_(scratch.take<std::uint8_t>(static_cast<std::size_t>(kColumnBytes) *
                                            static_cast<std::size_t>(kStrip + 2 * radius))),
        steps_(scratch.take<std::uint8_t>(kCounts * kCounts)),
        known_(scratch.take<std::int16_t>(kCounts * kCounts)) {
    for (int k = 0; k < kCounts * kCounts; ++k) steps_[k] = k % kCounts >= k / kCounts ? 1 : 0;
  }

  /// `width` ≤ kStrip columns of results; values are `tap` apart.
  void Compute(const std::uint8_t* source, std::ptrdiff_t source_stride, std::uint8_t* result,
               std::ptrdiff_t result_stride, std::ptrdiff_t tap, int width, int height) {
    const int used = width + side_ - 1;
    std::fill_n(columns_, std::ptrdiff_t{used} * kColumnBytes, std::uint8_t{0});
    for (int y = 0; y < side_ - 1; ++y) {
      for (int x = 0; x < used; ++x) Enter(x, source[y * source_stride + x * tap]);
    }
    for (int y = 0; y < height; ++y) {
      const std::uint8_t* const gone = source + (y - 1) * source_stride;
      const std::uint8_t* const come = source + (y + side_ - 1) * source_stride;
      if (y == 0) {
        for (int x = 0; x < used; ++x) Enter(x, come[x * tap]);
      } else {
        for (int x = 0; x < used; ++x) Replace(x, gone[x * tap], come[x * tap]);
      }
      Row(result + y * result_stride, tap, width);
    }
  }

 private:
  HWY_INLINE std::uint8_t* Coarse(int column) const { return columns_ + std::ptrdiff_t{column} * kColumnBytes; }
  HWY_INLINE std::uint8_t* Fine(int column, int part) const {
    return columns_ + std::ptrdiff_t{column} * kColumnBytes + (part + 1) * kCounts;
  }
  HWY_INLINE auto Step(int from) const { return hn::Load(Bytes(), steps_ + from * kCounts); }

  HWY_INLINE void Enter(int column, int value) const {
    const Bytes d;
    std::uint8_t* const coarse = Coarse(column);
    std::uint8_t* const fine = Fine(column, value / kCounts);
    hn::Store(hn::Add(hn::Load(d, coarse), Step(value / kCounts)), d, coarse);
    hn::Store(hn::Add(hn::Load(d, fine), Step(value % kCounts)), d, fine);
  }
  HWY_INLINE void Replace(int column, int gone, int come) const {
    const Bytes d;
    std::uint8_t* const coarse = Coarse(column);
    hn::Store(hn::Add(hn::Sub(hn::Load(d, coarse), Step(gone / kCounts)), Step(come / kCounts)), d, coarse);
    std::uint8_t* const fine_gone = Fine(column, gone / kCounts);
    hn::Store(hn::Sub(hn::Load(d, fine_gone), Step(gone % kCounts)), d, fine_gone);
    std::uint8_t* const fine_come = Fine(column, come / kCounts);
    hn::Store(hn::Add(hn::Load(d, fine_come), Step(come % kCounts)), d, fine_come);
  }

  HWY_INLINE void Slide(Sums& sums, int part, int from) const {
    sums.Subtract(Fine(from, part));
    sums.Add(Fine(from + side_, part));
  }

  /// The fine part of the window that begins at `column`, from where it was used before.
  HWY_INLINE Sums FineSums(int part, int column) const {
    const int known = known_at_[part];
    Sums sums;
    if (2 * (column - known) < side_) {
      sums = Sums::Load(known_ + part * kCounts);
      for (int x = known; x < column; ++x) Slide(sums, part, x);
    } else {
      for (auto& each : sums.parts) each = hn::Zero(Shorts());
      for (int x = column; x < column + side_; ++x) sums.Add(Fine(x, part));
    }
    return sums;
  }

  void Row(std::uint8_t* result, std::ptrdiff_t tap, int width) {
    std::fill_n(known_at_, kCounts, -side_);
    // Sums minus what is needed: below 0 where the median is above. Windows have up to 65025 values, twice what 16 bits
    // hold with a sign; less what is needed they fit.
    Sums coarse;
    for (auto& each : coarse.parts) each = hn::Set(Shorts(), static_cast<std::int16_t>(-needed_));
    for (int x = 0; x < side_; ++x) coarse.Add(Coarse(x));
    std::int16_t below[kCounts + 1];
    below[0] = static_cast<std::int16_t>(-needed_);
    int part = coarse.Below(0);
    Sums fine = FineSums(part, 0);
    for (int x = 0;; ++x) {
      coarse.Store(below + 1);
      const int value = fine.Below(below[part]);
      result[x * tap] = static_cast<std::uint8_t>(kCounts * part + value);
      if (x + 1 == width) break;
      coarse.Subtract(Coarse(x));
      coarse.Add(Coarse(x + side_));
      Slide(fine, part, x);
      const int next = coarse.Below(0);
      if (next != part) {
        fine.Store(known_ + part * kCounts);
        known_at_[part] = x + 1;
        part = next;
        fine = FineSums(part, x + 1);
      }
    }
  }

  const int side_;
  const int needed_;             ///< values up to the median, at least
  std::uint8_t* const columns_;  ///< histograms of columns of windows
  std::uint8_t* const steps_;    ///< 16 times 16 zeros and ones: ones from the first, second … on
  std::int16_t* const known_;    ///< fine parts of windows, where they were left
  int known_at_[kCounts] = {};   ///< where those windows begin
};

void HistogramU8(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch) {
  Histograms histograms(radius, scratch);
  for (int x = 0; x < tile.width; x += kStrip) {
    for (int c = 0; c < channels; ++c) {
      const std::ptrdiff_t column = std::ptrdiff_t{x} * channels + c;
      histograms.Compute(tile.source + column, tile.source_stride, tile.result + column, tile.result_stride, channels,
                         std::min(kStrip, tile.width - x), tile.height);
    }
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(HistogramU8);

void median_by_histogram(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(HistogramU8)(tile, channels, radius, scratch);
}

}  // namespace azulejo::kernels
#endif
