#include "azulejo/engine/operation.h"
#include "azulejo/rendering/draw.h"

namespace azulejo {
namespace {

std::vector<Field> draw_fields() {
  using Options = DrawOptions;
  return {
      field("width", &Options::width, {1, 65536}, "px", "of the picture; auto: of the page, or as the height asks"),
      field("height", &Options::height, {1, 65536}, "px", "of the picture; auto: of the page, or as the width asks"),
      field("scale", &Options::scale, {1e-6, 1e6}, "", "size of the picture beside the page, where it isn't given"),
      field("dpi", &Options::dpi, {1, 10000}, "", "pixels an inch, of pages in millimetres"),
      field("background", &Options::background, "behind the drawing; auto: nothing, the picture is transparent"),
      field("antialias", &Options::antialias,
            "what a path gives a pixel: the part of it that is inside, or all or nothing by its center"),
      field("tolerance", &Options::tolerance, {1e-3, 100}, "px", "of curves, which are drawn as lines"),
      field("strokes", &Options::strokes, "lines as they are, or as pixels one beside the other"),
      field("polygon_mode", &Options::polygon_mode, "what alone of paths is painted; auto: what their styles say"),
      field("light", &Options::light, "what is mixed where colors cover each other in part"),
  };
}

}  // namespace

extern const Operation kDraw =
    with_examples(value_operation<DrawOptions>(
                      "draw", "Draws lines and curves as pixels.", {{"drawing", "the page", ValueKind::Drawing}},
                      {{"image", "the picture, with alpha"}}, draw_fields(),
                      [](std::span<const Value> inputs, const DrawOptions& options, const Run& run) {
                        return std::vector<Value>{Value(draw(*inputs[0].drawing(), options, run))};
                      }),
                  {{"tiles.svg draw", "Gradients, clips and a group that is half transparent."},
                   {"tiles.svg draw:width=480,background=white,antialias=none", "Whole pixels, on white."}});

}  // namespace azulejo
