#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/off_read.h"
#include "azulejo/io/text_numbers.h"
#include "azulejo/io/text_pieces.h"
#include "azulejo/io/text_rows.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostExtras = 9;  ///< of a vertex: normal, colour with alpha, texture coordinates

bool is_integer(const char* text, const char* end) {
  return std::none_of(text, end, [](char c) { return (c < '0' || c > '9') && c != '-' && c != '+'; });
}

/// Parses lines of one piece.
class LineParser {
 public:
  LineParser(const TextPieces& file, const TextPiece& piece, OffRows& rows, OffFaces& faces)
      : file_(file), piece_(piece), next_(piece.begin), rows_(rows), faces_(faces) {}

  void vertices(std::size_t begin, std::size_t end, bool has_extras) {
    for (std::size_t vertex = begin; vertex < end; ++vertex) {
      to_row();
      for (int axis = 0; axis < 3; ++axis) rows_.positions[vertex][axis] = number("a coordinate");
      if (has_extras) {
        const std::size_t count = extras(kMostExtras);
        rows_.set_vertex(vertex, values_.data(), count, reals_, vertex_kinds);
      }
      end_row();
    }
  }

  void faces(std::size_t count) {
    for (std::size_t face = 0; face < count; ++face) {
      to_row();
      const std::int64_t corners = integer("the number of a face's corners");
      // A value takes two bytes at least, the last one.
      if (corners < 0 || corners > (piece_.end - next_ + 1) / 2) {
        throw file_.error(piece_, next_, fmt::format("a face of {} corners", corners));
      }
      faces_.counts.push_back(static_cast<std::uint32_t>(corners));
      for (std::int64_t i = 0; i < corners; ++i) {
        const std::int64_t index = integer("the number of a vertex");
        faces_.corners.push_back(index >= 0 && index < 0xFFFFFFFF ? static_cast<std::uint32_t>(index) : 0xFFFFFFFF);
      }
      if (const std::size_t values = extras(4)) faces_.add_color(values_.data(), values, reals_ != 0);
      end_row();
    }
  }

  OffColorKinds vertex_kinds;

 private:
  Error unexpected(const char* wanted) const {
    const std::string found = shown_word(next_, piece_.end);
    return file_.error(piece_, next_,
                       fmt::format("{}, expected {}", found.empty() ? "the row ends" : "'" + found + "'", wanted));
  }

  void to_row() {
    for (next_ = behind_space(next_); *next_ == '#'; next_ = behind_space(next_)) {
      next_ = end_of_line(next_, piece_.end);
    }
  }
  /// What a row has behind its values is nothing that the format knows; programs put much there.
  void end_row() { next_ = end_of_line(next_, piece_.end); }

  float number(const char* wanted) {
    next_ = behind_blanks(next_);
    float value = 0;
    const char* const end = parse_float(next_, value);
    if (end == nullptr || !ends_value(*end)) throw unexpected(wanted);
    next_ = end;
    return value;
  }

  std::int64_t integer(const char* wanted) {
    next_ = behind_blanks(next_);
    std::int64_t value = 0;
    const char* const end = parse_integer(next_, value);
    if (end == nullptr || !ends_value(*end)) throw unexpected(wanted);
    next_ = end;
    return value;
  }

  /// Up to `most` numbers that the row has further on.
  std::size_t extras(std::size_t most) {
    std::size_t count = 0;
    reals_ = 0;
    for (; count < most; ++count) {
      next_ = behind_blanks(next_);
      const char* const end = parse_float(next_, values_[count]);
      if (end == nullptr || !ends_value(*end)) break;
      if (!is_integer(next_, end)) reals_ |= 1U << count;
      next_ = end;
    }
    return count;
  }

  const TextPieces& file_;
  const TextPiece& piece_;
  const char* next_;
  OffRows& rows_;
  OffFaces& faces_;
  std::array<float, kMostExtras> values_ = {};
  unsigned reals_ = 0;  ///< bits of the last extras that were no integers
};

}  // namespace

void read_off_text(const std::shared_ptr<const Input>& input, const OffHeader& header, OffRows& rows, const Run& run) {
  const TextPieces file(input, header.body, run, header.line_end);
  const std::vector<std::uint64_t> first = first_rows(file, '#', run);
  const std::uint64_t wanted = header.vertices + header.faces;
  if (first.back() < wanted) {
    throw Error(Error::Data,
                fmt::format("{}: byte {}: the file ends too early: {} rows, expected {} vertices and {} faces",
                            input->name(), input->size(), first.back(), header.vertices, header.faces));
  }
  if (first.back() > wanted) {
    warn(run, fmt::format("{}: {} lines behind the last face are not read", input->name(), first.back() - wanted));
  }
  rows.faces.resize(file.size());
  std::vector<OffColorKinds> kinds(file.size());
  const bool has_extras = header.normals || header.colors || header.texcoords;
  file.for_each(run, [&](const TextPiece& piece, int) {
    const std::uint64_t begin = first[piece.index];
    const std::uint64_t end = std::min(first[piece.index + 1], wanted);
    LineParser parser(file, piece, rows, rows.faces[piece.index]);
    const std::uint64_t last_vertex = std::min(end, header.vertices);
    if (begin < last_vertex) {
      parser.vertices(static_cast<std::size_t>(begin), static_cast<std::size_t>(last_vertex), has_extras);
    }
    const std::uint64_t first_face = std::max(begin, header.vertices);
    if (first_face < end) parser.faces(static_cast<std::size_t>(end - first_face));
    kinds[piece.index] = parser.vertex_kinds;
  });
  for (const OffColorKinds& each : kinds) rows.vertex_kinds |= each;
}

}  // namespace azulejo
