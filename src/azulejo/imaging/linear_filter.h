#pragma once

#include <optional>
#include <vector>

#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/block_convolution.h"
#include "azulejo/imaging/convolve_bytes.h"
#include "azulejo/imaging/filter_pass.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

/// What a LinearFilter computes.
struct LinearSum {
  NumberGrid kernel;  ///< result(x, y) = Σ kernel(r, c) · source(x + c − center_column, y + r − center_row)
  int center_row = 0;
  int center_column = 0;
  float scale = 1;      ///< of the sum
  float offset = 0;     ///< added behind it, an intensity
  bool as_f32 = false;  ///< not saturated, in units of full range, without alpha
  Light light = Light::Encoded;
};

/// A weighted sum of neighbours on tiles: the one way in which kernels of any weights are applied.
///
/// Order   rows of the kernel, then columns, from the first; a separable kernel (kernel_factors): columns of the image
///         first, both in that order. Weights of 0 read nothing
/// Exact   whole weights of integer pixels while sums stay below 2²⁴. Other weights of bytes are rounded to 16 bits
///         where that changes a result by less than 1/32 of a level before rounding. Where weights · scale sum to 0 or 1, differences
///         from the pixel in the center are weighted, so constants give exactly the constant or `offset`. Else within
///         (weights + 4)2⁻²⁴ · Σ|weight| · the largest value
///         Kernels of more weights than are fast to sum: BlockConvolution
/// Alpha   colors are weighted by alpha. Kernels without negative weights average alpha likewise; others leave it
/// f32     result: of each color, multiplied by alpha, which is left out
class LinearFilter {
 public:
  LinearFilter(const ImageInfo& source, const LinearSum& sum);

  const ImageInfo& result() const { return result_; }
  Rect needs(const Rect& result) const;
  void run(const ConstTile& source, const Tile& result, Scratch& scratch) const;
  void run_reference(const ConstTile& source, const Tile& result, Scratch& scratch) const;

  /// 2: a column, then a row.
  int passes() const { return static_cast<int>(passes_.size()); }

 private:
  template <class Calls>
  class SourceRows;

  void plan(const LinearSum& sum);
  bool rounds_away(const LinearSum& sum) const;
  template <class Calls>
  void run_tile(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const;
  template <class Calls>
  void run_blocks(const ConstTile& source, const Tile& result, Scratch& scratch) const;
  template <class Calls>
  void second_pass(const float* row, float* across, std::size_t values, std::size_t count, float* result) const;
  template <class Calls>
  void deliver(const float* center, float* sums, int width, const AnyView& result, int y) const;
  /// Values of a source row before the one that stands where the result does.
  std::ptrdiff_t before() const { return std::ptrdiff_t{center_column_} * source_.channels; }
  void weigh_alpha(const float* center, float* row, int pixels) const;
  void drop_alpha(const float* row, float* result, int pixels) const;

  ImageInfo source_;
  ImageInfo result_;
  RowFormat format_;
  int rows_;
  int columns_;
  int center_row_;
  int center_column_;
  bool has_alpha_;
  bool as_f32_;
  bool in_place_;          ///< f32 that is summed where it lies
  bool averages_ = false;  ///< alpha is summed like colors, too
  float alpha_scale_ = 1;  ///< of the sums, then
  float color_scale_ = 1;
  float color_offset_ = 0;                  ///< a unit of alpha, if there is any
  std::vector<FilterPass> passes_;          ///< one, or a column and a row
  std::optional<BlockConvolution> blocks_;  ///< where that is faster
  std::optional<ByteSums> bytes_;           ///< bytes that are summed in integers
};

/// The step of an operation that is nothing but a LinearFilter.
class LinearFilterNode : public TileNode {
 public:
  LinearFilterNode(const LinearSum& sum, const BorderRule& border, std::span<const ImageInfo> sources)
      : TileNode(sources), border_(border), filter_(sources[0], sum) {
    set_results({filter_.result()});
  }

  Rect needs(const Rect& result, int) const override { return filter_.needs(result); }
  BorderRule border(int) const override { return border_; }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    filter_.run(sources[0], results[0], context.scratch);
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    filter_.run_reference(sources[0], results[0], context.scratch);
  }

 private:
  BorderRule border_;
  LinearFilter filter_;
};

}  // namespace azulejo
