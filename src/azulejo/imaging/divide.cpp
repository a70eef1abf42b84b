#include "azulejo/imaging/divide.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/arithmetic.h"

namespace azulejo {

extern const Operation kDivide = with_examples(
    image_operation<DivideOptions, ArithmeticStep<DivideOptions, Arithmetic::Divide>>(
        "divide", "Divides an image by another.", {{"source", "the image"}, {"other", "the divisor"}},
        {{"quotient", "f32: 1 where both are equal"}},
        {field("by_zero", &DivideOptions::by_zero, {-1e9, 1e9}, "", "the quotient where the divisor is 0")}),
    {{"photo.png divide:other=other.png", "Bright where the first picture is brighter than the second."}});

void divide(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, const DivideOptions& options,
            const Run& run) {
  apply_into(kDivide, &options, {source, other}, {result}, run);
}

Image divide(const Image& source, const Image& other, const DivideOptions& options, const Run& run) {
  return std::move(apply(kDivide, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
