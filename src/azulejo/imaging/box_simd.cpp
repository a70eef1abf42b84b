// How it is fast. Integers slide down columns: a row comes, a row goes. Along rows, sums of 1, 2, 4 … neighbours are made
// of one another, as vectors at two places, and those that make up the width are added: no value waits for the one before
// it. They stay in 16 bits as long as they fit. Floats don't slide, which would leave traces of what went; they are
// added by powers of two along columns, too.
#include "azulejo/imaging/box_kernels.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/box_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
std::ptrdiff_t Lanes() {
  return static_cast<std::ptrdiff_t>(hn::Lanes(hn::ScalableTag<T>()));
}

/// As many values as a vector of d has, as its type.
template <class D, class T>
HWY_INLINE hn::Vec<D> Promoted(D d, const T* from) {
  if constexpr (std::is_same_v<T, hn::TFromD<D>>) {
    return hn::LoadU(d, from);
  } else {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<T, D>(), from));
  }
}

/// Sums of `columns` neighbours along a row, of type A, from column sums of type S. At most 10 doublings: 1023 + 1023 + 1.
template <class S, class A>
class RowSums {
 public:
  /// count     of the longest row of results
  /// greatest  what a column sum may be; not asked of floats
  RowSums(int columns, std::ptrdiff_t tap, std::ptrdiff_t count, std::int64_t greatest, Scratch& scratch)
      : columns_(columns), tap_(tap), top_(std::bit_width(static_cast<unsigned>(columns)) - 1), last_low_(top_) {
    if constexpr (!std::is_same_v<S, A>) {
      last_low_ = 0;
      while (last_low_ < top_ && greatest * ((4 << last_low_) - 1) <= 0xFFFF) ++last_low_;
    }
    const auto room = static_cast<std::size_t>(count + columns * tap + 2 * Lanes<S>());
    for (int k = 1; k <= last_low_; ++k) low_[k] = scratch.take<S>(room);
    for (int k = last_low_ + 1; k <= top_; ++k) high_[k] = scratch.take<A>(room);
  }

  /// store(i, sums from i on) for vectors of A that make up `count` sums; the last one reaches beyond, and so do those that
  /// are read of the column sums.
  template <class Store>
  HWY_INLINE void Make(const S* columns, std::ptrdiff_t count, const Store& store) const {
    for (int k = 1; k <= top_; ++k) {
      const std::ptrdiff_t step = (std::ptrdiff_t{1} << (k - 1)) * tap_;
      const std::ptrdiff_t needed = count + columns_ * tap_ - 2 * step;
      const S* const from = k == 1 ? columns : low_[k - 1];
      if (k <= last_low_) {
        Double(from, step, needed, low_[k]);
      } else if (k == last_low_ + 1) {
        Double(from, step, needed, high_[k]);
      } else {
        Double(high_[k - 1], step, needed, high_[k]);
      }
    }
    Gather(columns, count, store);
  }

 private:
  template <class From, class To>
  static HWY_INLINE void Double(const From* HWY_RESTRICT from, std::ptrdiff_t step, std::ptrdiff_t count,
                                To* HWY_RESTRICT to) {
    const hn::ScalableTag<To> d;
    for (std::ptrdiff_t i = 0; i < count; i += Lanes<To>()) {
      hn::Store(hn::Add(Promoted(d, from + i), Promoted(d, from + i + step)), d, to + i);
    }
  }

  /// Adds the parts that the window's width is made of.
  template <class Store>
  HWY_INLINE void Gather(const S* columns, std::ptrdiff_t count, const Store& store) const {
    const hn::ScalableTag<A> d;
    const hn::Rebind<S, decltype(d)> ds;
    const S* lows[kDoublings + 1] = {};
    const A* highs[kDoublings + 1];
    int low_count = 0;
    int high_count = 0;
    for (int k = 0, done = 0; k <= top_; ++k) {
      if ((columns_ >> k & 1) == 0) continue;
      if (k <= last_low_) {
        lows[low_count++] = k == 0 ? columns : low_[k] + done * tap_;
      } else {
        highs[high_count++] = high_[k] + done * tap_;
      }
      done += 1 << k;
    }
    const S* const first = lows[0];
    const S* const second = lows[1];
    const auto add = [&](std::ptrdiff_t i, auto low) HWY_ATTR {
      for (int k = 2; k < low_count; ++k) low = hn::Add(low, hn::LoadU(ds, lows[k] + i));
      auto all = hn::Zero(d);
      if constexpr (std::is_same_v<S, A>) {
        all = low;
      } else {
        all = hn::PromoteTo(d, low);
        for (int k = 0; k < high_count; ++k) all = hn::Add(all, hn::LoadU(d, highs[k] + i));
      }
      store(i, all);
    };
    if (low_count == 1) {
      for (std::ptrdiff_t i = 0; i < count; i += Lanes<A>()) add(i, hn::LoadU(ds, first + i));
    } else {
      for (std::ptrdiff_t i = 0; i < count; i += Lanes<A>()) {
        add(i, hn::Add(hn::LoadU(ds, first + i), hn::LoadU(ds, second + i)));
      }
    }
  }

  static constexpr int kDoublings = 10;
  int columns_;
  std::ptrdiff_t tap_;
  int top_;                      ///< the greatest power of two that is not above columns_
  int last_low_;                 ///< up to this power sums are of type S, and so are all parts up to it together
  S* low_[kDoublings + 1] = {};  ///< sums of 2^k neighbours
  A* high_[kDoublings + 1] = {};
};

/// Division by an odd number of sums, rounded half up.
template <class A>
class Divider;

/// By the upper half of a product. Source: Granlund & Montgomery, Division by invariant integers using multiplication,
/// PLDI 1994.
template <>
class Divider<std::uint16_t> {
 public:
  explicit Divider(std::int64_t divisor)
      : shift_(static_cast<int>(std::bit_width(static_cast<std::uint64_t>(divisor))) - 1),
        factor_((std::int64_t{0x10000} << shift_) / divisor + 1),
        half_(static_cast<std::uint16_t>(divisor / 2)),
        exact_((255 * divisor + half_) * (factor_ * divisor - (std::int64_t{0x10000} << shift_)) < std::int64_t{0x10000}
                                                                                                       << shift_) {}
  /// Whether it is right for all sums of `divisor` bytes, and these fit 16 bits.
  static bool Serves(std::int64_t divisor) { return divisor <= 256 && Divider(divisor).exact_; }

  HWY_INLINE void operator()(hn::Vec<hn::ScalableTag<std::uint16_t>> sum, std::uint8_t* to) const {
    const hn::ScalableTag<std::uint16_t> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto product = hn::MulHigh(hn::Add(sum, hn::Set(d, half_)), hn::Set(d, static_cast<std::uint16_t>(factor_)));
    const auto quotient = hn::BitCast(di, hn::ShiftRightSame(product, shift_));
    hn::StoreU(hn::DemoteTo(hn::Rebind<std::uint8_t, decltype(di)>(), quotient),
               hn::Rebind<std::uint8_t, decltype(di)>(), to);
  }

 private:
  int shift_;
  std::int64_t factor_;  ///< 2^(16 + shift) ÷ divisor, rounded up
  std::uint16_t half_;
  bool exact_;
};

/// By a product in f32, off by at most one, and put right. Of sums of bytes it is off by less than 255.5 · 3 · 2⁻²⁴, and
/// right where halves are further than that from what an odd divisor gives: 1 / (2 · divisor).
template <>
class Divider<std::int32_t> {
 public:
  explicit Divider(std::int64_t divisor)
      : divisor_(static_cast<std::int32_t>(divisor)), factor_(1.0F / static_cast<float>(divisor)) {}

  template <class T>
  HWY_INLINE void operator()(hn::Vec<hn::ScalableTag<std::int32_t>> sum, T* to) const {
    const hn::ScalableTag<std::int32_t> d;
    const hn::RebindToFloat<decltype(d)> df;
    const hn::Rebind<T, decltype(d)> dt;
    const auto by = hn::Set(d, divisor_);
    const auto raised = hn::Add(sum, hn::Set(d, divisor_ / 2));
    auto quotient = hn::ConvertTo(d, hn::Mul(hn::ConvertTo(df, raised), hn::Set(df, factor_)));
    if (std::is_same_v<T, std::uint8_t> && divisor_ < 10'000) return hn::StoreU(hn::DemoteTo(dt, quotient), dt, to);
    const auto rest = hn::Sub(raised, hn::Mul(quotient, by));
    quotient = hn::Add(quotient, hn::BroadcastSignBit(rest));
    quotient = hn::Sub(quotient, hn::VecFromMask(d, hn::Gt(rest, hn::Set(d, divisor_ - 1))));
    hn::StoreU(hn::DemoteTo(dt, quotient), dt, to);
  }

 private:
  std::int32_t divisor_;
  float factor_;
};

/// sums[i] += come[i] − gone[i]; `gone` may be null.
template <class S, class T>
HWY_INLINE void Slide(const T* come, const T* gone, std::ptrdiff_t count, S* HWY_RESTRICT sums) {
  const hn::ScalableTag<S> d;
  std::ptrdiff_t i = 0;
  for (; i + Lanes<S>() <= count; i += Lanes<S>()) {
    auto sum = hn::Add(hn::Load(d, sums + i), Promoted(d, come + i));
    if (gone != nullptr) sum = hn::Sub(sum, Promoted(d, gone + i));
    hn::Store(sum, d, sums + i);
  }
  for (; i < count; ++i) sums[i] = static_cast<S>(sums[i] + come[i] - (gone != nullptr ? gone[i] : T{0}));
}

/// Values of a row that go through all steps together: what lies between stays in the first-level cache.
constexpr std::ptrdiff_t kPanel = 1024;

template <class S, class A, class T>
HWY_NOINLINE void Tile(const WindowTile<T>& tile, std::ptrdiff_t tap, const BoxWindow& window, Scratch& scratch) {
  const std::ptrdiff_t margin = (window.columns - 1) * tap;
  const std::ptrdiff_t panel = std::max(kPanel, 2 * margin / kPanel * kPanel);
  const std::int64_t greatest = std::int64_t{std::numeric_limits<T>::max()} * window.rows;
  const RowSums<S, A> row_sums(window.columns, tap, panel, greatest, scratch);
  S* const sums = scratch.take<S>(static_cast<std::size_t>(panel + margin + 2 * Lanes<S>()));
  const Divider<A> divide(window.pixels());
  T* const rest = scratch.take<T>(static_cast<std::size_t>(panel));
  for (std::ptrdiff_t left = 0; left < tile.width * tap; left += panel) {
    const std::ptrdiff_t count = std::min(panel, tile.width * tap - left);
    const std::ptrdiff_t whole = count / Lanes<A>() * Lanes<A>();
    const T* const source = tile.source + left;
    std::fill_n(sums, count + margin, S{0});
    for (int y = 0; y < window.rows - 1; ++y) {
      Slide(source + y * tile.source_stride, static_cast<const T*>(nullptr), count + margin, sums);
    }
    for (int y = 0; y < tile.height; ++y) {
      const T* const gone = y == 0 ? nullptr : source + (y - 1) * tile.source_stride;
      Slide(source + (y + window.rows - 1) * tile.source_stride, gone, count + margin, sums);
      T* const result = tile.result + y * tile.result_stride + left;
      row_sums.Make(sums, count,
                    [&](std::ptrdiff_t i, auto sum) HWY_ATTR { divide(sum, i < whole ? result + i : rest); });
      std::copy_n(rest, count - whole, result + whole);
    }
  }
}

void BoxU8(const WindowTile<std::uint8_t>& tile, int channels, const BoxWindow& window, Scratch& scratch) {
  if (Divider<std::uint16_t>::Serves(window.pixels())) {
    return Tile<std::uint16_t, std::uint16_t>(tile, channels, window, scratch);
  }
  if (window.rows <= 256) return Tile<std::uint16_t, std::int32_t>(tile, channels, window, scratch);
  Tile<std::int32_t, std::int32_t>(tile, channels, window, scratch);
}

void BoxU16(const WindowTile<std::uint16_t>& tile, int channels, const BoxWindow& window, Scratch& scratch) {
  Tile<std::int32_t, std::int32_t>(tile, channels, window, scratch);
}

/// A row of vectors that are summed together: additions wait for the one before.
constexpr std::ptrdiff_t kTogether = 4;

/// The sums of kCount vectors of columns, `height` rows of them, as anchored_sum adds them.
/// before  room for window.rows rows of kTogether vectors
template <int kCount>
HWY_INLINE void SumColumns(const float* HWY_RESTRICT source, std::ptrdiff_t source_stride, int height, int window_rows,
                           int first_row, float* HWY_RESTRICT before, float* HWY_RESTRICT sums,
                           std::ptrdiff_t sums_stride) {
  const hn::ScalableTag<float> d;
  const std::ptrdiff_t lanes = Lanes<float>();
  const auto add_row = [&](hn::Vec<decltype(d)>* HWY_RESTRICT sum, int y) HWY_ATTR {
    for (int k = 0; k < kCount; ++k) sum[k] = hn::Add(sum[k], hn::LoadU(d, source + y * source_stride + k * lanes));
  };
  const auto take_row = [&](hn::Vec<decltype(d)>* HWY_RESTRICT sum, int y) HWY_ATTR {
    for (int k = 0; k < kCount; ++k) sum[k] = hn::LoadU(d, source + y * source_stride + k * lanes);
  };
  int split = window_rows - (first_row % window_rows + window_rows) % window_rows;
  for (int top = 0; top < height; top = split, split += window_rows) {
    // All windows that begin above the split: the rows from there on were summed up from the split, and are now downwards.
    const int end = std::min(height, split);
    hn::Vec<decltype(d)> sum[kCount];
    for (int y = split - 1; y >= top; --y) {
      y == split - 1 ? take_row(sum, y) : add_row(sum, y);
      if (y >= end) continue;
      for (int k = 0; k < kCount; ++k) hn::Store(sum[k], d, before + ((y - top) * kCount + k) * lanes);
    }
    for (int y = split; y < top + window_rows - 1; ++y) y == split ? take_row(sum, y) : add_row(sum, y);
    for (int y = top; y < end; ++y) {
      const int last = y + window_rows - 1;
      if (last == split) take_row(sum, last);
      if (last > split) add_row(sum, last);
      for (int k = 0; k < kCount; ++k) {
        const auto upper = hn::Load(d, before + ((y - top) * kCount + k) * lanes);
        hn::StoreU(last < split ? upper : hn::Add(upper, sum[k]), d, sums + y * sums_stride + k * lanes);
      }
    }
  }
}

/// A tile whose rows are at least a vector long. Panels of columns, some rows at a time: the sums of columns stay in the
/// second-level cache.
HWY_NOINLINE void WideTile(const WindowTile<float>& tile, int channels, const BoxWindow& window, int first_row,
                           Scratch& scratch) {
  constexpr int kBand = 64;
  const hn::ScalableTag<float> d;
  const std::ptrdiff_t lanes = Lanes<float>();
  const std::ptrdiff_t values = std::ptrdiff_t{tile.width} * channels;
  const std::ptrdiff_t margin = (window.columns - 1) * channels;
  const std::ptrdiff_t panel = std::max(kPanel, margin / kPanel * kPanel);
  const std::ptrdiff_t stride = panel + (margin + 2 * lanes - 1) / lanes * lanes;
  const RowSums<float, float> row_sums(window.columns, channels, panel, 0, scratch);
  float* const before = scratch.take<float>(static_cast<std::size_t>(std::min(window.rows, kBand) * kTogether * lanes));
  float* const sums = scratch.take<float>(static_cast<std::size_t>(kBand * stride));
  float* const rest = scratch.take<float>(static_cast<std::size_t>(lanes));
  const auto pixels = hn::Set(d, static_cast<float>(window.pixels()));
  for (int top = 0; top < tile.height; top += kBand) {
    const int height = std::min(kBand, tile.height - top);
    for (std::ptrdiff_t begin = 0; begin < values; begin += panel) {
      // The last panel is moved back where it would be shorter than a vector.
      const std::ptrdiff_t left = std::min(begin, values - lanes);
      const std::ptrdiff_t count = std::min(panel, values - left);
      const std::ptrdiff_t columns = count + margin;
      const float* const source = tile.source + top * tile.source_stride + left;
      const auto sum_columns = [&]<int kCount>(std::ptrdiff_t i, std::integral_constant<int, kCount>) HWY_ATTR {
        SumColumns<kCount>(source + i, tile.source_stride, height, window.rows, first_row + top, before, sums + i,
                           stride);
      };
      std::ptrdiff_t i = 0;
      for (; i + kTogether * lanes <= columns; i += kTogether * lanes) {
        sum_columns(i, std::integral_constant<int, static_cast<int>(kTogether)>());
      }
      for (; i + lanes <= columns; i += lanes) sum_columns(i, std::integral_constant<int, 1>());
      if (i < columns) sum_columns(columns - lanes, std::integral_constant<int, 1>());
      const std::ptrdiff_t whole = count / lanes * lanes;
      for (int y = 0; y < height; ++y) {
        float* const result = tile.result + (top + y) * tile.result_stride + left;
        row_sums.Make(sums + y * stride, count, [&](std::ptrdiff_t k, auto sum) HWY_ATTR {
          hn::StoreU(hn::Div(sum, pixels), d, k < whole ? result + k : rest);
        });
        std::copy_n(rest, count - whole, result + whole);
      }
    }
  }
}

void BoxF32(const WindowTile<float>& tile, int channels, const BoxWindow& window, int first_row, Scratch& scratch) {
  const auto lanes = static_cast<int>(Lanes<float>());
  if (tile.width * channels >= lanes) return WideTile(tile, channels, window, first_row, scratch);
  // By way of padded memory.
  const std::ptrdiff_t source_stride = (lanes + window.columns - 1) * std::ptrdiff_t{channels};
  const std::ptrdiff_t used = (tile.width + window.columns - 1) * std::ptrdiff_t{channels};
  const std::ptrdiff_t result_stride = lanes * std::ptrdiff_t{channels};
  float* const source = scratch.take<float>(static_cast<std::size_t>(source_stride * (tile.height + window.rows - 1)));
  float* const result = scratch.take<float>(static_cast<std::size_t>(result_stride * tile.height));
  for (int y = 0; y < tile.height + window.rows - 1; ++y) {
    float* const row = source + y * source_stride;
    std::fill(std::copy_n(tile.source + y * tile.source_stride, used, row), row + source_stride, 0.0F);
  }
  WideTile({source, source_stride, result, result_stride, lanes, tile.height}, channels, window, first_row, scratch);
  for (int y = 0; y < tile.height; ++y) {
    std::copy_n(result + y * result_stride, tile.width * channels, tile.result + y * tile.result_stride);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(BoxU8);
HWY_EXPORT(BoxU16);
HWY_EXPORT(BoxF32);

void box_tile(const WindowTile<std::uint8_t>& tile, int channels, const BoxWindow& window, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(BoxU8)(tile, channels, window, scratch);
}
void box_tile(const WindowTile<std::uint16_t>& tile, int channels, const BoxWindow& window, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(BoxU16)(tile, channels, window, scratch);
}
void box_tile(const WindowTile<float>& tile, int channels, const BoxWindow& window, int first_row, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(BoxF32)(tile, channels, window, first_row, scratch);
}

}  // namespace azulejo::kernels
#endif
