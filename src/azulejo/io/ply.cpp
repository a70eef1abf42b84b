#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/ply_header.h"
#include "azulejo/io/ply_mesh.h"
#include "azulejo/io/ply_rows.h"
#include "azulejo/io/ply_write.h"

namespace azulejo {
namespace {

bool is_space(std::byte byte) {
  const auto c = static_cast<unsigned char>(byte);
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view) {
  const auto is = [&](std::size_t at, unsigned char c) { return at < head.size() && head[at] == std::byte{c}; };
  std::size_t start = is(0, 0xEF) && is(1, 0xBB) && is(2, 0xBF) ? 3 : 0;
  while (start < head.size() && is_space(head[start])) ++start;
  return is(start, 'p') && is(start + 1, 'l') && is(start + 2, 'y') && start + 3 < head.size() &&
         is_space(head[start + 3]);
}

Model read(const ModelFile& file, const ModelReadOptions&, const Run& run) {
  const std::string& name = file.input->name();
  const PlyHeader header = read_ply_header(file.input);
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    const std::uint64_t bytes = element.count * 4 * (element.properties.size() + 1);  // counts fit the file: checked
    if (element.count > 0xFFFFFFFE || bytes > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
      throw Error(Error::Resource,
                  fmt::format("{}: {} rows of element {}, more than the limit of memory, {} bytes, holds", name,
                              element.count, element.name, run.limits.memory_bytes));
    }
  }
  PlyMesh mesh(header, name);
  if (header.format == PlyFormat::Text) {
    read_ply_text(file.input, header, mesh.rows(), run);
  } else {
    read_ply_binary(file.input, header, mesh.rows(), run);
  }
  Mesh result = mesh.finish(run);
  result.check(name);  // indices are as the file gives them until here
  if (result.positions.empty()) warn(run, fmt::format("{}: holds no vertices", name));
  return result;
}

}  // namespace

extern const ModelCodec kPly;
const ModelCodec kPly = {"ply", {"ply"}, matches, read, write_ply, nullptr};

}  // namespace azulejo
