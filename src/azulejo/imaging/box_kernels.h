#pragma once

#include <cstddef>
#include <cstdint>

#include "azulejo/engine/scratch.h"
#include "azulejo/imaging/window_tile.h"

namespace azulejo::kernels {

/// Columns and rows of a window; both odd.
struct BoxWindow {
  int columns;
  int rows;
  std::int64_t pixels() const { return std::int64_t{columns} * rows; }
};

/// Up to this many pixels in a window, the sums of 16-bit values fit 32 bits with a sign.
constexpr std::int64_t kExactWindow16 = 32767;

/// The averages of a tile's windows, exact and rounded half up. Of 16-bit values windows have up to kExactWindow16 pixels.
void box_tile(const WindowTile<std::uint8_t>& tile, int channels, const BoxWindow& window, Scratch& scratch);
void box_tile(const WindowTile<std::uint16_t>& tile, int channels, const BoxWindow& window, Scratch& scratch);

/// A tile of f32: the averages are the sums of columns, as anchored_sum adds them, added along rows as tree_sum does, and
/// divided by the number of pixels.
/// first_row  place in the image of the first source row
void box_tile(const WindowTile<float>& tile, int channels, const BoxWindow& window, int first_row, Scratch& scratch);

/// The sum of `count` values, `stride` apart. Of those up to the next place in the image that is a multiple of `count`,
/// from the last to the first; of those from there on; of both sums. So neighbouring windows share sums wherever tiles
/// begin.
/// row  place in the image of the first
inline float anchored_sum(const float* first, std::ptrdiff_t stride, int count, int row) {
  const int split = count - (row % count + count) % count;
  float before = first[(split - 1) * stride];
  for (int k = split - 2; k >= 0; --k) before = before + first[k * stride];
  if (split == count) return before;
  float behind = first[split * stride];
  for (int k = split + 1; k < count; ++k) behind = behind + first[k * stride];
  return before + behind;
}

/// The sum of `count` values, `tap` apart: for each power of two that `count` is made of, from 1 on, the sum of as many
/// values, each by halves.
inline float halves_sum(const float* first, std::ptrdiff_t tap, int count) {
  if (count == 1) return *first;
  return halves_sum(first, tap, count / 2) + halves_sum(first + count / 2 * tap, tap, count / 2);
}
inline float tree_sum(const float* first, std::ptrdiff_t tap, int count) {
  float sum = 0;
  int done = 0;
  for (int part = 1; part <= count; part *= 2) {
    if ((count & part) == 0) continue;
    const float of_part = halves_sum(first + done * tap, tap, part);
    sum = done == 0 ? of_part : sum + of_part;
    done += part;
  }
  return sum;
}

}  // namespace azulejo::kernels
