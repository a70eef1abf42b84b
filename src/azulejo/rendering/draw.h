#pragma once

#include <array>
#include <glm/mat3x2.hpp>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/image.h"
#include "azulejo/math/color.h"
#include "azulejo/math/rect.h"
#include "azulejo/math/viewport.h"
#include "azulejo/rendering/coverage_band.h"
#include "azulejo/rendering/polygon_mode.h"

namespace azulejo {

/// What colors are mixed as where they cover each other in part.
enum class DrawLight : std::uint8_t { Encoded, Linear };
constexpr auto enum_names(DrawLight) { return std::array<std::string_view, 2>{"encoded", "linear"}; }

/// How lines are drawn: their exact outlines, or pixels one beside the other.
enum class DrawStrokes : std::uint8_t { Exact, Crisp };
constexpr auto enum_names(DrawStrokes) { return std::array<std::string_view, 2>{"exact", "crisp"}; }

struct DrawOptions {
  std::optional<int> width = {};         ///< px; auto: of the page, or as the height asks
  std::optional<int> height = {};        ///< px; auto: of the page, or as the width asks
  float scale = 1;                       ///< of a picture whose size is the page's
  float dpi = 96;                        ///< pixels an inch, of pages in millimetres
  std::optional<Color> background = {};  ///< auto: none, the picture is transparent
  Antialias antialias = Antialias::Area;
  float tolerance = 0.1F;  ///< px: of curves
  DrawStrokes strokes = DrawStrokes::Exact;
  /// Paints that alone of every path, with its own paint or, where it has none, that of another of the three; auto: all
  /// that the styles say.
  std::optional<PolygonMode> polygon_mode = {};
  DrawLight light = DrawLight::Encoded;
  std::optional<std::array<float, 4>> window = {};    ///< x0, y0, x1, y1: the part of the page to show; auto: all of it
  std::optional<std::array<float, 4>> viewport = {};  ///< x, y, width, height: pixels that show it; auto: all of them
  AspectPolicy aspect = AspectPolicy::Fit;            ///< where the window has another shape than the viewport
};

/// Draws a page of lines and curves.
///
/// Result      u8 RGBA, sRGB, straight alpha. Same bytes for any thread count and instruction set
/// Size        the window's, times dpi / 25.4 for millimetres, times scale, rounded up; width or height alone keep its
///             shape; both, and a viewport, do what `aspect` says
/// Window      in the page's coordinates, y down as everything of a drawing. What is outside of it is cut off at the
///             viewport. A stretched window of another shape than the viewport is warned of
/// Coverage    exact areas, also where outlines overlap or cross within a pixel (coverage_band.h). Of a line, too, but
///             where its parts overlap within a pixel what each covers is added up, to 1 (stroke_path.h); so it is with
///             the marks of points. antialias=none: whole pixels, by their centers; strokes=crisp: lines of whole pixels,
///             one wide (crisp_path.h)
/// Colors      source-over of stored values; light=linear: of linear light, gradients are mixed as stored all the same.
///             f32 until the last step
/// Groups      with opacity or a clip are painted by themselves first; one that paints one thing and has no clip isn't,
///             which is the same. A clip is the union of its paths: where they share a pixel, 1 − (1 − a)(1 − b)
/// Gradients   as SVG 2 has them: without extent the last stop's color is everywhere; where no circle passes, nothing. A
///             matrix without inverse paints nothing
/// Degenerate  what is not finite isn't drawn (flat_path.h). A page without size, if width or height aren't given both, is
///             Error(Argument)
/// Cost        O(points + pixels that are painted), on all threads
/// Throws      Error(Data) for a drawing that `check` refuses; Error(Resource) for pictures beyond run.limits.pixels, and
///             layers within each other that need more than run.limits.memory_bytes
AZULEJO_EXPORT Image draw(const Drawing& drawing, const DrawOptions& options = {}, const Run& run = {});

/// The same over another image, in the viewport only, background and all: width and height are the image's. So several
/// drawings come into one picture. See picture_onto.
AZULEJO_EXPORT Image draw_onto(const Image& under, const Drawing& drawing, const DrawOptions& options = {},
                               const Run& run = {});

/// The picture's size and where the page lies in it.
struct DrawFrame {
  int width = 0;
  int height = 0;
  glm::mat3x2 picture_from_page{1, 0, 0, 1, 0, 0};
  Rect viewport;  ///< the part of the picture that is drawn
};
/// Throws  Error(Argument) for a page without size
AZULEJO_EXPORT DrawFrame draw_frame(const Drawing& drawing, const DrawOptions& options);

}  // namespace azulejo
