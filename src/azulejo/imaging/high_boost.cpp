#include "azulejo/imaging/high_boost.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/detail.h"

namespace azulejo {
namespace {

Detail::Settings settings(const HighBoostOptions& options) {
  return {.sigma = options.sigma,
          .border = {options.border, options.border_value},
          .light = options.light,
          .weights = {.base = options.boost - 1, .gain = 1}};
}

}  // namespace

extern const Operation kHighBoost = with_examples(
    image_operation<HighBoostOptions, SettingsNode<Detail, HighBoostOptions, settings>>(
        "high_boost", "Multiplies an image and takes its smooth part away.", {{"source", "the image"}},
        {{"boosted", "the same with stronger details"}},
        {field("boost", &HighBoostOptions::boost, {1, 100}, "",
               "factor of the image: 1 leaves detail only, 2 keeps the brightness"),
         field("sigma", &HighBoostOptions::sigma, {0, 1000}, "px", "standard deviation of the Gaussian"),
         field("border", &HighBoostOptions::border, "what lies outside the image"),
         field("border_value", &HighBoostOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &HighBoostOptions::light, "what is smoothed: stored values or linear light")}),
    {{"photo.png high_boost:boost=2,sigma=2", "With a factor of 2 the brightness stays and details are doubled."},
     {"dark.png high_boost:boost=2.6,sigma=2", "A larger factor brightens too."}});

void high_boost(const ConstAnyView& source, const AnyView& result, const HighBoostOptions& options, const Run& run) {
  apply_into(kHighBoost, &options, {source}, {result}, run);
}

Image high_boost(const Image& source, const HighBoostOptions& options, const Run& run) {
  return std::move(apply(kHighBoost, &options, {&source}, run)[0]);
}

}  // namespace azulejo
