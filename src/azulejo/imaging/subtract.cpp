#include "azulejo/imaging/subtract.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/arithmetic.h"

namespace azulejo {

extern const Operation kSubtract = with_examples(
    image_operation<SubtractOptions, ArithmeticStep<SubtractOptions, Arithmetic::Subtract>>(
        "subtract", "Subtracts an image from another, with sign.",
        {{"source", "the image"}, {"other", "the image that is subtracted"}},
        {{"difference", "f32, in units of full range"}}, {}),
    {{"noisy.png subtract:other=gray.png brightness_contrast:brightness=0.5", "The noise alone, around middle gray."}});

void subtract(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
              const SubtractOptions& options, const Run& run) {
  apply_into(kSubtract, &options, {source, other}, {result}, run);
}

Image subtract(const Image& source, const Image& other, const SubtractOptions& options, const Run& run) {
  return std::move(apply(kSubtract, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
