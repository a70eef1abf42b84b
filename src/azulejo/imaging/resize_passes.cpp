#include "azulejo/imaging/resize_passes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "azulejo/imaging/resize_kernels.h"

namespace azulejo {
namespace {

using kernels::kPanelRows;

/// Rows filtered together along x by the enlarging kernel.
constexpr int kEnlargeRows = 4;

/// One stretch of a tile's columns: what both orders of passes share.
class Stretch {
 public:
  Stretch(const ResizePasses& passes, const ConstTile& source, const Tile& result, int begin, int end, Scratch& scratch)
      : passes_(passes), source_(source), result_(result), begin_(begin), scratch_(scratch) {
    const TapTable& table = passes.columns;
    columns_.count = end - begin;
    columns_.taps = table.taps;
    columns_.channels = passes.format.channels;
    columns_.first = table.first_of(begin);
    columns_.source_begin = columns_.first[0];
    columns_.source_count = columns_.first[columns_.count - 1] + table.taps - columns_.source_begin;
    columns_.weights = table.weights_of(begin);
    columns_.by_tap = table.by_tap.data() + (begin - table.begin);
    columns_.by_tap_stride = table.stride;
    source_values_ = passes.format.values(columns_.source_count);
    source_bytes_ = source_values_ * size_of(passes.format.type);
    result_values_ = passes.format.values(columns_.count);
    if (!passes.across.enlarging()) panel_ = scratch.take<float>(kernels::panel_values(columns_));
  }

  /// Sums of source rows, then along x, sixteen result rows at a time.
  void down_first() {
    const auto summed = take_rows<kPanelRows>(source_values_);
    const auto filtered = passes_.across.identity() ? summed : take_rows<kPanelRows>(result_values_);
    const bool in_blocks = passes_.rows.taps > kTapBlock;
    Ring ring = take_ring(in_blocks ? kTapBlock : passes_.rows.taps, source_values_);
    const auto compensation = in_blocks ? take_rows<kPanelRows>(source_values_) : std::array<float*, kPanelRows>{};
    for (int y = result_.rect.y; y < result_.rect.bottom(); y += kPanelRows) {
      const int count = std::min(kPanelRows, result_.rect.bottom() - y);
      if (in_blocks) {
        sum_in_blocks(y, count, ring, summed, compensation);
      } else {
        for (int r = 0; r < count; ++r) {
          load_until(ring, passes_.rows.first_of(y + r)[0] + ring.capacity);
          sum(ring, y + r, summed[static_cast<std::size_t>(r)], source_values_);
        }
      }
      filter(summed.data(), count, filtered.data());
      for (int r = 0; r < count; ++r) store(y + r, filtered[static_cast<std::size_t>(r)]);
    }
  }

  /// Rows along x, as many as are needed, then their sums.
  void across_first() {
    const int batch = passes_.across.enlarging() ? kEnlargeRows : kPanelRows;
    const auto loaded = take_rows<kPanelRows>(source_values_);
    const int taps = passes_.rows.taps;
    Ring ring = take_ring(taps + batch - 1, result_values_);
    float* const row = scratch_.take<float>(result_values_);
    std::array<float*, kPanelRows> places{};
    for (int y = result_.rect.y; y < result_.rect.bottom(); ++y) {
      const int end = passes_.rows.first_of(y)[0] + taps;
      skip_to(ring, end - taps);
      while (ring.next < end) {
        const int count = std::min(batch, source_.rect.bottom() - ring.next);
        for (int r = 0; r < kPanelRows; ++r) {
          const int k = std::min(r, count - 1);
          places[static_cast<std::size_t>(r)] = ring.row(ring.next + k);
          if (r < count)
            load(ring.next + r,
                 passes_.across.identity() ? ring.row(ring.next + r) : loaded[static_cast<std::size_t>(r)]);
        }
        spare_rows(count, places);
        filter(loaded.data(), count, places.data());
        ring.next += count;
      }
      if (passes_.down.identity()) {
        store(y, ring.row(y));
      } else {
        sum(ring, y, row, result_values_);
        store(y, row);
      }
    }
  }

 private:
  /// The last rows of a sequence.
  struct Ring {
    std::vector<float*> rows;
    int capacity = 0;
    int next = 0;  ///< the first one that is not there yet
    float* row(int k) const { return rows[static_cast<std::size_t>(k % capacity)]; }
  };

  template <std::size_t kRows>
  std::array<float*, kRows> take_rows(std::size_t values) {
    std::array<float*, kRows> rows;
    for (float*& row : rows) row = scratch_.take<float>(values);
    return rows;
  }

  Ring take_ring(int capacity, std::size_t values) {
    Ring ring{{}, capacity, source_.rect.y};
    for (int r = 0; r < capacity; ++r) ring.rows.push_back(scratch_.take<float>(values));
    window_.resize(static_cast<std::size_t>(capacity));
    return ring;
  }

  void skip_to(Ring& ring, int first) const { ring.next = std::max(ring.next, first); }

  const std::byte* source_row(int y) const {
    const auto pixel = static_cast<std::ptrdiff_t>(source_.pixels.info.pixel_bytes());
    return source_.pixels.row(y - source_.rect.y) + (columns_.source_begin - source_.rect.x) * pixel;
  }

  void load(int y, float* row) const {
    // A stretch of a row is too short for the machine to foresee the next one.
    constexpr int kAhead = 4;
    if (y + kAhead < source_.rect.bottom()) kernels::prefetch(source_row(y + kAhead), source_bytes_);
    load_row(passes_.format, source_row(y), columns_.source_count, row);
  }

  void load_until(Ring& ring, int end) const {
    skip_to(ring, end - ring.capacity);
    for (; ring.next < end; ++ring.next) load(ring.next, ring.row(ring.next));
  }

  void sum(const Ring& ring, int y, float* row, std::size_t values) {
    const int first = passes_.rows.first_of(y)[0];
    for (int t = 0; t < passes_.rows.taps; ++t) window_[static_cast<std::size_t>(t)] = ring.row(first + t);
    kernels::sum_rows(window_.data(), passes_.rows.weights_of(y), passes_.rows.taps, row, values);
  }

  /// Streams over the source rows: a block of them is loaded once for all result rows that it is part of.
  void sum_in_blocks(int y, int count, const Ring& ring, const std::array<float*, kPanelRows>& total,
                     const std::array<float*, kPanelRows>& compensation) {
    const TapTable& table = passes_.rows;
    for (std::size_t r = 0; r < static_cast<std::size_t>(count); ++r) {
      std::fill_n(total[r], source_values_, 0.0F);
      std::fill_n(compensation[r], source_values_, 0.0F);
    }
    const int end = table.first_of(y + count - 1)[0] + table.taps;
    for (int from = table.first_of(y)[0]; from < end;) {
      const int to = std::min(from / kTapBlock * kTapBlock + kTapBlock, end);
      for (int k = from; k < to; ++k) load(k, ring.row(k));
      for (int r = 0; r < count; ++r) {
        const int first = table.first_of(y + r)[0];
        const int low = std::max(from, first);
        const int high = std::min(to, first + table.taps);
        for (int k = low; k < high; ++k) window_[static_cast<std::size_t>(k - low)] = ring.row(k);
        if (low < high) {
          kernels::add_rows(window_.data(), table.weights_of(y + r) + (low - first), high - low,
                            total[static_cast<std::size_t>(r)], compensation[static_cast<std::size_t>(r)],
                            source_values_);
        }
      }
      from = to;
    }
  }

  /// Places beyond `count` become memory that nobody reads.
  void spare_rows(int count, std::array<float*, kPanelRows>& places) {
    if (spare_ == nullptr) spare_ = scratch_.take<float>(result_values_);
    std::fill(places.begin() + count, places.end(), spare_);
  }

  void filter(const float* const* rows, int count, float* const* results) {
    if (passes_.across.identity()) return;
    if (passes_.across.enlarging()) {
      kernels::enlarge_columns(columns_, rows, count, results);
    } else {
      kernels::shrink_columns(columns_, rows, count, panel_, results);
    }
  }

  void store(int y, const float* row) const {
    const auto pixel = static_cast<std::ptrdiff_t>(result_.pixels.info.pixel_bytes());
    store_row(passes_.format, row, columns_.count,
              result_.pixels.row(y - result_.rect.y) + (begin_ - result_.rect.x) * pixel);
  }

  const ResizePasses& passes_;
  const ConstTile& source_;
  const Tile& result_;
  int begin_;
  Scratch& scratch_;
  kernels::Columns columns_;
  std::size_t source_values_ = 0;
  std::size_t source_bytes_ = 0;
  std::size_t result_values_ = 0;
  float* panel_ = nullptr;
  float* spare_ = nullptr;
  std::vector<const float*> window_;
};

/// Area by half in encoded u8: f32 sums of halves are exact, so integers give the same bytes, many at a time.
bool halves(const ResizePasses& passes) {
  const auto by_half = [](const Axis& axis) { return axis.taps() == 2 && axis.source() == 2 * axis.result(); };
  return passes.format.type == PixelType::U8 && !passes.format.curve && passes.format.alpha == RowAlpha::Plain &&
         by_half(passes.across) && by_half(passes.down);
}

void halve(const ConstTile& source, const Tile& result, Scratch& scratch) {
  const auto from = source.pixels.as<std::uint8_t>();
  const auto to = result.pixels.as<std::uint8_t>();
  auto* const sums = scratch.take<std::uint16_t>(source.pixels.info.row_bytes());
  for (int y = 0; y < to.height; ++y) {
    kernels::halve_rows(from.row(2 * y), from.row(2 * y + 1), to.width, to.channels, sums, to.row(y));
  }
}

}  // namespace

void ResizePasses::run(const ConstTile& source, const Tile& result, Scratch& scratch) const {
  if (halves(*this)) return halve(source, result, scratch);
  // Columns at a time, so that the rows in use stay in the second-level cache: 2048 values; where windows are so large
  // that stretches would overlap by more than a quarter, more.
  constexpr int kValues = 2048;
  const std::int64_t wanted = std::max<std::int64_t>(kValues / format.channels, 4 * std::int64_t{across.taps()});
  const std::int64_t pixels =
      across.enlarging() ? kValues / format.channels : wanted * across.result() / across.source();
  const int step = static_cast<int>(std::clamp<std::int64_t>(pixels, 1, result.rect.width));
  for (int x = result.rect.x; x < result.rect.right(); x += step) {
    const Scratch::Mark start = scratch.mark();
    Stretch stretch(*this, source, result, x, std::min(x + step, result.rect.right()), scratch);
    if (down_first()) {
      stretch.down_first();
    } else {
      stretch.across_first();
    }
    scratch.release(start);
  }
}

void ResizePasses::run_reference(const ConstTile& source, const Tile& result) const {
  const std::size_t channels = format.values(1);
  const auto plane = [&](int width, int height) {
    return std::vector<float>(format.values(width) * static_cast<std::size_t>(height));
  };
  const Rect& from = source.rect;
  const Rect& to = result.rect;
  std::vector<float> loaded = plane(from.width, from.height);
  for (int y = 0; y < from.height; ++y) {
    load_row_reference(format, source.pixels.row(y), from.width,
                       loaded.data() + static_cast<std::size_t>(y) * format.values(from.width));
  }
  const auto sum_down = [&](const std::vector<float>& input, int width) {
    std::vector<float> output = plane(width, to.height);
    const std::size_t stride = format.values(width);
    for (int y = 0; y < to.height; ++y) {
      for (std::size_t i = 0; i < stride; ++i) {
        output[static_cast<std::size_t>(y) * stride + i] =
            weighted_sum(rows.weights_of(to.y + y), rows.first_of(to.y + y)[0], rows.taps,
                         [&](int k) { return input[static_cast<std::size_t>(k - from.y) * stride + i]; });
      }
    }
    return output;
  };
  const auto sum_across = [&](const std::vector<float>& input, int height) {
    std::vector<float> output = plane(to.width, height);
    for (int y = 0; y < height; ++y) {
      const float* const row = input.data() + static_cast<std::size_t>(y) * format.values(from.width);
      for (int x = 0; x < to.width; ++x) {
        for (std::size_t c = 0; c < channels; ++c) {
          output[static_cast<std::size_t>(y) * format.values(to.width) + static_cast<std::size_t>(x) * channels + c] =
              weighted_sum(columns.weights_of(to.x + x), columns.first_of(to.x + x)[0], columns.taps,
                           [&](int k) { return row[static_cast<std::size_t>(k - from.x) * channels + c]; });
        }
      }
    }
    return output;
  };
  const std::vector<float> computed = down_first() ? sum_across(sum_down(loaded, from.width), to.height)
                                                   : sum_down(sum_across(loaded, from.height), to.width);
  for (int y = 0; y < to.height; ++y) {
    store_row_reference(format, computed.data() + static_cast<std::size_t>(y) * format.values(to.width), to.width,
                        result.pixels.row(y));
  }
}

}  // namespace azulejo
