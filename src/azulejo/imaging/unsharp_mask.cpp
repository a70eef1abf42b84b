#include "azulejo/imaging/unsharp_mask.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/detail.h"

namespace azulejo {
namespace {

Detail::Settings settings(const UnsharpMaskOptions& options) {
  return {.sigma = options.sigma,
          .border = {options.border, options.border_value},
          .light = options.light,
          .weights = {.base = 1, .gain = options.amount, .threshold = options.threshold}};
}

}  // namespace

extern const Operation kUnsharpMask = with_examples(
    image_operation<UnsharpMaskOptions, SettingsNode<Detail, UnsharpMaskOptions, settings>>(
        "unsharp_mask", "Sharpens by adding the detail that a Gaussian removes.", {{"source", "the image"}},
        {{"sharpened", "the same with stronger details"}},
        {field("sigma", &UnsharpMaskOptions::sigma, {0, 1000}, "px", "standard deviation; 0 copies"),
         field("amount", &UnsharpMaskOptions::amount, {0, 100}, "", "how often the detail is added"),
         field("threshold", &UnsharpMaskOptions::threshold, {0, 1}, "", "smaller details stay as they are"),
         field("border", &UnsharpMaskOptions::border, "what lies outside the image"),
         field("border_value", &UnsharpMaskOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &UnsharpMaskOptions::light, "what is smoothed: stored values or linear light")}),
    {{"photo.png unsharp_mask:sigma=2,amount=1.5", "Edges and texture stand out."},
     {"noisy.png unsharp_mask:sigma=2,amount=1.5,threshold=0.1",
      "Below the threshold nothing is sharpened, and noise no further."}});

void unsharp_mask(const ConstAnyView& source, const AnyView& result, const UnsharpMaskOptions& options,
                  const Run& run) {
  apply_into(kUnsharpMask, &options, {source}, {result}, run);
}

Image unsharp_mask(const Image& source, const UnsharpMaskOptions& options, const Run& run) {
  return std::move(apply(kUnsharpMask, &options, {&source}, run)[0]);
}

}  // namespace azulejo
