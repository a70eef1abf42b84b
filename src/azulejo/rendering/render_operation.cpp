#include "azulejo/rendering/render_operation.h"

#include <memory>

#include "azulejo/engine/field_group.h"
#include "azulejo/rendering/camera_fields.h"

namespace azulejo {
namespace {

std::vector<Field> lighting_fields() {
  return {
      field("lights", &LightingOptions::lights, "which lights shine; auto: the file's, else the default three"),
      field("ambient", &LightingOptions::ambient, {0, 100}, "", "light from everywhere; 1 makes white white"),
  };
}

std::vector<Field> picture_fields() {
  using Options = RenderOptions;
  return {
      field("renderer", &Options::renderer, "how the picture is made"),
      field("width", &Options::width, {1, 65536}, "px", "of the picture"),
      field("height", &Options::height, {1, 65536}, "px", "of the picture"),
  };
}

std::vector<Field> look_fields() {
  using Options = RenderOptions;
  return {
      field("background", &Options::background, "behind the scene"),
      field("shading", &Options::shading, "of faces: one color each, from corner to corner, or for each pixel"),
      field("polygon_mode", &Options::polygon_mode, "of faces: all of them, their edges as lines, or their corners"),
      field("antialias", &Options::antialias, {1, 16}, "", "samples a pixel: 1, 4, 8 or 16"),
      field("exposure", &Options::exposure, {-40, 40}, "stops", "brighter or darker by powers of 2"),
      field("output", &Options::output, "of the color; auto: linear into files of floats, else display8"),
      field("layers", &Options::layers, "what is drawn; OpenEXR files hold all"),
      field("animation", &Options::animation, "which animation, by name or number"),
      field("time_s", &Options::time_s, {-1e9, 1e9}, "s", "time in the animation"),
      field("crease_angle_deg", &Options::crease_angle_deg, {0, 180}, "deg",
            "of meshes without normals: sharper edges stay sharp"),
      field("line_width", &Options::line_width, {0, 1000}, "px", "of lines and edges"),
      field("point_size", &Options::point_size, {0, 1000}, "px", "of points and corners"),
  };
}

std::vector<Port> inputs() {
  return {{"scene", "the model", ValueKind::Scene},
          {.name = "onto",
           .help = "a picture to draw on, in the viewport only; it sets width and height",
           .kind = ValueKind::Image,
           .optional = true}};
}

std::vector<Port> ports() {
  std::vector<Port> list = {
      {"image", "the picture, with the layers asked for", ValueKind::Frame},
      {"camera", "intrinsics and extrinsics", ValueKind::Report, true},
      {"statistics", "what became of the faces", ValueKind::Report, true},
  };
  for (const std::string_view name : enum_names(FrameLayer{})) {
    list.push_back({std::string(name), "that layer alone; -o with its name draws it", ValueKind::Image});
  }
  return list;
}

Json statistics_json(const RenderStatistics& statistics) {
  const ZBufferStatistics& faces = statistics.faces;
  Json json = Json::object();
  json.set("camera", statistics.camera.empty() ? Json() : Json(statistics.camera));
  json.set("lights", enum_names(LightChoice{})[static_cast<std::size_t>(statistics.lights)]);
  json.set("exposure", statistics.exposure);
  json.set("faces_in", faces.faces_in).set("faces_outside", faces.faces_outside);
  json.set("faces_culled", faces.faces_culled).set("faces_empty", faces.faces_empty);
  json.set("faces_clipped", faces.faces_clipped).set("faces_drawn", faces.faces_drawn);
  json.set("fragments_tested", faces.fragments_tested).set("fragments_passed", faces.fragments_passed);
  return json.set("fragments_shaded", faces.fragments_shaded);
}

std::vector<Value> render_values(std::span<const Value> inputs, const RenderOptions& options, const Run& run) {
  const Image* const onto = inputs.size() > 1 ? inputs[1].image() : nullptr;
  if (onto == nullptr) return rendered_values(SceneRenderer(*inputs[0].scene(), options, run), options, onto, run);
  const RenderOptions same_size = options_onto(*onto, options);
  return rendered_values(SceneRenderer(*inputs[0].scene(), same_size, run), same_size, onto, run);
}

}  // namespace

std::vector<Value> rendered_values(const SceneRenderer& renderer, const RenderOptions& options, const Image* onto,
                                   const Run& run) {
  RenderStatistics statistics;
  const auto frame =
      std::make_shared<const Frame>(onto != nullptr ? renderer.draw_onto(*onto, options.camera, run, &statistics)
                                                    : renderer.draw(options.camera, run, &statistics));
  std::vector<Value> values{Value(frame), Value(Report{frame->camera}), Value(Report{statistics_json(statistics)})};
  for (const std::string_view name : enum_names(FrameLayer{})) {
    const Image* const layer = frame->find(name);
    // Kept by the frame that it belongs to.
    values.push_back(layer != nullptr ? Value(std::shared_ptr<const Image>(frame, layer)) : Value());
  }
  return values;
}

extern const Operation kRender = with_examples(
    with_float_output(
        value_operation<RenderOptions>("render", "Draws a scene.", inputs(), ports(),
                                       joined({picture_fields(), nested(&RenderOptions::camera, camera_fields()),
                                               nested(&RenderOptions::lighting, lighting_fields()), look_fields()}),
                                       render_values),
        "output=linear"),
    {{"primitive:kind=teapot render:width=480,height=360,background=white", "Framed, lit by three lights."},
     {"primitive:kind=icosahedron "
      "render:width=480,height=360,view=isometric,projection=orthographic,shading=flat,background=#0b1f3a",
      "Without vanishing point; each face in one color."},
     {"primitive:kind=teapot render:width=480,height=360,layers=normal",
      "Which way each pixel's surface faces: x, y and z as red, green and blue."},
     {"primitive:kind=teapot as:pot render:width=480,height=240,viewport=0,0,240,240,background=white as:left "
      "@pot render:onto=@left,viewport=240,0,240,240,view=top,polygon_mode=edges,background=#0b1f3a",
      "Two viewports in one picture; on the right the edges alone, from above."},
     {"primitive:kind=teapot render:width=480,height=360,window=-0.2,-0.5,1,0.4,background=white",
      "A smaller window is a larger picture."}});

}  // namespace azulejo
