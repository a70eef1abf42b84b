// Fills beside Cairo's image backend, with its default antialiasing and with its good one, at 2048². Both get the path as
// it is and begin with an empty picture; ours ends in straight alpha, which the peer is spared.
#include "azulejo/rendering/draw.h"

#include <cairo/cairo.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr int kSize = 2048;

/// A drawing, and how the peer draws it.
struct Work {
  Drawing drawing;
  double segments = 0;
};

/// The peer's picture.
class CairoPicture {
 public:
  CairoPicture(std::shared_ptr<const Work> work, cairo_antialias_t antialias)
      : work_(std::move(work)),
        surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, kSize, kSize)),
        cairo_(cairo_create(surface_)) {
    cairo_set_antialias(cairo_, antialias);
  }
  CairoPicture(const CairoPicture&) = delete;
  CairoPicture& operator=(const CairoPicture&) = delete;
  ~CairoPicture() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
  }

  void draw() {
    cairo_set_operator(cairo_, CAIRO_OPERATOR_CLEAR);
    cairo_paint(cairo_);
    cairo_set_operator(cairo_, CAIRO_OPERATOR_OVER);
    for (const DrawingPath& path : work_->drawing.paths) {
      const DrawingStyle& style = work_->drawing.styles[path.style];
      set_paint(*style.fill);
      cairo_set_fill_rule(cairo_,
                          style.fill_rule == FillRule::NonZero ? CAIRO_FILL_RULE_WINDING : CAIRO_FILL_RULE_EVEN_ODD);
      add_path(work_->drawing.view(path));
      cairo_fill(cairo_);
    }
    cairo_surface_flush(surface_);
  }

  /// Alpha of the pixels of a row, from 0 to 255.
  int alpha(int x, int y) const {
    const unsigned char* const row =
        cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_);
    return row[4 * x + 3];
  }

 private:
  void set_paint(const Paint& paint) {
    if (!paint.pattern) {
      cairo_set_source_rgba(cairo_, paint.color.x, paint.color.y, paint.color.z, paint.color.w);
      return;
    }
    const auto& gradient = std::get<Gradient>(work_->drawing.patterns[*paint.pattern]);
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

  void add_path(const PathView& path) {
    const glm::vec2* p = path.points.data();
    for (const PathCommand command : path.commands) {
      switch (command) {
        case PathCommand::Move: cairo_move_to(cairo_, p[0].x, p[0].y); break;
        case PathCommand::Line: cairo_line_to(cairo_, p[0].x, p[0].y); break;
        case PathCommand::Cubic: cairo_curve_to(cairo_, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y); break;
        case PathCommand::Quadratic: break;  // it has none, and no row has
        case PathCommand::Close: cairo_close_path(cairo_); break;
      }
      p += points_of(command);
    }
  }

  std::shared_ptr<const Work> work_;
  cairo_surface_t* surface_;
  cairo_t* cairo_;
};

Drawing page() {
  Drawing drawing;
  drawing.width = drawing.height = kSize;
  return drawing;
}

std::uint32_t add_color(Drawing& drawing, const Paint& paint) {
  DrawingStyle style;
  style.fill = paint;
  return drawing.add_style(style);
}

/// An outline around the middle that doesn't cross itself, its radius a walk with steps of up to `roughness` pixels.
Work coast(int points, double roughness) {
  Work work{page(), static_cast<double>(points)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-roughness, roughness);
  Path path;
  double walk = 0;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    walk = 0.9 * walk + step(random);
    const double radius = 700 + 150 * std::sin(7 * angle) + 40 * std::sin(53 * angle) + walk;
    const glm::vec2 point(1024 + radius * std::cos(angle), 1024 + radius * std::sin(angle));
    i == 0 ? path.move_to(point) : path.line_to(point);
  }
  work.drawing.add_path(path.close(), add_color(work.drawing, glm::vec4(0.2F, 0.4F, 0.8F, 1)));
  return work;
}

Work triangles(int count) {
  Work work{page(), 3.0 * count};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(0, kSize);
  std::uniform_real_distribution<float> reach(-10, 10);
  for (int i = 0; i < count; ++i) {
    const glm::vec2 middle(place(random), place(random));
    const auto corner = [&] { return middle + glm::vec2(reach(random), reach(random)); };
    Path path;
    path.move_to(corner()).line_to(corner()).line_to(corner()).close();
    work.drawing.add_path(path, add_color(work.drawing, glm::vec4(static_cast<float>(i % 7) / 7, 0.4F, 0.8F, 1)));
  }
  return work;
}

/// Rings of cubic curves as large as letters, hundreds in a path.
Work letters(int count) {
  Work work{page(), 8.0 * count};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> size(3, 6);
  const std::uint32_t style = add_color(work.drawing, glm::vec4(0, 0, 0, 1));
  for (int i = 0; i < count; ++i) {
    Path path;
    const glm::vec2 middle(10 + i % 170 * 12, 10 + i / 170 % 126 * 16);
    for (const float turn : {1.0F, -0.55F}) {
      const float x = size(random);
      const float y = 7 * turn;
      const float c = 0.5523F;
      path.move_to(middle + glm::vec2(x, 0));
      path.cubic_to(middle + glm::vec2(x, c * y), middle + glm::vec2(c * x, y), middle + glm::vec2(0, y));
      path.cubic_to(middle + glm::vec2(-c * x, y), middle + glm::vec2(-x, c * y), middle + glm::vec2(-x, 0));
      path.cubic_to(middle + glm::vec2(-x, -c * y), middle + glm::vec2(-c * x, -y), middle + glm::vec2(0, -y));
      path.cubic_to(middle + glm::vec2(c * x, -y), middle + glm::vec2(x, -c * y), middle + glm::vec2(x, 0)).close();
    }
    work.drawing.add_path(path, style);
  }
  return work;
}

Work disk(bool radial) {
  Work work = coast(1000, 0);
  Gradient gradient;
  gradient.radial = radial;
  gradient.from = radial ? glm::vec2(900, 900) : glm::vec2(0);
  gradient.to = radial ? glm::vec2(1024) : glm::vec2(kSize);
  gradient.to_radius = 1000;
  gradient.stops = {{0, {1, 0, 0, 1}}, {0.4F, {1, 1, 0, 1}}, {1, {0, 0, 1, 1}}};
  work.drawing.styles[0].fill = Paint({0, 0, 0, 1}, work.drawing.add_pattern(gradient));
  work.segments = kSize * kSize;
  return work;
}

void add(Bench& bench, const std::string& name, Work (*make)(), double aim, double mean) {
  for (const bool good : {false, true}) {
    bench.row("draw " + name + (good ? ", beside its good quality" : ""), [=] {
      const auto work = std::make_shared<const Work>(make());
      const auto peer = std::make_shared<CairoPicture>(work, good ? CAIRO_ANTIALIAS_GOOD : CAIRO_ANTIALIAS_DEFAULT);
      const auto picture = std::make_shared<Image>();
      Row row;
      row.work = work->segments;
      row.unit = work->segments == kSize * kSize ? "Mpix/s" : "Mseg/s";
      row.ours = [=](int threads) { *picture = draw(work->drawing, {}, Run{.threads = threads}); };
      row.peer_name = "Cairo";
      row.peer = [=](int) { peer->draw(); };
      row.aim = aim;
      row.check = [=] {
        double sum = 0;
        for (int y = 0; y < kSize; ++y) {
          const std::uint8_t* const ours = picture->view<std::uint8_t>().row(y);
          for (int x = 0; x < kSize; ++x) sum += std::abs(ours[4 * x + 3] - peer->alpha(x, y));
        }
        const double difference = sum / (double{kSize} * kSize);
        return Check{difference < mean, "mean difference of alpha " + std::to_string(difference) + " of 255"};
      };
      return row;
    });
  }
}

const Rows kRows([](Bench& bench) {
  add(
      bench, "a coast of 10⁵ lines", [] { return coast(100'000, 0.4); }, 2, 0.05);
  add(
      bench, "a coast of 10⁶ lines", [] { return coast(1'000'000, 0.4); }, 2, 0.05);
  add(
      bench, "a ragged coast of 10⁵ lines", [] { return coast(100'000, 8); }, 2, 0.1);
  add(
      bench, "10⁵ triangles", [] { return triangles(100'000); }, 2, 1);
  add(
      bench, "20,000 letters of curves", [] { return letters(20'000); }, 2,
      2.5);  // a third of all pixels is on an edge: Cairo looks at 15 rows of each
  add(
      bench, "a linear gradient", [] { return disk(false); }, 2, 0.05);
  add(
      bench, "a radial gradient", [] { return disk(true); }, 2, 0.05);
});

}  // namespace
}  // namespace azulejo::bench
