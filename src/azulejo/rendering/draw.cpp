#include "azulejo/rendering/draw.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/stages.h"
#include "azulejo/rendering/draw_painter.h"
#include "azulejo/rendering/picture_onto.h"
#include "azulejo/rendering/viewport_rect.h"

namespace azulejo {
namespace {

constexpr int kMostPixels = 65536;

/// Rows that a thread paints at a time: what it needs of them stays in its cache.
int band_rows(int width) {
  constexpr int kBandPixels = 32768;
  return std::clamp(kBandPixels / width, 4, 32);
}

int picture_size(double size, const char* name) {
  // A page of 210 mm mustn't become a pixel larger by rounding of its size.
  const double pixels = std::ceil(size - 1e-3);
  if (!(pixels <= kMostPixels)) {
    throw Error(Error::Argument, fmt::format("draw: {} {:.0f}, expected at most {} px", name, pixels, kMostPixels));
  }
  return std::max(1, static_cast<int>(pixels));
}

void check_layers(const DrawBands& bands, const DrawFrame& frame, const Run& run) {
  const std::size_t blocks = static_cast<std::size_t>(frame.width + kBlock - 1) / kBlock;
  const std::size_t layer = blocks * static_cast<std::size_t>(bands.rows) * DrawLayer::kBlockBytes;
  const auto threads = static_cast<std::size_t>(std::min(thread_count(run), bands.count));
  const double bytes = static_cast<double>(layer) * static_cast<double>(bands.depth) * static_cast<double>(threads);
  if (bytes > static_cast<double>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("draw: {} layers within each other need {:.0f} bytes, the limit is {}",
                                             bands.depth, bytes, run.limits.memory_bytes));
  }
}

}  // namespace

DrawFrame draw_frame(const Drawing& drawing, const DrawOptions& options) {
  const double unit = drawing.unit == DrawingUnit::Millimetre ? options.dpi / 25.4 : 1.0;
  const bool sized = drawing.width > 0 && drawing.height > 0;
  if (!sized && !options.window && !(options.width && options.height)) {
    throw Error(Error::Argument,
                fmt::format("draw: the page is {} x {} {}, expected one with a size, or width and height",
                            drawing.width, drawing.height, to_string(drawing.unit)));
  }
  double scale = unit * options.scale;
  Window window{0, 0, drawing.width, drawing.height};
  if (!sized) window = {0, 0, options.width.value_or(1) / scale, options.height.value_or(1) / scale};
  if (options.window) {
    const auto [x0, y0, x1, y1] = *options.window;
    window = {x0, y0, x1, y1};
    viewport_from_window(window, {});  // refuses one without area
  }
  if (options.width && !options.height) scale = *options.width / window.width();
  if (options.height && !options.width) scale = *options.height / window.height();
  DrawFrame frame;
  frame.width = options.width ? *options.width : picture_size(window.width() * scale, "width");
  frame.height = options.height ? *options.height : picture_size(window.height() * scale, "height");
  frame.viewport = viewport_rect(options.viewport, frame.width, frame.height);
  glm::dmat3 matrix = viewport_from_window(window, {0, 0, scale * window.width(), scale * window.height()});
  if (options.viewport || (options.width && options.height)) {
    const FittedPixels shown = fitted(window, frame.viewport, options.aspect);
    matrix = viewport_from_window(shown.window, window_of(shown.viewport));
    frame.viewport = shown.viewport;
  }
  frame.picture_from_page = {
      static_cast<float>(matrix[0][0]), 0, 0, static_cast<float>(matrix[1][1]), static_cast<float>(matrix[2][0]),
      static_cast<float>(matrix[2][1])};
  return frame;
}

namespace {

/// A picture of what the frame shows, all of it.
Image draw_whole(const Drawing& drawing, const DrawFrame& frame, const DrawOptions& options, const Run& run) {
  Image picture({.width = frame.width, .height = frame.height, .channels = 4, .alpha = AlphaState::Straight},
                run.limits);
  const int rows = band_rows(frame.width);
  const DrawSteps steps = draw_steps(drawing, frame.picture_from_page, options.polygon_mode);
  const DrawOutlines outlines(drawing, steps, frame, options, rows, run);
  const DrawBands bands = draw_bands(steps, outlines, frame, rows);
  check_layers(bands, frame, run);

  DrawPlan plan{drawing, options, frame, steps, outlines, bands, {}, {}};
  plan.prepare();
  std::vector<std::unique_ptr<DrawPainter>> painters(static_cast<std::size_t>(thread_count(run)));
  const ImageView<std::uint8_t> rgba = picture.view<std::uint8_t>();
  parallel_tasks(static_cast<std::size_t>(bands.count), run, [&](std::size_t band, int worker) {
    std::unique_ptr<DrawPainter>& painter = painters[static_cast<std::size_t>(worker)];
    if (!painter) painter = std::make_unique<DrawPainter>(plan);
    painter->paint(static_cast<int>(band), rgba);
  });
  return picture;
}

/// What the viewport shows, in the middle of a picture of one color.
Image draw_part(const Drawing& drawing, const DrawFrame& frame, const DrawOptions& options, const Run& run) {
  const Rect& viewport = frame.viewport;
  if (viewport == Rect{0, 0, frame.width, frame.height}) return draw_whole(drawing, frame, options, run);
  DrawFrame inside{viewport.width, viewport.height, frame.picture_from_page, {0, 0, viewport.width, viewport.height}};
  inside.picture_from_page[2] -= glm::vec2(static_cast<float>(viewport.x), static_cast<float>(viewport.y));
  const Image part = draw_whole(drawing, inside, options, run);
  const Image pixel = draw_whole(Drawing(), {1, 1, {1, 0, 0, 1, 0, 0}, {0, 0, 1, 1}}, options, run);
  Image picture({.width = frame.width, .height = frame.height, .channels = 4, .alpha = AlphaState::Straight},
                run.limits);
  const ImageView<std::uint8_t> rgba = picture.view<std::uint8_t>();
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* const row = rgba.row(y);
    for (int x = 0; x < frame.width; ++x) std::copy_n(pixel.view<std::uint8_t>().row(0), 4, row + 4 * x);
    if (y < viewport.y || y >= viewport.bottom()) continue;
    std::copy_n(part.view<std::uint8_t>().row(y - viewport.y), 4 * viewport.width, row + 4 * viewport.x);
  }
  return picture;
}

void warn_of_stretching(const DrawFrame& frame, const DrawOptions& options, const Run& run) {
  const double mismatch =
      static_cast<double>(frame.picture_from_page[0].x) / static_cast<double>(frame.picture_from_page[1].y);
  constexpr double kSame = 0.01;
  if (options.aspect != AspectPolicy::Stretch || std::abs(mismatch - 1) < kSame) return;
  warn(run,
       fmt::format("draw: the window is not of the viewport's shape; lengths across are drawn {:.3g} times as long "
                   "as lengths down, aspect=fit keeps the shape",
                   mismatch));
}

/// The page, and where the viewport shows it.
void report_stages(const Drawing& drawing, const DrawFrame& frame, const Run& run) {
  if (run.stages == nullptr) return;
  const StageReporter reporter(*run.stages, "draw");
  Drawing seen = drawing.clone();
  seen.width = static_cast<float>(frame.width);
  seen.height = static_cast<float>(frame.height);
  seen.unit = DrawingUnit::Pixel;
  seen.groups[0].parent_from_group = combined(frame.picture_from_page, drawing.groups[0].parent_from_group);
  reporter.drawing("page", drawing);
  reporter.drawing("viewport", seen);
}

}  // namespace

Image draw(const Drawing& drawing, const DrawOptions& options, const Run& run) {
  drawing.check("draw");
  const DrawFrame frame = draw_frame(drawing, options);
  warn_of_stretching(frame, options, run);
  report_stages(drawing, frame, run);
  return draw_part(drawing, frame, options, run);
}

Image draw_onto(const Image& under, const Drawing& drawing, const DrawOptions& options, const Run& run) {
  check_onto(under, ColorState::Srgb);
  DrawOptions same_size = options;
  same_size.width = under.width();
  same_size.height = under.height();
  return picture_onto(under, draw(drawing, same_size, run), draw_frame(drawing, same_size).viewport, run);
}

}  // namespace azulejo
