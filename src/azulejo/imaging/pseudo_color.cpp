#include "azulejo/imaging/pseudo_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/color_mapping.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/value_range.h"

namespace azulejo {
namespace {

/// A mapping, and of bytes its table.
struct ReadyMapping {
  ReadyMapping(const PseudoColorOptions& options, const ImageInfo& info, float low, float high)
      : mapping(options, low, high) {
    if (info.type != PixelType::U8 || info.alpha == AlphaState::Premultiplied) return;
    table.resize(256, {});
    for (std::size_t v = 0; v < 256; ++v) {
      const auto color = mapping.at(static_cast<float>(v) / 255.0F);
      for (std::size_t c = 0; c < 3; ++c) table[v][c] = rounded<std::uint8_t>(color[c] * 255.0F);
    }
  }

  ColorMapping mapping;
  std::vector<std::array<std::uint8_t, 4>> table;  ///< the fourth is 0
};

/// Fills in the ends of the range that the options leave open.
class OpenRange final : public ValueRange {
 public:
  OpenRange(const PseudoColorOptions& options, const ImageInfo& info)
      : ValueRange(info), options_(options), info_(info), ready_(options, info, 0, 0) {}

  void finish() override {
    ready_ = ReadyMapping(options_, info_, options_.low.value_or(smallest()), options_.high.value_or(largest()));
  }

  const ReadyMapping& ready() const { return ready_; }

 private:
  PseudoColorOptions options_;
  ImageInfo info_;
  ReadyMapping ready_;
};

std::uint64_t packed(const std::array<std::uint8_t, 4>& color) {
  static_assert(std::endian::native == std::endian::little);
  return std::bit_cast<std::uint32_t>(color);
}

void look_up(const ConstAnyView& source, const AnyView& result, const ReadyMapping& ready) {
  const auto from = source.as<std::uint8_t>();
  const auto to = result.as<std::uint8_t>();
  for (int y = 0; y < to.height; ++y) {
    const std::uint8_t* const row = from.row(y);
    std::uint8_t* place = to.row(y);
    if (from.channels == 2) {
      for (int x = 0; x < to.width; ++x, place += 4) {
        std::memcpy(place, ready.table[row[2 * x]].data(), 4);
        place[3] = row[2 * x + 1];
      }
      continue;
    }
    // Two pixels at once, as eight bytes: the last two are written over by the next ones.
    int x = 0;
    for (; x + 3 < to.width; x += 2, place += 6) {
      const std::uint64_t colors = packed(ready.table[row[x]]) | packed(ready.table[row[x + 1]]) << 24;
      std::memcpy(place, &colors, 8);
    }
    for (; x < to.width; ++x, place += 3) std::memcpy(place, ready.table[row[x]].data(), 3);
  }
}

class PseudoColor final : public TileNode {
 public:
  PseudoColor(const PseudoColorOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources),
        options_(options),
        ready_(options, sources[0], options.low.value_or(0.0F), options.high.value_or(1.0F)) {
    ImageInfo info = sources[0];
    if (info.color_channels() != 1) {
      throw Error(Error::Argument, fmt::format("source: {}, expected 1 channel beside alpha", describe(info)));
    }
    info.channels += 2;
    info.color = ColorState::Srgb;
    set_results({info});
  }

  std::unique_ptr<Analysis> analysis(int) const override {
    if (options_.low && options_.high) return nullptr;
    return std::make_unique<OpenRange>(options_, sources()[0]);
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    const ReadyMapping& ready = ready_of(context);
    if (!ready.table.empty()) return look_up(from[0].pixels, results[0].pixels, ready);
    kernels::pseudo_color(from[0].pixels, results[0].pixels, ready.mapping);
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    const ColorMapping& mapping = ready_of(context).mapping;
    const bool premultiplied = sources()[0].alpha == AlphaState::Premultiplied;
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = from[0].pixels.as<T>();
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          const float whole = premultiplied ? static_cast<float>(source(x, y, 1)) : full_range(kPixelTypeOf<T>);
          const auto color = mapping.at(static_cast<float>(source(x, y)) / whole);
          for (int c = 0; c < 3; ++c) {
            result(x, y, c) = whole == 0 ? T{0} : rounded<T>(color[static_cast<std::size_t>(c)] * whole);
          }
          if (result.channels == 4) result(x, y, 3) = source(x, y, 1);
        }
      }
    });
  }

 private:
  const ReadyMapping& ready_of(const TileContext& context) const {
    return options_.low && options_.high ? ready_ : static_cast<const OpenRange&>(*context.analyses[0]).ready();
  }

  PseudoColorOptions options_;
  ReadyMapping ready_;
};

constexpr Range kAny{-1e30, 1e30};

}  // namespace

extern const Operation kPseudoColor = with_examples(
    image_operation<PseudoColorOptions, PseudoColor>(
        "pseudo_color", "Shows gray values as colors.", {{"source", "one channel, and alpha if any"}},
        {{"colored", "three channels of color"}},
        {field("map", &PseudoColorOptions::map, "colors from low to high"),
         field("low", &PseudoColorOptions::low, kAny, "", "intensity of the first color; auto: the image's smallest"),
         field("high", &PseudoColorOptions::high, kAny, "", "intensity of the last color; auto: the image's largest"),
         field("levels", &PseudoColorOptions::levels, {2, 256}, "", "number of colors, in bands; auto: all"),
         field("nan_color", &PseudoColorOptions::nan_color, "color of what is not a number")}),
    {{"gray.png pseudo_color", "Dark is blue, bright is yellow, and the eye tells more steps than of gray."},
     {"gray.png gaussian:sigma=3 pseudo_color:map=jet,levels=6",
      "Six bands make contours that are not in the picture."}});

void pseudo_color(const ConstAnyView& source, const AnyView& result, const PseudoColorOptions& options,
                  const Run& run) {
  apply_into(kPseudoColor, &options, {source}, {result}, run);
}

Image pseudo_color(const Image& source, const PseudoColorOptions& options, const Run& run) {
  return std::move(apply(kPseudoColor, &options, {&source}, run)[0]);
}

}  // namespace azulejo
