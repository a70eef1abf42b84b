#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "azulejo/data/array.h"
#include "azulejo/rendering/screen.h"

namespace azulejo {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFF;

/// A tile's visibility buffer: for every sample of every pixel its depth (0: nothing, 1: nearest) and the triangle that
/// is seen there. Samples are planes of size × size values, one after the other.
struct VisibilityBuffer {
  int origin_x = 0;  ///< of the tile's first pixel in the picture
  int origin_y = 0;
  int log2 = 6;
  int left = 0;  ///< the pixels of the tile that can be drawn: [left, right) × [top, bottom)
  int top = 0;
  int right = 0;
  int bottom = 0;
  std::span<const SamplePoint> samples;
  Array<float> depth;  ///< padded by a vector
  Array<std::uint32_t> triangle;

  int size() const { return 1 << log2; }
  std::size_t pixels() const { return std::size_t{1} << (2 * log2); }
  void prepare();  ///< sizes the arrays for `samples` and empties them
};

/// A sample that a triangle covers, in front of what the depth buffer holds there.
struct CoveredSample {
  std::uint32_t at = 0;  ///< index into the visibility buffer's arrays
  float depth = 0;
};

struct RasterCounts {
  std::uint64_t tested = 0;
  std::uint64_t passed = 0;
};

namespace kernels {

/// Draws triangles into a tile, in order, those in front of what is there (of two at the same depth the first stays).
/// A sample is inside by the top-left rule, exactly, with positions rounded to 1/256 pixel.
///
/// vertices    of an instance;  triangles  three vertices each
/// numbers     of the triangles to draw, counted over all instances; `first` is the instance's first
/// counts      may be null: then nothing is counted
void raster_triangles(VisibilityBuffer& target, const ScreenVertex* vertices, const std::uint32_t* triangles,
                      std::uint32_t first, std::span<const std::uint32_t> numbers, RasterCounts* counts);
/// One triangle.
void raster_triangle(VisibilityBuffer& target, const std::array<ScreenVertex, 3>& vertices, std::uint32_t number,
                     RasterCounts* counts);
/// The samples that `raster_triangle` would write are appended to `covered` instead.
void cover_triangle(const VisibilityBuffer& target, const std::array<ScreenVertex, 3>& vertices,
                    std::vector<CoveredSample>& covered);

struct VisibleCounts {
  std::size_t whole = 0;  ///< pixels all of whose samples see one triangle
  std::size_t mixed = 0;  ///< pixels whose samples see several, or partly nothing
};
/// The pixels in which something is seen, in raster order: the whole ones with their triangles, and the mixed ones.
/// All results have room for `pixels()` and 64 more.
VisibleCounts visible_pixels(const VisibilityBuffer& buffer, std::uint32_t* pixels, std::uint32_t* triangles,
                             std::uint32_t* mixed);

}  // namespace kernels
}  // namespace azulejo
