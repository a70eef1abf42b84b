#include "azulejo/imaging/bilateral.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/bilateral_kernels.h"
#include "azulejo/imaging/rows.h"

namespace azulejo {
namespace {

using kernels::BilateralOffset;
using kernels::BilateralPlanes;

/// Weights that are kept for later rows stay in the second-level cache.
constexpr int kRows = 64;  ///< of results that are computed together

class Bilateral final : public TileNode {
 public:
  Bilateral(const BilateralOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources),
        options_(options),
        radius_(options.radius.value_or(static_cast<int>(std::ceil(2 * options.sigma_space)))),
        format_(row_format(sources[0], options.light)) {
    set_results({sources[0]});
    const double space = 2.0 * options.sigma_space * options.sigma_space * kernels::kBilateralPower;
    for (int dy = 0; dy <= radius_; ++dy) {
      for (int dx = dy == 0 ? 1 : -radius_; dx <= radius_; ++dx) {
        const int squared = dx * dx + dy * dy;
        if (squared <= radius_ * radius_) offsets_.push_back({dx, dy, static_cast<float>(squared / space)});
      }
    }
    // Loaded values in units of full range, over what makes a difference's square the exponent.
    const double range = std::sqrt(2.0 * kernels::kBilateralPower) * options.sigma_range;
    const double full = full_range(format_.type);
    const double color = (format_.curve ? 1 : full) * (format_.alpha == RowAlpha::Plain ? 1 : full);
    for (int c = 0; c < format_.channels; ++c) {
      const bool alpha = sources[0].alpha != AlphaState::None && c == format_.channels - 1;
      const double unit = range * (alpha ? full : color);
      scale_[static_cast<std::size_t>(c)] = static_cast<float>(1 / unit);
      unit_[static_cast<std::size_t>(c)] = static_cast<float>(unit);
    }
  }

  Rect needs(const Rect& result, int) const override { return grown(result, radius_, radius_); }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    const ConstAnyView& source = sources[0].pixels;
    const AnyView& result = results[0].pixels;
    const int columns = std::max(128, 256 - 2 * ((radius_ + 15) / 16 * 16));
    for (int y = 0; y < result.height(); y += kRows) {
      const int height = std::min(kRows, result.height() - y);
      for (int x = 0; x < result.width(); x += columns) {
        const int width = std::min(columns, result.width() - x);
        const Scratch::Mark start = context.scratch.mark();
        run_block(source.crop({x, y, width + 2 * radius_, height + 2 * radius_}), result.crop({x, y, width, height}),
                  context.scratch);
        context.scratch.release(start);
      }
    }
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    const ConstAnyView& source = sources[0].pixels;
    const AnyView& result = results[0].pixels;
    const int channels = format_.channels;
    const auto stride = static_cast<std::ptrdiff_t>(format_.values(source.width()));
    float* const loaded = context.scratch.take<float>(static_cast<std::size_t>(stride * source.height()));
    float* const row = context.scratch.take<float>(format_.values(result.width()));
    for (int y = 0; y < source.height(); ++y) {
      load_row_reference(format_, source.row(y), source.width(), loaded + y * stride);
    }
    for (int y = 0; y < result.height(); ++y) {
      for (int x = 0; x < result.width(); ++x) {
        const float* const middle = loaded + (y + radius_) * stride + std::ptrdiff_t{x + radius_} * channels;
        const std::array<float, 4> changes = change(middle, stride);
        for (int c = 0; c < channels; ++c) {
          const auto channel = static_cast<std::size_t>(c);
          row[x * channels + c] = middle[c] + changes[channel] * unit_[channel];
        }
      }
      store_row_reference(format_, row, result.width(), result.row(y));
    }
  }

 private:
  /// The definition of kernels::bilateral_planes for one pixel.
  std::array<float, 4> change(const float* middle, std::ptrdiff_t stride) const {
    float sum = 1;
    std::array<float, 4> changes{};
    for (const BilateralOffset& offset : offsets_) {
      for (const int side : {-1, 1}) {
        const float* const other = middle + side * (offset.dy * stride + std::ptrdiff_t{offset.dx} * format_.channels);
        std::array<float, 4> difference{};
        float t = offset.distance;
        for (int c = 0; c < format_.channels; ++c) {
          const auto channel = static_cast<std::size_t>(c);
          difference[channel] = other[c] * scale_[channel] - middle[c] * scale_[channel];
          t = t + difference[channel] * difference[channel];
        }
        const float weight = kernels::bilateral_weight(t);
        sum = sum + weight;
        for (std::size_t c = 0; c < 4; ++c) changes[c] = changes[c] + weight * difference[c];
      }
    }
    for (float& each : changes) each = each / sum;
    return changes;
  }

  void run_block(const ConstAnyView& source, const AnyView& result, Scratch& scratch) const {
    const int channels = format_.channels;
    const int width = result.width();
    const std::ptrdiff_t stride = kernels::bilateral_stride(width, radius_);
    const std::ptrdiff_t plane = stride * source.height();
    const auto row = static_cast<std::ptrdiff_t>(format_.values(source.width()));
    float* const loaded = scratch.take<float>(static_cast<std::size_t>(row * source.height()));
    float* const planes = scratch.take<float>(static_cast<std::size_t>(plane * channels));
    std::fill_n(planes, plane * channels, 0.0F);
    for (int y = 0; y < source.height(); ++y) {
      float* const from = loaded + y * row;
      load_row(format_, source.row(y), source.width(), from);
      for (int c = 0; c < channels; ++c) {
        const float scale = scale_[static_cast<std::size_t>(c)];
        float* const to = planes + c * plane + y * stride + kernels::bilateral_margin(radius_) - radius_;
        for (int x = 0; x < source.width(); ++x) to[x] = from[x * channels + c] * scale;
      }
    }
    const std::ptrdiff_t changes_stride = (width + 15) / 16 * 16;
    float* const changes = scratch.take<float>(static_cast<std::size_t>(changes_stride * result.height() * channels));
    kernels::bilateral_planes(BilateralPlanes{planes, stride, channels, width, result.height(), radius_}, offsets_,
                              changes, changes_stride, scratch);
    for (int y = 0; y < result.height(); ++y) {
      float* const middle = loaded + (y + radius_) * row + std::ptrdiff_t{radius_} * channels;
      for (int c = 0; c < channels; ++c) {
        const float unit = unit_[static_cast<std::size_t>(c)];
        const float* const change = changes + (c * result.height() + y) * changes_stride;
        for (int x = 0; x < width; ++x) middle[x * channels + c] = middle[x * channels + c] + change[x] * unit;
      }
      store_row(format_, middle, width, result.row(y));
    }
  }

  BilateralOptions options_;
  int radius_;
  RowFormat format_;
  std::vector<BilateralOffset> offsets_;
  std::array<float, 4> scale_{};  ///< from loaded values to those that are compared
  std::array<float, 4> unit_{};   ///< and back
};

}  // namespace

extern const Operation kBilateral = with_examples(
    image_operation<BilateralOptions, Bilateral>(
        "bilateral", "Smooths and keeps edges.", {{"source", "the image"}}, {{"result", "the smoothed image"}},
        {field("sigma_space", &BilateralOptions::sigma_space, {0.1, 50}, "px", "standard deviation by distance"),
         field("sigma_range", &BilateralOptions::sigma_range, {0.001, 10}, "", "standard deviation by intensity"),
         field("radius", &BilateralOptions::radius, {0, 100}, "px", "of the window; auto: twice sigma_space"),
         field("border", &BilateralOptions::border, "what lies outside the image"),
         field("border_value", &BilateralOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &BilateralOptions::light, "what is weighted: stored values or linear light")}),
    {{"photo.png bilateral:sigma_space=4,sigma_range=0.1", "Fine texture is gone; outlines are as sharp as before."},
     {"photo.png bilateral:sigma_space=4,sigma_range=10", "With a wide range it is a Gaussian."}});

void bilateral(const ConstAnyView& source, const AnyView& result, const BilateralOptions& options, const Run& run) {
  apply_into(kBilateral, &options, {source}, {result}, run);
}

Image bilateral(const Image& source, const BilateralOptions& options, const Run& run) {
  return std::move(apply(kBilateral, &options, {&source}, run)[0]);
}

}  // namespace azulejo
