#include <algorithm>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/stl_soup.h"
#include "azulejo/io/text_numbers.h"
#include "azulejo/io/text_pieces.h"

namespace azulejo {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
bool ends_word(char c) { return c == '\0' || c == ' ' || (c >= '\t' && c <= '\r'); }

/// Behind `word` if it stands at `text` alone, in any case; else null. The text is padded: see TextPiece.
template <std::size_t Size>
const char* behind_keyword(const char* text, const char (&word)[Size]) {
  constexpr std::size_t kLength = Size - 1;
  static_assert(kLength < kTextPadding);
  if (std::memcmp(text, word, kLength) != 0) {
    for (std::size_t i = 0; i < kLength; ++i) {
      if (lower(text[i]) != word[i]) return nullptr;
    }
  }
  return ends_word(text[kLength]) ? text + kLength : nullptr;
}

/// What a piece of the file gives. Pieces begin where a facet does.
struct PieceSoup {
  Array<glm::vec3> corners;
  std::size_t opposed = 0;
  int solids = 0;         ///< "solid" lines
  bool ended = false;     ///< whether the last of "solid" and "endsolid" was "endsolid"
  bool says_end = false;  ///< whether one of them was there at all
  std::string name;       ///< of the first solid
};

class PieceParser {
 public:
  PieceParser(const TextPieces& file, const TextPiece& piece, PieceSoup& soup)
      : file_(file), piece_(piece), soup_(soup), next_(piece.begin) {}

  void parse() {
    constexpr std::size_t kUsualFacet = 200;
    soup_.corners.reserve(3 * (static_cast<std::size_t>(piece_.end - piece_.begin) / kUsualFacet + 1));
    for (next_ = behind_space(next_); next_ != piece_.end; next_ = behind_space(next_)) {
      if (take("facet")) {
        facet();
      } else if (take("solid")) {
        solid(true);
      } else if (take("endsolid") || take_end_of("solid")) {
        solid(false);
      } else {
        throw unexpected("facet, solid or endsolid");
      }
    }
  }

 private:
  template <std::size_t Size>
  bool take(const char (&word)[Size]) {
    const char* const behind = behind_keyword(next_, word);
    if (behind != nullptr) next_ = behind;
    return behind != nullptr;
  }
  /// "end facet", as some programs write it.
  template <std::size_t Size>
  bool take_end_of(const char (&word)[Size]) {
    const char* const before = next_;
    if (take("end")) {
      next_ = behind_space(next_);
      if (take(word)) return true;
    }
    next_ = before;
    return false;
  }

  Error unexpected(const char* wanted) const {
    if (next_ == piece_.end)
      return file_.error(piece_, next_, fmt::format("the file ends where {} is expected", wanted));
    return file_.error(piece_, next_, fmt::format("'{}', expected {}", shown_word(next_, piece_.end), wanted));
  }

  glm::vec3 vector() {
    glm::vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
      next_ = behind_space(next_);
      const char* const behind = parse_float(next_, result[axis]);
      if (behind == nullptr || !ends_word(*behind)) throw unexpected("a number");
      next_ = behind;
    }
    return result;
  }

  void facet() {
    next_ = behind_blanks(next_);
    const glm::vec3 normal = take("normal") ? vector() : glm::vec3(0, 0, 0);
    std::size_t corners = 0;
    glm::vec3 polygon[3];
    for (;;) {
      next_ = behind_space(next_);
      if (take("vertex")) {
        const glm::vec3 position = vector();
        if (corners >= 3) polygon[1] = polygon[2];
        polygon[std::min<std::size_t>(corners, 2)] = position;
        if (++corners >= 3) triangle(polygon, normal);
      } else if (take("endfacet") || take_end_of("facet")) {
        break;
      } else if (!take("outer") && !take("loop") && !take("endloop") && !take_end_of("loop")) {
        throw unexpected("vertex, outer loop, endloop or endfacet");
      }
    }
    if (corners < 3) throw file_.error(piece_, next_, fmt::format("a facet of {} vertices, expected 3", corners));
  }

  void triangle(const glm::vec3* corner, const glm::vec3& normal) {
    soup_.corners.insert(soup_.corners.end(), corner, corner + 3);
    soup_.opposed += opposes(normal, corner) ? 1U : 0U;
  }

  void solid(bool begins) {
    const char* const end = end_of_line(next_, piece_.end);
    if (begins && soup_.solids++ == 0) {
      const char* first = behind_blanks(next_);
      const char* last = end;
      while (last > first && ends_word(last[-1])) --last;
      if (first < last) soup_.name.assign(first, last);
    }
    soup_.says_end = true;
    soup_.ended = !begins;
    next_ = end;
  }

  const TextPieces& file_;
  const TextPiece& piece_;
  PieceSoup& soup_;
  const char* next_;
};

void join(std::vector<PieceSoup>& pieces, StlSoup& soup, const std::string& name, const Run& run) {
  std::vector<std::size_t> places;
  std::size_t corners = 0;
  bool ended = false;
  bool named = false;
  for (PieceSoup& piece : pieces) {
    places.push_back(corners);
    corners += piece.corners.size();
    soup.opposed += piece.opposed;
    if (piece.says_end) ended = piece.ended;
    if (piece.solids > 0 && !std::exchange(named, true)) soup.name = piece.name;
  }
  check_stl_size(name, corners / 3, run);
  soup.corners.resize(corners);
  parallel_tasks(pieces.size(), run, [&](std::size_t piece, int) {
    std::copy(pieces[piece].corners.begin(), pieces[piece].corners.end(), soup.corners.data() + places[piece]);
  });
  if (!ended) warn(run, fmt::format("{}: the file ends without endsolid: there may have been more", name));
}

}  // namespace

bool is_stl_text(std::span<const std::byte> head, std::uint64_t size) {
  const char* const text = reinterpret_cast<const char*>(head.data());
  const std::string padded = std::string(text, text + head.size()) + std::string(kTextPadding, '\0');
  const char* begin = padded.c_str();
  if (padded.starts_with("\xEF\xBB\xBF")) begin += 3;
  const bool control = std::any_of(padded.begin(), padded.end() - kTextPadding,
                                   [](char c) { return c >= 0 && c < ' ' && (c < '\t' || c > '\r'); });
  return !control && !fits_stl_binary(head, size) && behind_keyword(behind_space(begin), "solid") != nullptr;
}

void read_stl_text(const std::shared_ptr<const Input>& input, StlSoup& soup, const Run& run) {
  std::string head(512, '\0');
  head.resize(input->read(0, std::as_writable_bytes(std::span(head))));
  const std::uint64_t begin = head.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const auto begins_facet = [](std::string_view line) {
    const std::string padded = std::string(line) + std::string(kTextPadding, '\0');
    return behind_keyword(behind_space(padded.c_str()), "facet") != nullptr;
  };
  const TextPieces file(input, begin, run, line_end_of(head), begins_facet);
  std::vector<PieceSoup> pieces(file.size());
  file.for_each(run, [&](const TextPiece& piece, int) { PieceParser(file, piece, pieces[piece.index]).parse(); });
  join(pieces, soup, input->name(), run);
}

}  // namespace azulejo
