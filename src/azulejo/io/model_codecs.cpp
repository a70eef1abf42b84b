#include <vector>

#include "azulejo/io/model_codec.h"

namespace azulejo {

// One line a format, in the order in which they are asked: those with a signature first, those known by their ending
// last.
// clang-format off
#define AZULEJO_MODEL_CODECS(codec) \
  codec(kGltf) \
  codec(kPly) \
  codec(kSvg) \
  codec(kOff) \
  codec(kNifti) \
  codec(kNrrd) \
  codec(kInrimage) \
  codec(kNumpy) \
  codec(kMitsubaVolume) \
  codec(kStl) \
  codec(kObj) \
  codec(kRaw)
// clang-format on

#define AZULEJO_DECLARE(name) extern const ModelCodec name;
AZULEJO_MODEL_CODECS(AZULEJO_DECLARE)

#define AZULEJO_ADDRESS(name) &(name),
std::span<const ModelCodec* const> model_codecs() {
  static const std::vector<const ModelCodec*> list{AZULEJO_MODEL_CODECS(AZULEJO_ADDRESS)};
  return list;
}

}  // namespace azulejo
