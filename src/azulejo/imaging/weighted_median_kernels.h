#pragma once

#include <cstdint>
#include <span>

#include "azulejo/engine/scratch.h"
#include "azulejo/imaging/window_tile.h"

namespace azulejo::kernels {

/// A pixel of the window, from its first row and column on, and its weight, which is not 0.
struct WeightedTap {
  int dx;
  int dy;
  int weight;
};

/// The window: rows and columns, its taps, and the sum of their weights, 1–32767.
struct WeightedWindow {
  int columns;
  int rows;
  std::span<const WeightedTap> taps;
  int total;
};

/// The weighted medians of a tile's windows.
void weighted_median_tile(const WindowTile<std::uint8_t>& tile, int channels, const WeightedWindow& window,
                          Scratch& scratch);
void weighted_median_tile(const WindowTile<std::uint16_t>& tile, int channels, const WeightedWindow& window,
                          Scratch& scratch);
void weighted_median_tile(const WindowTile<float>& tile, int channels, const WeightedWindow& window, Scratch& scratch);

}  // namespace azulejo::kernels
