#include "azulejo/imaging/multiply.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/arithmetic.h"

namespace azulejo {

extern const Operation kMultiply = with_examples(
    image_operation<MultiplyOptions, ArithmeticStep<MultiplyOptions, Arithmetic::Multiply>>(
        "multiply", "Multiplies the intensities of two images.", {{"source", "the image"}, {"other", "the factor"}},
        {{"product", "dark where either is"}}, {}),
    {{"photo.png multiply:other=other.png", "Like two slides on top of each other: dark where either is."},
     {"photo.png multiply:other=mask.png", "Black outside the mask."}});

void multiply(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
              const MultiplyOptions& options, const Run& run) {
  apply_into(kMultiply, &options, {source, other}, {result}, run);
}

Image multiply(const Image& source, const Image& other, const MultiplyOptions& options, const Run& run) {
  return std::move(apply(kMultiply, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
