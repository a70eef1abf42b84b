#include "azulejo/math/viewport.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

[[noreturn]] void refuse(const char* name, const Window& box, const char* wanted) {
  throw Error(Error::Argument,
              fmt::format("{}: {:g},{:g},{:g},{:g}, expected {}", name, box.x0, box.y0, box.x1, box.y1, wanted));
}

void check(const char* name, const Window& box) {
  const bool has_area =
      box.width() > 0 && box.height() > 0 && std::isfinite(box.width()) && std::isfinite(box.height());
  if (!has_area) refuse(name, box, "x0,y0,x1,y1 with x0 < x1 and y0 < y1");
}

glm::dvec2 scale(const Window& window, const Window& viewport) {
  check("window", window);
  check("viewport", viewport);
  const glm::dvec2 factor(viewport.width() / window.width(), viewport.height() / window.height());
  for (const double each : {factor.x, factor.y}) {
    if (!std::isnormal(each) || !std::isnormal(1 / each)) refuse("window", window, "a size nearer the viewport's");
  }
  return factor;
}

glm::dmat3 scaled_and_moved(const glm::dvec2& factor, const glm::dvec2& offset) {
  return {factor.x, 0, 0, 0, factor.y, 0, offset.x, offset.y, 1};
}

/// The closed forms of tx and ty.
glm::dvec2 displacement(const Window& window, const Window& viewport) {
  return {(window.x1 * viewport.x0 - window.x0 * viewport.x1) / window.width(),
          (window.y1 * viewport.y0 - window.y0 * viewport.y1) / window.height()};
}

Window around(const glm::dvec2& center, double width, double height) {
  return {center.x - width / 2, center.y - height / 2, center.x + width / 2, center.y + height / 2};
}

}  // namespace

glm::dmat3 viewport_from_window(const Window& window, const Window& viewport) {
  return scaled_and_moved(scale(window, viewport), displacement(window, viewport));
}

glm::dmat3 scaling_to_viewport(const Window& window, const Window& viewport) {
  const glm::dvec2 factor = scale(window, viewport);
  return scaled_and_moved(factor, {window.x0 * (1 - factor.x), window.y0 * (1 - factor.y)});
}

glm::dmat3 translation_to_viewport(const Window& window, const Window& viewport) {
  scale(window, viewport);  // refuses what has no scale
  return scaled_and_moved({1, 1}, {viewport.x0 - window.x0, viewport.y0 - window.y0});
}

glm::dmat3 window_from_viewport(const Window& window, const Window& viewport) {
  const glm::dvec2 factor = scale(window, viewport);
  return scaled_and_moved(1.0 / factor, displacement(viewport, window));
}

glm::dmat3 raster_from_viewport(double picture_height) { return scaled_and_moved({1, -1}, {0, picture_height}); }

Window flipped(const Window& viewport, double picture_height) {
  return {viewport.x0, picture_height - viewport.y1, viewport.x1, picture_height - viewport.y0};
}

glm::dvec2 transformed(const glm::dmat3& matrix, const glm::dvec2& point) {
  return glm::dvec2(matrix * glm::dvec3(point, 1.0));
}

double aspect_mismatch(const Window& window, const Window& viewport) {
  const glm::dvec2 factor = scale(window, viewport);
  return factor.x / factor.y;
}

FittedWindow fitted(const Window& window, const Window& viewport, AspectPolicy policy) {
  const glm::dvec2 factor = scale(window, viewport);
  if (policy == AspectPolicy::Stretch || factor.x == factor.y) return {window, viewport};
  if (policy == AspectPolicy::Fit) {
    const double both = std::min(factor.x, factor.y);
    return {window, around(viewport.center(), both * window.width(), both * window.height())};
  }
  const double both = std::max(factor.x, factor.y);
  return {around(window.center(), viewport.width() / both, viewport.height() / both), viewport};
}

FittedPixels fitted(const Window& window, const Rect& viewport, AspectPolicy policy) {
  const FittedWindow exact = fitted(window, window_of(viewport), policy);
  if (policy != AspectPolicy::Fit) return {exact.window, viewport};
  const glm::dvec2 factor = scale(exact.window, exact.viewport);
  const auto pixels = [](double size, int most) {
    return std::clamp(static_cast<int>(std::lround(std::min(size, static_cast<double>(most)))), 1, most);
  };
  Rect shown;
  shown.width = pixels(exact.viewport.width(), viewport.width);
  shown.height = pixels(exact.viewport.height(), viewport.height);
  shown.x = viewport.x + (viewport.width - shown.width) / 2;
  shown.y = viewport.y + (viewport.height - shown.height) / 2;
  return {around(window.center(), shown.width / factor.x, shown.height / factor.y), shown};
}

}  // namespace azulejo
