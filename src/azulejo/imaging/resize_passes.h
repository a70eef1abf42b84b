#pragma once

#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/resize_taps.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {

/// A separable resampling of one tile. Which pass is first depends on the sizes of the images only: where rows get
/// fewer, columns are summed first, else rows are.
struct ResizePasses {
  RowFormat format;
  const Axis& across;
  const Axis& down;
  const TapTable& columns;  ///< covers the tile's columns, with `by_tap` where enlarging
  const TapTable& rows;     ///< covers the tile's rows

  bool down_first() const { return down.result() < down.source(); }

  void run(const ConstTile& source, const Tile& result, Scratch& scratch) const;
  void run_reference(const ConstTile& source, const Tile& result) const;
};

}  // namespace azulejo
