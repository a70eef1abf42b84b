#include "azulejo/vision/height_field.h"

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/vision/height_grid.h"

namespace azulejo {
namespace {

std::vector<Value> run_height_field(std::span<const Value> inputs, const HeightFieldOptions& options, const Run& run) {
  const bool image = !inputs.empty() && !inputs[0].empty();
  if (image != options.file.empty()) {
    throw Error(Error::Argument, image ? "file is given beside an image, expected one of them"
                                       : "neither an image nor a file, expected one of them");
  }
  std::vector<Value> results;
  results.emplace_back(image ? height_field(inputs[0].image()->any(), options, run)
                             : height_field(options.file, options, run));
  return results;
}

}  // namespace

extern const Operation kHeightField = with_examples(
    value_operation<HeightFieldOptions>(
        "height_field", "Makes a landscape of an image, or of a table: bright is high.",
        {{.name = "source", .help = "the image", .kind = ValueKind::Image, .optional = true}},
        {{"mesh", "the surface, a vertex a pixel, y up", ValueKind::Mesh}},
        {field("channel", &HeightFieldOptions::channel, "what is taken for the height"),
         field("height", &HeightFieldOptions::height, {-1e6, 1e6}, "", "of an intensity of 1, of a table's 1"),
         field("spacing", &HeightFieldOptions::spacing, {1e-6, 1e6}, "",
               "from sample to sample; auto: the longer side is 2"),
         field("base", &HeightFieldOptions::base, {-1e9, 1e9}, "",
               "where a flat bottom lies, with walls to it; auto: it is open"),
         field("file", &HeightFieldOptions::file,
               "a table of numbers (.csv) instead of an image; empty cells are holes")},
        run_height_field),
    {{"gray.png resize:width=200 gaussian:sigma=1 height_field render:elevation_deg=50",
      "The photograph as a relief."}});

Mesh height_field(const ConstAnyView& image, const HeightFieldOptions& options, const Run& run) {
  kHeightField.check(&options);
  return height_mesh(height_grid(image, options, run), options, run);
}

Mesh height_field(const std::string& csv_file, const HeightFieldOptions& options, const Run& run) {
  kHeightField.check(&options);
  return height_mesh(height_grid(csv_file, options, run), options, run);
}

}  // namespace azulejo
