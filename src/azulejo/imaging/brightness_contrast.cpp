#include "azulejo/imaging/brightness_contrast.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

Tones linear_tones(const BrightnessContrastOptions& options, const ImageInfo&) {
  const float offset = (0.5F - 0.5F * options.contrast) + options.brightness;
  return one_tone<LinearTone>(LinearFunction{.scale = options.contrast, .offset = offset});
}

}  // namespace

extern const Operation kBrightnessContrast = with_examples(
    image_operation<BrightnessContrastOptions, ToneNode<BrightnessContrastOptions, linear_tones>>(
        "brightness_contrast", "Adds to intensities, and scales them around middle gray.", {{"source", "the image"}},
        {{"adjusted", "the same, brighter or darker, with more or less contrast"}},
        {field("brightness", &BrightnessContrastOptions::brightness, {-1, 1}, "", "intensity that is added"),
         field("contrast", &BrightnessContrastOptions::contrast, {0, 100}, "", "factor around middle gray")}),
    {{"photo.png brightness_contrast:contrast=1.5",
      "More contrast: what is brighter than middle gray becomes brighter "
      "still, what is darker darker."},
     {"photo.png brightness_contrast:brightness=0.2,contrast=0.5", "Bright and flat."}});

void brightness_contrast(const ConstAnyView& source, const AnyView& result, const BrightnessContrastOptions& options,
                         const Run& run) {
  apply_into(kBrightnessContrast, &options, {source}, {result}, run);
}

Image brightness_contrast(const Image& source, const BrightnessContrastOptions& options, const Run& run) {
  return std::move(apply(kBrightnessContrast, &options, {&source}, run)[0]);
}

}  // namespace azulejo
