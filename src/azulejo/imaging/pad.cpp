#include "azulejo/imaging/pad.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/plan.h"
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

  /// The part of the image that stands for the result: what lies outside is made of it here.
  Rect needs(const Rect& result, int) const override {
    const ImageInfo& image = sources()[0];
    const int left = result.x + place_.x;
    const int top = result.y + place_.y;
    const Span1 columns = covering(left, std::int64_t{left} + result.width, image.width, border_);
    const Span1 rows = covering(top, std::int64_t{top} + result.height, image.height, border_);
    return rect_between(columns.low, rows.low, columns.high, rows.high);
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    const std::size_t bytes = sources()[0].pixel_bytes();
    const auto with_bytes = [&](auto... sizes) {
      ((sizes() == bytes ? fill<sizes()>(from[0], results[0], context.scratch) : void()), ...);
    };
    using std::integral_constant;
    using Size = std::size_t;
    with_bytes(integral_constant<Size, 1>(), integral_constant<Size, 2>(), integral_constant<Size, 3>(),
               integral_constant<Size, 4>(), integral_constant<Size, 6>(), integral_constant<Size, 8>(),
               integral_constant<Size, 12>(), integral_constant<Size, 16>());
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(from, results, context);
  }

 private:
  /// For pixels of kBytes bytes.
  template <std::size_t kBytes>
  void fill(const ConstTile& from, const Tile& to, Scratch& scratch) const {
    const ImageInfo& image = sources()[0];
    const int left = to.rect.x + place_.x;
    const int width = to.rect.width;
    const int inside_left = std::clamp(-left, 0, width);
    const int inside_right = std::clamp(image.width - left, inside_left, width);
    const auto offset = [](int pixels) { return static_cast<std::ptrdiff_t>(pixels) * std::ptrdiff_t{kBytes}; };
    // Where the pixels beside the image come from; < 0: nowhere.
    auto* const beside = scratch.take<std::ptrdiff_t>(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
      const int column = border_index(std::int64_t{left} + x, image.width, border_);
      beside[x] = column < 0 ? -1 : offset(column - from.rect.x);
    }
    for (int y = 0; y < to.rect.height; ++y) {
      std::byte* const row = to.pixels.row(y);
      const int line = border_index(std::int64_t{to.rect.y} + place_.y + y, image.height, border_);
      const std::byte* const source = line < 0 ? nullptr : from.pixels.row(line - from.rect.y);
      const auto outside = [&](int begin, int end) {
        for (int x = begin; x < end; ++x) {
          const bool nowhere = source == nullptr || beside[x] < 0;
          std::memcpy(row + offset(x), nowhere ? outside_.data() : source + beside[x], kBytes);
        }
      };
      if (source == nullptr) {
        outside(0, width);
        continue;
      }
      outside(0, inside_left);
      outside(inside_right, width);
      const std::byte* const middle = source + offset(left + inside_left - from.rect.x);
      if (inside_left < inside_right && middle != row + offset(inside_left)) {
        std::memcpy(row + offset(inside_left), middle, static_cast<std::size_t>(offset(inside_right - inside_left)));
      }
    }
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
