#include "azulejo/imaging/level_slice.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

Tones slice_tones(const LevelSliceOptions& options, const ImageInfo&) {
  if (options.low > options.high) {
    throw Error(Error::Argument, fmt::format("low: {}, expected at most high: {}", options.low, options.high));
  }
  return one_tone<SliceTone>(SliceFunction{options.low, options.high, options.level, options.keep});
}

}  // namespace

extern const Operation kLevelSlice = with_examples(
    image_operation<LevelSliceOptions, ToneNode<LevelSliceOptions, slice_tones>>(
        "level_slice", "Shows a band of intensities.", {{"source", "the image"}},
        {{"sliced", "one level in the band; elsewhere 0, or the source"}},
        {field("low", &LevelSliceOptions::low, {0, 1}, "", "intensity at which the band begins"),
         field("high", &LevelSliceOptions::high, {0, 1}, "", "intensity at which it ends"),
         field("level", &LevelSliceOptions::level, {0, 1}, "", "intensity that the band becomes"),
         field("keep", &LevelSliceOptions::keep, "what is outside the band stays as it is, instead of 0")}),
    {{"gray.png level_slice:low=0.3,high=0.5", "White is what was between 0.3 and 0.5 of the range."},
     {"gray.png level_slice:low=0.3,high=0.5,keep=true", "The same band, the rest as it was."}});

void level_slice(const ConstAnyView& source, const AnyView& result, const LevelSliceOptions& options, const Run& run) {
  apply_into(kLevelSlice, &options, {source}, {result}, run);
}

Image level_slice(const Image& source, const LevelSliceOptions& options, const Run& run) {
  return std::move(apply(kLevelSlice, &options, {&source}, run)[0]);
}

}  // namespace azulejo
