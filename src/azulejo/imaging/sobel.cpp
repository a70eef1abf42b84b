#include "azulejo/imaging/sobel.h"

#include <cmath>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/derivative_rows.h"
#include "azulejo/imaging/sobel_kernels.h"
#include "azulejo/math/arctangent.h"

namespace azulejo {
namespace {

using kernels::SobelRows;
using kernels::SobelSource;

/// The scalar definition of kernels::sobel_row.
template <class T>
void reference_row(const SobelSource<T>& source, float scale, const SobelRows& rows) {
  const auto value = [](const T* row, std::ptrdiff_t i) { return static_cast<float>(row[i]); };
  const auto weighted = [](float outer0, float outer1, float inner) { return (outer0 + outer1) + (inner + inner); };
  const std::ptrdiff_t tap = source.tap;
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(source.count); ++i) {
    const auto column = [&](std::ptrdiff_t at) {
      return weighted(value(source.above, at), value(source.below, at), value(source.at, at));
    };
    const auto row = [&](const T* of) { return weighted(value(of, i - tap), value(of, i + tap), value(of, i)); };
    const float dx = column(i + tap) - column(i - tap);
    const float dy = row(source.below) - row(source.above);
    if (rows.magnitude != nullptr) rows.magnitude[i] = std::sqrt(dx * dx + dy * dy) * scale;
    if (rows.x != nullptr) rows.x[i] = dx * scale;
    if (rows.y != nullptr) rows.y[i] = dy * scale;
    if (rows.orientation != nullptr) rows.orientation[i] = atan2_deterministic(0.0F - dy, dx);
  }
}

class Sobel final : public TileNode {
 public:
  Sobel(const SobelOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    const ImageInfo info = derivative_info(sources[0]);
    set_results({info, info, info, info});
    scale_ = derivative_scale(sources[0]);
  }

  Rect needs(const Rect& result, int) const override { return grown(result, 1, 1); }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    rows(sources[0], results, context, [](const auto&... arguments) { kernels::sobel_row(arguments...); });
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    rows(sources[0], results, context, [](const auto&... arguments) { reference_row(arguments...); });
  }

 private:
  template <class RowKernel>
  void rows(const ConstTile& source, std::span<const Tile> results, const TileContext& context,
            const RowKernel& kernel) const {
    for_derivative_rows(source, context.scratch, [&](const auto& from, int y) {
      const auto row = [&](std::size_t r) {
        return results[r].wanted() ? results[r].pixels.as<float>().row(y) : nullptr;
      };
      kernel(from, scale_, SobelRows{row(0), row(1), row(2), row(3)});
    });
  }

  SobelOptions options_;
  float scale_ = 1;
};

}  // namespace

extern const Operation kSobel = with_examples(
    image_operation<SobelOptions, Sobel>(
        "sobel", "Differentiates with Sobel's kernels.", {{"source", "the image"}},
        {{"magnitude", "length of the gradient"},
         {"x", "derivative to the right"},
         {"y", "derivative downwards"},
         {"orientation", "angle of the gradient in radians, counter-clockwise from the right"}},
        {field("border", &SobelOptions::border, "what lies outside the image"),
         field("border_value", &SobelOptions::border_value, {0, 1}, "", "intensity outside, for border=constant")}),
    {{"gray.png sobel convert:normalize=true", "Edges are bright: the length of the gradient, stretched to bytes."},
     {"gray.png gaussian:sigma=2 sobel as:s @s.orientation pseudo_color:map=cyclic,low=-3.1416,high=3.1416",
      "The direction of the gradient as a hue."}});

void sobel(const ConstAnyView& source, const SobelViews& results, const SobelOptions& options, const Run& run) {
  apply_into(kSobel, &options, {source}, {results.magnitude, results.x, results.y, results.orientation}, run);
}

SobelResult sobel(const Image& source, const SobelOptions& options, const Run& run) {
  std::vector<Image> results = apply(kSobel, &options, {&source}, run);
  return {std::move(results[0]), std::move(results[1]), std::move(results[2]), std::move(results[3])};
}

}  // namespace azulejo
