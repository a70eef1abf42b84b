#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/stl_soup.h"

namespace azulejo {
namespace {

constexpr std::uint64_t kHeader = 84;       ///< 80 bytes of anything, and the count
constexpr std::uint64_t kTriangle = 50;     ///< normal, three corners, attribute
constexpr std::size_t kChunk = 4096;        ///< triangles read together: 200 KB stay in the second-level cache
constexpr std::uint32_t kNotCounted = ~0U;  ///< written by programs that couldn't go back

glm::vec3 load_vector(const std::byte* bytes) {
  const auto number = [&](int i) { return load_number<float>(bytes + i * 4, std::endian::little); };
  return {number(0), number(1), number(2)};
}

/// How many triangles to read, with a word where the file's count isn't the truth.
std::uint64_t triangles_in(const Input& input, std::uint32_t counted, const Run& run) {
  const std::uint64_t there = (input.size() - kHeader) / kTriangle;
  const std::uint64_t rest = (input.size() - kHeader) % kTriangle;
  if ((counted == 0 || counted == kNotCounted) && there > 0 && rest == 0) {
    warn(run,
         fmt::format("{}: byte 80: counts {} triangles, but has {}, which are read", input.name(), counted, there));
    return there;
  }
  if (counted > there) {
    throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early: {} triangles, expected {}",
                                         input.name(), input.size(), there, counted));
  }
  const std::uint64_t end = kHeader + kTriangle * counted;
  if (end < input.size()) {
    warn(run, fmt::format("{}: byte {}: {} bytes behind the last triangle are not read", input.name(), end,
                          input.size() - end));
  }
  return counted;
}

std::size_t convert(const std::byte* source, std::size_t count, glm::vec3* corners, std::uint16_t* attributes) {
  std::size_t opposed = 0;
  for (std::size_t i = 0; i < count; ++i, source += kTriangle, corners += 3) {
    for (int corner = 0; corner < 3; ++corner) corners[corner] = load_vector(source + 12 + 12 * corner);
    attributes[i] = load_number<std::uint16_t>(source + 48, std::endian::little);
    opposed += opposes(load_vector(source), corners) ? 1U : 0U;
  }
  return opposed;
}

}  // namespace

bool fits_stl_binary(std::span<const std::byte> head, std::uint64_t size) {
  return size >= kHeader && head.size() >= kHeader &&
         size == kHeader + kTriangle * load_number<std::uint32_t>(head.data() + 80, std::endian::little);
}

void read_stl_binary(const Input& input, StlSoup& soup, const Run& run) {
  std::array<std::byte, kHeader> header = {};
  if (input.read(0, header) < kHeader) {
    throw Error(Error::Data,
                fmt::format("{}: byte {}: the file ends too early: neither text that begins with \"solid\" "
                            "nor the {} bytes of a binary header",
                            input.name(), input.size(), kHeader));
  }
  soup.header.assign(reinterpret_cast<const char*>(header.data()), 80);
  const std::uint64_t count =
      triangles_in(input, load_number<std::uint32_t>(header.data() + 80, std::endian::little), run);
  check_stl_size(input.name(), count, run);
  soup.corners.resize(static_cast<std::size_t>(count) * 3);
  soup.attributes.resize(static_cast<std::size_t>(count));
  std::vector<Array<std::byte>> buffers(static_cast<std::size_t>(thread_count(run)));
  const std::size_t chunks = (soup.attributes.size() + kChunk - 1) / kChunk;
  std::vector<std::size_t> opposed(chunks);
  parallel_tasks(chunks, run, [&](std::size_t chunk, int worker) {
    Array<std::byte>& buffer = buffers[static_cast<std::size_t>(worker)];
    buffer.resize(kChunk * kTriangle);
    const std::size_t first = chunk * kChunk;
    const std::size_t triangles = std::min(kChunk, soup.attributes.size() - first);
    const std::size_t bytes = triangles * kTriangle;
    if (input.read(kHeader + first * kTriangle, std::span(buffer).first(bytes)) < bytes) {
      throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early", input.name(), input.size()));
    }
    opposed[chunk] = convert(buffer.data(), triangles, &soup.corners[first * 3], &soup.attributes[first]);
  });
  for (const std::size_t each : opposed) soup.opposed += each;
}

}  // namespace azulejo
