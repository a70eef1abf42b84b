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
}

void check_style(const DrawingStyle& style, std::size_t index, std::string_view what) {
  const auto is_color = [](const std::optional<glm::vec4>& color) {
    return !color || (is_share(color->x) && is_share(color->y) && is_share(color->z) && is_share(color->w));
  };
  if (!is_color(style.fill) || !is_color(style.stroke) || !is_share(style.opacity)) {
    throw broken(what, fmt::format("style {} has a color or opacity outside 0 to 1", index));
  }
  if (!is_length(style.stroke_width) || !is_length(style.miter_limit) || !std::isfinite(style.dash_offset) ||
      !std::all_of(style.dash.begin(), style.dash.end(), is_length)) {
    throw broken(what, fmt::format("style {} has a length that is negative or not finite", index));
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
}

}  // namespace

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
  for (std::size_t s = 0; s < styles.size(); ++s) check_style(styles[s], s, what);
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
    for (auto item = group.items.rbegin(); item != group.items.rend(); ++item) waiting.push_back({*item, here});
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
