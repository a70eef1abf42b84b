#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/math/rect.h"

namespace azulejo {

/// A rectangle of a plane: the clipping window, of the world, or the viewport that shows it, in pixels.
struct Window {
  double x0 = -1;
  double y0 = -1;
  double x1 = 1;  ///< more than x0
  double y1 = 1;  ///< more than y0

  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  glm::dvec2 center() const { return {x0 + 0.5 * width(), y0 + 0.5 * height()}; }
  friend bool operator==(const Window&, const Window&) = default;
};

/// The plane's rectangle that a rectangle of pixels is.
constexpr Window window_of(const Rect& pixels) {
  return {static_cast<double>(pixels.x), static_cast<double>(pixels.y), static_cast<double>(pixels.x) + pixels.width,
          static_cast<double>(pixels.y) + pixels.height};
}

/// What becomes of a window whose shape is not the viewport's.
enum class AspectPolicy : std::uint8_t {
  Fit,      ///< all of it is seen, in the middle of the viewport
  Fill,     ///< the viewport is full: of the window the middle is seen
  Stretch,  ///< both are full: lengths along x and y have scales of their own
};
constexpr std::array<std::string_view, 3> enum_names(AspectPolicy) { return {"fit", "fill", "stretch"}; }

/// The window-to-viewport transformation: points keep their distance ratios to the edges,
///
///   xv = sx · xw + tx,   sx = (xv_max − xv_min) ÷ (xw_max − xw_min),
///                        tx = (xw_max · xv_min − xw_min · xv_max) ÷ (xw_max − xw_min),  and so for y.
///
/// Moving the window pans, sizing it zooms; moving and sizing the viewport moves and sizes the picture. Both keep the
/// sense of y: where the window's y points up, the viewport's does too, and `raster_from_viewport` is the last step.
/// Matrices act on column vectors (x, y, 1).
///
/// Throws  Error(Argument), beginning with `window` or `viewport`, for one without area, with numbers that are not
///         finite, or so small beside the other that the scale leaves the range of doubles
/// Source  Hughes et al., Computer Graphics: Principles and Practice, 3rd ed., 3.3
AZULEJO_EXPORT glm::dmat3 viewport_from_window(const Window& window, const Window& viewport);

/// The same in two steps, viewport_from_window = translation · scaling: first the window is scaled to the viewport's
/// size, its corner (x0, y0) fixed; then that corner is moved to the viewport's.
AZULEJO_EXPORT glm::dmat3 scaling_to_viewport(const Window& window, const Window& viewport);
AZULEJO_EXPORT glm::dmat3 translation_to_viewport(const Window& window, const Window& viewport);

/// The inverse, for picking: which point of the world is seen at a point of the viewport.
AZULEJO_EXPORT glm::dmat3 window_from_viewport(const Window& window, const Window& viewport);

/// The last step, from y up to rows that count down from the top of a picture of that height: y' = height − y. Its own
/// inverse.
AZULEJO_EXPORT glm::dmat3 raster_from_viewport(double picture_height);
/// The same of a rectangle: a viewport given in rows from the top becomes one in y up, and back.
AZULEJO_EXPORT Window flipped(const Window& viewport, double picture_height);

AZULEJO_EXPORT glm::dvec2 transformed(const glm::dmat3& matrix, const glm::dvec2& point);

/// sx ÷ sy: how much wider than high a square of the window would be drawn if both were filled; 1: their shapes agree.
AZULEJO_EXPORT double aspect_mismatch(const Window& window, const Window& viewport);

/// The part of a window that is seen, and where.
struct FittedWindow {
  Window window;
  Window viewport;
  friend bool operator==(const FittedWindow&, const FittedWindow&) = default;
};
AZULEJO_EXPORT FittedWindow fitted(const Window& window, const Window& viewport, AspectPolicy policy);

struct FittedPixels {
  Window window;
  Rect viewport;
  friend bool operator==(const FittedPixels&, const FittedPixels&) = default;
};
/// In whole pixels: where Fit leaves a part of one, the window grows by it, so that x and y keep one scale.
AZULEJO_EXPORT FittedPixels fitted(const Window& window, const Rect& viewport, AspectPolicy policy);

}  // namespace azulejo
