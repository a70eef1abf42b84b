#include "azulejo/imaging/difference.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/arithmetic.h"

namespace azulejo {

extern const Operation kDifference = with_examples(
    image_operation<DifferenceOptions, ArithmeticStep<DifferenceOptions, Arithmetic::Difference>>(
        "difference", "Shows how far two images differ, without sign.",
        {{"source", "the image"}, {"other", "the image that it is compared with"}},
        {{"difference", "dark where both are alike"}}, {}),
    {{"photo.png difference:other=later.png", "What moved: the orange where it was, and where it is."},
     {"gray.png difference:other=noisy.png contrast_stretch", "What the noise did, stretched to be seen."}});

void difference(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                const DifferenceOptions& options, const Run& run) {
  apply_into(kDifference, &options, {source, other}, {result}, run);
}

Image difference(const Image& source, const Image& other, const DifferenceOptions& options, const Run& run) {
  return std::move(apply(kDifference, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
