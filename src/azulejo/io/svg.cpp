#include "azulejo/io/model_codec.h"
#include "azulejo/io/svg_document.h"
#include "azulejo/io/svg_read.h"
#include "azulejo/io/svg_write.h"

namespace azulejo {
namespace {

bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view name) {
  return begins_like_svg(head, name);
}

Model read(const ModelFile& file, const ModelReadOptions&, const Run& run) { return read_svg(*file.input, run); }

}  // namespace

extern const ModelCodec kSvg;
const ModelCodec kSvg{"svg", {"svg"}, matches, read, nullptr, nullptr, write_svg};

}  // namespace azulejo
