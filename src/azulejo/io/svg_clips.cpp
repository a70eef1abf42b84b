#include "azulejo/io/svg_clips.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "azulejo/io/svg_text.h"

namespace azulejo {

pugi::xml_node SvgClips::find(std::string_view id) {
  const pugi::xml_node node = document_.find(id);
  if (document_.element_of(node) == SvgElement::ClipPath) return node;
  notes_.wrong("a clip-path names what isn't there");
  return {};
}

bool SvgClips::is_measured_by_box(const pugi::xml_node& clip) {
  return without_blanks(clip.attribute("clipPathUnits").value()) == "objectBoundingBox";
}

/// True in the content of this clip, however deep.
bool SvgClips::is_within(const pugi::xml_node& node) const {
  std::optional<std::size_t> each = read_ > 0 ? std::optional(read_ - 1) : std::nullopt;
  for (; each; each = clips_[*each].within) {
    if (clips_[*each].node == node) return true;
  }
  return false;
}

void SvgClips::clip(std::uint32_t group, const pugi::xml_node& node, const SvgViewport& viewport, const Box2& box) {
  const bool measured = is_measured_by_box(node);
  if (is_within(node)) {
    notes_.wrong("a clipPath clips itself");
    return;
  }
  if (!measured) {
    const auto known = shared_.find(node.internal_object());
    if (known != shared_.end()) {
      drawing_.groups[group].clip = known->second;
      return;
    }
  }
  glm::dmat3x2 matrix = parse_transform(node.attribute("transform").value()).value_or(glm::dmat3x2(1, 0, 0, 1, 0, 0));
  if (measured) {
    const glm::dvec2 lower = box.empty() ? glm::dvec2(0) : glm::dvec2(box.lower);
    const glm::dvec2 size = box.empty() ? glm::dvec2(0) : glm::dvec2(box.upper) - lower;
    matrix = combined(glm::dmat3x2(size.x, 0, 0, size.y, lower.x, lower.y), matrix);
  }
  budget_.add_bytes(sizeof(DrawingGroup) + sizeof(Clip));
  const std::uint32_t made = drawing_.add_clip();
  drawing_.groups[made].parent_from_group = to_floats(matrix);
  drawing_.groups[made].id = node.attribute("id").value();
  drawing_.groups[group].clip = made;
  const auto within = read_ > 0 ? std::optional(read_ - 1) : std::nullopt;
  clips_.push_back({made, node, measured ? SvgViewport{1, 1} : viewport, measured, within});
  if (!measured) shared_[node.internal_object()] = made;
}

void SvgClips::clip_to(std::uint32_t group, const Path& rectangle, std::uint32_t style) {
  budget_.add_bytes(sizeof(DrawingGroup) + sizeof(DrawingPath) + rectangle.points.size() * sizeof(glm::vec2));
  const std::uint32_t made = drawing_.add_clip();
  drawing_.add_path(rectangle, style, {}, made);
  drawing_.groups[group].clip = made;
}

const SvgClips::Clip* SvgClips::next() { return read_ < clips_.size() ? &clips_[read_++] : nullptr; }

Box2 SvgClips::box_of(std::uint32_t group) {
  Box2 box;
  std::vector<std::pair<DrawingItem, glm::mat3x2>> waiting;
  const auto enter = [&](const DrawingGroup& entered, const glm::mat3x2& matrix) {
    budget_.add_looks(entered.items.size());
    for (const DrawingItem& item : entered.items) waiting.emplace_back(item, matrix);
  };
  enter(drawing_.groups[group], {1, 0, 0, 1, 0, 0});
  while (!waiting.empty()) {
    const auto [item, matrix] = waiting.back();
    waiting.pop_back();
    if (item.is_group) {
      const DrawingGroup& inner = drawing_.groups[item.index];
      enter(inner, combined(matrix, inner.parent_from_group));
      continue;
    }
    const DrawingPath& path = drawing_.paths[item.index];
    budget_.add_looks(path.command_count / 16);
    const Box2 each = bounds(drawing_.view(path), matrix);
    if (each.empty()) continue;
    box.lower = {std::min(box.lower.x, each.lower.x), std::min(box.lower.y, each.lower.y)};
    box.upper = {std::max(box.upper.x, each.upper.x), std::max(box.upper.y, each.upper.y)};
  }
  return box;
}

void SvgClips::break_cycles() {
  struct Visit {
    std::uint32_t group = 0;
    std::uint32_t from = 0;  ///< which group names it as a clip, or shows it
    bool entered = false;
  };
  enum State : std::uint8_t { New, Entered, Done };
  std::vector<State> states(drawing_.groups.size(), New);
  std::vector<Visit> visits;
  for (std::uint32_t g = 0; g < drawing_.groups.size(); ++g) {
    if (states[g] == New) visits.push_back({g, g, false});
    while (!visits.empty()) {
      Visit& visit = visits.back();
      if (visit.entered || states[visit.group] == Done) {
        states[visit.group] = Done;
        visits.pop_back();
        continue;
      }
      // A group has one parent: only a clip leads back.
      if (states[visit.group] == Entered) {
        drawing_.groups[visit.from].clip.reset();
        notes_.wrong("a clipPath clips itself");
        visits.pop_back();
        continue;
      }
      visit.entered = true;
      const std::uint32_t group = visit.group;
      states[group] = Entered;
      const DrawingGroup& entering = drawing_.groups[group];
      if (entering.clip) visits.push_back({*entering.clip, group, false});
      for (const DrawingItem& item : entering.items) {
        if (item.is_group) visits.push_back({item.index, group, false});
      }
    }
  }
}

}  // namespace azulejo
