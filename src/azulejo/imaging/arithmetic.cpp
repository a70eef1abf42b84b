#include "azulejo/imaging/arithmetic.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "azulejo/imaging/common_image.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/tone_kernels.h"

namespace azulejo {
namespace {

/// Pixels of another number of channels: gray for each color, alpha of 1 where there was none.
template <class T>
void fit_channels(const T* from, const ImageInfo& info, int pixels, int colors, bool alpha, T* to) {
  const int from_colors = info.color_channels();
  for (int x = 0; x < pixels; ++x, from += info.channels) {
    for (int c = 0; c < colors; ++c) *to++ = from[from_colors == 1 ? 0 : c];
    if (alpha) *to++ = info.alpha == AlphaState::None ? T{1} : from[from_colors];
  }
}

/// One pixel as intensities, color times alpha, which is last.
template <class T>
void seen_pixel(const T* from, const ImageInfo& info, int colors, float* to) {
  constexpr float kTop = full_range(kPixelTypeOf<T>);
  std::array<float, 4> pixel{};
  for (int c = 0; c < info.channels; ++c) pixel[static_cast<std::size_t>(c)] = static_cast<float>(from[c]) / kTop;
  if (info.alpha == AlphaState::Straight) {
    const float alpha = pixel[static_cast<std::size_t>(info.channels - 1)];
    for (int c = 0; c + 1 < info.channels; ++c) {
      float& color = pixel[static_cast<std::size_t>(c)];
      color = alpha == 0.0F ? 0.0F : color * alpha;
    }
  }
  const int from_colors = info.color_channels();
  for (int c = 0; c < colors; ++c) to[c] = pixel[from_colors == 1 ? 0 : static_cast<std::size_t>(c)];
  to[colors] = info.alpha == AlphaState::None ? 1.0F : pixel[static_cast<std::size_t>(from_colors)];
}

}  // namespace

ArithmeticNode::ArithmeticNode(Arithmetic operation, std::span<const ImageInfo> sources, float by_zero)
    : TileNode(sources), operation_(operation), by_zero_(by_zero) {
  ImageInfo other = sources[1];
  if (sources[0].color == ColorState::Data || other.color == ColorState::Data) other.color = sources[0].color;
  ImageInfo info = common_image(sources[0], other);
  colors_ = info.color_channels();
  const bool is_measure = operation == Arithmetic::Subtract || operation == Arithmetic::Difference;
  if (is_measure) info.alpha = AlphaState::None;
  if (operation == Arithmetic::Multiply || operation == Arithmetic::Divide) info.alpha = sources[0].alpha;
  info.channels = colors_ + (info.alpha == AlphaState::None ? 0 : 1);
  if (operation == Arithmetic::Subtract || operation == Arithmetic::Divide) {
    info.type = PixelType::F32;
    info.color = ColorState::Data;
  }
  set_results({info});
}

void ArithmeticNode::run(std::span<const ConstTile> from, std::span<const Tile> results,
                         const TileContext& context) const {
  if (has_alpha()) return run_seen(from, results[0], context.scratch);
  run_plain(from, results[0], context.scratch);
}

void ArithmeticNode::run_plain(std::span<const ConstTile> from, const Tile& to, Scratch& scratch) const {
  const int width = to.rect.width;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(colors_);
  const PixelType type = sources()[0].type;
  const bool gapless = to.pixels.stride == static_cast<std::ptrdiff_t>(to.pixels.info.row_bytes()) &&
                       std::all_of(from.begin(), from.end(), [&](const ConstTile& each) {
                         return each.pixels.info.channels == colors_ &&
                                each.pixels.stride == static_cast<std::ptrdiff_t>(each.pixels.info.row_bytes());
                       });
  if (gapless) {
    return kernels::arithmetic_row(operation_, type, from[0].pixels.data, from[1].pixels.data,
                                   count * static_cast<std::size_t>(to.rect.height), to.pixels.data, by_zero_);
  }
  visit_type(type, [&](auto zero) {
    using T = decltype(zero);
    T* const fitted = scratch.take<T>(count);
    for (int y = 0; y < to.rect.height; ++y) {
      const std::byte* rows[2];
      for (std::size_t s = 0; s < 2; ++s) {
        rows[s] = from[s].pixels.row(y);
        if (sources()[s].channels == colors_) continue;
        fit_channels(reinterpret_cast<const T*>(rows[s]), sources()[s], width, colors_, false, fitted);
        rows[s] = reinterpret_cast<const std::byte*>(fitted);
      }
      kernels::arithmetic_row(operation_, type, rows[0], rows[1], count, to.pixels.row(y), by_zero_);
    }
  });
}

/// Images with alpha: intensities of f32, color times alpha, both with all channels and alpha.
void ArithmeticNode::run_seen(std::span<const ConstTile> from, const Tile& to, Scratch& scratch) const {
  const ImageInfo& info = results()[0];
  const int width = to.rect.width;
  const auto pixels = static_cast<std::size_t>(width);
  const auto channels = static_cast<std::size_t>(colors_) + 1;
  const auto values = pixels * static_cast<std::size_t>(info.channels);
  float* const loaded = scratch.take<float>(pixels * channels);
  float* const rows[] = {scratch.take<float>(pixels * channels), scratch.take<float>(pixels * channels)};
  float* const combined = scratch.take<float>(values);
  for (int y = 0; y < to.rect.height; ++y) {
    for (std::size_t s = 0; s < 2; ++s) {
      const ImageInfo& source = sources()[s];
      const std::size_t count = pixels * static_cast<std::size_t>(source.channels);
      kernels::load_intensities(source.type, from[s].pixels.row(y), count, loaded);
      if (source.alpha == AlphaState::Straight) {
        kernels::multiply_by_alpha(loaded, count, source.channels, false, loaded);
      }
      fit_channels(loaded, source, width, colors_, true, rows[s]);
    }
    for (std::size_t x = 0; x < pixels; ++x) {
      combine(rows[0] + x * channels, rows[1] + x * channels, combined + x * static_cast<std::size_t>(info.channels));
    }
    float* row = combined;
    if (info.alpha == AlphaState::Straight) {
      row = rows[0];
      kernels::divide_by_alpha(combined, values, info.channels, row);
      kernels::keep_alpha(combined, values, info.channels, row);
    }
    kernels::store_intensities(info.type, row, values, to.pixels.row(y));
  }
}

/// The definition for a pixel with alpha. Of factors and divisors, what can't be seen is white.
void ArithmeticNode::combine(const float* source, const float* other, float* result) const {
  const float source_alpha = source[colors_];
  const float other_alpha = other[colors_];
  const float white = 1.0F - other_alpha;
  for (int c = 0; c < colors_; ++c) {
    switch (operation_) {
      case Arithmetic::Add: result[c] = source[c] + other[c]; break;
      case Arithmetic::Subtract: result[c] = source[c] - other[c]; break;
      case Arithmetic::Difference: result[c] = std::fabs(source[c] - other[c]); break;
      case Arithmetic::Multiply: result[c] = source[c] * (white + other[c]); break;
      case Arithmetic::Divide: {
        const float divisor = white + other[c];
        result[c] = divisor == 0.0F ? by_zero_ * source_alpha : source[c] / divisor;
        break;
      }
    }
  }
  if (results()[0].alpha == AlphaState::None) return;
  const float sum = source_alpha + other_alpha;
  result[colors_] = operation_ != Arithmetic::Add ? source_alpha : sum > 1.0F ? 1.0F : sum;
}

void ArithmeticNode::run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                                   const TileContext&) const {
  const ImageInfo& info = this->results()[0];
  visit_type(sources()[0].type, [&](auto source_zero) {
    using T = decltype(source_zero);
    const auto value = [&](T a, T b) -> float {
      switch (operation_) {
        case Arithmetic::Add: return static_cast<float>(AddValues<T>()(a, b));
        case Arithmetic::Subtract: return SubtractValues<T>()(a, b);
        case Arithmetic::Difference: return static_cast<float>(DifferenceValues<T>()(a, b));
        case Arithmetic::Multiply: return static_cast<float>(MultiplyValues<T>()(a, b));
        default: return DivideValues<T>{by_zero_}(a, b);
      }
    };
    visit(results[0].pixels, [&](auto result) {
      using Stored = std::remove_pointer_t<decltype(result.data)>;
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          const T* const a = &from[0].pixels.as<T>()(x, y);
          const T* const b = &from[1].pixels.as<T>()(x, y);
          Stored* const to = &result(x, y);
          if (!has_alpha()) {
            for (int c = 0; c < colors_; ++c) {
              to[c] = static_cast<Stored>(
                  value(a[sources()[0].channels == 1 ? 0 : c], b[sources()[1].channels == 1 ? 0 : c]));
            }
            continue;
          }
          std::array<float, 5> seen[2];
          std::array<float, 5> combined;
          seen_pixel(a, sources()[0], colors_, seen[0].data());
          seen_pixel(b, sources()[1], colors_, seen[1].data());
          combine(seen[0].data(), seen[1].data(), combined.data());
          const float alpha = combined[static_cast<std::size_t>(colors_)];
          for (int c = 0; c < info.channels; ++c) {
            float v = combined[static_cast<std::size_t>(c)];
            if (info.alpha == AlphaState::Straight && c < colors_) v = alpha == 0.0F ? 0.0F : v / alpha;
            to[c] = rounded<Stored>(v * full_range(info.type));
          }
        }
      }
    });
  });
}

}  // namespace azulejo
