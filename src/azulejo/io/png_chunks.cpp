#include "azulejo/io/png_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/utf8.h"

namespace azulejo {
namespace {

constexpr std::uint64_t kSignatureBytes = 8;

std::uint32_t big_endian(const std::byte* at) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8U | std::to_integer<std::uint32_t>(at[i]);
  return value;
}

/// Splits `bytes` at its first zero.
std::pair<std::string_view, std::string_view> split(std::string_view bytes) {
  const std::size_t zero = std::min(bytes.find('\0'), bytes.size());
  return {bytes.substr(0, zero), bytes.substr(std::min(zero + 1, bytes.size()))};
}

/// PNG 1.2 with iTXt: keyword 0 compression-flag method language 0 translated-keyword 0 text.
void take_international_text(std::string_view body, Metadata& metadata) {
  auto [keyword, rest] = split(body);
  if (rest.size() < 2 || rest[0] != 0) return;  // compressed: nobody writes XMP or late comments so
  rest = split(split(rest.substr(2)).second).second;
  if (keyword == kXmpKeyword) {
    metadata.xmp.assign(rest.begin(), rest.end());
  } else {
    metadata.text.emplace(keyword, rest);
  }
}

void take(std::string_view type, std::string_view body, Metadata& metadata) {
  if (type == "eXIf") {
    set_exif({reinterpret_cast<const std::uint8_t*>(body.data()), body.size()}, metadata);
  } else if (type == "iTXt") {
    take_international_text(body, metadata);
  } else if (type == "tEXt") {
    const auto [keyword, text] = split(body);
    metadata.text.emplace(keyword, utf8_from_latin1(text));
  }
}

/// Takes the chunk that begins at `at`, if its checksum is right.
void take_chunk(const Input& input, std::uint64_t at, std::uint32_t length, const Run& run, Metadata& metadata) {
  std::vector<std::byte> chunk(std::size_t{4} + length + 4);  // type, body, checksum
  if (input.read(at + 4, chunk) != chunk.size()) return;
  const std::string_view text(reinterpret_cast<const char*>(chunk.data()), 4 + std::size_t{length});
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), 4 + length);
  if (sum != big_endian(chunk.data() + 4 + length)) {
    warn(run,
         fmt::format("{}: byte {}: the checksum of chunk {} is wrong, left out", input.name(), at, text.substr(0, 4)));
    return;
  }
  take(text.substr(0, 4), text.substr(4), metadata);
}

bool is_chunk_type(std::string_view type) {
  return std::all_of(type.begin(), type.end(), [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
}

}  // namespace

void set_exif(std::span<const std::uint8_t> exif, Metadata& metadata) {
  constexpr std::array<std::uint8_t, 6> kPrefix = {'E', 'x', 'i', 'f', 0, 0};
  if (exif.size() >= kPrefix.size() && std::equal(kPrefix.begin(), kPrefix.end(), exif.begin())) {
    exif = exif.subspan(kPrefix.size());
  }
  metadata.exif.assign(exif.begin(), exif.end());
}

void scan_png_chunks(const Input& input, const Run& run, Metadata& metadata) {
  bool after_pixels = false;
  std::array<std::byte, 8> head = {};
  for (std::uint64_t at = kSignatureBytes; input.read(at, head) == head.size();) {
    const std::uint32_t length = big_endian(head.data());
    const std::string_view type(reinterpret_cast<const char*>(head.data()) + 4, 4);
    if (type == "IEND" || !is_chunk_type(type)) return;
    const bool pixels = type == "IDAT";
    if (!pixels && length > kLongestPngChunk) {
      throw Error(Error::Data, fmt::format("{}: byte {}: chunk {} has {} bytes, at most {} expected", input.name(), at,
                                           type, length, kLongestPngChunk));
    }
    after_pixels |= pixels;
    const bool wanted = type == "eXIf" || type == "iTXt" || type == "tEXt";
    if (after_pixels && wanted) take_chunk(input, at, length, run, metadata);
    at += std::uint64_t{12} + length;
  }
}

}  // namespace azulejo
