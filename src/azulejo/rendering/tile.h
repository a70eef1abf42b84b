#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "azulejo/data/frame.h"
#include "azulejo/rendering/bin.h"
#include "azulejo/rendering/raster.h"
#include "azulejo/rendering/resolve.h"
#include "azulejo/rendering/shade.h"

namespace azulejo {

enum class LayerKind : std::uint8_t { Color, Depth, Normal, Position, Uv, Albedo, Object, Material, Face };

/// A layer of the frame that is being drawn.
struct LayerTarget {
  LayerKind kind;
  AnyView pixels;
};

/// What all tiles of a picture share.
struct Picture {
  ShadingContext shading;
  TileGrid grid;
  int width = 0;
  int height = 0;
  std::span<const SamplePoint> samples;
  std::span<const BinnedChunk> chunks;
  std::span<const LayerTarget> layers;
  Resolve resolve;
  bool count = false;  ///< statistics are wanted
};

/// Draws the tiles of pictures, one after the other; one a thread.
class TileRenderer {
 public:
  explicit TileRenderer(const Picture& picture);
  void draw(std::size_t tile);
  const ZBufferStatistics& statistics() const { return statistics_; }

 private:
  /// Triangles as they are seen in single pixels, by some of their samples: first those that all samples see.
  struct Visible {
    Array<std::uint32_t> pixel;  ///< in the tile
    Array<std::uint32_t> triangle;
    Array<std::uint8_t> weight;   ///< samples that see it
    Array<std::uint8_t> primary;  ///< seen by most of the pixel's samples: it goes into the data layers
    Array<std::uint32_t> group;   ///< empty: all are of one
    std::size_t whole = 0;        ///< the first so many have all samples, and neither weight nor primary
    std::size_t count = 0;
  };
  /// What is shaded together.
  struct Group {
    std::uint32_t instance;
    std::uint32_t material;
    std::uint32_t count;
    std::uint32_t next;
  };
  /// A sample of a transparent triangle.
  struct Layered {
    std::uint32_t at;
    float depth;
    std::uint32_t triangle;
    std::uint32_t visible;  ///< its shaded colour
  };

  void raster(std::size_t tile);
  void raster_reference(const BinnedChunk& chunk, std::uint32_t reference, const RasterInstance& instance);
  std::array<ScreenVertex, 3> vertices_of(const BinnedChunk& chunk, std::uint32_t reference,
                                          std::uint32_t& triangle) const;
  void raster_masked(const std::array<ScreenVertex, 3>& vertices, std::uint32_t triangle);
  void collect();
  void collect_mixed(std::size_t pixel);
  void collect_layered();
  void group_visible();
  std::size_t add_visible(std::size_t pixel, std::uint8_t weight, std::uint32_t triangle);
  std::uint32_t group_of(std::uint32_t triangle);
  const RasterInstance& instance_of(std::uint32_t triangle);
  void shade_all();
  void shade_group(const Group& group, std::size_t begin, std::size_t end);
  void write_layers(const FragmentBatch& batch, const std::uint32_t* members);
  void blend();
  void write_color();
  void write_empty();
  void place_batch(const std::uint32_t* members);
  Rect tile_rect() const;
  int pixel_x(std::size_t pixel) const {
    return buffer_.origin_x + static_cast<int>(pixel & ((1U << buffer_.log2) - 1));
  }
  int pixel_y(std::size_t pixel) const { return buffer_.origin_y + static_cast<int>(pixel >> buffer_.log2); }

  const Picture& picture_;
  VisibilityBuffer buffer_;
  std::unique_ptr<FragmentBatch> batch_;
  std::vector<CoveredSample> covered_;
  std::vector<Layered> layered_;
  Visible visible_;
  Array<glm::vec4> shaded_;         ///< of each visible: linear, straight
  Array<std::uint32_t> mixed_;      ///< pixels that see several triangles
  Array<std::uint32_t> order_;      ///< of the visible, by group
  Array<std::uint32_t> of_sample_;  ///< with transparent triangles: what each sample sees
  Array<glm::vec4> accumulated_;    ///< of each pixel: linear, premultiplied
  std::vector<Group> groups_;
  std::unordered_map<std::uint64_t, std::uint32_t> group_numbers_;
  std::uint32_t last_instance_ = 0;
  std::uint32_t last_group_ = 0;
  bool blending_ = false;
  bool one_group_ = false;  ///< what was drawn into the tile is of one instance and one material
  ZBufferStatistics statistics_;
};

}  // namespace azulejo
