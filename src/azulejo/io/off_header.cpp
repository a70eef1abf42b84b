#include "azulejo/io/off_header.h"

#include <array>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/load_number.h"
#include "azulejo/io/text_pieces.h"

namespace azulejo {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 16;  ///< with the comments in it

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Words of a text, without comments.
class Words {
 public:
  Words(std::string_view text, char line_end) : text_(text), line_end_(line_end) {}

  /// The next word; empty at the end of the text. Before it is taken, `line_has_more` tells if it is on the same line.
  std::string_view next() {
    skip_blanks(false);
    std::size_t end = place_;
    while (end < text_.size() && !is_space(text_[end]) && text_[end] != '#') ++end;
    const std::string_view word = text_.substr(place_, end - place_);
    place_ = end;
    return word;
  }
  bool line_has_more() {
    skip_blanks(true);
    return place_ < text_.size() && text_[place_] != line_end_;
  }
  /// Behind the line that the last word stood on.
  std::size_t next_line() const {
    const std::size_t end = text_.find(line_end_, place_);
    return end == std::string_view::npos ? text_.size() : end + 1;
  }
  std::size_t place() const { return place_; }

 private:
  void skip_blanks(bool in_line) {
    while (place_ < text_.size()) {
      const char c = text_[place_];
      if (c == '#') {
        const std::size_t end = text_.find(line_end_, place_);
        place_ = end == std::string_view::npos ? text_.size() : end;
      } else if (is_space(c) && !(in_line && c == line_end_)) {
        ++place_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  char line_end_;
  std::size_t place_ = 0;
};

struct Word {
  OffHeader header;
  bool four = false;
  bool any_dimension = false;
};

/// What OFF's word says, or nothing if it is none.
std::optional<Word> parse_word(std::string_view word) {
  if (!word.ends_with("OFF") || word.size() > 9) return std::nullopt;
  word.remove_suffix(3);
  Word result;
  while (!word.empty()) {
    const bool texcoords = word.starts_with("ST");
    bool& flag = texcoords             ? result.header.texcoords
                 : word.front() == 'C' ? result.header.colors
                 : word.front() == 'N' ? result.header.normals
                 : word.front() == '4' ? result.four
                                       : result.any_dimension;
    if (!texcoords && std::string_view("CN4n").find(word.front()) == std::string_view::npos) return std::nullopt;
    if (flag) return std::nullopt;
    flag = true;
    word.remove_prefix(texcoords ? 2 : 1);
  }
  return result;
}

class HeaderParser {
 public:
  HeaderParser(const Input& input, std::string_view head)
      : input_(input), head_(head), words_(head, line_end_of(head)) {}

  OffHeader parse() {
    Word word;
    const std::size_t before = words_.place();
    std::string_view first = words_.next();
    if (const auto parsed = parse_word(first)) {
      word = *parsed;
      first = {};
    } else if (first.empty() || first[0] < '0' || first[0] > '9') {
      throw error(before, "doesn't begin with OFF");
    }
    word.header.line_end = line_end_of(head_);
    if (word.four) throw unsupported("vertices of four coordinates, expected three");
    if (first.empty() && is_binary()) {
      word.header.binary = true;
      binary_counts(word);
    } else {
      text_counts(word, first);
    }
    check_counts(word.header);
    return word.header;
  }

 private:
  Error error(std::size_t place, const std::string& what) const {
    return Error(Error::Data, fmt::format("{}: byte {}: {}", input_.name(), place, what));
  }
  Error unsupported(const std::string& what) const {
    return Error(Error::Unsupported, fmt::format("{}: {}", input_.name(), what));
  }

  bool is_binary() {
    if (!words_.line_has_more()) return false;
    Words ahead = words_;
    if (ahead.next() != "BINARY") return false;
    words_ = ahead;
    return true;
  }

  std::uint64_t number(std::string_view word, const char* what) const {
    std::uint64_t value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || status != std::errc() || end != word.data() + word.size()) {
      throw error(words_.place(), fmt::format("'{}', expected the number of {}", word.substr(0, 20), what));
    }
    return value;
  }

  void text_counts(Word& word, std::string_view first) {
    if (word.any_dimension) {
      const std::uint64_t dimension = number(words_.next(), "dimensions");
      if (dimension != 3) throw unsupported(fmt::format("vertices of {} coordinates, expected three", dimension));
    }
    word.header.vertices = number(first.empty() ? words_.next() : first, "vertices");
    word.header.faces = number(words_.next(), "faces");
    // The number of edges, which nobody needs, and which not all files have.
    if (words_.line_has_more()) number(words_.next(), "edges");
    word.header.body = words_.next_line();
  }

  void binary_counts(Word& word) {
    std::uint64_t place = words_.next_line();
    const auto next = [&](const char* what) {
      std::array<std::byte, 4> bytes = {};
      if (input_.read(place, bytes) < bytes.size()) throw error(place, "the file ends too early");
      const auto value = load_number<std::int32_t>(bytes.data(), std::endian::big);
      if (value < 0) throw error(place, fmt::format("{} {}", value, what));
      place += bytes.size();
      return static_cast<std::uint64_t>(value);
    };
    if (word.any_dimension) {
      const std::uint64_t dimension = next("dimensions");
      if (dimension != 3) throw unsupported(fmt::format("vertices of {} coordinates, expected three", dimension));
    }
    word.header.vertices = next("vertices");
    word.header.faces = next("faces");
    next("edges");
    word.header.body = place;
  }

  void check_counts(const OffHeader& header) const {
    const std::uint64_t rest = input_.size() - std::min<std::uint64_t>(header.body, input_.size());
    // In text a value takes a digit and a byte that ends it; the last may lack that.
    const std::uint64_t vertex = header.binary ? 12 : 6;
    const std::uint64_t face = header.binary ? 8 : 2;
    if (header.vertices > (rest + 1) / vertex || header.faces > (rest + 1 - header.vertices * vertex) / face) {
      throw error(static_cast<std::size_t>(input_.size()),
                  fmt::format("the file ends too early: {} vertices and {} faces don't fit {} bytes", header.vertices,
                              header.faces, rest));
    }
  }

  const Input& input_;
  std::string_view head_;
  Words words_;
};

}  // namespace

OffHeader read_off_header(const Input& input) {
  std::string head(kLongestHeader, '\0');
  head.resize(input.read(0, std::as_writable_bytes(std::span(head))));
  return HeaderParser(input, head).parse();
}

bool begins_like_off(std::string_view head, bool named) {
  const std::string_view word = Words(head, line_end_of(head)).next();
  if (parse_word(word)) return true;
  return named && (word.empty() || (word[0] >= '0' && word[0] <= '9'));
}

}  // namespace azulejo
