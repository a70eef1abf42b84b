#include "azulejo/imaging/threshold.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/point.h"
#include "azulejo/imaging/threshold_kernels.h"

namespace azulejo {

using ThresholdNode = PointNode<ThresholdOptions, kernels::ThresholdPoint, kernels::threshold>;

extern const Operation kThreshold = with_examples(
    image_operation<ThresholdOptions, ThresholdNode>(
        "threshold", "Marks what is brighter than a level.", {{"source", "the image"}},
        {{"mask", "full range where the source is above the level, 0 elsewhere"}},
        {field("level", &ThresholdOptions::level, {0, 1}, "", "intensity above which a value is foreground"),
         field("invert", &ThresholdOptions::invert, "foreground is what is not above the level")}),
    {{"gray.png threshold", "White is what is brighter than half of the range."},
     {"photo.png grayscale gaussian:sigma=2 threshold:level=0.4,invert=true",
      "The dark parts, smoothed before so that they hang together."}});

void threshold(const ConstAnyView& source, const AnyView& result, const ThresholdOptions& options, const Run& run) {
  apply_into(kThreshold, &options, {source}, {result}, run);
}

Image threshold(const Image& source, const ThresholdOptions& options, const Run& run) {
  return std::move(apply(kThreshold, &options, {&source}, run)[0]);
}

}  // namespace azulejo
