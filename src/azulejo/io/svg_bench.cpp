#include <cairo-svg.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>
#include <pugixml.hpp>
#include <random>
#include <string>

#include "azulejo/core/error.h"
#include "azulejo/io/model_io.h"
#include "harness.h"

namespace azulejo::bench {
namespace {

/// Closed outlines of 20 cubics and 20 lines in a few styles and groups, with three decimals as drawing programs write
/// them.
Drawing outlines(int count) {
  std::mt19937 random(1);
  const auto number = [&](float reach) { return std::round(static_cast<float>(random() % 1000) * reach) / 1000; };
  Drawing drawing;
  drawing.width = drawing.height = 1000;
  std::uint32_t group = 0;
  for (int i = 0; i < count; ++i) {
    if (i % 50 == 0) group = drawing.add_group({1, 0, 0, 1, number(900), number(900)});
    Path path;
    path.move_to({number(100), number(100)});
    for (int k = 0; k < 20; ++k) {
      path.cubic_to({number(100), number(100)}, {number(100), number(100)}, {number(100), number(100)});
      path.line_to({number(100), number(100)});
    }
    DrawingStyle style;
    style.fill = Paint(glm::vec4(static_cast<float>(i % 5) / 5, 0.4F, 0.2F, 1));
    style.stroke_width = static_cast<float>(1 + i % 3);
    if (i % 2 == 0) style.stroke = Paint();
    drawing.add_path(path.close(), drawing.add_style(style), {}, group);
  }
  return drawing;
}

constexpr int kOutlines = 9000;  // about 10 MB

Row read_row() {
  const auto text = std::make_shared<std::vector<std::byte>>(encode_model(outlines(kOutlines), "svg"));
  const auto paths = std::make_shared<std::size_t>(0);
  const auto peer_read = std::make_shared<bool>(false);
  Row row;
  row.work = static_cast<double>(text->size());
  row.unit = "MB/s";
  row.ours = [=](int threads) {
    *paths = std::get<Drawing>(read_model(*text, "outlines.svg", {}, Run{.threads = threads})).paths.size();
  };
  row.peer_name = "librsvg, without drawing";
  row.peer = [=](int) {
    RsvgHandle* const handle =
        rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(text->data()), text->size(), nullptr);
    *peer_read = handle != nullptr;
    if (handle != nullptr) g_object_unref(handle);
  };
  row.limit_name = "pugixml's tree alone";
  row.limit = [=](int) {
    pugi::xml_document document;
    document.load_buffer(text->data(), text->size(), pugi::parse_escapes);
  };
  row.check = [=]() -> Check {
    return {*paths == static_cast<std::size_t>(kOutlines) && *peer_read, std::to_string(*paths) + " paths"};
  };
  return row;
}

void draw_with_cairo(cairo_t* cairo, const PathView& path) {
  const glm::vec2* p = path.points.data();
  const auto x = [&](int i) { return static_cast<double>(p[i].x); };
  const auto y = [&](int i) { return static_cast<double>(p[i].y); };
  for (const PathCommand command : path.commands) {
    switch (command) {
      case PathCommand::Move: cairo_move_to(cairo, x(0), y(0)); break;
      case PathCommand::Line: cairo_line_to(cairo, x(0), y(0)); break;
      case PathCommand::Cubic: cairo_curve_to(cairo, x(0), y(0), x(1), y(1), x(2), y(2)); break;
      case PathCommand::Quadratic: break;  // there are none
      case PathCommand::Close: cairo_close_path(cairo); break;
    }
    p += points_of(command);
  }
}

/// What cairo writes of the same paths; returns the number of bytes.
std::size_t written_by_cairo(const Drawing& drawing) {
  std::size_t bytes = 0;
  const auto count = [](void* sum, const unsigned char*, unsigned int length) {
    *static_cast<std::size_t*>(sum) += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* const surface = cairo_svg_surface_create_for_stream(count, &bytes, 1000, 1000);
  cairo_t* const cairo = cairo_create(surface);
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    const DrawingStyle& style = drawing.styles[path.style];
    cairo_identity_matrix(cairo);
    cairo_translate(cairo, static_cast<double>(placed.page_from_path[2].x),
                    static_cast<double>(placed.page_from_path[2].y));
    draw_with_cairo(cairo, drawing.view(path));
    const glm::dvec4 color(style.fill->color);
    cairo_set_source_rgb(cairo, color.x, color.y, color.z);
    style.stroke ? cairo_fill_preserve(cairo) : cairo_fill(cairo);
    if (!style.stroke) continue;
    cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_set_line_width(cairo, static_cast<double>(style.stroke_width));
    cairo_stroke(cairo);
  }
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return bytes;
}

Row write_row() {
  const auto drawing = std::make_shared<Drawing>(outlines(kOutlines));
  const auto ours = std::make_shared<std::size_t>(0);
  const auto peer = std::make_shared<std::size_t>(0);
  const std::size_t bytes = encode_model(*drawing, "svg").size();
  Row row;
  row.work = static_cast<double>(bytes);
  row.unit = "MB/s";
  row.ours = [=](int threads) { *ours = encode_model(*drawing, "svg", {}, Run{.threads = threads}).size(); };
  row.peer_name = "cairo's SVG surface";
  row.peer = [=](int) { *peer = written_by_cairo(*drawing); };
  row.limit = copy_limit(drawing->points.size() * sizeof(glm::vec2), bytes);
  row.check = [=]() -> Check {
    return {*ours > 0 && *peer > 0, std::to_string(*ours) + " bytes, the peer's " + std::to_string(*peer)};
  };
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("read SVG, 9000 outlines", read_row);
  bench.row("write SVG, 9000 outlines", write_row);
});

}  // namespace
}  // namespace azulejo::bench
