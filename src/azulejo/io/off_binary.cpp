#include <array>
#include <bit>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/off_read.h"

namespace azulejo {
namespace {

template <class T>
T next(ByteReader& reader) {
  std::array<std::byte, sizeof(T)> bytes = {};
  reader.read(bytes);
  return load_number<T>(bytes.data(), std::endian::big);
}

/// Four bytes a value: a number of that many can't be more than the file has left.
std::size_t next_count(ByteReader& reader, const char* what) {
  const auto count = next<std::int32_t>(reader);
  const std::uint64_t left = reader.size() - reader.position();
  if (count < 0 || static_cast<std::uint64_t>(count) > left / 4) {
    throw reader.error(Error::Data, fmt::format("{} {}, which the file has no room for", count, what));
  }
  return static_cast<std::size_t>(count);
}

}  // namespace

void read_off_binary(const std::shared_ptr<const Input>& input, const OffHeader& header, OffRows& rows) {
  ByteReader reader(input, header.body);
  // Here every row has all values: colours have alpha.
  const std::size_t extras = (header.normals ? 3U : 0U) + (header.colors ? 4U : 0U) + (header.texcoords ? 2U : 0U);
  std::array<float, 9> values = {};
  for (std::size_t vertex = 0; vertex < rows.positions.size(); ++vertex) {
    for (int axis = 0; axis < 3; ++axis) rows.positions[vertex][axis] = next<float>(reader);
    for (std::size_t i = 0; i < extras; ++i) values[i] = next<float>(reader);
    rows.set_vertex(vertex, values.data(), extras, ~0U, rows.vertex_kinds);
  }
  OffFaces& faces = rows.faces.emplace_back();
  for (std::uint64_t face = 0; face < header.faces; ++face) {
    const std::size_t corners = next_count(reader, "corners of a face");
    faces.counts.push_back(static_cast<std::uint32_t>(corners));
    for (std::size_t i = 0; i < corners; ++i) faces.corners.push_back(next<std::uint32_t>(reader));
    const std::size_t components = next_count(reader, "components of a face's color");
    if (components > 4) throw reader.error(Error::Data, fmt::format("a color of {} components", components));
    for (std::size_t i = 0; i < components; ++i) values[i] = next<float>(reader);
    if (components > 0) faces.add_color(values.data(), components, true);
  }
}

}  // namespace azulejo
