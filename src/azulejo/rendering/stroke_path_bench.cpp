// Lines beside Cairo's image backend with its default antialiasing, at 2048².
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "azulejo/data/drawing.h"
#include "bench/cairo_drawing.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr int kSide = 2048;

/// `paths` walks of `segments` each, a step up to `reach` pixels in both directions.
std::shared_ptr<const Drawing> walks(int paths, int segments, float reach, bool curved, const DrawingStyle& style) {
  const auto drawing = std::make_shared<Drawing>();
  drawing->width = drawing->height = kSide;
  drawing->add_style(style);
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
    drawing->add_path(path, 0);
  }
  return drawing;
}

/// Cairo samples coverage on 15 rows a pixel; ours adds it up where a line crosses itself within a pixel, which these
/// walks do in most.
constexpr double kMean = 2.8;

void add(Bench& bench, const std::string& name, int segments, std::shared_ptr<const Drawing> (*make)()) {
  bench.row(fmt::format("draw {}, {}×{}", name, kSide, kSide),
            [=] { return beside_cairo(make(), CAIRO_ANTIALIAS_DEFAULT, segments, "Mseg/s", kMean); });
}

DrawingStyle style_of(float width, LineJoin join = LineJoin::Miter, LineCap cap = LineCap::Butt) {
  DrawingStyle style;
  style.fill.reset();
  style.stroke = Paint({0.1F, 0.2F, 0.6F, 1});
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
