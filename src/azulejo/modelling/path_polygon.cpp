#include "azulejo/modelling/path_polygon.h"

#include <algorithm>
#include <utility>

#include "azulejo/modelling/flatten_path.h"

namespace azulejo {

Polygon polygon_of(const PathView& path, const glm::mat3x2& page_from_path, float tolerance) {
  FlatPath flat;
  flatten_path(path, page_from_path, {.tolerance = tolerance}, flat);
  Polygon polygon;
  for (std::size_t c = 0; c < flat.contour_count(); ++c) {
    if (flat.contour(c).size() >= 3) polygon.add_ring(flat.contour(c));
  }
  return polygon;
}

Path path_of(const Polygon& polygon) {
  Path path;
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) {
    const auto ring = polygon.ring(r);
    for (std::size_t i = 0; i < ring.size(); ++i) i == 0 ? path.move_to(ring[i]) : path.line_to(ring[i]);
    path.close();
  }
  return path;
}

Polygon filled_area(const Drawing& drawing, float tolerance, const Run& run) {
  warn_of_unfilled(drawing, run);
  Polygon area;
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    const DrawingStyle& style = drawing.styles[path.style];
    if (!style.fill) continue;
    Polygon polygon = polygon_of(drawing.view(path), placed.page_from_path, tolerance);
    // Of one direction, so that paths don't take away from each other.
    polygon = simplified(polygon, style.fill_rule, run);
    for (std::size_t r = 0; r < polygon.ring_count(); ++r) area.add_ring(polygon.ring(r));
  }
  return area;
}

DrawingStyle placed_style(const Drawing& source, const PlacedPath& placed, Drawing& result) {
  DrawingStyle style = source.styles[source.paths[placed.path].style];
  style.opacity *= placed.opacity;
  for (std::optional<Paint>* paint : {&style.fill, &style.stroke}) {
    if (!*paint || !(*paint)->pattern) continue;
    const PaintPattern& pattern = source.patterns[*(*paint)->pattern];
    const auto* gradient = std::get_if<Gradient>(&pattern);
    if (gradient == nullptr || placed.page_from_path == glm::mat3x2(1, 0, 0, 1, 0, 0)) continue;
    Gradient moved = *gradient;
    moved.path_from_gradient = combined(placed.page_from_path, gradient->path_from_gradient);
    const bool is_last = result.patterns.back() == PaintPattern(moved);  // paths of a group often share one
    (*paint)->pattern =
        is_last ? static_cast<std::uint32_t>(result.patterns.size() - 1) : result.add_pattern(std::move(moved));
  }
  return style;
}

void warn_of_unfilled(const Drawing& drawing, const Run& run) {
  const bool strokes = std::any_of(drawing.styles.begin(), drawing.styles.end(),
                                   [](const DrawingStyle& style) { return style.stroke.has_value(); });
  if (strokes) warn(run, "drawing: lines are left out, only fills are taken");
  warn_of_clips(drawing, run);
}

void warn_of_clips(const Drawing& drawing, const Run& run) {
  const bool clips = std::any_of(drawing.groups.begin(), drawing.groups.end(),
                                 [](const DrawingGroup& group) { return group.clip.has_value(); });
  if (clips) warn(run, "drawing: clips are left out");
}

}  // namespace azulejo
