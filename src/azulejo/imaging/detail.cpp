#include "azulejo/imaging/detail.h"

#include <algorithm>

#include "azulejo/imaging/gaussian_definition.h"
#include "azulejo/imaging/gaussian_kernels.h"

namespace azulejo {

using kernels::GaussianTile;

Detail::Detail(const Settings& settings, std::span<const ImageInfo> sources)
    : TileNode(sources), settings_(settings), format_(row_format(sources[0], settings.light)) {
  const ImageInfo& info = sources[0];
  ImageInfo result = info;
  if (settings.as_floats) {
    result.type = PixelType::F32;
    result.channels = info.color_channels();
    result.color = ColorState::Data;
    result.alpha = AlphaState::None;
  }
  set_results({result});
  unit_ = format_.curve ? 1.0F : full_range(info.type);
  settings_.weights.threshold *= unit_;
  const std::vector<double> exact = exact_gaussian_weights(settings.sigma);
  const bool as_stored = !format_.curve && info.alpha == AlphaState::None;
  if (info.type == PixelType::U8 && as_stored && settings.sigma <= kFixedGaussianSigma) {
    fixed_ = fixed_gaussian_weights(exact);
  }
  if (!fixed_.empty()) {
    radius_ = (static_cast<int>(fixed_.size()) - 3) / 2;
  } else {
    weights_ = float_gaussian_weights(exact);
    radius_ = static_cast<int>(weights_.size()) - 1;
  }
}

void Detail::run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext& context) const {
  if (!fixed_.empty()) return run_bytes(sources[0], results[0], context.scratch, false);
  run_floats(sources[0], results[0], context.scratch, false);
}

void Detail::run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                           const TileContext& context) const {
  if (!fixed_.empty()) return run_bytes(sources[0], results[0], context.scratch, true);
  run_floats(sources[0], results[0], context.scratch, true);
}

/// Bytes without alpha, in encoded light: smoothed in integers, by bands of rows that stay in the cache.
void Detail::run_bytes(const ConstTile& source, const Tile& result, Scratch& scratch, bool reference) const {
  constexpr int kBand = 32;  // as many rows as the kernel smooths together
  for (int y = 0; y < result.rect.height; y += kBand) {
    const int rows = std::min(kBand, result.rect.height - y);
    const Scratch::Mark start = scratch.mark();
    const Rect above{0, y, source.rect.width, rows + 2 * radius_};
    run_band(source.pixels.crop(above), result.pixels.crop({0, y, result.rect.width, rows}), scratch, reference);
    scratch.release(start);
  }
}

void Detail::run_band(const ConstAnyView& source, const AnyView& result, Scratch& scratch, bool reference) const {
  const auto view = source.as<std::uint8_t>();
  const int width = result.width();
  const int height = result.height();
  const int channels = view.channels;
  const auto values = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  const auto stride = static_cast<std::ptrdiff_t>(values);
  auto* const levels = scratch.take<std::int16_t>(values * static_cast<std::size_t>(height));
  if (reference) {
    const std::ptrdiff_t row = std::ptrdiff_t{view.width} * channels;
    auto* const columns = scratch.take<std::int16_t>(static_cast<std::size_t>(row));
    for (int y = 0; y < height; ++y) {
      for (std::ptrdiff_t i = 0; i < row; ++i) {
        columns[i] = static_cast<std::int16_t>(
            fixed_gaussian_value(view.row(y) + i, view.stride, fixed_, kernels::kGaussianFirstShift));
      }
      for (std::ptrdiff_t i = 0; i < stride; ++i) {
        levels[y * stride + i] = static_cast<std::int16_t>(
            fixed_gaussian_value(columns + i, channels, fixed_, kernels::kGaussianWeightBits));
      }
    }
  } else {
    const GaussianTile<std::uint8_t> tile{view.data, view.stride, nullptr, 0, width, height};
    kernels::gaussian_levels(tile, levels, stride, channels, fixed_.data(), radius_, scratch);
  }
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* const s = &view(radius_, y + radius_);
    const std::int16_t* const g = levels + y * stride;
    const auto value = [&](std::size_t i) {
      return kernels::detailed(static_cast<float>(s[i]), static_cast<float>(g[i]) * (1.0F / 64), settings_.weights);
    };
    if (settings_.as_floats) {
      float* const to = result.as<float>().row(y);
      if (!reference) {
        kernels::detail_row(s, g, values, settings_.weights, 1.0F / 255, to);
      } else {
        for (std::size_t i = 0; i < values; ++i) to[i] = value(i) * (1.0F / 255);
      }
    } else {
      std::uint8_t* const to = result.as<std::uint8_t>().row(y);
      if (!reference) {
        kernels::detail_row(s, g, values, settings_.weights, to);
      } else {
        for (std::size_t i = 0; i < values; ++i) {
          to[i] = static_cast<std::uint8_t>(std::clamp(value(i), 0.0F, 255.0F) + 0.5F);
        }
      }
    }
  }
}

void Detail::run_floats(const ConstTile& source, const Tile& result, Scratch& scratch, bool reference) const {
  const int width = result.rect.width;
  const int height = result.rect.height;
  const int wide = source.rect.width;
  const int channels = format_.channels;
  const auto load = reference ? load_row_reference : load_row;
  const auto row = static_cast<std::ptrdiff_t>(format_.values(wide));
  const auto values = static_cast<std::ptrdiff_t>(format_.values(width));
  float* const loaded =
      scratch.take<float>(static_cast<std::size_t>(row) * static_cast<std::size_t>(source.rect.height));
  for (int y = 0; y < source.rect.height; ++y) load(format_, source.pixels.row(y), wide, loaded + y * row);
  float* const smoothed = scratch.take<float>(static_cast<std::size_t>(values * height));
  if (radius_ > 0 && !reference) {
    const GaussianTile<float> tile{loaded, row, smoothed, values, width, height};
    kernels::gaussian_tile(tile, {.channels = channels}, weights_.data(), radius_, scratch);
  } else {
    float* const columns = scratch.take<float>(static_cast<std::size_t>(row));
    for (int y = 0; y < height; ++y) {
      const float* const center = loaded + (y + radius_) * row;
      for (std::ptrdiff_t i = 0; i < row; ++i) columns[i] = gaussian_value<float>(center + i, row, weights_);
      for (std::ptrdiff_t i = 0; i < values; ++i) {
        smoothed[y * values + i] =
            gaussian_value<float>(columns + i + std::ptrdiff_t{radius_} * channels, channels, weights_);
      }
    }
  }
  for (int y = 0; y < height; ++y) {
    float* const center = loaded + (y + radius_) * row + std::ptrdiff_t{radius_} * channels;
    finish_row(center, smoothed + y * values, width, result.pixels.row(y), reference);
  }
}

void Detail::finish_row(float* center, const float* smoothed, int width, std::byte* result, bool reference) const {
  const std::size_t values = format_.values(width);
  if (settings_.as_floats) {
    // Colors are times alpha as they are smoothed; alpha itself has no detail.
    const int colors = results()[0].channels;
    const float scale = 1.0F / (format_.alpha != RowAlpha::Plain ? unit_ * full_range(format_.type) : unit_);
    auto* to = reinterpret_cast<float*>(result);
    if (colors == format_.channels && !reference) {
      kernels::detail_row(center, smoothed, values, settings_.weights);
      for (std::size_t i = 0; i < values; ++i) to[i] = center[i] * scale;
      return;
    }
    for (std::size_t i = 0; i < values; i += static_cast<std::size_t>(format_.channels)) {
      for (int c = 0; c < colors; ++c) {
        const std::size_t at = i + static_cast<std::size_t>(c);
        *to++ = kernels::detailed(center[at], smoothed[at], settings_.weights) * scale;
      }
    }
    return;
  }
  combine(center, smoothed, width, reference);
  (reference ? store_row_reference : store_row)(format_, center, width, result);
}

void Detail::combine(float* center, const float* smoothed, int width, bool reference) const {
  const std::size_t values = format_.values(width);
  if (sources()[0].alpha == AlphaState::None) {
    if (!reference) return kernels::detail_row(center, smoothed, values, settings_.weights);
    for (std::size_t i = 0; i < values; ++i) center[i] = kernels::detailed(center[i], smoothed[i], settings_.weights);
    return;
  }
  const int colors = format_.channels - 1;
  // Colors are loaded times alpha, in units of color × units of alpha where that is straight.
  const float alpha_unit = format_.alpha == RowAlpha::Plain ? full_range(format_.type) : 1.0F;
  for (std::size_t i = 0; i < values; i += static_cast<std::size_t>(format_.channels)) {
    float* const pixel = center + i;
    const float alpha = pixel[colors] / alpha_unit;
    const float around = smoothed[i + static_cast<std::size_t>(colors)] / alpha_unit;
    for (int c = 0; c < colors; ++c) {
      if (alpha == 0) continue;  // stays 0
      const float mean = smoothed[i + static_cast<std::size_t>(c)] / around;
      pixel[c] = kernels::detailed(pixel[c] / alpha, mean, settings_.weights) * alpha;
    }
  }
}

}  // namespace azulejo
