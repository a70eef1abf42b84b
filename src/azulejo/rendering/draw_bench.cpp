// Fills beside Cairo's image backend, with its default antialiasing and with its good one, at 2048². Both get the path as
// it is and begin with an empty picture; ours ends in straight alpha, which the peer is spared.
#include "azulejo/rendering/draw.h"

#include <cmath>
#include <numbers>
#include <random>

#include "bench/cairo_drawing.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr int kSize = 2048;

/// A drawing, and how many lines or curves it has (of one that is all paint: pixels).
struct Work {
  Drawing drawing;
  double segments = 0;
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

/// mean  how far the alpha of both may be apart, in levels
void add(Bench& bench, const std::string& name, Work (*make)(), double mean) {
  for (const bool good : {false, true}) {
    bench.row("draw " + name + (good ? ", beside its good quality" : ""), [=] {
      Work work = make();
      return beside_cairo(std::make_shared<const Drawing>(std::move(work.drawing)),
                          good ? CAIRO_ANTIALIAS_GOOD : CAIRO_ANTIALIAS_DEFAULT, work.segments,
                          work.segments == kSize * kSize ? "Mpix/s" : "Mseg/s", mean);
    });
  }
}

const Rows kRows([](Bench& bench) {
  add(
      bench, "a coast of 10⁵ lines", [] { return coast(100'000, 0.4); }, 0.05);
  add(
      bench, "a coast of 10⁶ lines", [] { return coast(1'000'000, 0.4); }, 0.05);
  add(
      bench, "a ragged coast of 10⁵ lines", [] { return coast(100'000, 8); }, 0.1);
  add(
      bench, "10⁵ triangles", [] { return triangles(100'000); }, 1);
  // A third of all pixels is on an edge: Cairo looks at 15 rows of each.
  add(
      bench, "20,000 letters of curves", [] { return letters(20'000); }, 2.5);
  add(
      bench, "a linear gradient", [] { return disk(false); }, 0.05);
  add(
      bench, "a radial gradient", [] { return disk(true); }, 0.05);
});

}  // namespace
}  // namespace azulejo::bench
