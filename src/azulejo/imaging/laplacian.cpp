#include "azulejo/imaging/laplacian.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/linear_filter.h"

namespace azulejo {
namespace {

LinearSum laplacian_sum(LaplacianNeighbors neighbors) {
  const bool four = neighbors == LaplacianNeighbors::Four;
  const NumberGrid kernel =
      four ? NumberGrid{3, 3, {0, 1, 0, 1, -4, 1, 0, 1, 0}} : NumberGrid{3, 3, {1, 1, 1, 1, -8, 1, 1, 1, 1}};
  return {.kernel = kernel, .center_row = 1, .center_column = 1, .as_f32 = true};
}

class Laplacian final : public LinearFilterNode {
 public:
  Laplacian(const LaplacianOptions& options, std::span<const ImageInfo> sources)
      : LinearFilterNode(laplacian_sum(options.neighbors), {options.border, options.border_value}, sources) {}
};

}  // namespace

extern const Operation kLaplacian = with_examples(
    image_operation<LaplacianOptions, Laplacian>(
        "laplacian", "Sums second derivatives: neighbors minus the pixel.", {{"source", "the image"}},
        {{"result", "f32 in units of full range, negative in bright spots and lines"}},
        {field("neighbors", &LaplacianOptions::neighbors, "whether diagonal neighbors count"),
         field("border", &LaplacianOptions::border, "what lies outside the image"),
         field("border_value", &LaplacianOptions::border_value, {0, 1}, "", "intensity outside, for border=constant")}),
    {{"gray.png laplacian", "The dark sides of edges light up; surfaces are black, as is all that is negative."}});

void laplacian(const ConstAnyView& source, const AnyView& result, const LaplacianOptions& options, const Run& run) {
  apply_into(kLaplacian, &options, {source}, {result}, run);
}

Image laplacian(const Image& source, const LaplacianOptions& options, const Run& run) {
  return std::move(apply(kLaplacian, &options, {&source}, run)[0]);
}

}  // namespace azulejo
