#include "azulejo/imaging/within.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/mask_weight.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {
namespace {

/// How much of [at, at + 1) lies in [low, high).
double covered(int at, double low, double high) {
  return std::clamp(std::min(at + 1.0, high) - std::max<double>(at, low), 0.0, 1.0);
}

class Within final : public TileNode {
 public:
  Within(const WithinOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    if (sources[0] != sources[1]) {
      throw Error(Error::Argument, fmt::format("changed: {}, expected {}", describe(sources[1]), describe(sources[0])));
    }
    if (masked() && (sources[2].width != sources[0].width || sources[2].height != sources[0].height)) {
      throw Error(Error::Argument, fmt::format("mask: {}×{}, expected {}×{}", sources[2].width, sources[2].height,
                                               sources[0].width, sources[0].height));
    }
    if (options.label && !masked()) throw Error(Error::Argument, "label: there is no mask, expected one that holds it");
    if (options.rect && ((*options.rect)[2] < 0 || (*options.rect)[3] < 0)) {
      throw Error(Error::Argument,
                  fmt::format("rect: size {}×{}, expected at least 0", (*options.rect)[2], (*options.rect)[3]));
    }
    set_results({sources[0]});
  }

  Rect needs(const Rect& result, int source) const override {
    return source == 2 ? grown(result, options_.feather, options_.feather) : result;
  }
  BorderRule border(int) const override { return {Border::Clamp}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    compute(sources, results[0], context.scratch, load_row, store_row);
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    compute(sources, results[0], context.scratch, load_row_reference, store_row_reference);
  }

 private:
  bool masked() const { return sources().size() > 2; }

  /// The weights of a row without feather, from `left` on.
  void fill_weights(std::span<const ConstTile> sources, int y, int left, std::span<int> weights) const {
    const ImageInfo& whole = this->sources()[0];
    if (!masked()) {
      std::fill(weights.begin(), weights.end(), kFullWeight);
    } else {
      visit(sources[2].pixels, [&](auto view) {
        const auto* pixel = &view(left - sources[2].rect.x, y - sources[2].rect.y);
        for (int& weight : weights) {
          weight = !options_.label                                    ? mask_weight(pixel, sources[2].pixels.info)
                   : static_cast<double>(pixel[0]) == *options_.label ? kFullWeight
                                                                      : 0;
          pixel += view.channels;
        }
      });
    }
    if (!options_.rect) return;
    const auto [x0, y0, width, height] = *options_.rect;
    const double down = covered(std::clamp(y, 0, whole.height - 1), y0, double{y0} + height);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const int x = std::clamp(left + static_cast<int>(i), 0, whole.width - 1);
      const double part = down * covered(x, x0, double{x0} + width);
      weights[i] = static_cast<int>(weights[i] * part + 0.5);
    }
  }

  template <class Load, class Store>
  void compute(std::span<const ConstTile> sources, const Tile& to, Scratch& scratch, Load load, Store store) const {
    const int width = to.rect.width;
    const int f = options_.feather;
    const int wide = width + 2 * f;
    const int window = 2 * f + 1;
    const auto take_row = [&] {
      return std::span(scratch.take<int>(static_cast<std::size_t>(wide)), static_cast<std::size_t>(wide));
    };
    const std::span<int> entering = take_row();
    const std::span<int> weights = entering.subspan(static_cast<std::size_t>(f), static_cast<std::size_t>(width));
    // The window's rows, summed by columns.
    std::int64_t* const columns = scratch.take<std::int64_t>(static_cast<std::size_t>(wide));
    std::fill_n(columns, wide, 0);
    const auto add_row = [&](int y, int sign) {
      fill_weights(sources, y, to.rect.x - f, entering);
      for (int i = 0; i < wide; ++i) columns[i] += sign * entering[static_cast<std::size_t>(i)];
    };
    const RowFormat format = row_format(results()[0], Light::Encoded);
    float* const before = scratch.take<float>(format.values(width));
    float* const after = scratch.take<float>(format.values(width));
    for (int y = to.rect.y - f; f > 0 && y < to.rect.y + f; ++y) add_row(y, 1);
    for (int y = to.rect.y; y < to.rect.bottom(); ++y) {
      if (f > 0) {
        add_row(y + f, 1);
        if (y > to.rect.y) add_row(y - f - 1, -1);
      }
      fill_weights(sources, y, to.rect.x - f, entering);
      if (f > 0) {
        std::int64_t sum = 0;
        for (int i = 0; i < 2 * f; ++i) sum += columns[i];
        const std::int64_t area = std::int64_t{window} * window;
        for (int x = 0; x < width; ++x) {
          sum += columns[x + 2 * f];
          const std::int64_t ramp = std::max<std::int64_t>(0, 2 * sum - area * kFullWeight);
          int& weight = weights[static_cast<std::size_t>(x)];
          weight = static_cast<int>((weight * ramp + area * kFullWeight / 2) / (area * kFullWeight));
          sum -= columns[x];
        }
      }
      const int row = y - to.rect.y;
      mix(format, sources[0].pixels.row(row), sources[1].pixels.row(row), weights, before, after, to.pixels.row(row),
          load, store);
    }
  }

  /// Runs of pixels of weight 0, of weight 1, and of weights between.
  template <class Load, class Store>
  static void mix(const RowFormat& format, const std::byte* source, const std::byte* changed,
                  std::span<const int> weights, float* before, float* after, std::byte* result, Load load,
                  Store store) {
    const std::size_t bytes = size_of(format.type) * static_cast<std::size_t>(format.channels);
    const auto kind = [](int weight) { return weight == 0 ? 0 : weight == kFullWeight ? 2 : 1; };
    for (std::size_t begin = 0; begin < weights.size();) {
      std::size_t end = begin + 1;
      while (end < weights.size() && kind(weights[end]) == kind(weights[begin])) ++end;
      const std::size_t at = begin * bytes;
      if (kind(weights[begin]) != 1) {
        std::memmove(result + at, (weights[begin] == 0 ? source : changed) + at, (end - begin) * bytes);
      } else {
        const int pixels = static_cast<int>(end - begin);
        load(format, source + at, pixels, before);
        load(format, changed + at, pixels, after);
        for (std::size_t i = 0; i < format.values(pixels); ++i) {
          const float share =
              static_cast<float>(weights[begin + i / static_cast<std::size_t>(format.channels)]) / float{kFullWeight};
          before[i] = before[i] * (1.0F - share) + after[i] * share;
        }
        store(format, before, pixels, result + at);
      }
      begin = end;
    }
  }

  WithinOptions options_;
};

}  // namespace

extern const Operation kWithin = with_examples(
    image_operation<WithinOptions, Within>(
        "within", "Takes a change of an image over inside a selected area.",
        {{"source", "the image"},
         {"changed", "the same image after a change"},
         {.name = "mask", .help = "where the change shows: 0 outside, full range inside", .optional = true}},
        {{"result", "the changed image inside, the source outside"}},
        {field("rect", &WithinOptions::rect, {-1e6, 1e6}, "px", "left, top, width, height of the area"),
         field("label", &WithinOptions::label, {0, 16777216}, "", "the area is where the mask holds this value"),
         field("feather", &WithinOptions::feather, {0, 1000}, "px", "width over which the change fades in, inwards")}),
    {{"photo.png as:photo gaussian:sigma=6 as:soft @photo within:changed=@soft,mask=mask.png,feather=20",
      "Smooth inside the mask, fading in from its edge; `gaussian:sigma=6,within=mask.png,feather=20` is short for "
      "it."}});

bool may_be_within(const Operation& operation) {
  return operation.name != "within" && !operation.inputs.empty() && operation.inputs[0].kind == ValueKind::Image &&
         operation.outputs[0].kind == ValueKind::Image;
}

void within(const ConstAnyView& source, const ConstAnyView& changed, const ConstAnyView& mask, const AnyView& result,
            const WithinOptions& options, const Run& run) {
  if (mask.data == nullptr) return apply_into(kWithin, &options, {source, changed}, {result}, run);
  apply_into(kWithin, &options, {source, changed, mask}, {result}, run);
}

Image within(const Image& source, const Image& changed, const Image& mask, const WithinOptions& options,
             const Run& run) {
  if (mask.empty()) return std::move(apply(kWithin, &options, {&source, &changed}, run)[0]);
  return std::move(apply(kWithin, &options, {&source, &changed, &mask}, run)[0]);
}

}  // namespace azulejo
