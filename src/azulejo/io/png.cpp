#include "azulejo/io/png.h"

#include <cstring>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {

extern const Codec kPngCodec;

namespace {

bool matches_png(std::span<const std::byte> head, std::string_view /*name*/) {
  return head.size() >= kPngSignature.size() &&
         std::memcmp(head.data(), kPngSignature.data(), kPngSignature.size()) == 0;
}

ImageInfo storable_png(const ImageInfo& info, const WriteOptions& options) {
  if (info.alpha == AlphaState::None && info.channels % 2 == 0) {
    throw Error(Error::Unsupported,
                fmt::format("PNG can't hold {} channels without alpha; TIFF and OpenEXR can", info.channels));
  }
  ImageInfo result = info;
  const PixelType type = options.type.value_or(info.type);
  result.type = type == PixelType::U8 ? PixelType::U8 : PixelType::U16;
  if (info.color == ColorState::Linear) result.color = ColorState::Srgb;
  if (info.alpha != AlphaState::None) result.alpha = AlphaState::Straight;
  return result;
}

}  // namespace

const Codec kPngCodec = {"png", {"png"}, matches_png, decode_png, storable_png, encode_png};

}  // namespace azulejo
