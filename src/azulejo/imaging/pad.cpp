#include "azulejo/imaging/pad.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

using PixelBytes = std::array<std::byte, 16>;

/// The color as pixels of this kind store it.
PixelBytes stored_color(const Color& color, const ImageInfo& info) {
  const bool has_alpha = info.alpha != AlphaState::None;
  std::array<float, 4> channels{color.r, color.g, color.b, color.a};
  const int colors = info.color_channels();
  if (colors == 1) channels[0] = (0.299F * color.r + 0.587F * color.g) + 0.114F * color.b;
  for (int c = 0; c < colors; ++c) {
    float& value = channels[static_cast<std::size_t>(std::min(c, 2))];
    if (c < 3 && info.color == ColorState::Linear) value = srgb_to_linear(value);
    if (c < 3 && info.alpha != AlphaState::Straight) value *= color.a;
  }
  PixelBytes bytes{};
  visit_type(info.type, [&](auto zero) {
    using T = decltype(zero);
    for (int c = 0; c < info.channels; ++c) {
      const bool is_alpha = has_alpha && c == colors;
      const float value = channels[is_alpha ? 3 : static_cast<std::size_t>(std::min(c, 2))];
      const T stored = rounded<T>(value * full_range(info.type));
      std::memcpy(bytes.data() + static_cast<std::size_t>(c) * sizeof(T), &stored, sizeof(T));
    }
  });
  return bytes;
}

/// The result, in which the image lies at (−x, −y).
Rect padded(const PadOptions& options, const ImageInfo& info) {
  if (!options.size) {
    return rect_between(-options.left, -options.top, info.width + options.right, info.height + options.bottom);
  }
  if (options.left != 0 || options.right != 0 || options.top != 0 || options.bottom != 0) {
    throw Error(Error::Argument, "size: given beside left, right, top or bottom, expected one way to say it");
  }
  const auto [width, height] = *options.size;
  if (width != std::floor(width) || height != std::floor(height) || width < static_cast<float>(info.width) ||
      height < static_cast<float>(info.height)) {
    throw Error(Error::Argument, fmt::format("size: {}×{}, expected whole numbers, at least {}×{}", width, height,
                                             info.width, info.height));
  }
  const Rect size{0, 0, static_cast<int>(width), static_cast<int>(height)};
  return {-free_left(options.anchor, size.width - info.width), -free_above(options.anchor, size.height - info.height),
          size.width, size.height};
}

class Pad final : public TileNode {
 public:
  Pad(const PadOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), border_(options.border), place_(padded(options, sources[0])) {
    ImageInfo info = sources[0];
    info.width = place_.width;
    info.height = place_.height;
    const Color fallback{0, 0, 0, info.alpha == AlphaState::None ? 1.0F : 0.0F};
    outside_ = stored_color(options.color.value_or(fallback), info);
    set_results({info});
  }

  Rect needs(const Rect& result, int) const override {
    return {result.x + place_.x, result.y + place_.y, result.width, result.height};
  }
  BorderRule border(int) const override { return {border_, 0}; }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext&) const override {
    const AnyView& to = results[0].pixels;
    if (from[0].pixels.data != to.data) copy_pixels(from[0].pixels, to);
    if (border_ != Border::Constant) return;
    const ImageInfo& image = sources()[0];
    const Rect& rect = from[0].rect;
    const int inside_left = std::clamp(-rect.x, 0, rect.width);
    const int inside_right = std::clamp(image.width - rect.x, inside_left, rect.width);
    for (int y = 0; y < rect.height; ++y) {
      const bool inside = rect.y + y >= 0 && rect.y + y < image.height;
      fill(to.row(y), 0, inside ? inside_left : rect.width);
      if (inside) fill(to.row(y), inside_right, rect.width);
    }
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(from, results, context);
  }

 private:
  /// Pixels from `begin` to before `end` of a row.
  void fill(std::byte* row, int begin, int end) const {
    const std::size_t bytes = sources()[0].pixel_bytes();
    for (int x = begin; x < end; ++x) std::memcpy(row + static_cast<std::size_t>(x) * bytes, outside_.data(), bytes);
  }

  Border border_;
  Rect place_;
  PixelBytes outside_;
};

}  // namespace

extern const Operation kPad = with_examples(
    image_operation<PadOptions, Pad>(
        "pad", "Adds rows and columns around an image.", {{"source", "the image"}},
        {{"padded", "the image with what is added"}},
        {field("left", &PadOptions::left, {0, 100'000}, "px", "columns that are added"),
         field("right", &PadOptions::right, {0, 100'000}, "px", "columns that are added"),
         field("top", &PadOptions::top, {0, 100'000}, "px", "rows that are added"),
         field("bottom", &PadOptions::bottom, {0, 100'000}, "px", "rows that are added"),
         field("size", &PadOptions::size, {1, 1e6}, "px", "width, height of the result, instead of those four"),
         field("anchor", &PadOptions::anchor, "where the image lies in that size"),
         field("border", &PadOptions::border, "what is added"),
         field("color", &PadOptions::color, "of border=constant; auto: transparent where there is alpha, else black")}),
    {{"photo.png pad:left=24,right=24,top=24,bottom=24,color=orange", "A frame."},
     {"photo.png pad:left=64,right=64,top=64,bottom=64,border=mirror", "The picture goes on, mirrored at its edges."}});

void pad(const ConstAnyView& source, const AnyView& result, const PadOptions& options, const Run& run) {
  apply_into(kPad, &options, {source}, {result}, run);
}

Image pad(const Image& source, const PadOptions& options, const Run& run) {
  return std::move(apply(kPad, &options, {&source}, run)[0]);
}

}  // namespace azulejo
