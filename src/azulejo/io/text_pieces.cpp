#include "azulejo/io/text_pieces.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kWindow = std::size_t{1} << 14;
constexpr std::size_t kShown = 64;

/// The first start of a line at `from` or behind that may begin a piece; `from` itself is looked at only where the
/// byte before it ends a line. The file's size if there is none.
std::uint64_t next_start(const Input& input, std::uint64_t from, char line_end,
                         const std::function<bool(std::string_view)>& may_begin) {
  std::array<char, kWindow> window;
  std::uint64_t place = from - 1;  // the byte that might end a line
  for (;;) {
    const std::size_t count = input.read(place, std::as_writable_bytes(std::span(window)));
    if (count == 0) return input.size();
    const char* const end = window.data() + count;
    const char* next = window.data();
    while (next != end) {
      const char* const found = end_of_line(next, end, line_end);
      next = end;
      if (found == end) break;
      const std::size_t shown = std::min<std::size_t>(static_cast<std::size_t>(end - found) - 1, kShown);
      const std::uint64_t start = place + static_cast<std::uint64_t>(found - window.data()) + 1;
      if (start >= input.size()) break;
      next = found;
      if (shown < kShown && start + shown < input.size()) break;  // what follows is seen whole in the next window
      if (!may_begin || may_begin({found + 1, shown})) return start;
      next = found + 1;
    }
    place += static_cast<std::uint64_t>(next - window.data());
  }
}

}  // namespace

TextPieces::TextPieces(std::shared_ptr<const Input> input, std::uint64_t begin, const Run& run, char line_end,
                       const std::function<bool(std::string_view)>& may_begin, std::size_t bytes)
    : input_(std::move(input)), line_end_(line_end), starts_{begin} {
  const std::uint64_t size = input_->size();
  for (std::uint64_t wanted = begin + bytes; wanted < size; wanted += bytes) {
    if (wanted <= starts_.back()) continue;
    const std::uint64_t start = next_start(*input_, wanted, line_end, may_begin);
    if (start >= size) break;
    starts_.push_back(start);
  }
  if (size > begin) starts_.push_back(size);
  for (std::size_t i = 0; i + 1 < starts_.size(); ++i) {
    const std::uint64_t length = starts_[i + 1] - starts_[i];
    if (length > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
      throw Error(Error::Resource, fmt::format("{}: byte {}: {} bytes that can't be divided, the limit of memory is {}",
                                               name(), starts_[i], length, run.limits.memory_bytes));
    }
  }
}

void TextPieces::for_each(const Run& run, const std::function<void(const TextPiece& piece, int worker)>& body) const {
  std::vector<Array<char>> buffers(static_cast<std::size_t>(thread_count(run)));
  parallel_tasks(size(), run, [&](std::size_t index, int worker) {
    Array<char>& buffer = buffers[static_cast<std::size_t>(worker)];
    const auto length = static_cast<std::size_t>(starts_[index + 1] - starts_[index]);
    if (buffer.size() < length + kTextPadding) buffer.resize(length + kTextPadding);
    const auto bytes = std::as_writable_bytes(std::span(buffer.data(), length));
    if (input_->read(starts_[index], bytes) < length) {
      throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early", name(), starts_[index]));
    }
    if (line_end_ == '\r') std::replace(buffer.data(), buffer.data() + length, '\r', '\n');
    std::fill_n(buffer.data() + length, kTextPadding, '\0');
    body({index, starts_[index], buffer.data(), buffer.data() + length}, worker);
  });
}

Error TextPieces::error(const TextPiece& piece, const char* place, const std::string& what) const {
  return Error(Error::Data, fmt::format("{}: byte {}: {}", name(), piece.offset_of(place), what));
}

char line_end_of(std::string_view text) {
  const std::size_t first = text.find_first_of("\r\n");
  const bool alone = first != std::string_view::npos && text[first] == '\r' &&
                     (first + 1 >= text.size() || text[first + 1] != '\n') &&
                     text.find('\n', first) == std::string_view::npos;
  return alone ? '\r' : '\n';
}

const char* end_of_line(const char* text, const char* end, char line_end) {
  const void* const found = std::memchr(text, line_end, static_cast<std::size_t>(end - text));
  return found != nullptr ? static_cast<const char*>(found) : end;
}

std::string shown_word(const char* text, const char* end) {
  std::string word;
  for (; text != end && word.size() < 20 && *text != ' ' && (*text < '\t' || *text > '\r'); ++text) {
    word += *text > ' ' && *text <= '~' ? *text : '?';
  }
  return word;
}

}  // namespace azulejo
