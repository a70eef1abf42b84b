#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "azulejo/rendering/draw.h"
#include "azulejo/rendering/draw_paint.h"

namespace azulejo {

/// What of a path is painted.
enum class DrawShape : std::uint8_t { Inside, Stroke, Points };

/// A step of painting, in order.
struct DrawStep {
  enum Kind : std::uint8_t {
    Shape,   ///< covers the topmost layer
    Begin,   ///< a layer on top, empty
    Keep,    ///< the topmost layer is a mask: it ends, the one below keeps what its alpha lets
    End,     ///< the topmost layer is painted over the one below
    Nothing  ///< was taken out
  };
  Kind kind = Shape;
  DrawShape shape = DrawShape::Inside;
  bool in_clip = false;     ///< Shape: opaque, whatever the style says
  float opacity = 1;        ///< of a Shape or End
  std::uint32_t path = 0;   ///< of a Shape
  std::uint32_t place = 0;  ///< of a Shape: index of its matrix
};

struct DrawSteps {
  std::vector<DrawStep> steps;
  std::vector<glm::mat3x2> places;  ///< picture_from_path
};

/// Turns groups, clips and styles into steps. Layers are made only where they matter, and none that stays empty.
///
/// Throws  Error(Resource) if clips within clips make more than 2²⁴ steps and four times what the drawing has
DrawSteps draw_steps(const Drawing& drawing, const glm::mat3x2& picture_from_page,
                     std::optional<PolygonMode> polygon_mode);

/// What a style paints a shape with; nothing: it doesn't.
const std::optional<Paint>& paint_of(const DrawingStyle& style, DrawShape shape,
                                     std::optional<PolygonMode> polygon_mode);

}  // namespace azulejo
