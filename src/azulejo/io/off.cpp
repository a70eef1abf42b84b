#include <string>

#include "azulejo/io/decode_pass.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/off_header.h"
#include "azulejo/io/off_read.h"
#include "azulejo/io/off_write.h"

namespace azulejo {
namespace {

bool matches(std::span<const std::byte> head, std::uint64_t size, std::string_view name) {
  const bool named = size > 0 && ending_of(std::string(name)) == "off";
  return begins_like_off({reinterpret_cast<const char*>(head.data()), head.size()}, named);
}

Model read(const ModelFile& file, const ModelReadOptions&, const Run& run) { return read_off(file.input, run); }

}  // namespace

extern const ModelCodec kOff;
const ModelCodec kOff = {"off", {"off", "coff", "noff"}, matches, read, write_off, nullptr};

}  // namespace azulejo
