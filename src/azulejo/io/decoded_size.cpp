#include "azulejo/io/decoded_size.h"

#include <climits>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {

void check_decoded_size(const std::string& name, std::uint64_t width, std::uint64_t height, const Run& run) {
  if (width < 1 || height < 1 || width > INT_MAX || height > INT_MAX) {
    throw Error(Error::Data, fmt::format("{}: header: size {}×{}, 1 to {} expected", name, width, height, INT_MAX));
  }
  const auto limit = static_cast<std::uint64_t>(run.limits.pixels);
  if (width * height > limit) {
    throw Error(Error::Resource, fmt::format("{}: header: {}×{} pixels, the limit is {}", name, width, height, limit));
  }
}

void check_decoder_memory(const std::string& name, const char* what, std::uint64_t bytes, const Run& run) {
  const auto limit = static_cast<std::uint64_t>(run.limits.memory_bytes);
  if (bytes > limit) {
    throw Error(Error::Resource,
                fmt::format("{}: {} would take {} bytes of memory, the limit is {}", name, what, bytes, limit));
  }
}

}  // namespace azulejo
