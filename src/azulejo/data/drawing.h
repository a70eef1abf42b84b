#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/data/array.h"

namespace azulejo {

/// A step of a path, and how many points it takes.
enum class PathCommand : std::uint8_t {
  Move,       ///< 1: begins a subpath
  Line,       ///< 1
  Quadratic,  ///< 2: a control point and the end
  Cubic,      ///< 3: two control points and the end
  Close,      ///< 0: a line to where the subpath began; what follows begins there too
};
AZULEJO_EXPORT std::size_t points_of(PathCommand command);

/// An outline to put into a Drawing.
struct AZULEJO_EXPORT Path {
  std::vector<PathCommand> commands;
  std::vector<glm::vec2> points;

  Path& move_to(const glm::vec2& point);
  Path& line_to(const glm::vec2& point);
  Path& quadratic_to(const glm::vec2& control, const glm::vec2& point);
  Path& cubic_to(const glm::vec2& first_control, const glm::vec2& second_control, const glm::vec2& point);
  Path& close();
};

/// The same, where it lies in a Drawing.
struct PathView {
  std::span<const PathCommand> commands;
  std::span<const glm::vec2> points;
};

enum class FillRule : std::uint8_t { NonZero, EvenOdd };
enum class LineCap : std::uint8_t { Butt, Round, Square };
enum class LineJoin : std::uint8_t { Miter, Round, Bevel };
enum class PointShape : std::uint8_t { Circle, Square, Diamond, Triangle, Plus, Cross };

constexpr auto enum_names(FillRule) { return std::array<std::string_view, 2>{"nonzero", "evenodd"}; }
constexpr auto enum_names(LineCap) { return std::array<std::string_view, 3>{"butt", "round", "square"}; }
constexpr auto enum_names(LineJoin) { return std::array<std::string_view, 3>{"miter", "round", "bevel"}; }
constexpr auto enum_names(PointShape) {
  return std::array<std::string_view, 6>{"circle", "square", "diamond", "triangle", "plus", "cross"};
}

/// What a gradient shows before its first and behind its last stop.
enum class GradientSpread : std::uint8_t { Pad, Reflect, Repeat };

struct GradientStop {
  float offset = 0;  ///< 0–1
  glm::vec4 color{0, 0, 0, 1};
  friend bool operator==(const GradientStop&, const GradientStop&) = default;
};

/// Colors that change along a line, or from one circle to another. Between stops stored values are mixed, not
/// premultiplied, as SVG does.
struct Gradient {
  bool radial = false;
  glm::vec2 from{0, 0};  ///< where offset 0 is; of a radial one the center of the circle of offset 0, the focus
  glm::vec2 to{1, 0};    ///< where offset 1 is; of a radial one the center of the circle of offset 1
  float from_radius = 0;
  float to_radius = 1;
  GradientSpread spread = GradientSpread::Pad;
  glm::mat3x2 path_from_gradient{1, 0, 0, 1, 0, 0};
  std::vector<GradientStop> stops;  ///< offsets never fall; none: nothing is painted
  friend bool operator==(const Gradient&, const Gradient&) = default;
};

/// Parallel lines in the paint's color, one through the path's origin; between them nothing is painted.
struct Hatch {
  float angle = 0;    ///< radians, of the lines to the x axis, counter-clockwise as seen
  float spacing = 8;  ///< from center to center, in the path's units
  float width = 1;
  bool crossed = false;  ///< and the same lines turned by a quarter
  friend bool operator==(const Hatch&, const Hatch&) = default;
};

/// A mask of 32 × 32 pixels of the picture, which repeats from its upper left corner: the paint's color where a bit is 1.
struct Stipple {
  std::array<std::uint32_t, 32> rows{};  ///< from the top; the highest bit is on the left
  friend bool operator==(const Stipple&, const Stipple&) = default;
};

using PaintPattern = std::variant<Gradient, Hatch, Stipple>;

/// A color, or one of the drawing's patterns.
struct Paint {
  glm::vec4 color{0, 0, 0, 1};           ///< of a gradient only the alpha counts: its colors are multiplied by it
  std::optional<std::uint32_t> pattern;  ///< index

  Paint() = default;
  Paint(const glm::vec4& plain) : color(plain) {}
  Paint(const glm::vec4& tint, std::uint32_t index) : color(tint), pattern(index) {}
  friend bool operator==(const Paint&, const Paint&) = default;
};

/// How a path is painted: first its inside, then its line, then its points. Colors are sRGB, straight alpha, 0–1;
/// lengths are the path's own units.
struct DrawingStyle {
  std::optional<Paint> fill = Paint();
  FillRule fill_rule = FillRule::NonZero;
  std::optional<Paint> stroke;
  float stroke_width = 1;
  LineCap cap = LineCap::Butt;
  LineJoin join = LineJoin::Miter;
  float miter_limit = 4;        ///< a miter longer than this times the width becomes a bevel
  std::vector<float> dash;      ///< lengths of dashes and gaps by turns; empty: solid
  float dash_offset = 0;        ///< where in them the line begins
  bool fixed_stroke = false;    ///< width and dashes are in pixels of the picture, however the path is transformed
  std::optional<Paint> points;  ///< a mark at each point where a segment begins or ends
  float point_size = 4;         ///< width of the mark, in pixels of the picture
  PointShape point_shape = PointShape::Circle;
  float opacity = 1;  ///< of all three, each alone
  friend bool operator==(const DrawingStyle&, const DrawingStyle&) = default;
};

/// The dashes of a 16-bit line stipple, which begins with its lowest bit; each bit is `factor` units long.
struct LineStipple {
  std::vector<float> dash;
  float dash_offset = 0;
};
/// factor  1–256. A pattern of zeros gives one dash of no length and a gap, of ones no dashes: a solid line.
AZULEJO_EXPORT LineStipple line_stipple(std::uint16_t pattern, int factor);

/// What the outlines of a path spell.
struct DrawingText {
  std::string text = {};    ///< UTF-8, one line
  std::string family = {};  ///< of the font: "DejaVu Sans"
  bool bold = false;
  float size = 12;         ///< of the em square, in the path's units
  glm::vec2 origin{0, 0};  ///< where its baseline begins; it runs along x
  friend bool operator==(const DrawingText&, const DrawingText&) = default;
};

/// A path as a Drawing keeps it: ranges of its commands and points.
struct DrawingPath {
  std::size_t first_command = 0;
  std::size_t command_count = 0;
  std::size_t first_point = 0;
  std::size_t point_count = 0;
  std::uint32_t style = 0;            ///< index
  std::optional<std::uint32_t> text;  ///< index; none: it is no text
  std::string id;                     ///< what it came from; empty: unknown
};

/// What a group shows: one of the drawing's paths or groups.
struct DrawingItem {
  bool is_group = false;
  std::uint32_t index = 0;
  friend bool operator==(const DrawingItem&, const DrawingItem&) = default;
};

/// Items that are moved, clipped and faded together.
struct DrawingGroup {
  glm::mat3x2 parent_from_group{1, 0, 0, 1, 0, 0};  ///< columns: x axis, y axis, origin
  float opacity = 1;                                ///< of all that it shows, painted first
  /// A group without parent, in this group's own coordinates: only what is inside the union of its paths, each filled
  /// by its own rule, is shown. Styles count for nothing there; groups below it may have clips, too. None: everything.
  std::optional<std::uint32_t> clip;
  std::string id;
  std::vector<DrawingItem> items;  ///< the first is painted first
};

enum class DrawingUnit : std::uint8_t { Pixel, Millimetre };

/// A picture of lines and curves: y points down, (0, 0) is the upper left corner. Moved, not copied: `clone()` says a
/// copy aloud. Group 0 is the whole and is always there.
///
/// Invariants (`check` of a reader's result): paths begin with Move and have the points that their commands take; items
/// styles, patterns, clips and texts are there; every path and group has one parent at most, group 0 and clips have none,
/// and no clip is clipped by itself; numbers are in range. Coordinates may be any floats, NaN too.
struct AZULEJO_EXPORT Drawing {
  float width = 0;  ///< of the page
  float height = 0;
  DrawingUnit unit = DrawingUnit::Pixel;
  Array<PathCommand> commands;  ///< of all paths
  Array<glm::vec2> points;
  std::vector<DrawingPath> paths;
  std::vector<DrawingStyle> styles;
  std::vector<PaintPattern> patterns;
  std::vector<DrawingText> texts;
  std::vector<DrawingGroup> groups{1};

  Drawing() = default;
  Drawing(Drawing&&) noexcept = default;
  Drawing& operator=(Drawing&&) noexcept = default;
  ~Drawing() = default;
  Drawing clone() const { return Drawing(*this); }

  /// Index of the style, which is looked for among the last few.
  std::uint32_t add_style(const DrawingStyle& style);
  /// Index of the path, the topmost of its group.
  std::uint32_t add_path(const Path& path, std::uint32_t style, std::string id = {}, std::uint32_t group = 0);
  /// Index of an empty group, the topmost of its parent.
  std::uint32_t add_group(const glm::mat3x2& parent_from_group, float opacity = 1, std::uint32_t parent = 0);
  /// Index of an empty group that nothing shows: the clip of others.
  std::uint32_t add_clip();
  /// Index of the pattern.
  std::uint32_t add_pattern(PaintPattern pattern);

  PathView view(const DrawingPath& path) const {
    return {{commands.data() + path.first_command, path.command_count},
            {points.data() + path.first_point, path.point_count}};
  }

  /// Throws Error(Data), beginning with `what`, where an invariant doesn't hold. Cost O(commands + items).
  void check(std::string_view what) const;

 private:
  Drawing(const Drawing&) = default;
  Drawing& operator=(const Drawing&) = default;
};

/// A path as `walk` comes to it.
struct PlacedPath {
  std::uint32_t path = 0;
  std::uint32_t group = 0;
  glm::mat3x2 page_from_path{1, 0, 0, 1, 0, 0};
  float opacity = 1;  ///< of all groups around it, multiplied: the same as theirs where nothing in them overlaps
};

/// All paths below group 0 in the order of painting; clips are left out. Any depth. Cost O(items). Throws Error(Data) on a cycle.
AZULEJO_EXPORT std::vector<PlacedPath> walk(const Drawing& drawing);

/// An axis-parallel rectangle; empty where a lower exceeds the upper.
struct Box2 {
  glm::vec2 lower{3.4e38F, 3.4e38F};
  glm::vec2 upper{-3.4e38F, -3.4e38F};
  bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y); }
  friend bool operator==(const Box2&, const Box2&) = default;
};

/// Of the curves themselves, not of their control points, and without the width of lines. Segments with a coordinate
/// that is not finite are left out, and so is a Move that nothing follows.
AZULEJO_EXPORT Box2 bounds(const PathView& path, const glm::mat3x2& page_from_path = {1, 0, 0, 1, 0, 0});
AZULEJO_EXPORT Box2 bounds(const Drawing& drawing);

AZULEJO_EXPORT glm::vec2 transformed(const glm::mat3x2& matrix, const glm::vec2& point);
/// First `inner`, then `outer`.
AZULEJO_EXPORT glm::mat3x2 combined(const glm::mat3x2& outer, const glm::mat3x2& inner);

AZULEJO_EXPORT const char* to_string(DrawingUnit unit);  ///< "px", "mm"

}  // namespace azulejo
