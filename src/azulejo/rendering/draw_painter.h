#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "azulejo/rendering/coverage_band.h"
#include "azulejo/rendering/draw_bands.h"
#include "azulejo/rendering/draw_layer.h"

namespace azulejo {

/// All that a band must know of most steps, side by side.
struct DrawItem {
  DrawStep::Kind kind = DrawStep::Nothing;
  FillRule rule = FillRule::NonZero;
  std::uint32_t part_count = 0;
  const DrawPart* parts = nullptr;
  const OutlineEdge* edges = nullptr;  ///< of a Shape of one part without lists
  std::size_t edge_count = 0;
  glm::vec4 color{0};                  ///< premultiplied
  const DrawPaint* pattern = nullptr;  ///< instead
};

/// What all bands of a picture have in common.
struct DrawPlan {
  const Drawing& drawing;
  const DrawOptions& options;
  const DrawFrame& frame;
  const DrawSteps& steps;
  const DrawOutlines& outlines;
  const DrawBands& bands;
  std::vector<DrawItem> items;  ///< of each step
  std::vector<std::unique_ptr<const DrawPaint>> patterns;

  /// Fills `items`.
  void prepare();
};

/// Paints bands, one after another, on one thread.
class DrawPainter {
 public:
  explicit DrawPainter(const DrawPlan& plan);

  /// rgba  the picture
  void paint(int band, const ImageView<std::uint8_t>& rgba);

 private:
  void cover(const DrawItem& item);
  void add_edges(const DrawItem& item);
  void begin(const Rect& region, const glm::vec4& color);
  void end(const Rect& region, float opacity);
  void keep(const Rect& region);
  /// The layer so many below the topmost.
  DrawLayer& layer(std::size_t below = 0) { return *layers_[depth_ - 1 - below]; }
  template <class Each>
  void for_rows(const Rect& region, Each&& each);

  const DrawPlan& plan_;
  CoverageBand coverage_;
  std::vector<std::unique_ptr<DrawLayer>> layers_;
  std::size_t depth_ = 0;
  Array<float> colors_;
  int band_ = 0;
  int top_ = 0;
  int rows_ = 0;
};

}  // namespace azulejo
