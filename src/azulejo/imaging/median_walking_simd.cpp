// How it is fast. All values of a block of windows and its margins are sorted once. From then on a value is its rank, and
// the median of a window is the rank with as many ranks of the window below it as above. The window moves by a pixel
// at a time, and the rank with it: how many values that come and go are below is counted a vector at a time, columns
// being contiguous; the way to the new median goes over the ranks between, whose places tell, a vector at a time, which
// are in the window. It isn't far, as the block has only a few times as many values as a window.
#include "azulejo/imaging/median_kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

#include "azulejo/imaging/rank_key.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/median_walking_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Shorts = hn::ScalableTag<std::int16_t>;

constexpr std::int16_t kNowhere = -0x8000;  ///< the place of ranks that there aren't

/// A bit for each lane.
template <class D>
HWY_INLINE std::uint64_t Bits(D d, hn::Mask<D> mask) {
  std::uint64_t bits = 0;
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

/// Of 16-bit ranks, those of values up to 65536 are told apart with a sign, as vectors compare them.
template <class Rank>
constexpr int kLeastRank = std::is_same_v<Rank, std::int16_t> ? -0x8000 : 0;

/// What a block's values are, by number x · height + y.
template <class Key, class Rank>
struct Ranking {
  int width;
  int height;
  Key* keys;             ///< by number
  std::uint32_t* order;  ///< numbers by rank
  Rank* ranks;           ///< by number, kLeastRank<Rank> being the least
  std::int16_t* x;       ///< by rank: its column, kNowhere for a vector before the first and behind the last
  std::int16_t* y;
};

/// Numbers in ascending order of their keys, equal keys in that of their numbers: by 8 or 11 bits, the lowest first.
/// In `order` or in `other`, whichever is returned.
template <class Key>
std::uint32_t* SortNumbers(const Key* keys, std::size_t count, std::uint32_t* order, std::uint32_t* other) {
  using Unsigned = std::make_unsigned_t<Key>;
  constexpr Unsigned kSign = std::is_signed_v<Key> ? Unsigned{1} << (8 * sizeof(Key) - 1) : 0;
  constexpr std::size_t kBits = sizeof(Key) == 4 ? 11 : 8;
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(i);
  for (std::size_t shift = 0; shift < 8 * sizeof(Key); shift += kBits) {
    const auto digit = [&](std::size_t i) { return (static_cast<Unsigned>(keys[i]) ^ kSign) >> shift & (kDigits - 1); };
    std::uint32_t places[kDigits] = {};
    for (std::size_t i = 0; i < count; ++i) ++places[digit(i)];
    if (places[digit(0)] == count) continue;
    std::uint32_t place = 0;
    for (std::uint32_t& each : places) place += std::exchange(each, place);
    for (std::size_t i = 0; i < count; ++i) other[places[digit(order[i])]++] = order[i];
    std::swap(order, other);
  }
  return order;
}

/// The rank of the median, and the window that it is of.
template <class Key, class Rank>
class Walk {
 public:
  Walk(const Ranking<Key, Rank>& values, int radius)
      : values_(values), side_(2 * radius + 1), half_(side_ * side_ / 2) {
    // The first window: the whole block is walked over, up to its median.
    Step();
  }

  std::uint32_t median() const { return values_.order[rank_]; }

  void Right() {
    below_ += Below(left_ + side_) - Below(left_);
    ++left_;
    Step();
  }
  void Left() {
    --left_;
    below_ += Below(left_) - Below(left_ + side_);
    Step();
  }
  void Down() {
    const Rank* const gone = values_.ranks + std::ptrdiff_t{left_} * values_.height + top_;
    for (int x = 0; x < side_; ++x) {
      const Rank* const column = gone + std::ptrdiff_t{x} * values_.height;
      below_ += (column[side_] < Own() ? 1 : 0) - (column[0] < Own() ? 1 : 0);
    }
    ++top_;
    Step();
  }

 private:
  Rank Own() const { return static_cast<Rank>(rank_ + kLeastRank<Rank>); }

  /// Values of a column of the window that are below the rank.
  HWY_INLINE int Below(int column) const {
    const hn::ScalableTag<Rank> d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const Rank* const ranks = values_.ranks + std::ptrdiff_t{column} * values_.height + top_;
    const auto own = hn::Set(d, Own());
    int count = 0;
    int i = 0;
    for (; i + lanes <= side_; i += lanes) {
      count += static_cast<int>(hn::CountTrue(d, hn::Lt(hn::LoadU(d, ranks + i), own)));
    }
    if (i < side_) {
      const auto rest = Bits(d, hn::Lt(hn::LoadU(d, ranks + i), own)) & ((std::uint64_t{1} << (side_ - i)) - 1);
      count += std::popcount(rest);
    }
    return count;
  }

  /// Which of a vector of ranks are in the window.
  HWY_INLINE std::uint64_t Inside(int first) const {
    const Shorts d;
    const auto in = [&](const std::int16_t* places, int begin) HWY_ATTR {
      const auto place = hn::LoadU(d, places + first);
      return hn::And(hn::Gt(place, hn::Set(d, static_cast<std::int16_t>(begin - 1))),
                     hn::Lt(place, hn::Set(d, static_cast<std::int16_t>(begin + side_))));
    };
    return Bits(d, hn::And(in(values_.x, left_), in(values_.y, top_)));
  }

  /// From a rank with below_ values of the window below it to the median.
  HWY_INLINE void Step() {
    const auto lanes = static_cast<int>(hn::Lanes(Shorts()));
    if (below_ > half_) {
      int passing = below_ - half_;  // values of the window on the way down
      for (;;) {
        rank_ -= lanes;
        std::uint64_t inside = Inside(rank_);
        const int count = std::popcount(inside);
        if (count >= passing) {
          for (; passing < count; ++passing) inside &= inside - 1;
          rank_ += std::countr_zero(inside);
          break;
        }
        passing -= count;
      }
    } else {
      int passing = half_ - below_;
      for (;;) {
        std::uint64_t inside = Inside(rank_);
        const int count = std::popcount(inside);
        if (count > passing) {
          for (; passing > 0; --passing) inside &= inside - 1;
          rank_ += std::countr_zero(inside);
          break;
        }
        passing -= count;
        rank_ += lanes;
      }
    }
    below_ = half_;
  }

  const Ranking<Key, Rank> values_;
  const int side_;
  const int half_;
  int left_ = 0;
  int top_ = 0;
  int rank_ = 0;
  int below_ = 0;  ///< values of the window below the rank
};

/// Columns and rows of results in a block: sorting is less work a result in large ones, the walk is shorter in small ones.
constexpr int BlockSide(int radius) { return std::min(24 + radius + radius / 2, 512); }

template <class Rank, class T>
void Block(const T* source, std::ptrdiff_t source_stride, T* result, std::ptrdiff_t result_stride, std::ptrdiff_t tap,
           int width, int height, int radius, Scratch& scratch) {
  using Key = RankKey<T>;
  const Scratch::Mark start = scratch.mark();
  const std::ptrdiff_t vector = static_cast<std::ptrdiff_t>(hn::Lanes(Shorts()));
  Ranking<Key, Rank> values{};
  values.width = width + 2 * radius;
  values.height = height + 2 * radius;
  const auto count = static_cast<std::size_t>(values.width) * static_cast<std::size_t>(values.height);
  values.keys = scratch.take<Key>(count);
  values.ranks = scratch.take<Rank>(count + static_cast<std::size_t>(vector));
  const std::size_t places = count + 2 * static_cast<std::size_t>(vector);
  values.x = scratch.take<std::int16_t>(places) + vector;
  values.y = scratch.take<std::int16_t>(places) + vector;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      values.keys[std::ptrdiff_t{x} * values.height + y] = rank_key(source[y * source_stride + x * tap]);
    }
  }
  values.order =
      SortNumbers(values.keys, count, scratch.take<std::uint32_t>(count), scratch.take<std::uint32_t>(count));
  std::int16_t* const x_of = scratch.take<std::int16_t>(count);
  std::int16_t* const y_of = scratch.take<std::int16_t>(count);
  for (std::size_t i = 0, x = 0; x < static_cast<std::size_t>(values.width); ++x) {
    for (int y = 0; y < values.height; ++y, ++i) {
      x_of[i] = static_cast<std::int16_t>(x);
      y_of[i] = static_cast<std::int16_t>(y);
    }
  }
  for (std::size_t rank = 0; rank < count; ++rank) {
    const std::uint32_t number = values.order[rank];
    values.ranks[number] = static_cast<Rank>(static_cast<int>(rank) + kLeastRank<Rank>);
    values.x[rank] = x_of[number];
    values.y[rank] = y_of[number];
  }
  for (std::int16_t* const each : {values.x, values.y}) {
    std::fill_n(each - vector, vector, kNowhere);
    std::fill_n(each + count, vector, kNowhere);
  }
  std::fill_n(values.ranks + count, vector, Rank{0});

  Walk<Key, Rank> walk(values, radius);
  const auto store = [&](int x, int y) {
    result[y * result_stride + x * tap] = ranked_value<T>(values.keys[walk.median()]);
  };
  for (int y = 0; y < height; ++y) {
    if (y > 0) walk.Down();
    if (y % 2 == 0) {
      store(0, y);
      for (int x = 1; x < width; ++x) {
        walk.Right();
        store(x, y);
      }
    } else {
      store(width - 1, y);
      for (int x = width - 2; x >= 0; --x) {
        walk.Left();
        store(x, y);
      }
    }
  }
  scratch.release(start);
}

template <class T>
void ByWalking(const WindowTile<T>& tile, int channels, int radius, Scratch& scratch) {
  const int side = BlockSide(radius);
  for (int y = 0; y < tile.height; y += side) {
    const int height = std::min(side, tile.height - y);
    for (int x = 0; x < tile.width; x += side) {
      const int width = std::min(side, tile.width - x);
      const bool few = (width + 2 * radius) * std::int64_t{height + 2 * radius} <= 0x10000;
      for (int c = 0; c < channels; ++c) {
        const std::ptrdiff_t column = std::ptrdiff_t{x} * channels + c;
        (few ? Block<std::int16_t, T>
             : Block<std::int32_t, T>)(tile.source + y * tile.source_stride + column, tile.source_stride,
                                       tile.result + y * tile.result_stride + column, tile.result_stride, channels,
                                       width, height, radius, scratch);
      }
    }
  }
}

void WalkingU8(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch) {
  ByWalking(tile, channels, radius, scratch);
}
void WalkingU16(const WindowTile<std::uint16_t>& tile, int channels, int radius, Scratch& scratch) {
  ByWalking(tile, channels, radius, scratch);
}
void WalkingF32(const WindowTile<float>& tile, int channels, int radius, Scratch& scratch) {
  ByWalking(tile, channels, radius, scratch);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(WalkingU8);
HWY_EXPORT(WalkingU16);
HWY_EXPORT(WalkingF32);

void median_by_walking(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(WalkingU8)(tile, channels, radius, scratch);
}
void median_by_walking(const WindowTile<std::uint16_t>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(WalkingU16)(tile, channels, radius, scratch);
}
void median_by_walking(const WindowTile<float>& tile, int channels, int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(WalkingF32)(tile, channels, radius, scratch);
}

}  // namespace azulejo::kernels
#endif
