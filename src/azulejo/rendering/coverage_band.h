#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/rendering/coverage_scan.h"
#include "azulejo/rendering/edge_walk.h"
#include "azulejo/rendering/pixel_area.h"

namespace azulejo {

/// Whether a pixel is covered in part, or altogether or not at all.
enum class Antialias : std::uint8_t { None, Area };
constexpr auto enum_names(Antialias) { return std::array<std::string_view, 2>{"none", "area"}; }

/// Turns edges into the coverage of the pixels of some rows.
///
/// Area: the part of each pixel that is inside by the fill rule. Each edge adds its height, times the sign of its
/// direction, to all that is right of it, in units of 2⁻¹⁶ pixel: the sums from left to right are the windings' mean in
/// each pixel. That is the coverage where one line that never turns in y passes a pixel, whatever its windings; pixels
/// that more of them pass are done again by PixelArea. Errors: of the grid, 2⁻¹⁵ pixel at each end of an edge, and 2⁻¹⁷
/// of each edge in a pixel. Windings are counted modulo 65536.
///
/// None: 0 or 1, by the windings at the pixel's center; one on an edge is on the edge's right or, where it is level,
/// lower side, so that outlines with a common edge share no pixel and leave none out.
///
/// The same bits for any division into bands and any instruction set.
class AZULEJO_EXPORT CoverageBand {
 public:
  CoverageBand(int width, int rows);

  /// Begins with rows [first_row, first_row + rows) of the picture. Everything must have been taken by `row`.
  void move_to(int first_row, int rows);
  int rows() const { return rows_; }

  void add(std::span<const OutlineEdge> edges, Antialias antialias);
  void add(std::span<const OutlineEdge> edges, std::span<const std::uint32_t> chosen, Antialias antialias);
  /// Whether `gather` must see all edges again before the rows are taken.
  bool wants_gathering() const { return crowded_; }
  void gather(std::span<const OutlineEdge> edges);
  void gather(std::span<const OutlineEdge> edges, std::span<const std::uint32_t> chosen);

  /// Rows, of the band, that an edge passes: none outside of [first, last].
  int first_row() const { return used_first_; }
  int last_row() const { return used_last_; }
  /// Takes a row: its runs from left to right, with something inside. Valid until the next call.
  std::span<const CoverageRun> row(int row, FillRule rule);
  /// Of the row taken last, where runs are mixed.
  const float* coverage() const { return coverage_.data(); }
  /// Behind the last row.
  void finish();

 private:
  struct Piece {
    PixelEdge edge;
    std::uint32_t next;
  };
  struct Crowded {
    std::int32_t column;
    std::uint32_t head;
  };

  void use(int first, int last);
  void add_edge(const OutlineEdge& edge, Antialias antialias);
  void add_piece(const EdgePiece& piece, std::int32_t sign, std::uint32_t chain);
  void add_middle(int row, std::int32_t x, std::int32_t sign);
  void gather_edge(const OutlineEdge& edge);
  void gather_piece(const EdgePiece& piece, std::int32_t sign);
  void touch(int row, std::int32_t column);
  void sum_run(int row, int first, int last, FillRule rule, std::int32_t& carry);
  void settle(int row, FillRule rule);

  int width_;
  int blocks_;  ///< of a row, with one more for what is right of the last pixel
  int words_;   ///< of a row's touched blocks
  int first_ = 0;
  int rows_ = 0;
  int used_first_ = 0;
  int used_last_ = -1;
  bool crowded_ = false;
  Array<std::uint32_t> areas_;
  Array<std::uint32_t> chains_;
  Array<std::uint64_t> touched_;
  std::vector<std::vector<Crowded>> crowds_;  ///< of each row
  Array<Piece> pieces_;
  Array<PixelEdge> edges_;
  Array<std::int32_t> sums_;
  Array<float> coverage_;
  std::vector<CoverageRun> runs_;
  PixelArea pixel_;
};

}  // namespace azulejo
