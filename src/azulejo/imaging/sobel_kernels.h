#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// Three rows of values; each is readable from `tap` values before the first to `tap` behind the last.
template <class T>
struct SobelSource {
  const T* above;
  const T* at;
  const T* below;
  std::size_t count;
  std::ptrdiff_t tap;  ///< values to the next pixel
};

/// Rows of results; null where not wanted.
struct SobelRows {
  float* magnitude;
  float* x;
  float* y;
  float* orientation;
};

/// dx = ((above[+1] + below[+1]) + 2 at[+1]) − ((above[−1] + below[−1]) + 2 at[−1]), dy likewise turned over;
/// x = dx · scale, y = dy · scale, magnitude = √(dx² + dy²) · scale, orientation = atan2(0 − dy, dx).
void sobel_row(const SobelSource<std::uint8_t>& source, float scale, const SobelRows& rows);
void sobel_row(const SobelSource<std::uint16_t>& source, float scale, const SobelRows& rows);
void sobel_row(const SobelSource<float>& source, float scale, const SobelRows& rows);

}  // namespace azulejo::kernels
