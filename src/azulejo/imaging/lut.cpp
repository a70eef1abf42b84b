#include "azulejo/imaging/lut.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/lut_file.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

CurveFunction curve_function(const NumberGrid& curve) {
  constexpr int kMost = 256;
  if (curve.columns != 2 || curve.rows < 2 || curve.rows > kMost) {
    throw Error(Error::Argument, fmt::format("curve: {} rows of {} numbers, expected 2 to {} points x,y", curve.rows,
                                             curve.columns, kMost));
  }
  CurveFunction function;
  for (int i = 0; i < curve.rows; ++i) {
    const float x = curve(i, 0);
    const float y = curve(i, 1);
    if (i > 0 && !(x > curve(i - 1, 0))) {
      throw Error(Error::Argument, fmt::format("curve: x {} after {}, expected a larger one", x, curve(i - 1, 0)));
    }
    const bool last = i + 1 == curve.rows;
    function.points.push_back({x, y, last ? 0.0F : (curve(i + 1, 1) - y) / (curve(i + 1, 0) - x)});
  }
  return function;
}

Tones lut_tones(const LutOptions& options, const ImageInfo& source) {
  if (options.file.empty()) {
    if (options.scale) throw Error(Error::Argument, "scale: it is of a file's numbers, expected a file");
    return one_tone<CurveTone>(curve_function(options.curve));
  }
  if (options.curve != LutOptions{}.curve) {
    throw Error(Error::Argument, fmt::format("file: {}, given beside curve, expected one of them", options.file));
  }
  const std::vector<LutTable> tables = read_lut(options.file, options.scale);
  if (tables.size() > 1 && source.color_channels() != 3) {
    throw Error(Error::Argument, fmt::format("file: {}: a table for each of red, green and blue, expected one: {}",
                                             options.file, describe(source)));
  }
  Tones tones;
  for (const LutTable& each : tables) {
    tones.push_back(
        std::make_unique<TableTone>(TableFunction{each.first, 1.0F / (each.last - each.first), each.values}));
  }
  return tones;
}

}  // namespace

extern const Operation kLut =
    with_examples(image_operation<LutOptions, ToneNode<LutOptions, lut_tones>>(
                      "lut", "Maps intensities by a curve or a table.", {{"source", "the image"}},
                      {{"mapped", "the same through the curve"}},
                      {field("file", &LutOptions::file,
                             "path of a table: a number a line, or .cube of one dimension; instead of curve"),
                       field("curve", &LutOptions::curve, {0, 1}, "", "points of the curve, x growing"),
                       field("scale", &LutOptions::scale, {1e-6, 1e9}, "",
                             "number in the file that stands for full range; auto: 1, 255 or 65535, by its largest")}),
                  {{"photo.png lut:curve=0,0/0.3,0.15/0.7,0.85/1,1",
                    "An S: middle tones get contrast, shadows and lights lose some."},
                   {"gray.png lut:curve=0,0/0.5,1/1,0", "Bright up to middle gray and dark again beyond: solarized."}});

void lut(const ConstAnyView& source, const AnyView& result, const LutOptions& options, const Run& run) {
  apply_into(kLut, &options, {source}, {result}, run);
}

Image lut(const Image& source, const LutOptions& options, const Run& run) {
  return std::move(apply(kLut, &options, {&source}, run)[0]);
}

}  // namespace azulejo
