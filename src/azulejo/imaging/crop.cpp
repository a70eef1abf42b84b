#include "azulejo/imaging/crop.h"

#include <fmt/format.h>

#include <cmath>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"

namespace azulejo {
namespace {

int nearest(double length) { return static_cast<int>(std::floor(length + 0.5)); }

/// The part of an image that the options ask for.
Rect part_of(const CropOptions& options, const ImageInfo& info) {
  if (options.rect && options.size) throw Error(Error::Argument, "size: given beside rect, expected one of them");
  const bool fractions = options.unit == LengthUnit::Fractions;
  const double across = fractions ? info.width : 1;
  const double down = fractions ? info.height : 1;
  Rect part = info.rect();
  if (options.rect) {
    const auto [left, top, width, height] = *options.rect;
    part = rect_between(nearest(left * across), nearest(top * down), nearest((double{left} + width) * across),
                        nearest((double{top} + height) * down));
  } else if (options.size) {
    const auto [width, height] = *options.size;
    part = {0, 0, nearest(width * across), nearest(height * down)};
    part.x = free_left(options.anchor, info.width - part.width);
    part.y = free_above(options.anchor, info.height - part.height);
  }
  if (part.empty() || !info.rect().contains(part)) {
    throw Error(Error::Argument,
                fmt::format("{}: {}×{} pixels from {}, {}, expected a part of {}×{}", options.size ? "size" : "rect",
                            part.width, part.height, part.x, part.y, info.width, info.height));
  }
  return part;
}

class Crop final : public TileNode {
 public:
  Crop(const CropOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), part_(part_of(options, sources[0])) {
    ImageInfo info = sources[0];
    info.width = part_.width;
    info.height = part_.height;
    set_results({info});
  }

  Rect needs(const Rect& result, int) const override {
    return {result.x + part_.x, result.y + part_.y, result.width, result.height};
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext&) const override {
    if (from[0].pixels.data != results[0].pixels.data) copy_pixels(from[0].pixels, results[0].pixels);
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(from, results, context);
  }

 private:
  Rect part_;
};

}  // namespace

extern const Operation kCrop = with_examples(
    image_operation<CropOptions, Crop>(
        "crop", "Takes a part of an image.", {{"source", "the image"}}, {{"part", "its bytes, unchanged"}},
        {field("rect", &CropOptions::rect, {0, 1e6}, "", "left, top, width, height; auto: all"),
         field("size", &CropOptions::size, {0, 1e6}, "", "width, height, instead of rect: placed by anchor"),
         field("anchor", &CropOptions::anchor, "where a part of that size lies"),
         field("unit", &CropOptions::unit, "of rect and size: pixels, or fractions of the image's size")}),
    {{"photo.png crop:rect=0.25,0.25,0.5,0.5,unit=fractions", "The middle quarter of the area."},
     {"photo.png crop:size=96,96,anchor=bottom_right", "A square out of a corner."}});

void crop(const ConstAnyView& source, const AnyView& result, const CropOptions& options, const Run& run) {
  apply_into(kCrop, &options, {source}, {result}, run);
}

Image crop(const Image& source, const CropOptions& options, const Run& run) {
  return std::move(apply(kCrop, &options, {&source}, run)[0]);
}

}  // namespace azulejo
