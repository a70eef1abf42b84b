#include "azulejo/rendering/draw.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/rendering/draw_painter.h"

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
  const double page_width = drawing.width;
  const double page_height = drawing.height;
  const bool sized = page_width > 0 && page_height > 0;
  if (!sized && !(options.width && options.height)) {
    throw Error(Error::Argument,
                fmt::format("draw: the page is {} x {} {}, expected one with a size, or width and height",
                            drawing.width, drawing.height, to_string(drawing.unit)));
  }
  double scale_x = unit * options.scale;
  double scale_y = scale_x;
  if (sized && options.width) scale_x = *options.width / page_width;
  if (sized && options.height) scale_y = *options.height / page_height;
  if (sized && options.width && !options.height) scale_y = scale_x;
  if (sized && options.height && !options.width) scale_x = scale_y;
  DrawFrame frame;
  frame.width = options.width ? *options.width : picture_size(page_width * scale_x, "width");
  frame.height = options.height ? *options.height : picture_size(page_height * scale_y, "height");
  frame.picture_from_page = {static_cast<float>(scale_x), 0, 0, static_cast<float>(scale_y), 0, 0};
  return frame;
}

Image draw(const Drawing& drawing, const DrawOptions& options, const Run& run) {
  drawing.check("draw");
  const DrawFrame frame = draw_frame(drawing, options);
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

}  // namespace azulejo
