#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// Asks for memory that will be read soon.
void prefetch(const std::byte* memory, std::size_t bytes);

/// Rows have 128 bytes behind them that may be read and written, and lose what is there.

/// result[i] = Σ weights[t] · rows[t][i], added in the order of t.
void sum_rows(const float* const* rows, const float* weights, int count, float* result, std::size_t values);

/// Adds such a sum to `total` with Kahan's compensation; `total` and `compensation` begin as 0.
void add_rows(const float* const* rows, const float* weights, int count, float* total, float* compensation,
              std::size_t values);

/// Result pixels of a row, and where they come from.
struct Columns {
  int count = 0;  ///< result pixels
  int taps = 0;
  int channels = 1;
  int source_begin = 0;            ///< the source pixel with which rows begin
  int source_count = 0;            ///< source pixels in rows
  const int* first = nullptr;      ///< first source pixel of each result pixel; 16 more may be read
  const float* weights = nullptr;  ///< taps of each result pixel
  const float* by_tap = nullptr;   ///< the same, by_tap_stride values for each tap; 16 more may be read
  std::ptrdiff_t by_tap_stride = 0;
};

/// Filters `row_count` rows along x, for windows that begin at most one source pixel further from each result pixel
/// to the next (enlarging).
void enlarge_columns(const Columns& columns, const float* const* rows, int row_count, float* const* results);

inline constexpr int kPanelRows = 16;

/// The same for any windows. Both arrays have kPanelRows rows, of which `row_count` matter; `panel` holds
/// panel_values(columns) values.
void shrink_columns(const Columns& columns, const float* const* rows, int row_count, float* panel,
                    float* const* results);
std::size_t panel_values(const Columns& columns);

/// Means of two by two pixels of u8, rounded half up. sums: 2 · count · channels values.
void halve_rows(const std::uint8_t* upper, const std::uint8_t* lower, int count, int channels, std::uint16_t* sums,
                std::uint8_t* result);

}  // namespace azulejo::kernels
