#include "azulejo/imaging/posterize.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

Tones step_tones(const PosterizeOptions& options, const ImageInfo&) {
  return one_tone<StepTone>(StepFunction{static_cast<float>(options.levels - 1)});
}

}  // namespace

extern const Operation kPosterize =
    with_examples(image_operation<PosterizeOptions, ToneNode<PosterizeOptions, step_tones>>(
                      "posterize", "Leaves few intensities.", {{"source", "the image"}},
                      {{"posterized", "the same in a few levels of each channel"}},
                      {field("levels", &PosterizeOptions::levels, {2, 65536}, "", "intensities of each channel")}),
                  {{"photo.png posterize:levels=4", "Four levels a channel, as in a poster of few inks."},
                   {"gray.png posterize:levels=8", "Smooth shading falls into steps: false contours."}});

void posterize(const ConstAnyView& source, const AnyView& result, const PosterizeOptions& options, const Run& run) {
  apply_into(kPosterize, &options, {source}, {result}, run);
}

Image posterize(const Image& source, const PosterizeOptions& options, const Run& run) {
  return std::move(apply(kPosterize, &options, {&source}, run)[0]);
}

}  // namespace azulejo
