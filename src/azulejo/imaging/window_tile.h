#pragma once

#include <cstddef>

namespace azulejo::kernels {

/// A tile and the pixels around it. Strides in values.
template <class T>
struct WindowTile {
  const T* source;  ///< (width + 2 · radius) × (height + 2 · radius) pixels
  std::ptrdiff_t source_stride;
  T* result;
  std::ptrdiff_t result_stride;
  int width;
  int height;
};

}  // namespace azulejo::kernels
