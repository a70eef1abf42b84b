#include "azulejo/io/exr.h"

#include <array>

namespace azulejo {
namespace {

bool matches(std::span<const std::byte> head, std::string_view) {
  constexpr std::array kMagic{std::byte{0x76}, std::byte{0x2f}, std::byte{0x31}, std::byte{0x01}};
  return head.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), head.begin());
}

ImageInfo storable(const ImageInfo& info, const WriteOptions&) {
  ImageInfo result = info;
  result.type = PixelType::F32;
  if (result.color == ColorState::Srgb) result.color = ColorState::Linear;
  if (result.alpha == AlphaState::Straight) result.alpha = AlphaState::Premultiplied;
  return result;
}

}  // namespace

extern const Codec kExrCodec;
const Codec kExrCodec{"exr", {"exr"}, matches, decode_exr, storable, encode_exr};

}  // namespace azulejo
