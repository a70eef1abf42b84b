#include "azulejo/imaging/box.h"

#include <algorithm>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/box_kernels.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {
namespace {

using kernels::BoxWindow;
using kernels::WindowTile;

class Box final : public TileNode {
 public:
  Box(const BoxOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources),
        options_(options),
        window_{2 * options.radius + 1, 2 * options.radius_y.value_or(options.radius) + 1},
        format_(row_format(sources[0], options.light)) {
    set_results({sources[0]});
    const bool as_stored = !format_.curve && format_.alpha == RowAlpha::Plain;
    exact_ = as_stored && (format_.type == PixelType::U8 ||
                           (format_.type == PixelType::U16 && window_.pixels() <= kernels::kExactWindow16));
  }

  Rect needs(const Rect& result, int) const override { return grown(result, window_.columns / 2, window_.rows / 2); }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    if (window_.pixels() == 1) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      if constexpr (!std::is_same_v<T, float>) {
        const WindowTile<T> tile{source.data, source.stride, result.data, result.stride, result.width, result.height};
        if (exact_) return kernels::box_tile(tile, result.channels, window_, context.scratch);
      }
      const int first_row = sources[0].rect.y;
      if constexpr (std::is_same_v<T, float>) {
        if (!format_.curve && format_.alpha == RowAlpha::Plain) {
          const WindowTile<T> tile{source.data, source.stride, result.data, result.stride, result.width, result.height};
          return kernels::box_tile(tile, result.channels, window_, first_row, context.scratch);
        }
      }
      run_rows(sources[0].pixels, results[0].pixels, first_row, context.scratch);
    });
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    if (window_.pixels() == 1) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      if constexpr (!std::is_same_v<T, float>) {
        if (exact_) return average(source, result);
      }
      run_rows_reference(sources[0].pixels, results[0].pixels, sources[0].rect.y, context.scratch);
    });
  }

 private:
  /// Panels of columns, some rows at a time: what is between source and result stays in the second-level cache.
  void run_rows(const ConstAnyView& source, const AnyView& result, int first_row, Scratch& scratch) const {
    const int panel = std::max(256 / result.info.channels, window_.columns);
    const int band = std::max(64, window_.rows);
    const int margin = window_.columns - 1;
    const auto stride = static_cast<std::ptrdiff_t>(format_.values(panel + margin));
    float* const loaded = scratch.take<float>(static_cast<std::size_t>(stride * (band + window_.rows - 1)));
    float* const averages = scratch.take<float>(static_cast<std::size_t>(stride * band));
    for (int top = 0; top < result.height(); top += band) {
      const int height = std::min(band, result.height() - top);
      for (int left = 0; left < result.width(); left += panel) {
        const int width = std::min(panel, result.width() - left);
        const ConstAnyView from = source.crop({left, top, width + margin, height + window_.rows - 1});
        const AnyView to = result.crop({left, top, width, height});
        for (int y = 0; y < from.height(); ++y) load_row(format_, from.row(y), from.width(), loaded + y * stride);
        const Scratch::Mark start = scratch.mark();
        kernels::box_tile(WindowTile<float>{loaded, stride, averages, stride, width, height}, format_.channels, window_,
                          first_row + top, scratch);
        scratch.release(start);
        for (int y = 0; y < height; ++y) store_row(format_, averages + y * stride, width, to.row(y));
      }
    }
  }

  void run_rows_reference(const ConstAnyView& source, const AnyView& result, int first_row, Scratch& scratch) const {
    const auto row = static_cast<std::ptrdiff_t>(format_.values(source.width()));
    float* const loaded = scratch.take<float>(static_cast<std::size_t>(row * source.height()));
    float* const columns = scratch.take<float>(static_cast<std::size_t>(row));
    float* const averages = scratch.take<float>(static_cast<std::size_t>(row));
    for (int y = 0; y < source.height(); ++y) {
      load_row_reference(format_, source.row(y), source.width(), loaded + y * row);
    }
    for (int y = 0; y < result.height(); ++y) {
      for (std::ptrdiff_t i = 0; i < row; ++i) {
        columns[i] = kernels::anchored_sum(loaded + y * row + i, row, window_.rows, first_row + y);
      }
      for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(format_.values(result.width())); ++i) {
        const float sum = kernels::tree_sum(columns + i, format_.channels, window_.columns);
        averages[i] = sum / static_cast<float>(window_.pixels());
      }
      store_row_reference(format_, averages, result.width(), result.row(y));
    }
  }

  /// The definition for integers.
  template <class T>
  void average(const ImageView<const T>& source, const ImageView<T>& result) const {
    const std::int64_t pixels = window_.pixels();
    for (int y = 0; y < result.height; ++y) {
      for (int i = 0; i < result.width * result.channels; ++i) {
        std::int64_t sum = 0;
        for (int dy = 0; dy < window_.rows; ++dy) {
          for (int dx = 0; dx < window_.columns; ++dx) sum += source.row(y + dy)[i + dx * source.channels];
        }
        result.row(y)[i] = static_cast<T>((2 * sum + pixels) / (2 * pixels));
      }
    }
  }

  BoxOptions options_;
  BoxWindow window_;
  RowFormat format_;
  bool exact_;  ///< stored integers are summed as they are
};

}  // namespace

extern const Operation kBox = with_examples(
    image_operation<BoxOptions, Box>(
        "box", "Averages a rectangular window.", {{"source", "the image"}}, {{"result", "the smoothed image"}},
        {field("radius", &BoxOptions::radius, {0, 1000}, "px", "of the window, 2 · radius + 1 wide; 0 copies"),
         field("radius_y", &BoxOptions::radius_y, {0, 1000}, "px", "of its height; auto: as wide as high"),
         field("border", &BoxOptions::border, "what lies outside the image"),
         field("border_value", &BoxOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &BoxOptions::light, "what is averaged: stored values or linear light")}),
    {{"photo.png box:radius=4", "Smoothed; bright points become squares."},
     {"photo.png box:radius=20,radius_y=0", "Smoothed along rows only, as by a camera that moved."}});

void box(const ConstAnyView& source, const AnyView& result, const BoxOptions& options, const Run& run) {
  apply_into(kBox, &options, {source}, {result}, run);
}

Image box(const Image& source, const BoxOptions& options, const Run& run) {
  return std::move(apply(kBox, &options, {&source}, run)[0]);
}

}  // namespace azulejo
