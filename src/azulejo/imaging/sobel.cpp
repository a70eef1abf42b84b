#include "azulejo/imaging/sobel.h"

#include <array>
#include <cmath>

#include "azulejo/engine/operation.h"
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

/// The colors of a row of pixels as f32, multiplied by alpha if that is straight; alpha is left out.
template <class T>
void load_colors(const T* pixels, int width, int channels, bool multiply, float* colors) {
  for (int x = 0; x < width; ++x, pixels += channels, colors += channels - 1) {
    const float alpha = multiply ? static_cast<float>(pixels[channels - 1]) : 1.0F;
    for (int c = 0; c < channels - 1; ++c) colors[c] = static_cast<float>(pixels[c]) * alpha;
  }
}

class Sobel final : public TileNode {
 public:
  Sobel(const SobelOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    ImageInfo info = sources[0];
    info.channels = info.color_channels();
    info.type = PixelType::F32;
    info.color = ColorState::Data;
    info.alpha = AlphaState::None;
    set_results({info, info, info, info});
    const float full = full_range(sources[0].type);
    scale_ = sources[0].alpha == AlphaState::Straight ? 1.0F / (full * full) : 1.0F / full;
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
    const ImageInfo& info = source.pixels.info;
    const auto result_rows = [&](int y) {
      const auto row = [&](std::size_t r) {
        return results[r].wanted() ? results[r].pixels.as<float>().row(y) : nullptr;
      };
      return SobelRows{row(0), row(1), row(2), row(3)};
    };
    const int height = info.height - 2;
    const std::ptrdiff_t tap = info.color_channels();
    const auto count = static_cast<std::size_t>((info.width - 2) * tap);
    visit(source.pixels, [&](auto view) {
      using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
      if (info.alpha == AlphaState::None) {
        for (int y = 0; y < height; ++y) {
          kernel(SobelSource<T>{view.row(y) + tap, view.row(y + 1) + tap, view.row(y + 2) + tap, count, tap}, scale_,
                 result_rows(y));
        }
        return;
      }
      std::array<float*, 3> ring;
      for (float*& each : ring) each = context.scratch.take<float>(static_cast<std::size_t>(info.width * tap));
      const auto loaded = [&](int y) { return ring[static_cast<std::size_t>(y) % 3]; };
      for (int y = 0; y < info.height; ++y) {
        load_colors(view.row(y), view.width, view.channels, info.alpha == AlphaState::Straight, loaded(y));
        if (y < 2) continue;
        kernel(SobelSource<float>{loaded(y - 2) + tap, loaded(y - 1) + tap, loaded(y) + tap, count, tap}, scale_,
               result_rows(y - 2));
      }
    });
  }

  SobelOptions options_;
  float scale_ = 1;
};

}  // namespace

extern const Operation kSobel = image_operation<SobelOptions, Sobel>(
    "sobel", "Differentiates with Sobel's kernels.", {{"source", "the image"}},
    {{"magnitude", "length of the gradient"},
     {"x", "derivative to the right"},
     {"y", "derivative downwards"},
     {"orientation", "angle of the gradient in radians, counter-clockwise from the right"}},
    {field("border", &SobelOptions::border, "what lies outside the image"),
     field("border_value", &SobelOptions::border_value, {0, 1}, "", "intensity outside, for border=constant")});

void sobel(const ConstAnyView& source, const SobelViews& results, const SobelOptions& options, const Run& run) {
  apply_into(kSobel, &options, {source}, {results.magnitude, results.x, results.y, results.orientation}, run);
}

SobelResult sobel(const Image& source, const SobelOptions& options, const Run& run) {
  std::vector<Image> results = apply(kSobel, &options, {&source}, run);
  return {std::move(results[0]), std::move(results[1]), std::move(results[2]), std::move(results[3])};
}

}  // namespace azulejo
