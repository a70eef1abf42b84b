#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "azulejo/data/drawing.h"
#include "azulejo/rendering/draw.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr int kSide = 2048;

/// Lines for both: a drawing on white, and the same for cairo.
struct Lines {
  Drawing drawing;
  DrawingStyle style;
};

std::shared_ptr<Lines> empty_lines(const DrawingStyle& wanted) {
  auto lines = std::make_shared<Lines>();
  lines->drawing.width = lines->drawing.height = kSide;
  lines->style = wanted;
  lines->style.fill.reset();
  lines->style.stroke = Paint({0.1F, 0.2F, 0.6F, 1});
  lines->drawing.add_style(lines->style);
  return lines;
}

/// `paths` walks of `segments` each, a step up to `reach` pixels in both directions.
std::shared_ptr<Lines> walks(int paths, int segments, float reach, bool curved, const DrawingStyle& style) {
  auto lines = empty_lines(style);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(0, kSide);
  std::uniform_real_distribution<float> step(-reach, reach);
  for (int p = 0; p < paths; ++p) {
    glm::vec2 here(place(random), place(random));
    const auto next = [&] {
      here.x = std::clamp(here.x + step(random), 0.0F, static_cast<float>(kSide));
      here.y = std::clamp(here.y + step(random), 0.0F, static_cast<float>(kSide));
      return here;
    };
    Path path = Path().move_to(here);
    for (int s = 0; s < segments; ++s) {
      if (curved) {
        const glm::vec2 first = next();
        const glm::vec2 second = next();
        path.cubic_to(first, second, next());
      } else {
        path.line_to(next());
      }
    }
    lines->drawing.add_path(path, 0);
  }
  return lines;
}

void add_path(cairo_t* context, const PathView& path) {
  const glm::vec2* p = path.points.data();
  for (const PathCommand command : path.commands) {
    switch (command) {
      case PathCommand::Move: cairo_move_to(context, p[0].x, p[0].y); break;
      case PathCommand::Line: cairo_line_to(context, p[0].x, p[0].y); break;
      case PathCommand::Cubic: cairo_curve_to(context, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y); break;
      default: break;
    }
    p += points_of(command);
  }
}

void draw_with_cairo(const Lines& lines, cairo_surface_t* surface) {
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface), &cairo_destroy);
  cairo_t* const c = context.get();
  cairo_set_source_rgb(c, 1, 1, 1);
  cairo_paint(c);
  const DrawingStyle& style = lines.style;
  const glm::vec4 color = style.stroke->color;
  cairo_set_source_rgba(c, color.x, color.y, color.z, color.w);
  cairo_set_tolerance(c, 0.1);
  cairo_set_line_width(c, style.stroke_width);
  cairo_set_line_cap(c, static_cast<cairo_line_cap_t>(style.cap));
  cairo_set_line_join(c, static_cast<cairo_line_join_t>(style.join));
  cairo_set_miter_limit(c, style.miter_limit);
  const std::vector<double> dash(style.dash.begin(), style.dash.end());
  cairo_set_dash(c, dash.data(), static_cast<int>(dash.size()), 0);
  for (const DrawingPath& path : lines.drawing.paths) {
    add_path(c, lines.drawing.view(path));
    cairo_stroke(c);
  }
  cairo_surface_flush(surface);
}

/// The mean difference of a channel, in levels. Cairo samples coverage on 15 rows a pixel; ours adds it up where a line
/// crosses itself within a pixel, which these walks do in most.
Check compared(const Image& ours, cairo_surface_t* surface) {
  const auto view = ours.view<const std::uint8_t>();
  const unsigned char* const theirs = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  double sum = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) sum += std::abs(view.row(y)[4 * x] - theirs[y * stride + 4 * x + 2]);
  }
  const double mean = sum / kSide / kSide;
  return {mean < 2.5, fmt::format("mean {:.2f} levels", mean)};
}

void add(Bench& bench, const std::string& name, int segments, std::function<std::shared_ptr<Lines>()> make) {
  bench.row(fmt::format("draw {}, {}×{}", name, kSide, kSide), [segments, make] {
    const auto lines = make();
    const auto image = std::make_shared<Image>();
    const std::shared_ptr<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, kSide, kSide),
                                                   &cairo_surface_destroy);
    Row row;
    row.work = segments;
    row.unit = "Mseg/s";
    row.ours = [=](int threads) {
      Run run;
      run.threads = threads;
      DrawOptions options;
      options.background = Color{1, 1, 1, 1};
      *image = draw(lines->drawing, options, run);
    };
    row.peer_name = "cairo";
    row.peer = [=](int) { draw_with_cairo(*lines, surface.get()); };
    row.check = [=] { return compared(*image, surface.get()); };
    return row;
  });
}

DrawingStyle style_of(float width, LineJoin join = LineJoin::Miter, LineCap cap = LineCap::Butt) {
  DrawingStyle style;
  style.stroke_width = width;
  style.join = join;
  style.cap = cap;
  return style;
}

const Rows kRows([](Bench& bench) {
  add(bench, "10⁵ lines of 1 px", 100000, [] { return walks(100000, 1, 40, false, style_of(1)); });
  add(bench, "10⁶ lines of 1 px", 1000000, [] { return walks(1000000, 1, 20, false, style_of(1)); });
  add(bench, "polylines of 10⁵ segments, 1 px", 100000, [] { return walks(100, 1000, 20, false, style_of(1)); });
  add(bench, "polylines of 10⁵ segments, 8 px, round", 100000,
      [] { return walks(1000, 100, 20, false, style_of(8, LineJoin::Round, LineCap::Round)); });
  add(bench, "10⁵ curves of 2 px", 100000, [] { return walks(10000, 10, 20, true, style_of(2, LineJoin::Round)); });
  add(bench, "polylines of 10⁵ segments, dashed", 100000, [] {
    DrawingStyle style = style_of(2);
    style.dash = {6, 4};
    return walks(1000, 100, 40, false, style);
  });
});

}  // namespace
}  // namespace azulejo::bench
