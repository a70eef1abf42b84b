#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace azulejo {

/// A vertex in the picture: pixels (y down, centres at half), depth (1 near, 0 far) and 1 ÷ clip w. One that lies
/// outside the near, far or guard planes, or isn't finite, has x = NaN: the triangles that use it are clipped.
struct alignas(16) ScreenVertex {
  float x, y, z, inverse_w;
};

/// Positions are rounded to 1/256 pixel before anything is decided about coverage.
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixels = 1 << kSubpixelBits;
/// Triangles narrower and lower than this many subpixels are rasterized in 32-bit integers.
inline constexpr int kSmallExtent = 1 << 14;
/// Coordinates beyond are clipped away: (guard band, in pixels) 2^17 · 256 · 2 squared still fits 64 bits.
inline constexpr float kGuardBand = 131072.0F;

/// Where a pixel is sampled, in subpixels from its top left.
struct SamplePoint {
  std::int32_t x;
  std::int32_t y;
};

/// The standard patterns of Direct3D for 1, 4, 8 and 16 samples.
/// Source: Direct3D 11.3 functional specification, 19.2 (in sixteenths of a pixel from its centre)
std::span<const SamplePoint> sample_pattern(int samples);

}  // namespace azulejo
