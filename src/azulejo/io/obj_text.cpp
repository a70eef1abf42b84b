#include "azulejo/io/obj_text.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "azulejo/io/read_text.h"

namespace azulejo {
namespace {

/// Large enough that arrays of pieces grow few times, small enough to share among threads.
constexpr std::uint64_t kPieceBytes = std::uint64_t{1} << 20;
constexpr std::size_t kWindow = std::size_t{1} << 14;
constexpr std::size_t kLineFeeds = 2;

}  // namespace

ObjText::ObjText(std::shared_ptr<const Input> input, const Run& run) : input_(std::move(input)) {
  std::array<char, 3> mark = {};
  input_->read(0, std::as_writable_bytes(std::span(mark)));
  const std::string_view head(mark.data(), mark.size());
  if (head.starts_with("\xFE\xFF") || head.starts_with("\xFF\xFE")) {
    converted_ = std::move(read_text(*input_, run).bytes);
    input_ = memory_input(std::as_bytes(std::span(converted_)), input_->name());
  }
  const std::uint64_t size = input_->size();
  starts_.push_back(head == "\xEF\xBB\xBF" ? 3 : 0);
  while (starts_.back() < size) {
    starts_.push_back(size - starts_.back() <= kPieceBytes ? size : next_line(starts_.back() + kPieceBytes));
    const std::uint64_t length = starts_.back() - starts_[starts_.size() - 2];
    if (length > static_cast<std::uint64_t>(run.limits.memory_bytes)) {
      throw Error(Error::Resource, fmt::format("{}: a line of {} bytes, the limit of memory is {}", name(), length,
                                               run.limits.memory_bytes));
    }
  }
}

/// The byte behind the first line end at or behind `from` (2 or more) that no \ takes back.
std::uint64_t ObjText::next_line(std::uint64_t from) const {
  constexpr std::size_t kBefore = 2;
  std::array<char, kWindow> window;
  for (std::uint64_t place = from - kBefore;; place += window.size() - kBefore) {
    const std::size_t count = input_->read(place, std::as_writable_bytes(std::span(window)));
    const std::string_view text(window.data(), count);
    for (std::size_t at = text.find('\n', kBefore); at != std::string_view::npos; at = text.find('\n', at + 1)) {
      const char before = text[at - 1] == '\r' ? text[at - 2] : text[at - 1];
      if (before != '\\') return place + at + 1;
    }
    if (count < window.size()) return input_->size();
  }
}

std::string_view ObjText::load(std::size_t piece, Array<char>& buffer) const {
  const auto length = static_cast<std::size_t>(starts_[piece + 1] - starts_[piece]);
  if (buffer.size() < length + kLineFeeds) buffer.resize(length + kLineFeeds);
  if (input_->read(starts_[piece], std::as_writable_bytes(std::span(buffer.data(), length))) < length) {
    throw Error(Error::Io,
                fmt::format("{}: byte {}: the file became shorter while it was read", name(), starts_[piece]));
  }
  std::fill_n(buffer.data() + length, kLineFeeds, '\n');
  return {buffer.data(), length + kLineFeeds};
}

std::size_t ObjText::line_of(std::uint64_t byte) const {
  std::array<char, kWindow> window;
  std::size_t line = 1;
  bool carriage = false;  // the last byte was \r
  for (std::uint64_t place = 0; place < byte;) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(window.size(), byte - place));
    const std::size_t count = input_->read(place, std::as_writable_bytes(std::span(window.data(), wanted)));
    if (count == 0) break;
    for (std::size_t i = 0; i < count; ++i) {
      if (window[i] == '\r' || (window[i] == '\n' && !carriage)) ++line;
      carriage = window[i] == '\r';
    }
    place += count;
  }
  return line;
}

Error ObjText::error(std::uint64_t byte, const std::string& what) const {
  return Error(Error::Data, fmt::format("{}: line {}: {}", name(), line_of(byte), what));
}

}  // namespace azulejo
