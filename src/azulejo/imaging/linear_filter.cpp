#include "azulejo/imaging/linear_filter.h"

#include <algorithm>
#include <cmath>

#include "azulejo/imaging/kernel_factors.h"

namespace azulejo {
namespace {

using kernels::ConvolveTaps;
using kernels::kConvolveRows;

/// With more weights, blocks of 256 × 256 are transformed faster than they are summed (1920×1080, one thread of AVX-512:
/// 30 ms at 35 × 35; a weight takes 0.047 ms in f32, 0.025 in bytes).
std::ptrdiff_t most_summed(PixelType type) { return type == PixelType::U8 ? 1000 : 600; }

/// The weights with a sum of 1.
std::vector<float> normalized(const std::vector<float>& weights) {
  const double sum = kernel_sum(weights).sum;
  std::vector<float> result;
  for (const float weight : weights) result.push_back(static_cast<float>(weight / sum));
  return result;
}

/// How rows are read and written, and summed.
struct VectorCalls {
  static constexpr auto load = [](const auto&... arguments) { load_row(arguments...); };
  static constexpr auto store = [](const auto&... arguments) { store_row(arguments...); };
  static constexpr auto subtract = [](const auto&... arguments) { kernels::subtract_row(arguments...); };
  static constexpr auto sum = [](const auto&... arguments) { kernels::convolve_rows(arguments...); };
};
struct ReferenceCalls {
  static constexpr auto load = [](const auto&... arguments) { load_row_reference(arguments...); };
  static constexpr auto store = [](const auto&... arguments) { store_row_reference(arguments...); };
  static void subtract(const float* minuend, const float* subtrahend, std::size_t count, float* differences) {
    for (std::size_t i = 0; i < count; ++i) differences[i] = minuend[i] - subtrahend[i];
  }
  static void sum(const ConvolveTaps& taps, const float* const* source, const float* const* centers, int rows,
                  std::size_t count, float* const* results) {
    for (int r = 0; r < rows; ++r) {
      for (std::size_t i = 0; i < count; ++i) {
        results[r][i] = kernels::convolved(taps, source, centers, r, static_cast<std::ptrdiff_t>(i));
      }
    }
  }
};

}  // namespace

LinearFilter::LinearFilter(const ImageInfo& source, const LinearSum& sum)
    : source_(source),
      result_(source),
      format_(row_format(source, sum.light)),
      rows_(sum.kernel.rows),
      columns_(sum.kernel.columns),
      center_row_(sum.center_row),
      center_column_(sum.center_column),
      has_alpha_(source.alpha != AlphaState::None),
      as_f32_(sum.as_f32),
      in_place_(source.type == PixelType::F32 && format_.alpha == RowAlpha::Plain && !format_.curve) {
  if (as_f32_) {
    result_.type = PixelType::F32;
    result_.color = ColorState::Data;
    result_.channels = source.color_channels();
    result_.alpha = AlphaState::None;
  }
  plan(sum);
}

/// Chooses passes, and whether differences are weighted to keep constants.
void LinearFilter::plan(const LinearSum& sum) {
  const NumberGrid& kernel = sum.kernel;
  const KernelSum total = kernel_sum(kernel.values);
  const float unit = row_unit(format_);
  const bool exact = source_.type != PixelType::F32 && unit == full_range(source_.type) && is_whole(kernel) &&
                     double{unit} * total.magnitude < 0x1p24;
  const double scale = double{sum.scale};
  const bool one = KernelSum{total.sum * scale, total.magnitude * std::fabs(scale)}.is(1);
  const bool keeps = one && !exact && !rounds_away(sum);

  const auto add = [&](int rows, int columns, const std::vector<float>& weights, int center_row, int center_column) {
    const bool differences = !exact && (keeps || kernel_sum(weights).is(0));
    passes_.emplace_back(NumberGrid{rows, columns, keeps ? normalized(weights) : weights}, center_row, center_column,
                         source_.channels, differences);
  };
  if (const auto factors = kernel_factors(kernel)) {
    add(rows_, 1, factors->column, center_row_, 0);
    add(1, columns_, factors->row, 0, center_column_);
  } else {
    add(rows_, columns_, kernel.values, center_row_, center_column_);
  }

  averages_ = total.sum > 0 && std::all_of(kernel.values.begin(), kernel.values.end(), [](float w) { return w >= 0; });
  alpha_scale_ = keeps ? 1.0F : static_cast<float>(1 / total.sum);
  color_scale_ = (keeps ? 1.0F : sum.scale) / (as_f32_ ? unit : 1.0F);
  color_offset_ = sum.offset * (as_f32_ ? 1.0F : has_alpha_ ? unit / full_range(source_.type) : unit);
  const auto weights =
      static_cast<std::ptrdiff_t>(kernel.values.size()) - std::count(kernel.values.begin(), kernel.values.end(), 0.0F);
  if (passes_.size() == 1 && weights > most_summed(source_.type)) {
    const NumberGrid scaled{rows_, columns_, keeps ? normalized(kernel.values) : kernel.values};
    blocks_.emplace(scaled, keeps ? 1.0F : total.is(0) ? 0.0F : static_cast<float>(total.sum));
    return;
  }
  if (has_alpha_) return;
  passes_.back().scale = color_scale_;
  passes_.back().offset = color_offset_;
  constexpr int kCheap = 28;  // pairs of weights, at which two passes in f32 cost as much
  const bool small = passes_.size() == 1 || rows_ * ((columns_ + 1) / 2) <= kCheap;
  if (source_.type == PixelType::U8 && !format_.curve) {
    bytes_ = ByteSums::make(kernel, center_column_, source_.channels, sum.scale / (as_f32_ ? unit : 1.0F),
                            color_offset_, as_f32_);
    if (bytes_ && !small && !bytes_->has_factors()) bytes_.reset();
  }
}

/// Whether a sum of bytes is rounded to the same level with and without the error of the weights.
bool LinearFilter::rounds_away(const LinearSum& sum) const {
  if (source_.type != PixelType::U8 || as_f32_ || format_.curve || format_.alpha != RowAlpha::Plain) return false;
  const double magnitude = kernel_sum(sum.kernel.values).magnitude * std::fabs(double{sum.scale});
  return static_cast<double>(sum.kernel.values.size()) * magnitude * 255 * 0x1p-24 < 0.25;
}

Rect LinearFilter::needs(const Rect& part) const {
  const Rect result = blocks_ ? BlockConvolution::blocks(part, source_.rect()) : part;
  return {result.x - center_column_, result.y - center_row_, result.width + columns_ - 1, result.height + rows_ - 1};
}

/// Rows of the source, loaded into a ring of as many as kConvolveRows results read, and their differences.
template <class Calls>
class LinearFilter::SourceRows {
 public:
  SourceRows(const LinearFilter& filter, const ConstAnyView& source, Scratch& scratch)
      : filter_(filter),
        pass_(filter.passes_[0]),
        source_(source),
        values_(filter.format_.values(source.width())),
        count_(filter.rows_ + kConvolveRows - 1) {
    for (int i = 0; i < count_; ++i) {
      ring_.push_back(filter.in_place_ ? nullptr : scratch.take<float>(values_));
      across_.push_back(pass_.differences && pass_.across ? scratch.take<float>(values_) : nullptr);
      down_.push_back(pass_.differences && pass_.rows > 1 ? scratch.take<float>(values_) : nullptr);
    }
    pointers_.resize(static_cast<std::size_t>(2 * count_));
  }

  const float* row(int y) const { return filter_.in_place_ ? source_.as<float>().row(y) : ring_[place(y)]; }

  /// What the first pass reads for `rows` results from row y on: each row from value `before` on.
  const float* const* pointers(int y, int rows, std::ptrdiff_t before) {
    const int end = y + rows + pass_.rows - 1;
    for (; loaded_ < end; ++loaded_) load(loaded_);
    for (int s = y; s < end; ++s) {
      const auto i = static_cast<std::size_t>(s - y);
      if (!pass_.differences) {
        pointers_[i] = row(s) + before;
        continue;
      }
      pointers_[2 * i] = pass_.across ? across_[place(s)] + before : nullptr;
      pointers_[2 * i + 1] = pass_.rows > 1 ? down_[place(s)] + before : nullptr;
    }
    return pointers_.data();
  }

 private:
  std::size_t place(int y) const { return static_cast<std::size_t>(y % count_); }

  void load(int y) {
    if (!filter_.in_place_) Calls::load(filter_.format_, source_.row(y), source_.width(), ring_[place(y)]);
    if (!pass_.differences) return;
    const auto tap = static_cast<std::size_t>(filter_.source_.channels);
    if (pass_.across) Calls::subtract(row(y) + tap, row(y), values_ - tap, across_[place(y)]);
    if (pass_.rows > 1 && y > 0) Calls::subtract(row(y), row(y - 1), values_, down_[place(y - 1)]);
  }

  const LinearFilter& filter_;
  const FilterPass& pass_;
  const ConstAnyView& source_;
  const std::size_t values_;
  const int count_;
  int loaded_ = 0;
  std::vector<float*> ring_;
  std::vector<float*> across_;  ///< a value's right neighbor minus it
  std::vector<float*> down_;    ///< the row below minus it
  std::vector<const float*> pointers_;
};

template <class Calls>
void LinearFilter::run_tile(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const {
  const int height = result.height();
  const int width = result.width();
  const std::size_t values = format_.values(source.width());
  const std::size_t count = format_.values(width);
  const bool two = passes_.size() == 2;
  const bool straight = result_.type == PixelType::F32 && !has_alpha_ && (as_f32_ || !format_.curve);
  SourceRows<Calls> rows(*this, source, scratch);
  float* sums[kConvolveRows];
  float* between[kConvolveRows];
  for (int r = 0; r < kConvolveRows; ++r) {
    sums[r] = straight ? nullptr : scratch.take<float>(count);
    between[r] = two ? scratch.take<float>(values) : nullptr;
  }
  float* const across = two ? scratch.take<float>(values) : nullptr;

  for (int y = 0, n = 0; y < height; y += n) {
    n = height - y >= kConvolveRows ? kConvolveRows : 1;
    const std::ptrdiff_t first = two ? 0 : before();
    const float* const* const pointers = rows.pointers(y, n, first);
    const float* centers[kConvolveRows];
    for (int r = 0; r < n; ++r) {
      centers[r] = rows.row(y + r + center_row_) + first;
      if (straight) sums[r] = result.as<float>().row(y + r);
    }
    Calls::sum(passes_[0].taps(n), pointers, passes_[0].keeps ? centers : nullptr, n, two ? values : count,
               two ? between : sums);
    for (int r = 0; r < n; ++r) {
      if (two) second_pass<Calls>(between[r], across, values, count, sums[r]);
      if (!straight) deliver<Calls>(rows.row(y + r + center_row_) + before(), sums[r], width, result, y + r);
    }
  }
}

/// Whole blocks are computed, and what lies in the tile is written.
template <class Calls>
void LinearFilter::run_blocks(const ConstTile& source, const Tile& result, Scratch& scratch) const {
  constexpr int kBlock = BlockConvolution::kBlock;
  const int channels = source_.channels;
  const Rect all = BlockConvolution::blocks(result.rect, source_.rect());
  const std::size_t values = format_.values(kBlock + columns_ - 1);
  float* const loaded = scratch.take<float>(values * static_cast<std::size_t>(kBlock + rows_ - 1));
  float* const sums = scratch.take<float>(format_.values(kBlock) * kBlock);
  const auto stride = static_cast<std::ptrdiff_t>(values);
  const std::ptrdiff_t sum_stride = std::ptrdiff_t{kBlock} * channels;
  for (int top = all.y; top < all.bottom(); top += kBlock) {
    for (int left = all.x; left < all.right(); left += kBlock) {
      const Rect block{left, top, std::min(kBlock, all.right() - left), std::min(kBlock, all.bottom() - top)};
      const int width = block.width + columns_ - 1;
      const ConstAnyView from = source.pixels.crop({left - all.x, top - all.y, width, block.height + rows_ - 1});
      for (int y = 0; y < from.height(); ++y) Calls::load(format_, from.row(y), width, loaded + y * stride);
      for (int c = 0; c < channels; ++c) {
        blocks_->run(loaded + c, stride, block.width, block.height, channels, sums + c, sum_stride);
      }
      const Rect part = intersection(block, result.rect);
      const AnyView to = result.pixels.crop({part.x - result.rect.x, part.y - result.rect.y, part.width, part.height});
      for (int y = 0; y < part.height; ++y) {
        const std::ptrdiff_t across = std::ptrdiff_t{part.x - left} * channels;
        const std::ptrdiff_t row = part.y - top + y;
        const float* const center = loaded + (row + center_row_) * stride + across + before();
        deliver<Calls>(center, sums + row * sum_stride + across, part.width, to, y);
      }
    }
  }
}

template <class Calls>
void LinearFilter::second_pass(const float* row, float* across, std::size_t values, std::size_t count,
                               float* result) const {
  const FilterPass& pass = passes_[1];
  const auto tap = static_cast<std::size_t>(source_.channels);
  if (pass.differences) Calls::subtract(row + tap, row, values - tap, across);
  const float* const source[2] = {(pass.differences ? across : row) + before(), nullptr};
  const float* const center = row + before();
  Calls::sum(pass.taps(1), source, pass.keeps ? &center : nullptr, 1, count, &result);
}

template <class Calls>
void LinearFilter::deliver(const float* center, float* sums, int width, const AnyView& result, int y) const {
  if (blocks_ && !has_alpha_) {
    const auto count = static_cast<std::ptrdiff_t>(format_.values(width));
    for (std::ptrdiff_t i = 0; i < count; ++i) sums[i] = sums[i] * color_scale_ + color_offset_;
    if (as_f32_) {
      std::copy_n(sums, count, result.as<float>().row(y));
      return;
    }
  }
  if (as_f32_) return drop_alpha(sums, result.as<float>().row(y), width);
  if (has_alpha_) weigh_alpha(center, sums, width);
  Calls::store(format_, sums, width, result.row(y));
}

/// Sums of pixels with alpha as they are stored.
void LinearFilter::weigh_alpha(const float* center, float* row, int pixels) const {
  const int last = source_.channels - 1;
  const bool saturates = source_.type != PixelType::F32 && format_.alpha == RowAlpha::Plain;
  for (int x = 0; x < pixels; ++x, row += source_.channels, center += source_.channels) {
    const float alpha = averages_ ? row[last] * alpha_scale_ : center[last];
    for (int c = 0; c < last; ++c) {
      const float color = row[c] * color_scale_ + color_offset_ * alpha;
      row[c] = saturates && color > alpha ? alpha : color;
    }
    row[last] = alpha;
  }
}

void LinearFilter::drop_alpha(const float* row, float* result, int pixels) const {
  const int colors = result_.channels;
  for (int x = 0; x < pixels; ++x, row += source_.channels, result += colors) {
    for (int c = 0; c < colors; ++c) result[c] = row[c] * color_scale_ + color_offset_;
  }
}

void LinearFilter::run(const ConstTile& source, const Tile& result, Scratch& scratch) const {
  if (blocks_) return run_blocks<VectorCalls>(source, result, scratch);
  if (bytes_) return bytes_->run(source.pixels, result.pixels, before(), scratch);
  run_tile<VectorCalls>(source.pixels, result.pixels, scratch);
}
void LinearFilter::run_reference(const ConstTile& source, const Tile& result, Scratch& scratch) const {
  if (blocks_) return run_blocks<ReferenceCalls>(source, result, scratch);
  if (bytes_) return bytes_->run_reference(source.pixels, result.pixels, before(), scratch);
  run_tile<ReferenceCalls>(source.pixels, result.pixels, scratch);
}

}  // namespace azulejo
