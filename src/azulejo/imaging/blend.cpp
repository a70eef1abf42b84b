#include "azulejo/imaging/blend.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/blend_kernels.h"
#include "azulejo/imaging/common_image.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {

void kernels::blend_reference(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                              float amount) {
  visit(result, [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    const BlendPoint<T> mix(amount);
    for (int y = 0; y < view.height; ++y) {
      const T* const a = source.as<T>().row(y);
      const T* const b = other.as<T>().row(y);
      for (int i = 0; i < view.width * view.channels; ++i) view.row(y)[i] = mix(a[i], b[i]);
    }
  });
}

namespace {

/// Makes rows of one image fit rows of the result, both as load_row gives them.
///
/// Colors that come times alpha in stored units (RowAlpha::Weigh, Unweigh) are larger than others by the full range.
struct Fit {
  Fit(const ImageInfo& from, const ImageInfo& to, Light light)
      : format(row_format(from, light)),
        colors(from.color_channels()),
        wanted_colors(to.color_channels()),
        channels(to.channels),
        full(full_range(to.type)),
        scale(unit(row_format(to, light)) / unit(format)) {}

  bool fits() const { return format.channels == channels && scale == 1; }

  void apply(const float* from, int pixels, float* to) const {
    for (int x = 0; x < pixels; ++x, from += format.channels, to += channels) {
      for (int c = 0; c < wanted_colors; ++c) to[c] = from[colors == 1 ? 0 : c] * scale;
      if (channels > wanted_colors) to[wanted_colors] = format.channels > colors ? from[colors] : full;
    }
  }

  RowFormat format;
  int colors;
  int wanted_colors;
  int channels;
  float full;
  float scale;

 private:
  float unit(const RowFormat& of) const { return of.alpha == RowAlpha::Plain ? 1 : full; }
};

class Blend final : public TileNode {
 public:
  Blend(const BlendOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    const ImageInfo& source = sources[0];
    const ImageInfo& other = sources[1];
    const ImageInfo info = common_image(source, other);
    set_results({info});
    plain_ = row_format(info, options.light).alpha == RowAlpha::Plain && !row_format(info, options.light).curve &&
             source.alpha == other.alpha && source.channels == other.channels;
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    if (!plain_) {
      mix_rows(from, results[0], context.scratch, load_row, kernels::blend, store_row);
    } else {
      kernels::blend(from[0].pixels, from[1].pixels, results[0].pixels, options_.amount);
    }
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    if (!plain_) {
      mix_rows(from, results[0], context.scratch, load_row_reference, kernels::blend_reference, store_row_reference);
    } else {
      kernels::blend_reference(from[0].pixels, from[1].pixels, results[0].pixels, options_.amount);
    }
  }

 private:
  template <class Load, class Mix, class Store>
  void mix_rows(std::span<const ConstTile> from, const Tile& to, Scratch& scratch, Load load, Mix mix,
                Store store) const {
    const ImageInfo& info = results()[0];
    const int width = to.rect.width;
    const auto values = static_cast<std::size_t>(width) * static_cast<std::size_t>(info.channels);
    float* const loaded = scratch.take<float>(values);
    float* const rows[] = {scratch.take<float>(values), scratch.take<float>(values)};
    const Fit fits[] = {{sources()[0], info, options_.light}, {sources()[1], info, options_.light}};
    const auto view = [&](float* row) {
      return AnyView(ImageView<float>{row, width, 1, info.channels, static_cast<std::ptrdiff_t>(values)});
    };
    for (int y = 0; y < to.rect.height; ++y) {
      for (std::size_t s = 0; s < 2; ++s) {
        const Fit& fit = fits[s];
        load(fit.format, from[s].pixels.row(y), width, fit.fits() ? rows[s] : loaded);
        if (!fit.fits()) fit.apply(loaded, width, rows[s]);
      }
      mix(view(rows[0]), view(rows[1]), view(rows[0]), options_.amount);
      store(row_format(info, options_.light), rows[0], width, to.pixels.row(y));
    }
  }

  BlendOptions options_;
  bool plain_ = false;  ///< stored values are weighted and summed as they are
};

}  // namespace

extern const Operation kBlend = with_examples(
    image_operation<BlendOptions, Blend>(
        "blend", "Mixes two images.", {{"source", "the image"}, {"other", "the image that is mixed in"}},
        {{"blended", "the weighted mean of both"}},
        {field("amount", &BlendOptions::amount, {0, 1}, "", "share of the other image"),
         field("light", &BlendOptions::light, "what is mixed: stored values, or the light they stand for")}),
    {{"photo.png blend:other=other.png", "Two pictures, each seen through the other."},
     {"photo.png blend:other=other.png,amount=0.2,light=linear", "A fifth of the light of another picture."}});

void blend(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, const BlendOptions& options,
           const Run& run) {
  apply_into(kBlend, &options, {source, other}, {result}, run);
}

Image blend(const Image& source, const Image& other, const BlendOptions& options, const Run& run) {
  return std::move(apply(kBlend, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
