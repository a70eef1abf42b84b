#include "azulejo/charting/text.h"

#include <cairo.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr std::size_t kLabels = 10000;
constexpr float kSize = 12;

std::vector<std::string> numbers() {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < kLabels; ++i) texts.push_back(fmt::format("{:.3f}", 0.37 * static_cast<double>(i)));
  return texts;
}

/// Draws into no pixels: outlines only. Its toy interface looks glyphs up and neither kerns nor shapes.
class Cairo {
 public:
  Cairo() : surface_(cairo_recording_surface_create(CAIRO_CONTENT_ALPHA, nullptr)), context_(cairo_create(surface_)) {
    cairo_select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, kSize);
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context_, options);
    cairo_font_options_destroy(options);
  }
  ~Cairo() {
    cairo_destroy(context_);
    cairo_surface_destroy(surface_);
  }
  Cairo(const Cairo&) = delete;
  Cairo& operator=(const Cairo&) = delete;

  /// The outlines of a text, and how far it moves the pen.
  double outline(const std::string& text) {
    cairo_new_path(context_);
    cairo_move_to(context_, 0, 0);
    cairo_text_path(context_, text.c_str());
    double x = 0;
    double y = 0;
    cairo_get_current_point(context_, &x, &y);
    cairo_path_t* const path = cairo_copy_path(context_);
    cairo_path_destroy(path);
    return x;
  }

 private:
  cairo_surface_t* surface_;
  cairo_t* context_;
};

Row labels() {
  const auto texts = std::make_shared<const std::vector<std::string>>(numbers());
  const auto cairo = std::make_shared<Cairo>();
  const auto widths = std::make_shared<std::pair<double, double>>();
  Row row;
  row.work = 1000.0 * kLabels;
  row.unit = "klabels/s";
  row.threads = {1};
  row.ours = [texts, widths](int) {
    Drawing drawing;
    const std::uint32_t style = drawing.add_style({});
    for (const std::string& text : *texts) add_text(drawing, text, {0, 0}, {.size = kSize}, style);
    widths->first = measure_text(texts->back(), {.size = kSize}).width;
  };
  row.peer_name = "cairo";
  row.peer = [texts, cairo, widths](int) {
    for (const std::string& text : *texts) widths->second = cairo->outline(text);
  };
  row.limit_name = "";
  row.check = [widths]() -> Check {
    const double difference = std::abs(widths->first - widths->second);
    return {difference < 0.05, fmt::format("widths {} and {}", widths->first, widths->second)};
  };
  row.aim = 1;
  return row;
}

const Rows kRows([](Bench& bench) { bench.row("text, 10000 labels", labels); });

}  // namespace
}  // namespace azulejo::bench
