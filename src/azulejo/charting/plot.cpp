#include "azulejo/charting/plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "azulejo/charting/chart_text.h"
#include "azulejo/charting/palette.h"

namespace azulejo {
namespace {

constexpr float kQuarter = std::numbers::pi_v<float> / 2;
constexpr float kFrameWidth = 0.8F;

/// Thin lines are sharp in the middle of pixels.
float sharp(float place) { return std::floor(place) + 0.5F; }

glm::vec4 mixed(const glm::vec4& a, const glm::vec4& b, float share) { return a * (1 - share) + b * share; }

std::string factor_text(int exponent) { return "×" + power_of_ten(exponent); }

}  // namespace

Path rectangle(const Box2& box) {
  Path path;
  path.move_to(box.lower).line_to({box.upper.x, box.lower.y}).line_to(box.upper).line_to({box.lower.x, box.upper.y});
  path.close();
  return path;
}

DrawingStyle filled(const glm::vec4& color) {
  DrawingStyle style;
  style.fill = Paint(color);
  return style;
}

DrawingStyle stroked(const glm::vec4& color, float width) {
  DrawingStyle style;
  style.fill.reset();
  style.stroke = Paint(color);
  style.stroke_width = width;
  return style;
}

glm::vec4 contrast_ink(const glm::vec4& background) {
  const float light = 0.3F * background.x + 0.59F * background.y + 0.11F * background.z;
  return light * background.w + (1 - background.w) > 0.5F ? glm::vec4(0.13F, 0.13F, 0.13F, 1)
                                                          : glm::vec4(0.92F, 0.92F, 0.92F, 1);
}

Plot::Plot(const PlotOptions& options, const Run& run)
    : sizes(options.font_size), options_(options), run_(warning_once(run)) {
  paper = to_vec4(options.background);
  ink = contrast_ink(paper);
  const glm::vec4 behind = paper.w > 0 ? glm::vec4(paper.x, paper.y, paper.z, 1) : glm::vec4(1, 1, 1, 1);
  faint = mixed(behind, ink, 0.45F);
  grid = mixed(behind, ink, 0.12F);
  lay_out();
  drawing.width = options_.width;
  drawing.height = options_.height;
  if (paper.w > 0) {
    drawing.add_path(rectangle({{0, 0}, {drawing.width, drawing.height}}), drawing.add_style(filled(paper)),
                     "background");
  }
  if (options_.grid) draw_grid();
  data = drawing.add_group({1, 0, 0, 1, 0, 0});
  const std::uint32_t clip = drawing.add_clip();
  drawing.add_path(rectangle(area), drawing.add_style(filled(ink)), {}, clip);
  drawing.groups[data].clip = clip;
  draw_frame();
  draw_tick_labels();
  draw_titles();
  front = drawing.add_group({1, 0, 0, 1, 0, 0});
}

void Plot::lay_out() {
  const float tick_line = line_height(sizes.tick_text);
  const float label_line = line_height(sizes.label_text);
  const float title_room = options_.title.empty() ? 0 : line_height(sizes.title_text) + 0.5F * sizes.pad;
  const float x_label_room = options_.x.label.empty() ? 0 : label_line + sizes.gap;
  const float y_label_room = options_.y.label.empty() ? 0 : label_line + sizes.gap;
  const float outside = sizes.tick + sizes.gap;
  x_ticks_.depth = tick_line;
  y_ticks_.depth = 3 * sizes.tick_text;
  // Ticks need to know the area, and the area how large they are: that settles at once, or nearly.
  for (int pass = 0; pass < 3; ++pass) {
    const bool top_factor = y_ticks_.exponent != 0;
    const bool bottom_factor = x_ticks_.exponent != 0 && options_.x.label.empty();
    float top = sizes.pad + title_room + (top_factor ? tick_line : 0);
    float bottom = 0.7F * sizes.pad + outside + x_ticks_.depth + (bottom_factor ? tick_line : x_label_room);
    float left = 0.7F * sizes.pad + y_label_room + outside + y_ticks_.depth;
    float right = sizes.pad + options_.right_room;
    if (!x_ticks_.marks.empty()) {
      // Labels at the ends reach beyond the area.
      const PlacedTicks::Mark& first = x_ticks_.marks.front();
      const PlacedTicks::Mark& last = x_ticks_.marks.back();
      const float reach = x_ticks_.slanted ? 0.71F * first.width : 0.5F * first.width;
      left = std::max(left, reach - (first.at - area.lower.x) + 0.4F * sizes.pad);
      if (!x_ticks_.slanted) right = std::max(right, 0.5F * last.width - (area.upper.x - last.at) + 0.4F * sizes.pad);
    }
    // On a page that is too small, the area keeps a third of it.
    const auto shrink = [](float& a, float& b, float whole) {
      const float scale = std::min(1.0F, 0.67F * whole / (a + b));
      a *= scale;
      b *= scale;
    };
    shrink(left, right, options_.width);
    if (options_.square) {
      const double ratio = (options_.y.high - options_.y.low) / (options_.x.high - options_.x.low);
      if (options_.auto_height) {
        const auto wanted = static_cast<float>(ratio * static_cast<double>(options_.width - left - right));
        options_.height = std::clamp(std::round(wanted + top + bottom), 0.2F * options_.width, 3 * options_.width);
      }
      shrink(top, bottom, options_.height);
      const float width = options_.width - left - right;
      const float height = options_.height - top - bottom;
      const auto high = std::min<double>(height, ratio * width);
      area = {{left, top}, {left + static_cast<float>(high / ratio), top + static_cast<float>(high)}};
    } else {
      shrink(top, bottom, options_.height);
      area = {{sharp(left), sharp(top)}, {sharp(options_.width - right), sharp(options_.height - bottom)}};
    }
    x_axis = Axis(options_.x, area.lower.x, area.upper.x);
    y_axis = options_.y.reversed ? Axis(options_.y, area.lower.y, area.upper.y)
                                 : Axis(options_.y, area.upper.y, area.lower.y);
    x_ticks_ = place_x_ticks(options_.x, x_axis, area.upper.x - area.lower.x, sizes, 0.35F * options_.height,
                             x_ticks_.slanted);
    y_ticks_ = place_y_ticks(options_.y, y_axis, area.upper.y - area.lower.y, sizes, 0.35F * options_.width);
  }
}

void Plot::draw_grid() {
  Path lines;
  if (options_.x.categories.empty()) {
    for (const PlacedTicks::Mark& mark : x_ticks_.marks) {
      lines.move_to({sharp(mark.at), area.lower.y}).line_to({sharp(mark.at), area.upper.y});
    }
  }
  if (options_.y.categories.empty()) {
    for (const PlacedTicks::Mark& mark : y_ticks_.marks) {
      lines.move_to({area.lower.x, sharp(mark.at)}).line_to({area.upper.x, sharp(mark.at)});
    }
  }
  drawing.add_path(lines, drawing.add_style(stroked(grid, 1)), "grid");
}

void Plot::draw_frame() {
  const std::uint32_t style = drawing.add_style(stroked(faint, kFrameWidth));
  drawing.add_path(rectangle(area), style, "frame");
  Path marks;
  const auto below = [&](float at, float length) {
    marks.move_to({sharp(at), area.upper.y}).line_to({sharp(at), area.upper.y + length});
  };
  const auto beside = [&](float at, float length) {
    marks.move_to({area.lower.x, sharp(at)}).line_to({area.lower.x - length, sharp(at)});
  };
  for (const PlacedTicks::Mark& mark : x_ticks_.marks) below(mark.at, sizes.tick);
  for (const float at : x_ticks_.minor) below(at, 0.55F * sizes.tick);
  for (const PlacedTicks::Mark& mark : y_ticks_.marks) beside(mark.at, sizes.tick);
  for (const float at : y_ticks_.minor) beside(at, 0.55F * sizes.tick);
  drawing.add_path(marks, style, "ticks");
}

void Plot::draw_tick_labels() {
  const float outside = sizes.tick + sizes.gap;
  for (const PlacedTicks::Mark& mark : x_ticks_.marks) {
    if (x_ticks_.slanted) {
      write(mark.label, {mark.at + 0.35F * sizes.tick_text, area.upper.y + outside + 0.3F * sizes.tick_text},
            {.size = sizes.tick_text, .anchor = TextAnchor::End, .level = TextLevel::Middle, .angle = kQuarter / 2},
            "x-tick", 0);
    } else {
      write(mark.label, {mark.at, area.upper.y + outside},
            {.size = sizes.tick_text, .anchor = TextAnchor::Middle, .level = TextLevel::Top}, "x-tick", 0);
    }
  }
  for (const PlacedTicks::Mark& mark : y_ticks_.marks) {
    write(mark.label, {area.lower.x - outside, mark.at},
          {.size = sizes.tick_text, .anchor = TextAnchor::End, .level = TextLevel::Middle}, "y-tick", 0);
  }
  if (y_ticks_.exponent != 0) {
    write(factor_text(y_ticks_.exponent), {area.lower.x, area.lower.y - sizes.gap},
          {.size = sizes.tick_text, .level = TextLevel::Bottom}, "y-factor", 0);
  }
  if (x_ticks_.exponent != 0) {
    write(factor_text(x_ticks_.exponent), {area.upper.x, area.upper.y + outside + x_ticks_.depth},
          {.size = sizes.tick_text, .anchor = TextAnchor::End, .level = TextLevel::Top}, "x-factor", 0);
  }
}

void Plot::draw_titles() {
  const glm::vec2 middle = 0.5F * (area.lower + area.upper);
  const float pad = sizes.pad;
  if (!options_.title.empty()) {
    const TextOptions how{
        .size = sizes.title_text, .bold = true, .anchor = TextAnchor::Middle, .level = TextLevel::Top};
    const std::string text = fitted_text(options_.title, how, drawing.width - 2 * pad);
    const float half = 0.5F * measure_text(text, how).width;
    const float x = std::max(half + pad, std::min(middle.x, drawing.width - pad - half));
    write(text, {x, pad}, how, "title", 0);
  }
  if (!options_.x.label.empty()) {
    const TextOptions how{.size = sizes.label_text, .anchor = TextAnchor::Middle, .level = TextLevel::Top};
    const float factor =
        x_ticks_.exponent == 0 ? 0 : measure_text(factor_text(x_ticks_.exponent), how).width + sizes.label_text;
    const float room = std::max(0.0F, area.upper.x - area.lower.x - 2 * factor);
    write(fitted_text(options_.x.label, how, room),
          {middle.x, area.upper.y + sizes.tick + 2 * sizes.gap + x_ticks_.depth}, how, "x-label", 0);
  }
  if (!options_.y.label.empty()) {
    const TextOptions how{
        .size = sizes.label_text, .anchor = TextAnchor::Middle, .level = TextLevel::Top, .angle = kQuarter};
    write(fitted_text(options_.y.label, how, area.upper.y - area.lower.y), {0.7F * pad, middle.y}, how, "y-label", 0);
  }
}

std::uint32_t Plot::write(std::string_view text, const glm::vec2& place, const TextOptions& how, std::string id,
                          std::uint32_t group) {
  return add_text(drawing, text, place, how, drawing.add_style(filled(ink)), std::move(id), group, run_);
}

}  // namespace azulejo
