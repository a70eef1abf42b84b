#include <array>

#include "azulejo/io/codec.h"

namespace azulejo {

extern const Codec kPngCodec;
extern const Codec kJpegCodec;
extern const Codec kTiffCodec;
extern const Codec kExrCodec;
extern const Codec kPpmCodec;
extern const Codec kPgmCodec;
extern const Codec kPbmCodec;
extern const Codec kPamCodec;
extern const Codec kPfmCodec;
extern const Codec kHdrCodec;
extern const Codec kWebpCodec;
extern const Codec kBmpCodec;
extern const Codec kTgaCodec;
extern const Codec kGifCodec;

std::span<const Codec* const> codecs() {
  // Targa comes last: it has no magic bytes and is recognized by what its header may hold.
  static constexpr std::array<const Codec*, 14> kCodecs = {
      &kPngCodec, &kJpegCodec, &kTiffCodec, &kExrCodec,  &kPpmCodec, &kPgmCodec, &kPbmCodec,
      &kPamCodec, &kPfmCodec,  &kHdrCodec,  &kWebpCodec, &kBmpCodec, &kGifCodec, &kTgaCodec,
  };
  return kCodecs;
}

}  // namespace azulejo
