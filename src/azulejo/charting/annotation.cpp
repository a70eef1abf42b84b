#include "azulejo/charting/annotation.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "azulejo/charting/color_bar.h"
#include "azulejo/charting/label_layout.h"
#include "azulejo/charting/palette.h"
#include "azulejo/charting/text.h"
#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostRows = 100000;
constexpr std::size_t kColors = 256;

/// The column that is asked for, or the first of the usual names that is there; null: none.
const CsvColumn* column_of(const CsvTable& data, const std::string& given, const char* argument,
                           std::initializer_list<const char*> usual) {
  if (!given.empty()) return &data.column(given, argument);
  for (const char* name : usual) {
    const auto found = std::ranges::find(data.columns, name, &CsvColumn::name);
    if (found != data.columns.end()) return &*found;
  }
  return nullptr;
}

}  // namespace

AnnotationTable::AnnotationTable(const CsvTable& data, const AnnotateOptions& options)
    : data_(data),
      id_(column_of(data, options.id, "id", {"id", "name"})),
      text_(column_of(data, options.text, "text", {"text", "label"})),
      value_(column_of(data, options.value, "value", {"value"})),
      x_(column_of(data, options.x, "x", {"x"})),
      y_(column_of(data, options.y, "y", {"y"})),
      z_(column_of(data, options.z, "z", {"z"})) {
  if (data.rows > kMostRows) {
    throw Error(Error::Data, fmt::format("{}: {} rows, expected at most {}", data.source, data.rows, kMostRows));
  }
  if (!has_places() && !has_ids()) {
    throw Error(Error::Argument, fmt::format("{}: no columns x and y, and none that is id or name", data.source));
  }
  if (value_ == nullptr) return;
  if (options.range) {
    low_ = static_cast<double>(options.range->x);
    high_ = static_cast<double>(options.range->y);
  } else {
    low_ = std::numeric_limits<double>::infinity();
    high_ = -low_;
    for (const double value : value_->numbers) {
      if (!std::isfinite(value)) continue;
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    }
  }
  colors_ = map_colors(options.map, static_cast<int>(kColors));
}

std::string AnnotationTable::cell(const CsvColumn* column, std::size_t row) {
  if (column == nullptr) return "";
  if (column->is_text()) return column->texts[row];
  return std::isnan(column->numbers[row]) ? "" : fmt::format("{}", column->numbers[row]);
}

double AnnotationTable::number(const CsvColumn* column, std::size_t row) {
  return column != nullptr ? column->numbers[row] : std::numeric_limits<double>::quiet_NaN();
}

std::string AnnotationTable::text(std::size_t row) const {
  if (text_ != nullptr) return cell(text_, row);
  return value_ != nullptr ? cell(value_, row) : cell(id_, row);
}

std::optional<glm::vec4> AnnotationTable::color(std::size_t row) const {
  if (!has_colors() || std::isnan(value_->numbers[row])) return std::nullopt;
  const std::size_t index = color_index(value_->numbers[row], low_, high_, colors_.size());
  return index < colors_.size() ? std::optional(colors_[index]) : std::nullopt;
}

std::vector<Annotation> AnnotationTable::placed(
    const std::function<std::optional<AnnotationPlace>(std::size_t row)>& by_point,
    const std::function<std::optional<AnnotationPlace>(const std::string& id)>& by_id, const Run& run) const {
  std::vector<Annotation> list;
  std::size_t lost = 0;
  for (std::size_t row = 0; row < rows(); ++row) {
    std::optional<AnnotationPlace> place;
    if (has_places() && std::isfinite(x(row)) && std::isfinite(y(row))) place = by_point(row);
    if (!place && has_ids()) place = by_id(id(row));
    if (place) {
      list.push_back({id(row), text(row), color(row), *place});
    } else {
      ++lost;
    }
  }
  if (lost > 0) {
    warn(run, fmt::format("{}: {} of {} rows are about nothing that is here, or outside of the picture", data_.source,
                          lost, rows()));
  }
  return list;
}

namespace {

/// The groups and styles of what is added.
class Writer {
 public:
  Writer(Drawing& drawing, const AnnotateOptions& options, const Run& run)
      : drawing_(drawing), options_(options), run_(run) {
    const std::uint32_t all = group("annotations", 0);
    leaders_ = group("leaders", all);
    marks_ = group("marks", all);
    labels_ = group("labels", all);
    bar_ = group("color-bar", all);
  }

  void add(const std::vector<Annotation>& annotations) {
    std::vector<WantedLabel> wanted;
    const TextOptions text{.size = options_.font_size, .anchor = TextAnchor::Middle, .level = TextLevel::Middle};
    for (const Annotation& each : annotations) {
      WantedLabel label{each.place.point, {0, 0}, each.place.room};
      if (each.color && !each.place.painted) label.room = {};  // the mark shows the color: it is left to be seen
      if (options_.labels && !each.text.empty()) {
        const TextExtent extent = measure_text(each.text, text);
        label.size = {extent.width + 0.4F * options_.font_size, 1.25F * options_.font_size};
      }
      wanted.push_back(label);
      if (!each.place.painted && options_.mark_size > 0) add_mark(each);
    }
    const float clearance = 0.5F * options_.mark_size + 0.25F * options_.font_size;
    const Box2 page{{0, 0}, {drawing_.width, drawing_.height}};
    const std::vector<PlacedLabel> places = place_labels(wanted, page, clearance, taken_);
    for (std::size_t i = 0; i < annotations.size(); ++i) {
      if (places[i].box.empty()) continue;
      if (places[i].leader) add_leader(annotations[i].place.point, places[i].box);
      add_label(annotations[i], 0.5F * (places[i].box.lower + places[i].box.upper), text);
    }
  }

  /// Before the labels, which keep off it.
  void add_bar(const AnnotationTable& table, const std::vector<Annotation>& annotations) {
    ColorBar bar;
    bar.label = options_.bar_label.empty() ? table.value_name() : options_.bar_label;
    bar.low = table.low();
    bar.high = table.high();
    bar.map = options_.map;
    const PlotSizes sizes(options_.font_size);
    const float height = std::min(drawing_.height - 4 * options_.font_size, 14 * options_.font_size);
    const float width = color_bar_width(bar, height, sizes);
    if (height < 3 * options_.font_size || width > drawing_.width) return;  // no room
    const float top = 2 * options_.font_size;
    const auto panel_at = [&](float left) {
      return Box2{{left, top - options_.font_size},
                  {left + width + 0.5F * options_.font_size, top + height + options_.font_size}};
    };
    // On the side where it hides fewer places.
    const float gap = 0.5F * options_.font_size;
    const Box2 sides[] = {panel_at(drawing_.width - width - 2 * gap), panel_at(gap)};
    const auto hidden = [&](const Box2& box) {
      return std::ranges::count_if(annotations, [&](const Annotation& each) {
        const glm::vec2& p = each.place.point;
        return p.x >= box.lower.x && p.x <= box.upper.x && p.y >= box.lower.y && p.y <= box.upper.y;
      });
    };
    const Box2& panel = hidden(sides[1]) < hidden(sides[0]) ? sides[1] : sides[0];
    const float right = panel.lower.x;
    taken_.push_back(panel);
    if (options_.halo.a > 0) {
      drawing_.add_path(rectangle(panel), drawing_.add_style(filled(to_vec4(options_.halo))), "panel", bar_);
    }
    draw_color_bar(drawing_, bar_, bar, {{right, top}, {right, top + height}}, sizes, to_vec4(options_.color), run_);
  }

 private:
  std::uint32_t group(const char* id, std::uint32_t parent) {
    const std::uint32_t index = drawing_.add_group({1, 0, 0, 1, 0, 0}, 1, parent);
    drawing_.groups[index].id = id;
    return index;
  }

  void add_mark(const Annotation& annotation) {
    DrawingStyle style;
    style.fill.reset();
    style.point_size = options_.mark_size;
    if (options_.halo.a > 0) {
      style.points = Paint(to_vec4(options_.halo));
      style.point_size += 2;
      mark(annotation.place.point, style, {});
      style.point_size -= 2;
    }
    style.points = Paint(annotation.color.value_or(to_vec4(options_.color)));
    mark(annotation.place.point, style, annotation.id);
  }

  void mark(const glm::vec2& point, const DrawingStyle& style, const std::string& id) {
    Path path;
    path.move_to(point).close();
    drawing_.add_path(path, drawing_.add_style(style), id, marks_);
  }

  void add_leader(const glm::vec2& point, const Box2& box) {
    Path path;
    path.move_to(point).line_to(leader_end(box, point));
    if (options_.halo.a > 0) {
      drawing_.add_path(path, drawing_.add_style(stroked(to_vec4(options_.halo), 3)), {}, leaders_);
    }
    drawing_.add_path(path, drawing_.add_style(stroked(to_vec4(options_.color), 1)), {}, leaders_);
  }

  void add_label(const Annotation& annotation, const glm::vec2& center, const TextOptions& text) {
    if (options_.halo.a > 0) {
      DrawingStyle halo = stroked(to_vec4(options_.halo), 0.25F * options_.font_size);
      halo.join = LineJoin::Round;
      const std::uint32_t path =
          add_text(drawing_, annotation.text, center, text, drawing_.add_style(halo), {}, labels_, run_);
      drawing_.paths[path].text.reset();  // said once
    }
    const std::uint32_t style = drawing_.add_style(filled(to_vec4(options_.color)));
    add_text(drawing_, annotation.text, center, text, style, annotation.id, labels_, run_);
  }

  Drawing& drawing_;
  const AnnotateOptions& options_;
  const Run& run_;
  std::uint32_t leaders_ = 0;
  std::uint32_t marks_ = 0;
  std::uint32_t labels_ = 0;
  std::uint32_t bar_ = 0;
  std::vector<Box2> taken_;
};

}  // namespace

void add_annotations(Drawing& drawing, const std::vector<Annotation>& annotations, const AnnotationTable& table,
                     const AnnotateOptions& options, const Run& run) {
  Writer writer(drawing, options, run);
  if (options.bar && table.has_colors()) writer.add_bar(table, annotations);
  writer.add(annotations);
}

}  // namespace azulejo
