#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "azulejo/core/export.h"
#include "azulejo/math/rect.h"

namespace azulejo {

enum class PixelType : std::uint8_t { U8, U16, F32 };
enum class ColorState : std::uint8_t { Srgb, Linear, Data };  ///< Data: not colour (depth, distances, derivatives)
enum class AlphaState : std::uint8_t { None, Straight, Premultiplied };

constexpr std::size_t size_of(PixelType type) { return type == PixelType::U8 ? 1 : type == PixelType::U16 ? 2 : 4; }

/// What stands for an intensity of 1: 255, 65535 or 1.
constexpr float full_range(PixelType type) {
  return type == PixelType::U8 ? 255.0F : type == PixelType::U16 ? 65535.0F : 1.0F;
}

template <class T>
inline constexpr PixelType kPixelTypeOf = std::is_same_v<std::remove_const_t<T>, std::uint8_t>    ? PixelType::U8
                                          : std::is_same_v<std::remove_const_t<T>, std::uint16_t> ? PixelType::U16
                                                                                                  : PixelType::F32;

/// What an image is, without its pixels.
struct ImageInfo {
  int width = 0;
  int height = 0;
  int channels = 1;
  PixelType type = PixelType::U8;
  ColorState color = ColorState::Srgb;
  AlphaState alpha = AlphaState::None;  ///< not None: the last channel is alpha

  Rect rect() const { return {0, 0, width, height}; }
  std::size_t pixel_bytes() const { return static_cast<std::size_t>(channels) * size_of(type); }
  std::size_t row_bytes() const { return static_cast<std::size_t>(width) * pixel_bytes(); }
  /// Channels that aren't alpha.
  int color_channels() const { return alpha == AlphaState::None ? channels : channels - 1; }
  friend bool operator==(const ImageInfo&, const ImageInfo&) = default;
};

/// Interleaved pixels that somebody else owns. Trivially copyable.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  int channels = 1;
  std::ptrdiff_t stride = 0;  ///< from a row to the next, in elements of T

  T* row(int y) const { return data + y * stride; }
  T& operator()(int x, int y, int channel = 0) const {
    return row(y)[static_cast<std::ptrdiff_t>(x) * channels + channel];
  }
  ImageView crop(const Rect& part) const {
    return {row(part.y) + static_cast<std::ptrdiff_t>(part.x) * channels, part.width, part.height, channels, stride};
  }
  operator ImageView<const T>() const { return {data, width, height, channels, stride}; }
};

/// Pixels of any type that somebody else owns. `Byte` is std::byte or const std::byte.
template <class Byte>
struct BasicAnyView {
  Byte* data = nullptr;
  std::ptrdiff_t stride = 0;  ///< from a row to the next, in bytes
  ImageInfo info;

  template <class T>
  using Pixel = std::conditional_t<std::is_const_v<Byte>, const T, T>;

  BasicAnyView() = default;
  BasicAnyView(Byte* first, std::ptrdiff_t row_stride, const ImageInfo& what)
      : data(first), stride(row_stride), info(what) {}
  /// A typed view: 2 and 4 channels are taken to end in straight alpha, colours to be sRGB.
  template <class T>
  requires std::is_const_v<Byte> ||(!std::is_const_v<T>)BasicAnyView(const ImageView<T>& view)
      : data(reinterpret_cast<Byte*>(view.data)),
        stride(view.stride * static_cast<std::ptrdiff_t>(sizeof(T))),
        info{view.width,      view.height,      view.channels,
             kPixelTypeOf<T>, ColorState::Srgb, view.channels % 2 == 0 ? AlphaState::Straight : AlphaState::None} {}

  operator BasicAnyView<const std::byte>() const { return {data, stride, info}; }

  int width() const { return info.width; }
  int height() const { return info.height; }
  Byte* row(int y) const { return data + y * stride; }
  /// The typed view; T must be the pixel type.
  template <class T>
  ImageView<Pixel<T>> as() const {
    return {reinterpret_cast<Pixel<T>*>(data), info.width, info.height, info.channels,
            stride / static_cast<std::ptrdiff_t>(sizeof(T))};
  }
  BasicAnyView crop(const Rect& part) const {
    BasicAnyView result = *this;
    result.data = row(part.y) + part.x * static_cast<std::ptrdiff_t>(info.pixel_bytes());
    result.info.width = part.width;
    result.info.height = part.height;
    return result;
  }
};

using AnyView = BasicAnyView<std::byte>;
using ConstAnyView = BasicAnyView<const std::byte>;

/// Calls f(T{}) with T the C++ type of `type`: the one place where a pixel type becomes a template argument.
template <class F>
decltype(auto) visit_type(PixelType type, F&& f) {
  switch (type) {
    case PixelType::U8: return std::forward<F>(f)(std::uint8_t{});
    case PixelType::U16: return std::forward<F>(f)(std::uint16_t{});
    default: return std::forward<F>(f)(float{});
  }
}

/// Calls f with the typed view of `view`.
template <class Byte, class F>
decltype(auto) visit(const BasicAnyView<Byte>& view, F&& f) {
  return visit_type(view.info.type, [&](auto zero) -> decltype(auto) { return f(view.template as<decltype(zero)>()); });
}

/// Copies pixels between views of the same size, channels and type. They must not overlap.
AZULEJO_EXPORT void copy_pixels(const ConstAnyView& source, const AnyView& result);

}  // namespace azulejo
