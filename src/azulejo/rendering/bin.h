#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "azulejo/data/array.h"
#include "azulejo/math/rect.h"
#include "azulejo/rendering/clip.h"
#include "azulejo/rendering/raster_scene.h"
#include "azulejo/rendering/screen.h"
#include "azulejo/rendering/vertex_stage.h"
#include "azulejo/rendering/zbuffer.h"

namespace azulejo {

/// How the picture is divided, and where its pixels are sampled.
struct TileGrid {
  Rect area;          ///< pixels that can be drawn: the viewport inside the picture
  int tile_log2 = 6;  ///< tiles are squares of 2^tile_log2 pixels
  int columns = 0;    ///< of tiles, over the whole picture
  int rows = 0;
  int sample_low = 0;  ///< smallest and largest coordinate of a sample in its pixel, subpixels
  int sample_high = 0;
  std::size_t tiles() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};
TileGrid tile_grid(int width, int height, const Rect& viewport, int samples);

/// A piece of a triangle that was clipped, or of a widened line or point.
struct ClippedTriangle {
  std::array<ScreenVertex, 3> vertices;
  std::uint32_t triangle = 0;  ///< that it belongs to
};

/// In a list of references: the number of a ClippedTriangle of the same chunk, not of a triangle.
inline constexpr std::uint32_t kClippedReference = std::uint32_t{1} << 31;

/// The triangles of a chunk, by the tiles that they touch, in their order.
struct BinnedChunk {
  std::vector<std::uint32_t> first;  ///< of each tile, into `references`; one more at the end; empty: nothing
  Array<std::uint32_t> references;
  std::vector<ClippedTriangle> clipped;
  ZBufferStatistics statistics;
  std::span<const std::uint32_t> of_tile(std::size_t tile) const {
    if (first.empty()) return {};
    return {references.data() + first[tile], first[tile + 1] - first[tile]};
  }
};

namespace kernels {

/// What `cull_block` leaves of a block. Tiles are packed: column | row << 12.
struct CulledBlock {
  static constexpr std::size_t kTriangles = 1024;
  static constexpr std::uint32_t kByHand = 0xFFFFFFFF;                  ///< as first tile: clipped or large
  static constexpr std::uint32_t kBackFacing = std::uint32_t{1} << 31;  ///< in the first tile
  alignas(64) std::array<std::uint32_t, kTriangles + 64> triangle;      ///< number in the block
  alignas(64) std::array<std::uint32_t, kTriangles + 64> first_tile;
  alignas(64) std::array<std::uint32_t, kTriangles + 64> last_tile;
  std::size_t count = 0;
  std::uint32_t culled = 0;
  std::uint32_t empty = 0;
  std::uint32_t outside = 0;
};

/// Looks at up to kTriangles triangles whose vertices are `triangles`, three each.
///
/// mirrored   front faces turn the other way in the picture
/// cull       what is seen from behind is dropped
void cull_block(const ScreenVertex* vertices, const std::uint32_t* triangles, std::size_t count, bool mirrored,
                bool cull, const TileGrid& grid, CulledBlock& result);

}  // namespace kernels

struct BinSettings {
  TileGrid grid;
  glm::mat4 clip_from_world{1.0F};
  ScreenTransform transform;
  float line_width = 1.5F;  ///< pixels
  float point_size = 3;
};

/// Sorts triangles into tiles: drops what is outside, seen from behind, without area or between all samples; clips what
/// needs it. One a thread: its memory is used again from chunk to chunk.
class Binner {
 public:
  /// clip  of the vertices, where a program made them; else empty
  Binner(const RasterScene& scene, std::span<const ScreenVertex> vertices, std::span<const glm::vec4> clip,
         const BinSettings& settings);
  /// The triangles [first, first + count), counted over all instances.
  BinnedChunk bin(std::uint32_t first, std::uint32_t count);

 private:
  void bin_block(std::uint32_t first, std::uint32_t count);
  bool double_sided(std::uint32_t triangle) const;
  void bin_by_hand(std::uint32_t triangle);
  /// What becomes of a face, from the least to the most: of the pieces of one, the most counts.
  enum class Fate : std::uint8_t { Empty, Outside, Culled, Drawn };
  Fate bin_polygon(const ClippedPolygon& polygon, std::uint32_t triangle);
  Fate bin_large(const std::array<ScreenVertex, 3>& vertices, std::uint32_t triangle, std::uint32_t reference);
  void count(Fate fate);
  void widen(std::uint32_t triangle);
  glm::vec4 clip_of(std::uint32_t vertex) const;
  void push(std::uint32_t tile, std::uint32_t reference);
  BinnedChunk finish();

  const RasterScene& scene_;
  std::span<const ScreenVertex> vertices_;
  std::span<const glm::vec4> clip_;
  const BinSettings& settings_;
  const RasterInstance* instance_ = nullptr;
  const RasterMesh* mesh_ = nullptr;
  glm::mat4 clip_from_object_{1.0F};
  kernels::CulledBlock block_;
  BinnedChunk chunk_;
  std::vector<std::uint32_t> tiles_;  ///< with `references_`: what was found, in its order
  std::vector<std::uint32_t> references_;
  std::vector<std::uint32_t> counts_;  ///< of each tile
};

}  // namespace azulejo
