#pragma once

#include <cairo/cairo.h>

#include <memory>

#include "azulejo/data/drawing.h"
#include "azulejo/data/image.h"
#include "bench/harness.h"

namespace azulejo::bench {

/// A drawing as Cairo paints it into an image of its page's size, which is empty before: fills and lines of paths in one
/// group. It gets curves as they are, and ends in premultiplied alpha, ours in straight alpha.
class CairoDrawing {
 public:
  CairoDrawing(std::shared_ptr<const Drawing> drawing, cairo_antialias_t antialias);
  CairoDrawing(const CairoDrawing&) = delete;
  CairoDrawing& operator=(const CairoDrawing&) = delete;
  ~CairoDrawing();

  void draw();
  /// Whether the alpha of a picture of the same size differs by less than so many levels of 255 on average.
  Check compare(const Image& ours, double mean) const;

 private:
  void set_paint(const Paint& paint);
  void set_line(const DrawingStyle& style);
  void add_path(const PathView& path);

  std::shared_ptr<const Drawing> drawing_;
  cairo_surface_t* surface_;
  cairo_t* cairo_;
};

/// A row that draws a drawing beside Cairo.
/// work   how many of `unit` there are
/// mean   of CairoDrawing::compare
Row beside_cairo(std::shared_ptr<const Drawing> drawing, cairo_antialias_t antialias, double work, std::string unit,
                 double mean);

}  // namespace azulejo::bench
