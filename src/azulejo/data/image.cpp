#include "azulejo/data/image.h"

#include <cstring>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::int64_t kRowAlignment = 64;

std::int64_t row_stride(const ImageInfo& info) {
  const auto bytes = static_cast<std::int64_t>(info.row_bytes());
  return (bytes + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
}

}  // namespace

void copy_pixels(const ConstAnyView& source, const AnyView& result) {
  const std::size_t bytes = source.info.row_bytes();
  for (int y = 0; y < source.info.height; ++y) std::memcpy(result.row(y), source.row(y), bytes);
}

std::int64_t image_bytes(const ImageInfo& info) { return row_stride(info) * info.height; }

void check_image_info(const ImageInfo& info, const Limits& limits) {
  if (info.width < 1 || info.height < 1) {
    throw Error(Error::Argument, fmt::format("image: size {}×{}, expected at least 1×1", info.width, info.height));
  }
  if (info.channels < 1 || info.channels > 4) {
    throw Error(Error::Argument, fmt::format("image: {} channels, expected 1–4", info.channels));
  }
  if (info.alpha != AlphaState::None && info.channels % 2 != 0) {
    throw Error(Error::Argument, fmt::format("image: {} channels with alpha, expected 2 or 4", info.channels));
  }
  if (std::int64_t{info.width} * info.height > limits.pixels) {
    throw Error(Error::Resource,
                fmt::format("image: {}×{} pixels, the limit is {}", info.width, info.height, limits.pixels));
  }
}

Image::Image(const ImageInfo& info, const Limits& limits, bool temporary) : info_(info) {
  check_image_info(info, limits);
  stride_ = row_stride(info);
  const auto bytes = static_cast<std::size_t>(image_bytes(info));
  buffer_ = temporary ? Buffer::in_temporary_file(bytes, limits.temporary_folder) : Buffer(bytes);
}

Image::Image(const ImageInfo& info, const Limits& limits) : Image(info, limits, false) {}

Image::Image(int width, int height, int channels, PixelType type)
    : Image(ImageInfo{width, height, channels, type, ColorState::Srgb,
                      channels % 2 == 0 ? AlphaState::Straight : AlphaState::None}) {}

Image Image::in_temporary_file(const ImageInfo& info, const Limits& limits) { return {info, limits, true}; }

Image Image::clone() const {
  if (empty()) return {};
  Image copy(info_, Limits{.pixels = std::int64_t{info_.width} * info_.height});
  copy_pixels(any(), copy.any());
  copy.metadata_ = metadata_;
  return copy;
}

void Image::set_states(ColorState color, AlphaState alpha) {
  ImageInfo changed = info_;
  changed.color = color;
  changed.alpha = alpha;
  if (!empty()) check_image_info(changed, Limits{.pixels = std::int64_t{info_.width} * info_.height});
  info_ = changed;
}

void Image::check_type(PixelType wanted) const {
  if (info_.type != wanted) {
    throw Error(Error::Argument,
                fmt::format("image: its pixels are {}, seen as {}", to_string(info_.type), to_string(wanted)));
  }
}

const std::shared_ptr<const Metadata>& Image::no_metadata() {
  static const auto none = std::make_shared<const Metadata>();
  return none;
}

const char* to_string(PixelType type) { return type == PixelType::U8 ? "u8" : type == PixelType::U16 ? "u16" : "f32"; }

const char* to_string(ColorState state) {
  return state == ColorState::Srgb ? "srgb" : state == ColorState::Linear ? "linear" : "data";
}

const char* to_string(AlphaState state) {
  return state == AlphaState::None ? "none" : state == AlphaState::Straight ? "straight" : "premultiplied";
}

std::string describe(const ImageInfo& info) {
  return fmt::format("{}×{}, {} channel{}, {}, {}, alpha {}", info.width, info.height, info.channels,
                     info.channels == 1 ? "" : "s", to_string(info.type), to_string(info.color), to_string(info.alpha));
}

}  // namespace azulejo
