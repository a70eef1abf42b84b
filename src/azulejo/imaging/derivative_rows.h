#pragma once

#include <array>
#include <type_traits>

#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/sobel_kernels.h"

namespace azulejo {

/// What the derivatives of an image by 3 × 3 kernels are: f32, as many channels as it has colors, no colors themselves.
inline ImageInfo derivative_info(const ImageInfo& source) {
  ImageInfo info = source;
  info.channels = source.color_channels();
  info.type = PixelType::F32;
  info.color = ColorState::Data;
  info.alpha = AlphaState::None;
  return info;
}

/// An intensity of 1 in the rows that `for_derivative_rows` gives is 1 / this.
inline float derivative_scale(const ImageInfo& source) {
  const float full = full_range(source.type);
  return source.alpha == AlphaState::Straight ? 1.0F / (full * full) : 1.0F / full;
}

/// The colors of a row of pixels as f32, multiplied by alpha if that is straight; alpha is left out.
template <class T>
void load_colors(const T* pixels, int width, int channels, bool multiply, float* colors) {
  for (int x = 0; x < width; ++x, pixels += channels, colors += channels - 1) {
    const float alpha = multiply ? static_cast<float>(pixels[channels - 1]) : 1.0F;
    for (int c = 0; c < channels - 1; ++c) colors[c] = static_cast<float>(pixels[c]) * alpha;
  }
}

/// Calls kernel(SobelSource<T>, y) for each row y of a tile that is a pixel smaller than `source` on each side: the colors,
/// times alpha where there is one.
template <class Kernel>
void for_derivative_rows(const ConstTile& source, Scratch& scratch, const Kernel& kernel) {
  const ImageInfo& info = source.pixels.info;
  const int height = info.height - 2;
  const std::ptrdiff_t tap = info.color_channels();
  const auto count = static_cast<std::size_t>((info.width - 2) * tap);
  visit(source.pixels, [&](auto view) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
    if (info.alpha == AlphaState::None) {
      for (int y = 0; y < height; ++y) {
        kernel(kernels::SobelSource<T>{view.row(y) + tap, view.row(y + 1) + tap, view.row(y + 2) + tap, count, tap}, y);
      }
      return;
    }
    std::array<float*, 3> ring;
    for (float*& each : ring) each = scratch.take<float>(static_cast<std::size_t>(info.width * tap));
    const auto loaded = [&](int y) { return ring[static_cast<std::size_t>(y) % 3]; };
    for (int y = 0; y < info.height; ++y) {
      load_colors(view.row(y), view.width, view.channels, info.alpha == AlphaState::Straight, loaded(y));
      if (y < 2) continue;
      kernel(kernels::SobelSource<float>{loaded(y - 2) + tap, loaded(y - 1) + tap, loaded(y) + tap, count, tap}, y - 2);
    }
  });
}

}  // namespace azulejo
