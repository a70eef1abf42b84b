#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "azulejo/engine/tile_node.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {
namespace kernels {

/// Rows of results computed at once: they share what they read.
constexpr int kByteRows = 4;

/// Two neighboring places of the source that are read, and what they are weighted with.
struct PairStep {
  std::ptrdiff_t offset = 0;             ///< pairs from the result's place in its row
  int row = 0;                           ///< of the source, counted from the first that the first result row reads
  unsigned outputs = 0;                  ///< bit r: result row r reads it
  std::int32_t weights[kByteRows] = {};  ///< two of 16 bits: of the first place in the lower ones
};

struct PairTaps {
  std::span<const PairStep> steps;
  float scale = 1;
  float offset = 0;
};

/// pairs[i] = source[i] + 2¹⁶ · source[i + tap], for i in [0, count).
/// source  readable up to a vector beyond count + tap
void pair_bytes(const std::uint8_t* source, std::ptrdiff_t tap, std::size_t count, std::uint32_t* pairs);

/// Exact sums in 32 bits; result = sum · scale + offset in f32. Bytes: saturated, then cut: 0.5 is in the offset.
/// rows  result rows, 1 or kByteRows
void convolve_pairs(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                    std::uint8_t* const* results);
void convolve_pairs(const PairTaps& taps, const std::uint32_t* const* source, int rows, std::size_t count,
                    float* const* results);

/// The same by a column of weights and a row of them, whose number is even: sums of a column fit in 16 bits.
/// source   rows.size() rows of count + tap · (row.size() − 1) bytes
/// between  memory for as many values
void convolve_factors(std::span<const std::int16_t> column, std::span<const std::int16_t> row, const PairTaps& taps,
                      std::ptrdiff_t tap, const std::uint8_t* const* source, std::int16_t* between, std::size_t count,
                      std::uint8_t* result);

/// The scalar definition, for value i of row r, before bytes are cut.
inline float convolved(const PairTaps& taps, const std::uint32_t* const* source, int r, std::ptrdiff_t i) {
  std::int32_t sum = 0;
  for (const PairStep& step : taps.steps) {
    if ((step.outputs >> r & 1U) == 0) continue;
    const std::uint32_t pair = source[step.row][i + step.offset];
    const auto first = static_cast<std::int16_t>(step.weights[r] & 0xFFFF);
    const auto second = static_cast<std::int16_t>(step.weights[r] >> 16);
    sum += first * static_cast<std::int32_t>(pair & 0xFFFF) + second * static_cast<std::int32_t>(pair >> 16);
  }
  return static_cast<float>(sum) * taps.scale + taps.offset;
}

inline std::uint8_t cut_to_byte(float value) {
  return static_cast<std::uint8_t>(value > 0.0F ? (value < 255.0F ? value : 255.0F) : 0.0F);
}

}  // namespace kernels

/// Weighted sums of bytes in integers of 32 bits, by weights of 16 bits.
class ByteSums {
 public:
  /// kernel   as of LinearSum, weights taken for whole ones times a power of two
  /// scale    of the sum in stored units, then offset
  /// as_f32   results are not rounded: then only whole weights will do
  /// Returns nothing where weights of 16 bits could change a result by more than 1/32 of a level, or sums don't fit.
  static std::optional<ByteSums> make(const NumberGrid& kernel, int center_column, int channels, float scale,
                                      float offset, bool as_f32);

  /// Whether sums are those of a column times a row.
  bool has_factors() const { return !column_.empty(); }

  /// source  rows of the image from the kernel's first row on; result  bytes or f32
  void run(const ConstAnyView& source, const AnyView& result, std::ptrdiff_t before, Scratch& scratch) const;
  void run_reference(const ConstAnyView& source, const AnyView& result, std::ptrdiff_t before, Scratch& scratch) const;

 private:
  void find_factors(const NumberGrid& kernel);
  void run_factors(const ConstAnyView& source, const ImageView<std::uint8_t>& result, Scratch& scratch) const;
  template <class T, class Calls>
  void run_tile(const ConstAnyView& source, const ImageView<T>& result, std::ptrdiff_t before, Scratch& scratch,
                const Calls& calls) const;

  int rows_ = 1;
  int channels_ = 1;
  kernels::PairTaps taps_;
  std::vector<kernels::PairStep> group_;
  std::vector<kernels::PairStep> single_;
  std::vector<std::int16_t> column_;  ///< factors of a kernel that has such; else empty
  std::vector<std::int16_t> row_;
};

}  // namespace azulejo
