#include "azulejo/imaging/convolve_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "azulejo/imaging/kernel_factors.h"

namespace azulejo {
namespace {

using kernels::kByteRows;
using kernels::PairStep;
using kernels::PairTaps;

constexpr double kMostMagnitude = 8'400'000;  ///< times 255 fits in 32 bits

struct WholeWeights {
  std::vector<int> values;
  double unit = 1;  ///< what 1 stands for
};

/// Weights in units of the smallest power of two for which they have 16 bits. Of a kernel that sums to 0, these do too.
WholeWeights whole_weights(const NumberGrid& kernel) {
  double largest = kernel_sum(kernel.values).magnitude / kMostMagnitude * 32760;
  for (const float weight : kernel.values) largest = std::max(largest, std::fabs(double{weight}));
  WholeWeights whole;
  if (!is_whole(kernel) || largest > 32767) {
    int exponent = 0;
    std::frexp(largest / 32760, &exponent);
    whole.unit = std::ldexp(1.0, exponent);
  }
  int sum = 0;
  for (const float weight : kernel.values) {
    whole.values.push_back(static_cast<int>(std::floor(weight / whole.unit + 0.5)));
    sum += whole.values.back();
  }
  if (kernel_sum(kernel.values).is(0) && std::abs(sum) <= static_cast<int>(kernel.values.size())) {
    const auto by_size = [](int a, int b) { return std::abs(a) < std::abs(b); };
    *std::max_element(whole.values.begin(), whole.values.end(), by_size) -= sum;
  }
  return whole;
}

std::vector<PairStep> make_steps(const NumberGrid& shape, const std::vector<int>& weights, int center_column,
                                 int channels, int rows) {
  const auto weight = [&](int r, int c) {
    return c < shape.columns ? weights[static_cast<std::size_t>(r * shape.columns + c)] : 0;
  };
  std::vector<PairStep> steps;
  for (int s = 0; s < shape.rows + rows - 1; ++s) {
    for (int c = 0; c < shape.columns; c += 2) {
      PairStep step{std::ptrdiff_t{c - center_column} * channels, s, 0, {}};
      for (int r = 0; r < rows; ++r) {
        const int row = s - r;
        if (row < 0 || row >= shape.rows || (weight(row, c) == 0 && weight(row, c + 1) == 0)) continue;
        step.outputs |= 1U << r;
        step.weights[r] = static_cast<std::int32_t>(static_cast<std::uint32_t>(weight(row, c) & 0xFFFF) |
                                                    static_cast<std::uint32_t>(weight(row, c + 1)) << 16);
      }
      if (step.outputs != 0) steps.push_back(step);
    }
  }
  return steps;
}

struct VectorCalls {
  static void pair(const std::uint8_t* source, std::ptrdiff_t tap, std::size_t count, std::uint32_t* pairs) {
    kernels::pair_bytes(source, tap, count, pairs);
  }
  template <class T>
  static void sum(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                  T* const* results) {
    kernels::convolve_pairs(taps, source, rows, count, results);
  }
};
struct ReferenceCalls {
  static void pair(const std::uint8_t* source, std::ptrdiff_t tap, std::size_t count, std::uint32_t* pairs) {
    for (std::size_t i = 0; i < count; ++i) {
      pairs[i] = source[i] | static_cast<std::uint32_t>(source[static_cast<std::ptrdiff_t>(i) + tap]) << 16;
    }
  }
  template <class T>
  static void sum(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                  T* const* results) {
    for (int r = 0; r < rows; ++r) {
      for (std::size_t i = 0; i < count; ++i) {
        const float value = kernels::convolved(taps, source, r, static_cast<std::ptrdiff_t>(i));
        if constexpr (std::is_same_v<T, float>) {
          results[r][i] = value;
        } else {
          results[r][i] = kernels::cut_to_byte(value);
        }
      }
    }
  }
};

}  // namespace

std::optional<ByteSums> ByteSums::make(const NumberGrid& kernel, int center_column, int channels, float scale,
                                       float offset, bool as_f32) {
  const WholeWeights whole = whole_weights(kernel);
  const KernelSum wanted = kernel_sum(kernel.values);
  double sum = 0;
  double magnitude = 0;
  for (const int weight : whole.values) {
    if (std::abs(weight) > 32767) return std::nullopt;
    sum += weight;
    magnitude += std::abs(weight);
  }
  const bool exact = whole.unit == 1 && magnitude * 255 < 0x1p24;
  const double error = static_cast<double>(whole.values.size()) * 255 * whole.unit / 2 * std::fabs(double{scale});
  if (magnitude > kMostMagnitude + static_cast<double>(whole.values.size()) || (!exact && (as_f32 || error > 1.0 / 32)))
    return std::nullopt;

  ByteSums sums;
  sums.rows_ = kernel.rows;
  sums.channels_ = channels;
  // Constants become what the weights wanted make of them.
  const bool balanced = !exact && std::fabs(sum) > magnitude / 2;
  sums.taps_.scale = static_cast<float>(double{scale} * (balanced ? wanted.sum / sum : whole.unit));
  sums.taps_.offset = as_f32 ? offset : offset + 0.5F;
  sums.group_ = make_steps(kernel, whole.values, center_column, channels, kByteRows);
  sums.single_ = make_steps(kernel, whole.values, center_column, channels, 1);
  if (exact && !as_f32) sums.find_factors(kernel);
  return sums;
}

void ByteSums::find_factors(const NumberGrid& kernel) {
  const auto factors = kernel_factors(kernel);
  if (!factors || kernel_sum(factors->column).magnitude * 255 > 32767 || kernel_sum(factors->row).magnitude > 32767) {
    return;
  }
  column_.assign(factors->column.begin(), factors->column.end());
  row_.assign(factors->row.begin(), factors->row.end());
  if (row_.size() % 2 == 1) row_.push_back(0);
}

void ByteSums::run_factors(const ConstAnyView& source, const ImageView<std::uint8_t>& result, Scratch& scratch) const {
  const auto values = static_cast<std::size_t>(source.width() * channels_);
  auto* const between = scratch.take<std::int16_t>(values + 4);  // 4: what the weight that makes the row even reads
  std::fill_n(between + values, 4, std::int16_t{0});
  std::vector<const std::uint8_t*> rows(column_.size());
  for (int y = 0; y < result.height; ++y) {
    for (std::size_t a = 0; a < rows.size(); ++a) {
      rows[a] = reinterpret_cast<const std::uint8_t*>(source.row(y + static_cast<int>(a)));
    }
    kernels::convolve_factors(column_, row_, taps_, channels_, rows.data(), between,
                              static_cast<std::size_t>(result.width * channels_), result.row(y));
  }
}

template <class T, class Calls>
void ByteSums::run_tile(const ConstAnyView& source, const ImageView<T>& result, std::ptrdiff_t before, Scratch& scratch,
                        const Calls&) const {
  const auto values = static_cast<std::size_t>(source.width()) * static_cast<std::size_t>(channels_);
  const auto count = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(channels_);
  const auto tap = static_cast<std::size_t>(channels_);
  auto* const bytes = scratch.take<std::uint8_t>(values + tap);
  std::fill_n(bytes + values, tap, std::uint8_t{0});
  const auto ring_rows = static_cast<std::size_t>(rows_ + kByteRows - 1);
  std::vector<std::uint32_t*> ring(ring_rows);
  for (std::uint32_t*& row : ring) row = scratch.take<std::uint32_t>(values);

  std::vector<const std::uint32_t*> rows(ring_rows);
  T* results[kByteRows];
  int loaded = 0;
  for (int y = 0, n = 0; y < result.height; y += n) {
    n = result.height - y >= kByteRows ? kByteRows : 1;
    for (; loaded < y + n + rows_ - 1; ++loaded) {
      std::memcpy(bytes, source.row(loaded), values);
      Calls::pair(bytes, channels_, values, ring[static_cast<std::size_t>(loaded) % ring_rows]);
    }
    for (int s = 0; s < n + rows_ - 1; ++s) {
      rows[static_cast<std::size_t>(s)] = ring[static_cast<std::size_t>(y + s) % ring_rows] + before;
    }
    for (int r = 0; r < n; ++r) results[r] = result.row(y + r);
    PairTaps taps = taps_;
    taps.steps = n == 1 ? single_ : group_;
    Calls::sum(taps, rows.data(), n, count, results);
  }
}

void ByteSums::run(const ConstAnyView& source, const AnyView& result, std::ptrdiff_t before, Scratch& scratch) const {
  if (result.info.type == PixelType::F32) return run_tile(source, result.as<float>(), before, scratch, VectorCalls{});
  if (has_factors()) return run_factors(source, result.as<std::uint8_t>(), scratch);
  run_tile(source, result.as<std::uint8_t>(), before, scratch, VectorCalls{});
}
void ByteSums::run_reference(const ConstAnyView& source, const AnyView& result, std::ptrdiff_t before,
                             Scratch& scratch) const {
  if (result.info.type == PixelType::F32) {
    return run_tile(source, result.as<float>(), before, scratch, ReferenceCalls{});
  }
  run_tile(source, result.as<std::uint8_t>(), before, scratch, ReferenceCalls{});
}

}  // namespace azulejo
