#include "azulejo/imaging/laplacian.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/derivative_rows.h"
#include "azulejo/imaging/laplacian_kernels.h"

namespace azulejo {
namespace {

/// The scalar definition of kernels::laplacian_row.
template <class T>
void reference_row(const kernels::SobelSource<T>& source, bool eight, float scale, float* result) {
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(source.count); ++i) {
    const auto less = [&](const T* row, std::ptrdiff_t step) {
      return static_cast<float>(row[i + step * source.tap]) - static_cast<float>(source.at[i]);
    };
    float sum = (less(source.above, 0) + less(source.below, 0)) + (less(source.at, -1) + less(source.at, 1));
    if (eight) {
      sum = sum + ((less(source.above, -1) + less(source.above, 1)) + (less(source.below, -1) + less(source.below, 1)));
    }
    result[i] = sum * scale;
  }
}

class Laplacian final : public TileNode {
 public:
  Laplacian(const LaplacianOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options), scale_(derivative_scale(sources[0])) {
    set_results({derivative_info(sources[0])});
  }

  Rect needs(const Rect& result, int) const override { return grown(result, 1, 1); }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    for_derivative_rows(sources[0], context.scratch, [&](const auto& from, int y) {
      kernels::laplacian_row(from, eight(), scale_, results[0].pixels.as<float>().row(y));
    });
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    for_derivative_rows(sources[0], context.scratch, [&](const auto& from, int y) {
      reference_row(from, eight(), scale_, results[0].pixels.as<float>().row(y));
    });
  }

 private:
  bool eight() const { return options_.neighbors == Neighbors::Eight; }

  LaplacianOptions options_;
  float scale_;
};

}  // namespace

extern const Operation kLaplacian = with_examples(
    image_operation<LaplacianOptions, Laplacian>(
        "laplacian", "Sums the differences to the neighbors.", {{"source", "the image"}},
        {{"laplacian", "f32: positive in dark places, negative in bright ones, 0 on even slopes"}},
        {field("neighbors", &LaplacianOptions::neighbors, "how many pixels around count"),
         field("border", &LaplacianOptions::border, "what lies outside the image"),
         field("border_value", &LaplacianOptions::border_value, {0, 1}, "", "intensity outside, for border=constant")}),
    {{"gray.png gaussian:sigma=1.5 laplacian",
      "Edges are where it changes its sign; smoothed before, as it answers to noise."}});

void laplacian(const ConstAnyView& source, const AnyView& result, const LaplacianOptions& options, const Run& run) {
  apply_into(kLaplacian, &options, {source}, {result}, run);
}

Image laplacian(const Image& source, const LaplacianOptions& options, const Run& run) {
  return std::move(apply(kLaplacian, &options, {&source}, run)[0]);
}

}  // namespace azulejo
