#include <vector>

#include "azulejo/charting/annotate.h"
#include "azulejo/engine/field_group.h"
#include "azulejo/engine/operation.h"
#include "azulejo/rendering/camera_fields.h"

namespace azulejo {
namespace {

constexpr const char* kSummary = "Writes labels and colors from a table beside what they are about.";

struct SceneAnnotateOptions {
  AnnotateOptions annotate = {};
  CameraOptions camera = {};
  int width = 1024;
  int height = 768;
};

std::vector<Field> annotate_fields() {
  using Options = AnnotateOptions;
  return {
      field("data", &Options::data, "path of the table: CSV, or JSON: a list of objects, or an object of ids"),
      field("id", &Options::id, "column of what a row is about; empty: id, else name"),
      field("text", &Options::text, "column of texts; empty: text, else label, else the value, else the id"),
      field("value", &Options::value, "column of numbers that become colors; empty: value"),
      field("x", &Options::x, "column of places; empty: x"),
      field("y", &Options::y, "column of places; empty: y"),
      field("z", &Options::z, "column of places in a scene; empty: z"),
      field("font_size", &Options::font_size, {1, 1000}, "px", "of texts"),
      field("color", &Options::color, "of texts, leaders and marks without a value"),
      field("halo", &Options::halo, "behind them; transparent: none"),
      field("mark_size", &Options::mark_size, {0, 1000}, "px", "of points; 0: none"),
      field("labels", &Options::labels, "texts are written"),
      field("map", &Options::map, "from values to colors"),
      field("range", &Options::range, {-1e30, 1e30}, "", "values of the first and of the last color"),
      field("bar", &Options::bar, "a bar says what the colors stand for"),
      field("bar_label", &Options::bar_label, "what stands at the bar; empty: the value's column"),
  };
}

std::vector<Field> page_fields() {
  return {field("width", &SceneAnnotateOptions::width, {1, 65536}, "px", "of the picture"),
          field("height", &SceneAnnotateOptions::height, {1, 65536}, "px", "of the picture")};
}

std::vector<Port> inputs(ValueKind kind, const char* help) {
  return {{"source", help, kind},
          {.name = "regions",
           .help = "of an image: equal numbers of the first channel are a region",
           .kind = ValueKind::Image,
           .optional = true}};
}

std::vector<Port> outputs(const char* help) { return {{"drawing", help, ValueKind::Drawing}}; }

/// The rows; without a file none.
CsvTable table_of(const AnnotateOptions& options, const Run& run) {
  if (!options.data.empty()) return read_annotations(options.data, run);
  warn(run, "annotate: no data, nothing is written; expected data=FILE, CSV or JSON");
  CsvTable none;
  none.columns.push_back({"id", {}, {}});
  return none;
}

/// Regions are of images only.
void warn_of_regions(std::span<const Value> given, const Run& run) {
  if (given.size() > 1) warn(run, "annotate: regions are of images, and the source is none: they are not looked at");
}

std::vector<Value> result_of(Drawing drawing) {
  std::vector<Value> results;
  results.emplace_back(std::move(drawing));
  return results;
}

const Operation kAnnotateImage = value_operation<AnnotateOptions>(
    "annotate", kSummary, inputs(ValueKind::Image, "the image"), outputs("labels to draw over the image"),
    annotate_fields(), [](std::span<const Value> given, const AnnotateOptions& options, const Run& run) {
      const Image* const regions = given.size() > 1 ? given[1].image() : nullptr;
      return result_of(annotate(*given[0].image(), regions, table_of(options, run), options, run));
    });

const Operation kAnnotateScene = value_operation<SceneAnnotateOptions>(
    "annotate", kSummary, inputs(ValueKind::Scene, "the model"), outputs("labels to draw over a picture of the model"),
    joined({nested(&SceneAnnotateOptions::annotate, annotate_fields()), page_fields(),
            nested(&SceneAnnotateOptions::camera, camera_fields())}),
    [](std::span<const Value> given, const SceneAnnotateOptions& options, const Run& run) {
      warn_of_regions(given, run);
      const CsvTable table = table_of(options.annotate, run);
      return result_of(
          annotate(*given[0].scene(), options.camera, options.width, options.height, table, options.annotate, run));
    });

}  // namespace

extern const Operation kAnnotate = with_examples(
    with_variants(value_operation<AnnotateOptions>(
                      "annotate", kSummary, inputs(ValueKind::Drawing, "the drawing"),
                      outputs("the drawing with labels"), annotate_fields(),
                      [](std::span<const Value> given, const AnnotateOptions& options, const Run& run) {
                        warn_of_regions(given, run);
                        return result_of(annotate(*given[0].drawing(), table_of(options, run), options, run));
                      }),
                  {&kAnnotateImage, &kAnnotateScene}),
    {{"photo.png as:photo annotate:data=sights.csv,mark_size=10,bar_label=grams draw:onto=@photo",
      "Places of a table, written over the picture that they are of; numbers are colors."}});

}  // namespace azulejo
