#pragma once

#include <cstddef>
#include <cstdint>

#include "azulejo/engine/scratch.h"
#include "azulejo/imaging/window_tile.h"

namespace azulejo::kernels {

/// Up to this radius medians are found by networks.
constexpr int kNetworkRadius = 4;
/// Up to this radius the median of bytes is found by histograms: what is in a column fits a byte, in a window 16 bits.
constexpr int kHistogramRadius = 127;

/// The medians of a tile's windows by sorting networks; `radius` is 1 … kNetworkRadius.
void median_by_network(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch);
void median_by_network(const WindowTile<std::uint16_t>& tile, int channels, int radius, Scratch& scratch);
void median_by_network(const WindowTile<float>& tile, int channels, int radius, Scratch& scratch);

/// The same by histograms of columns; `radius` is 1 … kHistogramRadius.
void median_by_histogram(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch);

/// The same by walking along the ranks of all values; any radius.
void median_by_walking(const WindowTile<std::uint8_t>& tile, int channels, int radius, Scratch& scratch);
void median_by_walking(const WindowTile<std::uint16_t>& tile, int channels, int radius, Scratch& scratch);
void median_by_walking(const WindowTile<float>& tile, int channels, int radius, Scratch& scratch);

}  // namespace azulejo::kernels
