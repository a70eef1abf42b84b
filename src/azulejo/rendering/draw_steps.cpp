#include "azulejo/rendering/draw_steps.h"

#include <array>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostSteps = std::size_t{1} << 24;

static_assert(static_cast<int>(DrawShape::Stroke) == static_cast<int>(PolygonMode::Edges) &&
              static_cast<int>(DrawShape::Points) == static_cast<int>(PolygonMode::Vertices));

/// A group that is walked through.
struct Open {
  std::uint32_t group;
  std::uint32_t place;  ///< of the group's own coordinates
  bool in_clip;
  bool is_clip;            ///< it is another group's clip
  std::size_t next = 0;    ///< item
  std::size_t begin = 0;   ///< its first step
  std::size_t shapes = 0;  ///< painted in it
  bool clipped = false;    ///< its clip was walked through
};

class StepMaker {
 public:
  StepMaker(const Drawing& drawing, const glm::mat3x2& picture_from_page, std::optional<PolygonMode> polygon_mode)
      : drawing_(drawing),
        polygon_mode_(polygon_mode),
        most_(kMostSteps + 4 * (drawing.paths.size() + drawing.groups.size())) {
    made_.places.push_back(picture_from_page);
  }

  DrawSteps make() {
    open_group(0, 0, false, false);
    while (!open_.empty()) {
      Open& here = open_.back();
      const DrawingGroup& group = drawing_.groups[here.group];
      if (here.next == group.items.size()) {
        close_group();
        continue;
      }
      const DrawingItem item = group.items[here.next++];
      if (item.is_group) {
        open_group(item.index, here.place, here.in_clip, false);
      } else {
        here.shapes += add_path(item.index, here);
      }
    }
    return std::move(made_);
  }

 private:
  bool needs_layer(const Open& open) const {
    const DrawingGroup& group = drawing_.groups[open.group];
    return open.is_clip || group.clip || (group.opacity < 1 && !open.in_clip);
  }

  void add(const DrawStep& step) {
    if (made_.steps.size() >= most_) {
      throw Error(Error::Resource, fmt::format("draw: clips within clips make more than {} steps", most_));
    }
    made_.steps.push_back(step);
  }

  void open_group(std::uint32_t group, std::uint32_t place, bool in_clip, bool is_clip) {
    const glm::mat3x2& own = drawing_.groups[group].parent_from_group;
    Open open{group, place, in_clip, is_clip};
    if (own != glm::mat3x2(1, 0, 0, 1, 0, 0)) {
      open.place = static_cast<std::uint32_t>(made_.places.size());
      made_.places.push_back(combined(made_.places[place], own));
    }
    open.begin = made_.steps.size();
    if (needs_layer(open)) add({.kind = DrawStep::Begin});
    open_.push_back(open);
  }

  std::size_t add_path(std::uint32_t path, const Open& here) {
    const DrawingStyle& style = drawing_.styles[drawing_.paths[path].style];
    DrawStep step{.in_clip = here.in_clip, .opacity = style.opacity, .path = path, .place = here.place};
    if (here.in_clip) {
      step.opacity = 1;
      add(step);
      return 1;
    }
    std::size_t count = 0;
    for (const DrawShape shape : {DrawShape::Inside, DrawShape::Stroke, DrawShape::Points}) {
      const std::optional<Paint>& paint = paint_of(style, shape, polygon_mode_);
      if (!paint || paint->color.w * style.opacity <= 0) continue;
      step.shape = shape;
      add(step);
      ++count;
    }
    return count;
  }

  void close_group() {
    const Open closed = open_.back();
    const DrawingGroup& group = drawing_.groups[closed.group];
    const float opacity = closed.in_clip ? 1 : group.opacity;
    if (closed.shapes == 0 || opacity <= 0) {
      made_.steps.resize(closed.begin);
      open_.pop_back();
      if (closed.is_clip) drop_clipped();
      return;
    }
    if (group.clip && !closed.clipped) {
      open_.back().clipped = true;
      return open_group(*group.clip, closed.place, true, true);
    }
    open_.pop_back();
    if (closed.is_clip) return add({.kind = DrawStep::Keep});
    if (needs_layer(closed)) end_layer(closed.begin, opacity, closed.shapes == 1 && !group.clip);
    if (!open_.empty()) open_.back().shapes += closed.shapes;
  }

  /// alone  only one shape is painted in it, which has the opacity as well: the last step ends that
  void end_layer(std::size_t begin, float opacity, bool alone) {
    if (!alone) return add({.kind = DrawStep::End, .opacity = opacity});
    made_.steps.back().opacity *= opacity;
    made_.steps[begin].kind = DrawStep::Nothing;
    if (begin + 2 == made_.steps.size()) {
      made_.steps[begin] = made_.steps.back();
      made_.steps.pop_back();
    }
  }

  /// A clip is empty: nothing is left of what it clips.
  void drop_clipped() {
    Open& clipped = open_.back();
    made_.steps.resize(clipped.begin);
    clipped.shapes = 0;
  }

  const Drawing& drawing_;
  std::optional<PolygonMode> polygon_mode_;
  std::size_t most_;
  DrawSteps made_;
  std::vector<Open> open_;
};

}  // namespace

DrawSteps draw_steps(const Drawing& drawing, const glm::mat3x2& picture_from_page,
                     std::optional<PolygonMode> polygon_mode) {
  return StepMaker(drawing, picture_from_page, polygon_mode).make();
}

const std::optional<Paint>& paint_of(const DrawingStyle& style, DrawShape shape,
                                     std::optional<PolygonMode> polygon_mode) {
  static const std::optional<Paint> nothing;
  const std::array<const std::optional<Paint>*, 3> paints{&style.fill, &style.stroke, &style.points};
  const auto wanted = static_cast<std::size_t>(shape);
  if (!polygon_mode) return *paints[wanted];
  if (static_cast<std::size_t>(*polygon_mode) != wanted) return nothing;
  if (*paints[wanted]) return *paints[wanted];
  for (const std::optional<Paint>* other : paints) {
    if (*other) return *other;
  }
  return nothing;
}

}  // namespace azulejo
