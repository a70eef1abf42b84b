#include "bench/cairo_drawing.h"

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/rendering/draw.h"

namespace azulejo::bench {

CairoDrawing::CairoDrawing(std::shared_ptr<const Drawing> drawing, cairo_antialias_t antialias)
    : drawing_(std::move(drawing)),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(drawing_->width),
                                          static_cast<int>(drawing_->height))),
      cairo_(cairo_create(surface_)) {
  cairo_set_antialias(cairo_, antialias);
  cairo_set_tolerance(cairo_, DrawOptions().tolerance);
}

CairoDrawing::~CairoDrawing() {
  cairo_destroy(cairo_);
  cairo_surface_destroy(surface_);
}

void CairoDrawing::draw() {
  cairo_set_operator(cairo_, CAIRO_OPERATOR_CLEAR);
  cairo_paint(cairo_);
  cairo_set_operator(cairo_, CAIRO_OPERATOR_OVER);
  for (const DrawingPath& path : drawing_->paths) {
    const DrawingStyle& style = drawing_->styles[path.style];
    add_path(drawing_->view(path));
    if (style.fill) {
      set_paint(*style.fill);
      cairo_set_fill_rule(cairo_,
                          style.fill_rule == FillRule::NonZero ? CAIRO_FILL_RULE_WINDING : CAIRO_FILL_RULE_EVEN_ODD);
      cairo_fill_preserve(cairo_);
    }
    if (style.stroke) {
      set_paint(*style.stroke);
      set_line(style);
      cairo_stroke_preserve(cairo_);
    }
    cairo_new_path(cairo_);
  }
  cairo_surface_flush(surface_);
}

Check CairoDrawing::compare(const Image& ours, double mean) const {
  const auto view = ours.view<const std::uint8_t>();
  double sum = 0;
  for (int y = 0; y < view.height; ++y) {
    const unsigned char* const theirs =
        cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_);
    for (int x = 0; x < view.width; ++x) sum += std::abs(view(x, y, 3) - theirs[4 * x + 3]);
  }
  const double difference = sum / view.width / view.height;
  return {difference < mean, fmt::format("mean difference of alpha {:.3f} of 255", difference)};
}

void CairoDrawing::set_paint(const Paint& paint) {
  if (!paint.pattern) {
    cairo_set_source_rgba(cairo_, paint.color.x, paint.color.y, paint.color.z, paint.color.w);
    return;
  }
  const auto& gradient = std::get<Gradient>(drawing_->patterns[*paint.pattern]);
  cairo_pattern_t* const pattern =
      gradient.radial ? cairo_pattern_create_radial(gradient.from.x, gradient.from.y, gradient.from_radius,
                                                    gradient.to.x, gradient.to.y, gradient.to_radius)
                      : cairo_pattern_create_linear(gradient.from.x, gradient.from.y, gradient.to.x, gradient.to.y);
  for (const GradientStop& stop : gradient.stops) {
    cairo_pattern_add_color_stop_rgba(pattern, stop.offset, stop.color.x, stop.color.y, stop.color.z, stop.color.w);
  }
  cairo_set_source(cairo_, pattern);
  cairo_pattern_destroy(pattern);
}

void CairoDrawing::set_line(const DrawingStyle& style) {
  cairo_set_line_width(cairo_, style.stroke_width);
  cairo_set_line_cap(cairo_, static_cast<cairo_line_cap_t>(style.cap));
  cairo_set_line_join(cairo_, static_cast<cairo_line_join_t>(style.join));
  cairo_set_miter_limit(cairo_, style.miter_limit);
  const std::vector<double> dash(style.dash.begin(), style.dash.end());
  cairo_set_dash(cairo_, dash.data(), static_cast<int>(dash.size()), style.dash_offset);
}

void CairoDrawing::add_path(const PathView& path) {
  const glm::vec2* p = path.points.data();
  for (const PathCommand command : path.commands) {
    switch (command) {
      case PathCommand::Move: cairo_move_to(cairo_, p[0].x, p[0].y); break;
      case PathCommand::Line: cairo_line_to(cairo_, p[0].x, p[0].y); break;
      case PathCommand::Cubic: cairo_curve_to(cairo_, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y); break;
      case PathCommand::Quadratic: std::abort();  // Cairo has none, and no row has
      case PathCommand::Close: cairo_close_path(cairo_); break;
    }
    p += points_of(command);
  }
}

Row beside_cairo(std::shared_ptr<const Drawing> drawing, cairo_antialias_t antialias, double work, std::string unit,
                 double mean) {
  const auto peer = std::make_shared<CairoDrawing>(drawing, antialias);
  const auto picture = std::make_shared<Image>();
  Row row;
  row.work = work;
  row.unit = std::move(unit);
  row.ours = [=](int threads) { *picture = draw(*drawing, {}, Run{.threads = threads}); };
  row.peer_name = "Cairo";
  row.peer = [=](int) { peer->draw(); };
  row.check = [=] { return peer->compare(*picture, mean); };
  return row;
}

}  // namespace azulejo::bench
