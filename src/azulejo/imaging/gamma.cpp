#include "azulejo/imaging/gamma.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

Tones power_tones(const GammaOptions& options, const ImageInfo&) {
  return one_tone<PowerTone>(PowerFunction{options.gamma});
}

}  // namespace

extern const Operation kGamma = with_examples(
    image_operation<GammaOptions, ToneNode<GammaOptions, power_tones>>(
        "gamma", "Raises intensities to a power.", {{"source", "the image"}},
        {{"corrected", "the same with middle tones brighter or darker"}},
        {field("gamma", &GammaOptions::gamma, {0.01, 100}, "", "exponent: below 1 brightens, above 1 darkens")}),
    {{"dark.png gamma:gamma=0.5", "Dark tones are spread, so that what the shadows hide is seen; black stays black."},
     {"photo.png gamma:gamma=2", "Above 1, middle tones become darker."}});

void gamma(const ConstAnyView& source, const AnyView& result, const GammaOptions& options, const Run& run) {
  apply_into(kGamma, &options, {source}, {result}, run);
}

Image gamma(const Image& source, const GammaOptions& options, const Run& run) {
  return std::move(apply(kGamma, &options, {&source}, run)[0]);
}

}  // namespace azulejo
