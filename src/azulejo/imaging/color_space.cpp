#include "azulejo/imaging/color_space.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/color_space_kernels.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {
namespace {

using color::Pixel;

ColorSpace space_of(const ColorSpaceOptions& options, const ImageInfo& info) {
  if (options.from) return *options.from;
  if (info.color == ColorState::Data) {
    throw Error(Error::Argument, fmt::format("from: auto for {}, expected the space of its values", describe(info)));
  }
  return info.color == ColorState::Linear ? ColorSpace::Linear : ColorSpace::Srgb;
}

ColorState state_of(ColorSpace space) {
  if (space == ColorSpace::Srgb) return ColorState::Srgb;
  return space == ColorSpace::Linear ? ColorState::Linear : ColorState::Data;
}

/// The definition for a pixel of 3 channels, or of 4.
template <class T>
void convert_pixel(const ColorPlan& plan, const T* source, T* result) {
  const auto alpha = plan.premultiplied ? static_cast<float>(source[3]) : 1.0F;
  const auto load = [&](T value) {
    const auto number = static_cast<float>(value);
    if (!plan.premultiplied) return number * plan.load_scale;
    return alpha == 0 ? 0.0F : (number / alpha) * plan.load_scale;
  };
  Pixel pixel{load(source[0]), load(source[1]), load(source[2])};
  // 0, or NaN if a value isn't finite: such pixels are calculated as black.
  const float rest = (pixel.c0 - pixel.c0) + (pixel.c1 - pixel.c1) + (pixel.c2 - pixel.c2);
  if (rest != 0) pixel = {0, 0, 0};
  for (const ColorStep& each : plan.steps()) pixel = apply_step(each, plan, pixel);
  const auto store = [&](float value) {
    float number = value * plan.store_scale;
    if (plan.premultiplied) number = alpha == 0 ? 0.0F : number * alpha;
    return rounded<T>(std::is_same_v<T, float> ? number + rest : number);
  };
  result[0] = store(pixel.c0);
  result[1] = store(pixel.c1);
  result[2] = store(pixel.c2);
}

class ColorSpaceNode final : public TileNode {
 public:
  ColorSpaceNode(const ColorSpaceOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), plan_(space_of(options, sources[0]), options.to, sources[0].type, sources[0].alpha) {
    ImageInfo info = sources[0];
    if (info.color_channels() != 3) {
      throw Error(Error::Argument, fmt::format("source: {}, expected 3 channels beside alpha", describe(info)));
    }
    info.color = state_of(options.to);
    set_results({info});
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    if (plan_.count == 0) return copy_pixels(sources[0].pixels, results[0].pixels);
    kernels::color_space(sources[0].pixels, results[0].pixels, plan_);
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    if (plan_.count == 0) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          if (result.channels == 4) result(x, y, 3) = source(x, y, 3);
          convert_pixel(plan_, &source(x, y), &result(x, y));
        }
      }
    });
  }

 private:
  ColorPlan plan_;
};

}  // namespace

extern const Operation kColorSpace = with_examples(
    image_operation<ColorSpaceOptions, ColorSpaceNode>(
        "color_space", "Says the colors of pixels in another space.", {{"source", "three channels, and alpha if any"}},
        {{"converted", "the same colors in the other space"}},
        {field("to", &ColorSpaceOptions::to, "the space of the result"),
         field("from", &ColorSpaceOptions::from, "the space of the source; auto: as its color state says")}),
    {{"photo.png color_space:to=lab", "Lightness, green to red, blue to yellow, seen as red, green, blue."},
     {"photo.png color_space:to=hsv color_space:from=hsv,to=srgb",
      "There and back: no value differs by more than three steps of 255."}});

void color_space(const ConstAnyView& source, const AnyView& result, const ColorSpaceOptions& options, const Run& run) {
  apply_into(kColorSpace, &options, {source}, {result}, run);
}

Image color_space(const Image& source, const ColorSpaceOptions& options, const Run& run) {
  return std::move(apply(kColorSpace, &options, {&source}, run)[0]);
}

}  // namespace azulejo
