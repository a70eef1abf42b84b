#pragma once

#include <cstdint>

#include "azulejo/core/export.h"
#include "azulejo/data/pool.h"
#include "azulejo/data/view.h"

namespace azulejo {

/// An image of region ids: 0 is no region, the others are dense, 1…count, in the raster order of their first
/// pixel. Moved, not copied: `clone()` says a copy aloud.
class AZULEJO_EXPORT Labels {
 public:
  Labels() = default;
  /// All pixels are 0. Throws Error(Argument) for sizes below 1.
  Labels(int width, int height);

  Labels clone() const;
  int width() const { return width_; }
  int height() const { return height_; }
  ImageView<std::uint32_t> view() { return {data(), width_, height_, 1, width_}; }
  ImageView<const std::uint32_t> view() const { return {data(), width_, height_, 1, width_}; }

  /// Renumbers to dense ids in raster order; returns their number. Cost O(pixels).
  std::uint32_t make_dense();

 private:
  std::uint32_t* data() const { return reinterpret_cast<std::uint32_t*>(buffer_.data()); }
  int width_ = 0;
  int height_ = 0;
  Buffer buffer_;
};

}  // namespace azulejo
