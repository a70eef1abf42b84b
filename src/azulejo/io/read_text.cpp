#include "azulejo/io/read_text.h"

#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kReadBytes = std::size_t{1} << 20;
constexpr std::size_t kLineFeeds = 2;

void put_utf8(std::uint32_t letter, Array<char>& result) {
  const auto put = [&](std::uint32_t byte) { result.push_back(static_cast<char>(byte)); };
  if (letter < 0x80) return put(letter);
  if (letter < 0x800) {
    put(0xC0 | letter >> 6);
  } else {
    if (letter < 0x10000) {
      put(0xE0 | letter >> 12);
    } else {
      put(0xF0 | letter >> 18);
      put(0x80 | (letter >> 12 & 0x3F));
    }
    put(0x80 | (letter >> 6 & 0x3F));
  }
  put(0x80 | (letter & 0x3F));
}

/// `bytes` without the mark; an odd last byte is left out.
Array<char> from_utf16(std::string_view bytes, bool big_endian) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  const auto unit = [&](std::size_t at) -> std::uint32_t {
    if (at + 1 >= bytes.size()) return 0;
    const auto first = static_cast<unsigned char>(bytes[at]);
    const auto second = static_cast<unsigned char>(bytes[at + 1]);
    return big_endian ? first * 256U + second : second * 256U + first;
  };
  Array<char> result;
  result.reserve(bytes.size() / 2 + kLineFeeds);
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    std::uint32_t letter = unit(at);
    const std::uint32_t low = unit(at + 2);
    if (letter >= 0xD800 && letter < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
      letter = 0x10000 + ((letter - 0xD800) << 10) + (low - 0xDC00);
      at += 2;
    } else if (letter >= 0xD800 && letter < 0xE000) {
      letter = kReplacement;
    }
    put_utf8(letter, result);
  }
  return result;
}

}  // namespace

Text read_text(const Input& input, const Run& run) {
  if (input.size() > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("{}: {} bytes to hold, the limit of memory is {}", input.name(),
                                             input.size(), run.limits.memory_bytes));
  }
  const auto size = static_cast<std::size_t>(input.size());
  Text text;
  text.bytes.resize(size + kLineFeeds);
  parallel_for(size, kReadBytes, run, [&](std::size_t begin, std::size_t end) {
    const auto part = std::as_writable_bytes(std::span(text.bytes)).subspan(begin, end - begin);
    if (input.read(begin, part) < part.size()) {
      throw Error(Error::Io,
                  fmt::format("{}: byte {}: the file became shorter while it was read", input.name(), begin));
    }
  });
  const std::string_view all(text.bytes.data(), size);
  if (all.starts_with("\xEF\xBB\xBF")) text.begin = 3;
  if (all.starts_with("\xFE\xFF") || all.starts_with("\xFF\xFE")) {
    text.bytes = from_utf16(all.substr(2), all[0] == '\xFE');
    text.bytes.resize(text.bytes.size() + kLineFeeds);
  }
  std::fill_n(text.bytes.end() - kLineFeeds, kLineFeeds, '\n');
  return text;
}

}  // namespace azulejo
