#include "azulejo/charting/contour_labels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include <fmt/format.h>

#include "azulejo/charting/turn.h"

namespace azulejo {
namespace {

constexpr float kSmaller = 0.85F;  // than the labels of ticks

/// A polyline by its length.
class Measured {
 public:
  explicit Measured(const std::vector<glm::vec2>& points) : points_(points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      lengths_.push_back(lengths_.back() + glm::distance(points[i - 1], points[i]));
    }
  }
  float length() const { return lengths_.back(); }
  glm::vec2 at(float length) const {
    const auto next = std::upper_bound(lengths_.begin(), lengths_.end(), length);
    if (next == lengths_.end()) return points_.back();
    const auto i = static_cast<std::size_t>(next - lengths_.begin());
    const float share = (length - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]);
    return points_[i - 1] + (points_[i] - points_[i - 1]) * share;
  }

 private:
  const std::vector<glm::vec2>& points_;
  std::vector<float> lengths_{0};
};

}  // namespace

bool ContourLabels::is_free(const glm::vec2& place, float radius) const {
  const Box2& area = plot_.area;
  if (place.x < area.lower.x + radius || place.x > area.upper.x - radius || place.y < area.lower.y + radius ||
      place.y > area.upper.y - radius) {
    return false;
  }
  return std::none_of(labels_.begin(), labels_.end(),
                      [&](const Label& label) { return glm::distance(label.place, place) < label.radius + radius; });
}

void ContourLabels::add(const Path& path, float level) {
  const std::string text = fmt::format("{:.6g}", level);
  std::vector<glm::vec2> line;
  std::size_t point = 0;
  for (const PathCommand command : path.commands) {
    if (command == PathCommand::Move) {
      add_line(line, text);
      line.clear();
    }
    if (command == PathCommand::Close) {
      line.push_back(line.front());
    } else {
      line.push_back(path.points[point++]);
    }
  }
  add_line(line, text);
}

void ContourLabels::add_line(const std::vector<glm::vec2>& points, const std::string& text) {
  if (points.size() < 2) return;
  const float size = kSmaller * plot_.sizes.tick_text;
  const float width = measure_text(text, {.size = size}).width + 0.4F * size;
  const Measured line(points);
  if (!(line.length() > 4 * width)) return;
  const float radius = 0.7F * width;
  float straightest = 0.9F;  // chord ÷ length; more bent lines have no label
  Label best;
  for (float middle = 0.5F * width; middle <= line.length() - 0.5F * width; middle += 0.5F * width) {
    const glm::vec2 from = line.at(middle - 0.5F * width);
    const glm::vec2 to = line.at(middle + 0.5F * width);
    const float straightness = glm::distance(from, to) / width;
    if (straightness <= straightest || !is_free(line.at(middle), radius)) continue;
    straightest = straightness;
    // Never upside down.
    const glm::vec2 along = to.x >= from.x ? to - from : from - to;
    best = {text, line.at(middle), std::atan2(-along.y, along.x), radius};
  }
  if (!best.text.empty()) labels_.push_back(std::move(best));
}

void ContourLabels::draw() {
  Drawing& drawing = plot_.drawing;
  const glm::vec4 behind =
      plot_.paper.w > 0 ? glm::vec4(plot_.paper.x, plot_.paper.y, plot_.paper.z, 1) : glm::vec4(1, 1, 1, 1);
  const std::uint32_t gap = drawing.add_style(filled(behind));
  for (const Label& label : labels_) {
    const TextOptions how{.size = kSmaller * plot_.sizes.tick_text,
                          .anchor = TextAnchor::Middle,
                          .level = TextLevel::Middle,
                          .angle = label.angle};
    // A gap in the lines, for the text.
    const TextExtent extent = measure_text(label.text, how);
    const glm::vec2 half = 0.5F * glm::vec2(extent.width, extent.capital) + 0.2F * how.size;
    const std::uint32_t group = drawing.add_group(turned(label.angle, label.place), 1, plot_.data);
    drawing.add_path(rectangle({-half, half}), gap, "level-gap", group);
    plot_.write(label.text, label.place, how, "level-text", plot_.data);
  }
}

}  // namespace azulejo
