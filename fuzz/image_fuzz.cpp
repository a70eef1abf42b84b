// Any bytes into the reader of one format: a value or an Error, within the limits given.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "azulejo/core/error.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/decode_pass.h"

namespace azulejo {
namespace {

Run small_run() {
  Run run;
  run.threads = 1;
  run.limits.pixels = std::int64_t{1} << 22;
  run.limits.memory_bytes = std::int64_t{256} << 20;
  run.limits.temporary_bytes = 0;
  return run;
}

/// All rows from this codec, whatever the first bytes are.
void decode_forced(const Codec& codec, std::span<const std::byte> bytes, const Run& run) {
  const auto decoder = codec.decode(memory_input(bytes, "fuzz"), {}, run);
  ImageInfo info = decoder->header().file.info;
  const int height = info.height;
  check_image_info(info, run.limits);  // a header that the codec should have refused
  info.height = decoder->streams() ? std::min(height, 16) : height;
  Image rows(info, run.limits);
  for (int y = 0; y < height; y += info.height) {
    decoder->read(rows.any().crop({0, 0, info.width, std::min(info.height, height - y)}));
  }
}

}  // namespace
}  // namespace azulejo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace azulejo;
  static const Codec& codec = *codec_for_ending(AZULEJO_FUZZ_FORMAT);
  static const Run run = small_run();
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    if (codec.matches(bytes.first(std::min<std::size_t>(size, 64)), "fuzz." AZULEJO_FUZZ_FORMAT)) {
      read_image(bytes, "fuzz." AZULEJO_FUZZ_FORMAT, {}, run);
    } else {
      decode_forced(codec, bytes, run);
    }
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled || error.kind() == Error::Argument) std::abort();
  }
  return 0;
}
