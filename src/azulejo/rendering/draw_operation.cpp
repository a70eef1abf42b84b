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
      field("window", &Options::window, {-1e30, 1e30}, "",
            "x0,y0,x1,y1: the part of the page to show; auto: all of it"),
      field("viewport", &Options::viewport, {0, 65536}, "px", "x,y,width,height of the picture to draw in; auto: all"),
      field("aspect", &Options::aspect, "where the window has another shape than the viewport"),
  };
}

std::vector<Port> inputs() {
  return {{"drawing", "the page", ValueKind::Drawing},
          {.name = "onto",
           .help = "a picture to draw on, in the viewport only; it sets width and height",
           .kind = ValueKind::Image,
           .optional = true}};
}

}  // namespace

extern const Operation kDraw = with_examples(
    value_operation<DrawOptions>(
        "draw", "Draws lines and curves as pixels.", inputs(), {{"image", "the picture, with alpha"}}, draw_fields(),
        [](std::span<const Value> inputs, const DrawOptions& options, const Run& run) {
          const Image* const onto = inputs.size() > 1 ? inputs[1].image() : nullptr;
          const Drawing& drawing = *inputs[0].drawing();
          return std::vector<Value>{
              Value(onto != nullptr ? draw_onto(*onto, drawing, options, run) : draw(drawing, options, run))};
        }),
    {{"tiles.svg draw", "Gradients, clips and a group that is half transparent."},
     {"tiles.svg draw:width=480,background=white,antialias=none", "Whole pixels, on white."},
     {"primitive:kind=teapot as:pot render:width=480,height=360,background=white as:picture @pot "
      "wireframe:width=480,height=360,line_width=0.5,color=#c00000 draw:onto=@picture",
      "Lines over a picture of the same model."}});

}  // namespace azulejo
