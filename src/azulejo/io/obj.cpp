#include "azulejo/io/obj.h"

#include <algorithm>
#include <array>

#include "azulejo/io/decode_pass.h"
#include "azulejo/io/obj_read.h"
#include "azulejo/io/obj_write.h"

namespace azulejo {
namespace {

/// Whether the first line that says something begins with a keyword of OBJ.
bool begins_like_obj(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  for (std::size_t at = text.find_first_not_of(kBlank); at < text.size(); at = text.find_first_not_of(kBlank, at)) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end;
    if (line.front() == '#') continue;
    constexpr std::array<std::string_view, 8> kWords{"v", "vt", "vn", "o", "g", "s", "mtllib", "usemtl"};
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    return word.size() < line.size() && std::find(kWords.begin(), kWords.end(), word) != kWords.end();
  }
  return false;
}

/// OBJ has no signature: its ending tells, or, of standard input, its first line.
bool matches(std::span<const std::byte> head, std::uint64_t, std::string_view name) {
  const std::string ending = ending_of(std::string(name));
  return ending == "obj" ||
         (ending.empty() && begins_like_obj({reinterpret_cast<const char*>(head.data()), head.size()}));
}

}  // namespace

const ModelCodec kObj = {"obj", {"obj"}, matches, read_obj, nullptr, write_obj};

}  // namespace azulejo
