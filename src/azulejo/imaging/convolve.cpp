#include "azulejo/imaging/convolve.h"

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/kernel_factors.h"
#include "azulejo/imaging/kernel_file.h"
#include "azulejo/imaging/linear_filter.h"

namespace azulejo {
namespace {

LinearSum linear_sum(const ConvolveOptions& options) {
  const KernelFile given = chosen_kernel(options.kernel, ConvolveOptions{}.kernel, options.file);
  const NumberGrid& kernel = given.kernel;
  LinearSum sum{.kernel = kernel,
                .center_row = kernel.rows / 2,
                .center_column = kernel.columns / 2,
                .scale = options.scale / given.full,
                .offset = options.offset,
                .as_f32 = options.output == FilterOutput::F32,
                .light = options.light};
  if (options.normalize) {
    const KernelSum total = kernel_sum(kernel.values);
    if (total.is(0)) throw Error(Error::Argument, "normalize: the weights sum to 0, expected another sum");
    sum.scale = static_cast<float>(double{options.scale} / total.sum);
  }
  if (!options.correlate) {
    sum.kernel = turned(kernel);
    sum.center_row = kernel.rows - 1 - sum.center_row;
    sum.center_column = kernel.columns - 1 - sum.center_column;
  }
  return sum;
}

class Convolve final : public LinearFilterNode {
 public:
  Convolve(const ConvolveOptions& options, std::span<const ImageInfo> sources)
      : LinearFilterNode(linear_sum(options), {options.border, options.border_value}, sources) {}
};

}  // namespace

extern const Operation kConvolve = with_examples(
    image_operation<ConvolveOptions, Convolve>(
        "convolve", "Weighs neighbors by any kernel.", {{"source", "the image"}}, {{"result", "the weighted sums"}},
        {field("kernel", &ConvolveOptions::kernel, {-1e6, 1e6}, "", "weights, up to 255 rows and columns"),
         field("file", &ConvolveOptions::file, "text or an image of one channel that holds the weights instead"),
         field("correlate", &ConvolveOptions::correlate,
               "the kernel is laid on the image as it is, not turned by 180°"),
         field("normalize", &ConvolveOptions::normalize, "weights are divided by their sum"),
         field("scale", &ConvolveOptions::scale, {-1e6, 1e6}, "", "factor of the sum"),
         field("offset", &ConvolveOptions::offset, {-1e3, 1e3}, "", "intensity added to the sum"),
         field("output", &ConvolveOptions::output, "same: the source's type, saturated; f32: negative values stay"),
         field("border", &ConvolveOptions::border, "what lies outside the image"),
         field("border_value", &ConvolveOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &ConvolveOptions::light, "what is weighted: stored values or linear light")}),
    {{"photo.png convolve", "The default kernel sharpens: each pixel five times, less its four neighbors."},
     {"photo.png convolve:kernel=-2,-1,0/-1,1,1/0,1,2",
      "An emboss kernel lights the picture from one corner: edges stand out in relief, surfaces keep their colors."},
     {"gray.png convolve:kernel=-1,0,1/-2,0,2/-1,0,1,offset=0.5,scale=0.5",
      "A derivative to the left on middle gray: vertical edges are bright or dark by their direction."}});

void convolve(const ConstAnyView& source, const AnyView& result, const ConvolveOptions& options, const Run& run) {
  apply_into(kConvolve, &options, {source}, {result}, run);
}

Image convolve(const Image& source, const ConvolveOptions& options, const Run& run) {
  return std::move(apply(kConvolve, &options, {&source}, run)[0]);
}

}  // namespace azulejo
