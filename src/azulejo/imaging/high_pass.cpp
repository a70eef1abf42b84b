#include "azulejo/imaging/high_pass.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/detail.h"

namespace azulejo {
namespace {

Detail::Settings settings(const HighPassOptions& options) {
  return {.sigma = options.sigma,
          .border = {options.border, options.border_value},
          .light = options.light,
          .weights = {.base = 0, .gain = 1},
          .as_floats = true};
}

}  // namespace

extern const Operation kHighPass = with_examples(
    image_operation<HighPassOptions, SettingsNode<Detail, HighPassOptions, settings>>(
        "high_pass", "Keeps the detail that a Gaussian removes.", {{"source", "the image"}},
        {{"detail", "image minus its smooth part, f32: 0 where nothing changes"}},
        {field("sigma", &HighPassOptions::sigma, {0, 1000}, "px", "standard deviation of the Gaussian"),
         field("border", &HighPassOptions::border, "what lies outside the image"),
         field("border_value", &HighPassOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &HighPassOptions::light, "what is smoothed: stored values or linear light")}),
    {{"photo.png high_pass:sigma=3", "Positive and negative detail around 0, which is middle gray when stretched."}});

void high_pass(const ConstAnyView& source, const AnyView& result, const HighPassOptions& options, const Run& run) {
  apply_into(kHighPass, &options, {source}, {result}, run);
}

Image high_pass(const Image& source, const HighPassOptions& options, const Run& run) {
  return std::move(apply(kHighPass, &options, {&source}, run)[0]);
}

}  // namespace azulejo
