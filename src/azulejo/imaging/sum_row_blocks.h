#pragma once

#include <algorithm>
#include <array>

#include "azulejo/engine/scratch.h"
#include "azulejo/imaging/resize_kernels.h"

namespace azulejo {

/// Sums of more rows than this are sums of blocks of them: rounding grows with the square root of their number.
constexpr int kRowBlock = 32;

/// total[i] = Σ weights[t] · row t [i], for `count` rows of `values` values that load(t, row) makes.
///
/// reference  by the plain definition, with the same bytes
template <class Load>
void sum_row_blocks(const float* weights, int count, std::size_t values, bool reference, Scratch& scratch, float* total,
                    Load load) {
  const auto mark = scratch.mark();
  std::array<float*, kRowBlock> rows{};
  for (int r = 0; r < std::min(count, kRowBlock); ++r) rows[static_cast<std::size_t>(r)] = scratch.take<float>(values);
  float* const sum = scratch.take<float>(values);
  for (int first = 0; first < count; first += kRowBlock) {
    const int size = std::min(kRowBlock, count - first);
    for (int r = 0; r < size; ++r) load(first + r, rows[static_cast<std::size_t>(r)]);
    float* const block = first == 0 ? total : sum;
    if (reference) {
      for (std::size_t i = 0; i < values; ++i) {
        block[i] = weights[first] * rows[0][i];
        for (int r = 1; r < size; ++r) block[i] = block[i] + weights[first + r] * rows[static_cast<std::size_t>(r)][i];
      }
    } else {
      kernels::sum_rows(rows.data(), weights + first, size, block, values);
    }
    for (std::size_t i = 0; first > 0 && i < values; ++i) total[i] = total[i] + sum[i];
  }
  scratch.release(mark);
}

}  // namespace azulejo
