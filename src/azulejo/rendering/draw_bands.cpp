#include "azulejo/rendering/draw_bands.h"

#include <algorithm>

namespace azulejo {
namespace {

/// From what is painted outward: a layer holds what is painted on it, and inside of its mask.
void find_regions(const DrawSteps& steps, const DrawOutlines& outlines, DrawBands& bands) {
  std::vector<std::size_t> open;  // Begin steps
  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    switch (steps.steps[i].kind) {
      case DrawStep::Shape:
        bands.regions[i] = outlines.of(i).pixels;
        if (!open.empty()) bands.regions[open.back()] = united(bands.regions[open.back()], bands.regions[i]);
        break;
      case DrawStep::Begin:
        open.push_back(i);
        bands.depth = std::max(bands.depth, open.size());
        break;
      case DrawStep::Keep: {
        const std::size_t mask = open.back();
        open.pop_back();
        Rect& kept = bands.regions[open.back()];
        kept = intersection(kept, bands.regions[mask]);
        bands.regions[mask] = bands.regions[i] = kept;
        break;
      }
      case DrawStep::End: {
        const Rect layer = bands.regions[open.back()];
        open.pop_back();
        bands.regions[i] = layer;
        if (!open.empty()) bands.regions[open.back()] = united(bands.regions[open.back()], layer);
        break;
      }
      case DrawStep::Nothing: break;
    }
  }
}

/// And back inward: nothing is seen beyond the layer that it is on.
void cut_regions(const DrawSteps& steps, const Rect& picture, DrawBands& bands) {
  std::vector<Rect> open{picture};
  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    Rect& region = bands.regions[i];
    switch (steps.steps[i].kind) {
      case DrawStep::Shape: region = intersection(region, open.back()); break;
      case DrawStep::Begin:
        region = intersection(region, open.back());
        open.push_back(region);
        break;
      case DrawStep::Keep:
      case DrawStep::End:
        region = open.back();
        open.pop_back();
        break;
      case DrawStep::Nothing: break;
    }
  }
}

}  // namespace

DrawBands draw_bands(const DrawSteps& steps, const DrawOutlines& outlines, const DrawFrame& frame, int rows) {
  DrawBands bands;
  bands.rows = rows;
  bands.count = (frame.height + rows - 1) / rows;
  bands.regions.resize(steps.steps.size());
  find_regions(steps, outlines, bands);
  cut_regions(steps, {0, 0, frame.width, frame.height}, bands);

  bands.starts.assign(static_cast<std::size_t>(bands.count) + 1, 0);
  const auto for_bands = [&](const Rect& region, auto&& each) {
    if (region.empty()) return;
    for (int band = region.y / rows; band <= (region.bottom() - 1) / rows; ++band) each(static_cast<std::size_t>(band));
  };
  for (const Rect& region : bands.regions) {
    for_bands(region, [&](std::size_t band) { ++bands.starts[band + 1]; });
  }
  for (std::size_t band = 0; band + 1 < bands.starts.size(); ++band) bands.starts[band + 1] += bands.starts[band];
  bands.lists.resize(bands.starts.back());
  std::vector<std::size_t> next = bands.starts;
  for (std::size_t i = 0; i < bands.regions.size(); ++i) {
    for_bands(bands.regions[i], [&](std::size_t band) { bands.lists[next[band]++] = static_cast<std::uint32_t>(i); });
  }
  return bands;
}

}  // namespace azulejo
