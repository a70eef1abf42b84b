#include "azulejo/modelling/path_boolean.h"

#include "azulejo/engine/operation.h"
#include "azulejo/modelling/path_polygon.h"

namespace azulejo {
namespace {

std::vector<Value> run_path_boolean(std::span<const Value> inputs, const PathBooleanOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(path_boolean(*inputs[0].drawing(), *inputs[1].drawing(), options, run));
  return results;
}

}  // namespace

extern const Operation kPathBoolean = with_examples(
    value_operation<PathBooleanOptions>(
        "path_boolean", "Unites, intersects or subtracts what two drawings fill.",
        {{"source", "the first drawing", ValueKind::Drawing}, {"other", "the second drawing", ValueKind::Drawing}},
        {{"drawing", "one path: outlines and holes", ValueKind::Drawing}},
        {field("mode", &PathBooleanOptions::mode, "what is kept: in either, in both, in the first alone, in one only"),
         field("tolerance", &PathBooleanOptions::tolerance, {1e-6, 1e6}, "", "how far lines may be from curves")},
        run_path_boolean),
    {{"star.svg path_boolean:other=disk.svg draw", "The union, in the color of the first."},
     {"star.svg path_boolean:other=disk.svg,mode=difference draw", "The star without the disk."},
     {"star.svg path_boolean:other=disk.svg,mode=xor draw", "What is in one of them only."}});

Drawing path_boolean(const Drawing& a, const Drawing& b, const PathBooleanOptions& options, const Run& run) {
  kPathBoolean.check(&options);
  const Polygon first = filled_area(a, options.tolerance, run);
  const Polygon second = filled_area(b, options.tolerance, run);
  Drawing result;
  result.width = a.width;
  result.height = a.height;
  result.unit = a.unit;
  result.patterns = a.patterns;
  DrawingStyle style;
  for (const PlacedPath& placed : walk(a)) {
    if (!a.styles[a.paths[placed.path].style].fill) continue;
    style = placed_style(a, placed, result);
    break;
  }
  style.stroke.reset();
  style.points.reset();
  result.add_path(path_of(boolean(first, second, options.mode, run)), result.add_style(style));
  return result;
}

}  // namespace azulejo
