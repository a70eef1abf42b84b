#include "azulejo/io/stl.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/decode_pass.h"
#include "azulejo/io/gzip.h"
#include "azulejo/io/model_codec.h"
#include "azulejo/io/stl_soup.h"
#include "azulejo/io/stl_write.h"
#include "azulejo/io/weld.h"

namespace azulejo {
namespace {

constexpr std::size_t kHead = 512;
constexpr std::size_t kChunk = std::size_t{1} << 16;

bool matches(std::span<const std::byte> head, std::uint64_t size, std::string_view name) {
  if (is_stl_text(head, size)) return true;
  const bool named = ending_of(std::string(name)) == "stl";
  // An empty binary file looks like any few zeros.
  return size > 0 && (named || (size > 84 && fits_stl_binary(head, size)));
}

void read_soup(const std::shared_ptr<const Input>& input, StlSoup& soup, const Run& run) {
  std::array<std::byte, kHead> head = {};
  const std::size_t count = input->read(0, head);
  if (is_stl_text(std::span(head).first(count), input->size())) {
    read_stl_text(input, soup, run);
  } else {
    read_stl_binary(*input, soup, run);
  }
  if (soup.opposed > 0) {
    warn(run, fmt::format("{}: {} of {} stored normals point against the winding of their triangles, which holds",
                          input->name(), soup.opposed, soup.corners.size() / 3));
  }
}

std::uint8_t from_five_bits(unsigned value) { return static_cast<std::uint8_t>((value & 31) * 255 / 31); }

using Rgb = std::array<std::uint8_t, 3>;

/// The colours of 15-bit attributes; `set` of them have their own, others get `otherwise`.
template <class IsSet>
Attribute face_colors(const StlSoup& soup, bool red_is_low, const Rgb& otherwise, IsSet is_set, const Run& run) {
  Array<std::uint8_t> values(soup.attributes.size() * 3);
  parallel_for(soup.attributes.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const unsigned bits = soup.attributes[i];
      const Rgb low_first = {from_five_bits(bits), from_five_bits(bits >> 5), from_five_bits(bits >> 10)};
      Rgb color = otherwise;
      if (is_set(bits)) color = red_is_low ? low_first : Rgb{low_first[2], low_first[1], low_first[0]};
      std::copy(color.begin(), color.end(), &values[i * 3]);
    }
  });
  return {"COLOR_0", Domain::Face, 3, std::move(values)};
}

/// Two conventions: Materialise Magics says COLOR= in the header and has bit 15 clear where a triangle has its own
/// colour, red lowest; VisCAM and SolidView have bit 15 set there, blue lowest.
void add_colors(const StlSoup& soup, Mesh& mesh, const Run& run) {
  constexpr unsigned kBit15 = 1U << 15;
  const std::size_t color = soup.header.find("COLOR=");
  const bool materialise = color != std::string::npos && color + 9 <= soup.header.size();
  const bool some = std::any_of(soup.attributes.begin(), soup.attributes.end(), [](std::uint16_t a) { return a != 0; });
  if (materialise) {
    Rgb object = {};
    for (std::size_t i = 0; i < 3; ++i) object[i] = static_cast<std::uint8_t>(soup.header[color + 6 + i]);
    // Programs that know no colours of triangles leave all attributes 0: none is black of its own then.
    const auto own = [&](unsigned bits) { return some && (bits & kBit15) == 0; };
    mesh.attributes.push_back(face_colors(soup, true, object, own, run));
  } else if (some) {
    const auto own = [](unsigned bits) { return (bits & kBit15) != 0; };
    if (std::none_of(soup.attributes.begin(), soup.attributes.end(), own)) return;
    mesh.attributes.push_back(face_colors(soup, false, {255, 255, 255}, own, run));
  }
}

Model read(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  StlSoup soup;
  read_soup(file.input, soup, run);
  Mesh mesh;
  mesh.name = soup.name;
  mesh.space.up = UpAxis::Z;
  add_colors(soup, mesh, run);
  if (options.weld) {
    Welded welded = weld_exactly(soup.corners, run);
    mesh.positions = std::move(welded.positions);
    mesh.corners = std::move(welded.corners);
  } else {
    mesh.positions = std::move(soup.corners);
    mesh.corners.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) mesh.corners[i] = static_cast<std::uint32_t>(i);
  }
  return mesh;
}

}  // namespace

void check_stl_size(const std::string& name, std::uint64_t triangles, const Run& run) {
  constexpr std::uint64_t kMostTriangles = 0xFFFFFFFE / 3;
  constexpr std::uint64_t kBytes = 36 + 2 + 12 + 3 * 32;  // soup, attribute, corners, and what welding takes
  if (triangles > kMostTriangles || triangles * kBytes > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
    throw Error(Error::Resource,
                fmt::format("{}: {} triangles, the limit is {}", name, triangles,
                            std::min(kMostTriangles, static_cast<std::uint64_t>(run.limits.memory_bytes) / kBytes)));
  }
}

void read_stl_soup(const std::string& path, Array<glm::vec3>& corners, const Run& run) {
  std::shared_ptr<const Input> input = open_input(path, run.limits.memory_bytes);
  if (is_gzip(*input)) input = unpack_gzip(*input, run.limits.memory_bytes);
  StlSoup soup;
  soup.corners = std::move(corners);
  read_soup(input, soup, run);
  corners = std::move(soup.corners);
}

extern const ModelCodec kStl;
const ModelCodec kStl = {"stl", {"stl"}, matches, read, write_stl, nullptr};

}  // namespace azulejo
