#include "azulejo/data/drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Error broken(std::string_view what, const std::string& why) {
  return Error(Error::Data, fmt::format("{}: {}", what, why));
}

bool is_share(float value) { return value >= 0 && value <= 1; }
bool is_length(float value) { return value >= 0 && std::isfinite(value); }

void check_path(const Drawing& drawing, std::size_t index, std::string_view what) {
  const DrawingPath& path = drawing.paths[index];
  const auto within = [](std::size_t first, std::size_t count, std::size_t size) {
    return first <= size && count <= size - first;
  };
  if (!within(path.first_command, path.command_count, drawing.commands.size()) ||
      !within(path.first_point, path.point_count, drawing.points.size())) {
    throw broken(what, fmt::format("path {} reaches beyond the commands or points", index));
  }
  const PathView view = drawing.view(path);
  std::size_t wanted = 0;
  for (const PathCommand each : view.commands) wanted += points_of(each);
  if (wanted != view.points.size()) {
    throw broken(what, fmt::format("path {} has {} points, its commands take {}", index, view.points.size(), wanted));
  }
  if (!view.commands.empty() && view.commands.front() != PathCommand::Move) {
    throw broken(what, fmt::format("path {} doesn't begin with a move", index));
  }
  if (path.style >= drawing.styles.size()) {
    throw broken(what, fmt::format("path {} names style {}, of {}", index, path.style, drawing.styles.size()));
  }
  if (path.text && *path.text >= drawing.texts.size()) {
    throw broken(what, fmt::format("path {} names text {}, of {}", index, *path.text, drawing.texts.size()));
  }
}

bool is_color(const glm::vec4& color) {
  return is_share(color.x) && is_share(color.y) && is_share(color.z) && is_share(color.w);
}

void check_style(const Drawing& drawing, std::size_t index, std::string_view what) {
  const DrawingStyle& style = drawing.styles[index];
  for (const std::optional<Paint>* paint : {&style.fill, &style.stroke, &style.points}) {
    if (!*paint) continue;
    if (!is_color((*paint)->color)) throw broken(what, fmt::format("style {} has a color outside 0 to 1", index));
    if ((*paint)->pattern.value_or(0) >= drawing.patterns.size() && (*paint)->pattern) {
      throw broken(what,
                   fmt::format("style {} names pattern {}, of {}", index, *(*paint)->pattern, drawing.patterns.size()));
    }
  }
  if (!is_share(style.opacity)) throw broken(what, fmt::format("style {} has an opacity outside 0 to 1", index));
  if (!is_length(style.stroke_width) || !is_length(style.miter_limit) || !is_length(style.point_size) ||
      !std::isfinite(style.dash_offset) || !std::all_of(style.dash.begin(), style.dash.end(), is_length)) {
    throw broken(what, fmt::format("style {} has a length that is negative or not finite", index));
  }
}

bool is_finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

bool is_sound(const Gradient& gradient) {
  float before = 0;
  for (const GradientStop& stop : gradient.stops) {
    if (!is_share(stop.offset) || stop.offset < before || !is_color(stop.color)) return false;
    before = stop.offset;
  }
  return is_finite(gradient.from) && is_finite(gradient.to) && is_length(gradient.from_radius) &&
         is_length(gradient.to_radius);
}
bool is_sound(const Hatch& hatch) {
  return std::isfinite(hatch.angle) && is_length(hatch.spacing) && hatch.spacing > 0 && is_length(hatch.width);
}
bool is_sound(const Stipple&) { return true; }

/// Clips have no parent, and what they clip is not in them.
void check_clips(const Drawing& drawing, const std::vector<std::uint8_t>& has_parent, std::string_view what) {
  const std::size_t count = drawing.groups.size();
  for (std::size_t g = 0; g < count; ++g) {
    const std::optional<std::uint32_t> clip = drawing.groups[g].clip;
    if (!clip) continue;
    if (*clip >= count) throw broken(what, fmt::format("group {} names clip {}, of {} groups", g, *clip, count));
    if (*clip == 0 || has_parent[*clip] != 0) throw broken(what, fmt::format("clip {} is shown by a group", *clip));
  }
  // A tree waits for the trees of its clips; those that wait for each other are never done.
  std::vector<std::uint8_t> state(count, 0);  // 1: entered, 2: done
  std::vector<std::pair<std::uint32_t, bool>> waiting;
  for (std::uint32_t g = 0; g < count; ++g) {
    if (drawing.groups[g].clip) waiting.emplace_back(*drawing.groups[g].clip, false);
  }
  while (!waiting.empty()) {
    auto& [group, entered] = waiting.back();
    if (entered || state[group] == 2) {
      state[group] = 2;
      waiting.pop_back();
      continue;
    }
    if (state[group] == 1) throw broken(what, fmt::format("group {} is clipped by itself", group));
    state[group] = 1;
    entered = true;
    const DrawingGroup& entering = drawing.groups[group];
    if (entering.clip) waiting.emplace_back(*entering.clip, false);
    for (const DrawingItem& item : entering.items) {
      if (item.is_group) waiting.emplace_back(item.index, false);
    }
  }
}

void check_groups(const Drawing& drawing, std::string_view what) {
  if (drawing.groups.empty()) throw broken(what, "it has no group");
  std::vector<std::uint8_t> path_used(drawing.paths.size(), 0);
  std::vector<std::uint8_t> group_used(drawing.groups.size(), 0);
  group_used[0] = 1;
  for (std::size_t g = 0; g < drawing.groups.size(); ++g) {
    if (!is_share(drawing.groups[g].opacity)) throw broken(what, fmt::format("group {} has no opacity in 0 to 1", g));
    for (const DrawingItem& item : drawing.groups[g].items) {
      std::vector<std::uint8_t>& used = item.is_group ? group_used : path_used;
      const char* const kind = item.is_group ? "group" : "path";
      if (item.index >= used.size()) {
        throw broken(what, fmt::format("group {} names {} {}, of {}", g, kind, item.index, used.size()));
      }
      if (std::exchange(used[item.index], std::uint8_t{1}) != 0) {
        throw broken(what, fmt::format("{} {} has two parents or is its own ancestor", kind, item.index));
      }
    }
  }
  group_used[0] = 0;
  check_clips(drawing, group_used, what);
}

}  // namespace

LineStipple line_stipple(std::uint16_t pattern, int factor) {
  const auto unit = static_cast<float>(factor);
  if (pattern == 0) return {{0, 16 * unit}, 0};
  if (pattern == 0xFFFF) return {};
  // Dashes begin with one: with the first bit behind a gap.
  const auto is_set = [&](int bit) { return (pattern >> (bit & 15) & 1) != 0; };
  int first = 0;
  while (!is_set(first) || is_set(first + 15)) ++first;
  LineStipple stipple;
  stipple.dash_offset = static_cast<float>((16 - first) % 16) * unit;
  for (int bit = first; bit < first + 16; ++bit) {
    const bool turns = bit == first || is_set(bit) != is_set(bit - 1);
    if (turns) stipple.dash.push_back(0);
    stipple.dash.back() += unit;
  }
  return stipple;
}

std::size_t points_of(PathCommand command) {
  switch (command) {
    case PathCommand::Move:
    case PathCommand::Line: return 1;
    case PathCommand::Quadratic: return 2;
    case PathCommand::Cubic: return 3;
    case PathCommand::Close: return 0;
  }
  return 0;
}

Path& Path::move_to(const glm::vec2& point) {
  commands.push_back(PathCommand::Move);
  points.push_back(point);
  return *this;
}

Path& Path::line_to(const glm::vec2& point) {
  commands.push_back(PathCommand::Line);
  points.push_back(point);
  return *this;
}

Path& Path::quadratic_to(const glm::vec2& control, const glm::vec2& point) {
  commands.push_back(PathCommand::Quadratic);
  points.insert(points.end(), {control, point});
  return *this;
}

Path& Path::cubic_to(const glm::vec2& first_control, const glm::vec2& second_control, const glm::vec2& point) {
  commands.push_back(PathCommand::Cubic);
  points.insert(points.end(), {first_control, second_control, point});
  return *this;
}

Path& Path::close() {
  commands.push_back(PathCommand::Close);
  return *this;
}

std::uint32_t Drawing::add_style(const DrawingStyle& style) {
  constexpr std::size_t kLookedAt = 8;
  const std::size_t first = styles.size() > kLookedAt ? styles.size() - kLookedAt : 0;
  for (std::size_t i = styles.size(); i-- > first;) {
    if (styles[i] == style) return static_cast<std::uint32_t>(i);
  }
  styles.push_back(style);
  return static_cast<std::uint32_t>(styles.size() - 1);
}

std::uint32_t Drawing::add_path(const Path& path, std::uint32_t style, std::string id, std::uint32_t group) {
  DrawingPath added;
  added.first_command = commands.size();
  added.command_count = path.commands.size();
  added.first_point = points.size();
  added.point_count = path.points.size();
  added.style = style;
  added.id = std::move(id);
  commands.insert(commands.end(), path.commands.begin(), path.commands.end());
  points.insert(points.end(), path.points.begin(), path.points.end());
  const auto index = static_cast<std::uint32_t>(paths.size());
  paths.push_back(std::move(added));
  groups[group].items.push_back({false, index});
  return index;
}

std::uint32_t Drawing::add_clip() {
  groups.emplace_back();
  return static_cast<std::uint32_t>(groups.size() - 1);
}

std::uint32_t Drawing::add_pattern(PaintPattern pattern) {
  patterns.push_back(std::move(pattern));
  return static_cast<std::uint32_t>(patterns.size() - 1);
}

std::uint32_t Drawing::add_group(const glm::mat3x2& parent_from_group, float opacity, std::uint32_t parent) {
  const auto index = static_cast<std::uint32_t>(groups.size());
  DrawingGroup added;
  added.parent_from_group = parent_from_group;
  added.opacity = opacity;
  groups.push_back(std::move(added));
  groups[parent].items.push_back({true, index});
  return index;
}

void Drawing::check(std::string_view what) const {
  if (!is_length(width) || !is_length(height)) throw broken(what, fmt::format("its size is {} x {}", width, height));
  for (std::size_t s = 0; s < styles.size(); ++s) check_style(*this, s, what);
  for (std::size_t p = 0; p < patterns.size(); ++p) {
    if (!std::visit([](const auto& pattern) { return is_sound(pattern); }, patterns[p])) {
      throw broken(what, fmt::format("pattern {} has a number out of its range", p));
    }
  }
  for (std::size_t t = 0; t < texts.size(); ++t) {
    if (!is_length(texts[t].size) || !is_finite(texts[t].origin)) {
      throw broken(what, fmt::format("text {} has a size or place that is not finite", t));
    }
  }
  for (std::size_t p = 0; p < paths.size(); ++p) check_path(*this, p, what);
  // A group has one parent at most, and the whole has none: what is reached from there has no cycle.
  check_groups(*this, what);
}

std::vector<PlacedPath> walk(const Drawing& drawing) {
  struct Waiting {
    DrawingItem item;
    PlacedPath parent;  ///< its group and matrix
  };
  std::vector<PlacedPath> placed;
  std::vector<Waiting> waiting{{{true, 0}, {}}};
  std::size_t seen = 0;
  while (!waiting.empty()) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    if (seen++ > drawing.paths.size() + drawing.groups.size()) {
      throw Error(Error::Data, "drawing: its groups form a cycle");
    }
    PlacedPath here = next.parent;
    if (!next.item.is_group) {
      here.path = next.item.index;
      placed.push_back(here);
      continue;
    }
    const DrawingGroup& group = drawing.groups[next.item.index];
    here.group = next.item.index;
    here.page_from_path = combined(here.page_from_path, group.parent_from_group);
    here.opacity *= group.opacity;
    for (std::size_t i = group.items.size(); i-- > 0;) waiting.push_back({group.items[i], here});
  }
  return placed;
}

glm::vec2 transformed(const glm::mat3x2& matrix, const glm::vec2& point) {
  return matrix[0] * point.x + matrix[1] * point.y + matrix[2];
}

glm::mat3x2 combined(const glm::mat3x2& outer, const glm::mat3x2& inner) {
  const auto turned = [&](const glm::vec2& v) { return outer[0] * v.x + outer[1] * v.y; };
  return {turned(inner[0]), turned(inner[1]), transformed(outer, inner[2])};
}

const char* to_string(DrawingUnit unit) { return unit == DrawingUnit::Millimetre ? "mm" : "px"; }

}  // namespace azulejo
