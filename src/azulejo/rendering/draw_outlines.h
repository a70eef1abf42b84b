#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "azulejo/math/rect.h"
#include "azulejo/rendering/draw_steps.h"
#include "azulejo/rendering/outline_edges.h"

namespace azulejo {

/// Edges of a part of an outline.
struct DrawPart {
  std::span<const OutlineEdge> edges;
  int first_band = 0;
  /// For each of its bands where its edges begin in `chosen`, and behind the last where they end. Empty: all edges are
  /// looked at in each band.
  std::span<const std::uint32_t> starts;
  std::span<const std::uint32_t> chosen;
};

/// What a Shape covers.
struct DrawOutline {
  std::uint32_t first_part = 0;
  std::uint32_t part_count = 0;
  Rect pixels;  ///< nothing is covered beyond
  FillRule rule = FillRule::NonZero;
};

/// The outlines of all steps, made on all threads.
class DrawOutlines {
 public:
  DrawOutlines(const Drawing& drawing, const DrawSteps& steps, const DrawFrame& frame, const DrawOptions& options,
               int band_rows, const Run& run);

  /// Of a step; empty where that is no Shape.
  const DrawOutline& of(std::size_t step) const { return outlines_[step]; }
  std::span<const DrawPart> parts(const DrawOutline& outline) const {
    return {parts_.data() + outline.first_part, outline.part_count};
  }

 private:
  struct Chunk;
  void add_parts(Chunk& chunk);

  std::vector<DrawOutline> outlines_;
  std::vector<DrawPart> parts_;
  std::vector<std::shared_ptr<Chunk>> chunks_;  ///< whose arrays the parts lie in
};

}  // namespace azulejo
