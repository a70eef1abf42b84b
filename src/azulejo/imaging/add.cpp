#include "azulejo/imaging/add.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/arithmetic.h"

namespace azulejo {

extern const Operation kAdd = with_examples(
    image_operation<AddOptions, ArithmeticStep<AddOptions, Arithmetic::Add>>(
        "add", "Adds two images.", {{"source", "the image"}, {"other", "the image that is added"}},
        {{"sum", "both together, saturated"}}, {}),
    {{"photo.png add:other=other.png", "Both pictures at once, as in a double exposure; bright parts saturate."},
     {"photo.png add:other=mask.png", "Gray is added to each channel: white where the mask is."}});

void add(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, const AddOptions& options,
         const Run& run) {
  apply_into(kAdd, &options, {source, other}, {result}, run);
}

Image add(const Image& source, const Image& other, const AddOptions& options, const Run& run) {
  return std::move(apply(kAdd, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
