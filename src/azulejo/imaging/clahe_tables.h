#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "azulejo/data/pool.h"
#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/clahe.h"
#include "azulejo/imaging/clahe_kernels.h"

namespace azulejo {

/// One direction of the grid of tiles.
struct ClaheAxis {
  /// Pixels between the centers of two tiles, or outside the outermost.
  struct Stretch {
    int begin;
    int end;
    int low;   ///< tile before
    int high;  ///< tile behind; the same outside
  };
  ClaheAxis(int size, int tiles);

  int tiles() const { return static_cast<int>(begins.size()) - 1; }

  std::vector<int> begins;            ///< of tiles, and the size
  std::vector<Stretch> stretches;     ///< those that have pixels
  std::vector<std::int16_t> weights;  ///< of the tile behind, for each pixel
};

/// What is mapped of an image.
struct ClaheLayout {
  ClaheLayout(const ImageInfo& source, const ClaheOptions& options);

  ImageInfo info;
  bool luma;    ///< one plane of luma; else one a color channel
  bool direct;  ///< the plane is the image
  int planes;
  float clip;
  ClaheAxis across;
  ClaheAxis down;
};

/// A plane of straight color or luma of a part of the image: the part itself, or in scratch.
template <class T>
ImageView<const T> clahe_plane(const ClaheLayout& layout, const ConstAnyView& pixels, int plane, Scratch& scratch);

/// Histograms of all tiles and planes, and their mappings.
template <class T>
class ClaheTables final : public Analysis {
 public:
  using Mapping = kernels::ClaheMapping<T>;
  using Entry = typename Mapping::Entry;

  explicit ClaheTables(const ClaheLayout& layout);

  void add(const ConstTile& tile, Scratch& scratch) override;
  void merge(const Analysis& other) override;
  void finish() override;

  std::span<const std::uint64_t> counts(int plane, int row, int column) const {
    return {all() + index(plane, row, column) * Mapping::kBins, Mapping::kBins};
  }
  const Entry* table(int plane, int row, int column) const {
    return reinterpret_cast<const Entry*>(tables_.data()) + index(plane, row, column) * Mapping::kEntries;
  }

 private:
  std::uint64_t* all() const { return reinterpret_cast<std::uint64_t*>(counts_.data()); }
  std::size_t index(int plane, int row, int column) const {
    return static_cast<std::size_t>((plane * layout_.down.tiles() + row) * layout_.across.tiles() + column);
  }
  std::size_t size() const { return index(layout_.planes, 0, 0); }

  const ClaheLayout& layout_;  ///< the node's, which lives longer
  Buffer counts_;              ///< of std::uint64_t
  Buffer tables_;              ///< of Entry
};

/// Cuts what is above `clip` times the mean off, and gives it to the other bins: each becomes min(limit, count + δ)
/// with the δ that keeps the sum. Nothing counted: all bins are the same.
///
/// counts   of at least one bin
/// clipped  as many
void clahe_clip(std::span<const std::uint64_t> counts, double clip, std::span<double> clipped);

extern template class ClaheTables<std::uint8_t>;
extern template class ClaheTables<std::uint16_t>;
extern template class ClaheTables<float>;

}  // namespace azulejo
