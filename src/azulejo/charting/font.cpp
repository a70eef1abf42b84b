#include "azulejo/charting/font.h"

#include <algorithm>
#include <memory>
#include <unordered_map>

#include <hb.h>

#include "azulejo/charting/font_data.h"

namespace azulejo {
namespace {

template <auto Destroy>
struct Destroyer {
  template <class T>
  void operator()(T* object) const {
    Destroy(object);
  }
};
using FacePointer = std::unique_ptr<hb_face_t, Destroyer<hb_face_destroy>>;
using FontPointer = std::unique_ptr<hb_font_t, Destroyer<hb_font_destroy>>;
using BufferPointer = std::unique_ptr<hb_buffer_t, Destroyer<hb_buffer_destroy>>;
using DrawPointer = std::unique_ptr<hb_draw_funcs_t, Destroyer<hb_draw_funcs_destroy>>;

/// A face that is never changed again, which all threads share.
struct Face {
  explicit Face(bool bold) {
    const std::span<const std::byte> data = font_data(bold);
    hb_blob_t* const blob =
        hb_blob_create(reinterpret_cast<const char*>(data.data()), static_cast<unsigned>(data.size()),
                       HB_MEMORY_MODE_READONLY, nullptr, nullptr);
    face.reset(hb_face_create(blob, 0));
    hb_blob_destroy(blob);
    font.reset(hb_font_create(face.get()));
    hb_face_make_immutable(face.get());
    hb_font_make_immutable(font.get());
    metrics.units_per_em = static_cast<float>(hb_face_get_upem(face.get()));
    hb_font_extents_t extents{};
    hb_font_get_h_extents(font.get(), &extents);
    metrics.ascent = static_cast<float>(extents.ascender);
    metrics.descent = static_cast<float>(-extents.descender);
    hb_codepoint_t capital = 0;
    hb_glyph_extents_t box{};
    if (hb_font_get_nominal_glyph(font.get(), 'H', &capital) != 0 &&
        hb_font_get_glyph_extents(font.get(), capital, &box) != 0) {
      metrics.capital = static_cast<float>(box.y_bearing);
    }
  }

  FacePointer face;
  FontPointer font;
  FontMetrics metrics;
};

const Face& face_of(bool bold) {
  static const Face regular(false);
  static const Face strong(true);
  return bold ? strong : regular;
}

glm::vec2 point(float x, float y) { return {x, y}; }

DrawPointer make_pen() {
  DrawPointer pen(hb_draw_funcs_create());
  hb_draw_funcs_set_move_to_func(
      pen.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float x, float y, void*) {
        static_cast<Path*>(path)->move_to(point(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_line_to_func(
      pen.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float x, float y, void*) {
        static_cast<Path*>(path)->line_to(point(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_quadratic_to_func(
      pen.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
        static_cast<Path*>(path)->quadratic_to(point(cx, cy), point(x, y));
      },
      nullptr, nullptr);
  hb_draw_funcs_set_cubic_to_func(
      pen.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float ax, float ay, float bx, float by, float x, float y,
         void*) { static_cast<Path*>(path)->cubic_to(point(ax, ay), point(bx, by), point(x, y)); },
      nullptr, nullptr);
  hb_draw_funcs_set_close_path_func(
      pen.get(), [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, void*) { static_cast<Path*>(path)->close(); },
      nullptr, nullptr);
  hb_draw_funcs_make_immutable(pen.get());
  return pen;
}

}  // namespace

const FontMetrics& font_metrics(bool bold) { return face_of(bold).metrics; }

ShapedLine shape_line(std::string_view text, bool bold) {
  thread_local const BufferPointer kBuffer(hb_buffer_create());
  hb_buffer_t* const buffer = kBuffer.get();
  hb_buffer_reset(buffer);
  const auto length = static_cast<int>(text.size());
  hb_buffer_add_utf8(buffer, text.data(), length, 0, length);
  hb_buffer_guess_segment_properties(buffer);
  // The guess takes the language of the process' locale: what is drawn must not depend on it.
  hb_buffer_set_language(buffer, hb_language_from_string("en", -1));
  hb_shape(face_of(bold).font.get(), buffer, nullptr, 0);

  ShapedLine line;
  unsigned count = 0;
  const hb_glyph_info_t* const infos = hb_buffer_get_glyph_infos(buffer, &count);
  const hb_glyph_position_t* const positions = hb_buffer_get_glyph_positions(buffer, &count);
  line.glyphs.reserve(count);
  unsigned first_missing = static_cast<unsigned>(text.size());
  for (unsigned i = 0; i < count; ++i) {
    line.glyphs.push_back({infos[i].codepoint, line.width + static_cast<float>(positions[i].x_offset),
                           static_cast<float>(positions[i].y_offset)});
    line.width += static_cast<float>(positions[i].x_advance);
    if (infos[i].codepoint == 0) first_missing = std::min(first_missing, infos[i].cluster);
  }
  if (first_missing < text.size()) {
    hb_buffer_reset(buffer);
    hb_buffer_add_utf8(buffer, text.data(), length, first_missing, -1);
    line.missing = hb_buffer_get_glyph_infos(buffer, &count)->codepoint;
  }
  return line;
}

const Path& glyph_outline(std::uint32_t glyph, bool bold) {
  static const DrawPointer kPen = make_pen();
  thread_local std::unordered_map<std::uint32_t, Path> outlines;  // as many as the two faces have glyphs, at most
  const auto [place, added] = outlines.try_emplace(glyph * 2 + (bold ? 1U : 0U));
  if (added) hb_font_get_glyph_shape(face_of(bold).font.get(), glyph, kPen.get(), &place->second);
  return place->second;
}

}  // namespace azulejo
