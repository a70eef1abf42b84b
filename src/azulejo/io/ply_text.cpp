#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/ply_rows.h"
#include "azulejo/io/text_numbers.h"
#include "azulejo/io/text_pieces.h"
#include "azulejo/io/text_rows.h"

namespace azulejo {
namespace {

/// Parses lines of one piece: rows of one element, or of several in turn.
class LineParser {
 public:
  LineParser(const TextPieces& file, const TextPiece& piece) : file_(file), piece_(piece), next_(piece.begin) {}

  /// The next `count` lines, as rows from `first_row`.
  void rows(const PlyRows& rows, PlyPiece& result, std::size_t first_row, std::size_t count) {
    result.lost.assign(rows.sinks.size(), false);
    for (std::size_t row = first_row; row < first_row + count; ++row) {
      next_ = behind_space(next_);
      for (std::size_t i = 0; i < rows.sinks.size(); ++i) {
        const PlyProperty& property = rows.element->properties[i];
        if (property.is_list) {
          list(*rows.element, property, rows.sinks[i], result);
        } else if (!scalar(property, rows.sinks[i], row) && rows.sinks[i].says_loss) {
          result.lost[i] = true;
        }
      }
      end_row(*rows.element);
    }
  }

 private:
  Error unexpected(const PlyProperty& property) const {
    const std::string found = shown_word(next_, piece_.end);
    return file_.error(piece_, next_,
                       fmt::format("{}, expected a value of property {}",
                                   found.empty() ? "the row ends" : "'" + found + "'", property.name));
  }

  float real(const PlyProperty& property) {
    next_ = behind_blanks(next_);
    float value = 0;
    const char* const end = parse_float(next_, value);
    if (end == nullptr || !ends_value(*end)) throw unexpected(property);
    next_ = end;
    return value;
  }

  /// Integers that some program wrote like 3.0 are taken too.
  std::int64_t integer(const PlyProperty& property) {
    next_ = behind_blanks(next_);
    std::int64_t value = 0;
    const char* const end = parse_integer(next_, value);
    if (end != nullptr && ends_value(*end)) {
      next_ = end;
      return value;
    }
    const double number = static_cast<double>(real(property));
    return number >= -4e9 && number <= 4e9 ? static_cast<std::int64_t>(number) : -1;
  }

  bool scalar(const PlyProperty& property, const PlySink& sink, std::size_t row) {
    const bool is_real = property.type == PlyType::F32 || property.type == PlyType::F64;
    // What a float can't hold of a decimal fraction was never meant.
    if (is_real) return put_ply_value(sink, row, static_cast<double>(real(property)));
    return put_ply_value(sink, row, static_cast<double>(integer(property)));
  }

  void list(const PlyElement& element, const PlyProperty& property, const PlySink& sink, PlyPiece& result) {
    const std::int64_t count = integer(property);
    // A value takes two bytes at least, the last one.
    if (count < 0 || count > (piece_.end - next_ + 1) / 2) {
      throw file_.error(
          piece_, next_,
          fmt::format("a list of {} values of property {} of element {}", count, property.name, element.name));
    }
    if (sink.kind == PlySink::Indices) {
      result.index_counts.push_back(static_cast<std::uint32_t>(count));
      for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t index = integer(property);
        result.indices.push_back(index >= 0 && index < kNoPlyIndex ? static_cast<std::uint32_t>(index) : kNoPlyIndex);
      }
    } else {
      const bool wanted = sink.kind == PlySink::Texcoords;
      if (wanted) result.texcoord_counts.push_back(static_cast<std::uint32_t>(count));
      for (std::int64_t i = 0; i < count; ++i) {
        const float value = real(property);
        if (wanted) result.texcoords.push_back(value);
      }
    }
  }

  void end_row(const PlyElement& element) {
    next_ = behind_blanks(next_);
    if (next_ == piece_.end || *next_ == '\n') return;
    throw file_.error(
        piece_, next_,
        fmt::format("'{}' behind the last value of a row of element {}", shown_word(next_, piece_.end), element.name));
  }

  const TextPieces& file_;
  const TextPiece& piece_;
  const char* next_;
};

/// The rows of each element, as lines of the file. Elements without properties have none.
struct Lines {
  std::vector<std::uint64_t> first_of_rows;   ///< for each of `rows`, and the number of lines wanted
  std::vector<std::uint64_t> first_of_piece;  ///< for each piece, and the number of lines there are
};

Lines count_all(const TextPieces& file, const std::vector<PlyRows>& rows, const Run& run) {
  Lines lines;
  std::uint64_t line = 0;
  for (const PlyRows& each : rows) {
    lines.first_of_rows.push_back(line);
    if (!each.element->properties.empty()) line += each.element->count;
  }
  lines.first_of_rows.push_back(line);
  lines.first_of_piece = first_rows(file, '\0', run);
  return lines;
}

void check_lines(const Input& input, const std::vector<PlyRows>& rows, const Lines& lines, const Run& run) {
  const std::uint64_t there = lines.first_of_piece.back();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (there >= lines.first_of_rows[i + 1]) continue;
    throw Error(Error::Data, fmt::format("{}: byte {}: the file ends too early: {} of {} rows of element {}",
                                         input.name(), input.size(), there - lines.first_of_rows[i],
                                         rows[i].element->count, rows[i].element->name));
  }
  if (there > lines.first_of_rows.back()) {
    warn(run, fmt::format("{}: {} lines behind the last element are not read", input.name(),
                          there - lines.first_of_rows.back()));
  }
}

}  // namespace

void read_ply_text(const std::shared_ptr<const Input>& input, const PlyHeader& header, std::vector<PlyRows>& rows,
                   const Run& run) {
  const TextPieces file(input, header.body, run, header.line_end);
  const Lines lines = count_all(file, rows, run);
  check_lines(*input, rows, lines, run);
  for (PlyRows& each : rows) each.pieces.resize(file.size());
  file.for_each(run, [&](const TextPiece& piece, int) {
    const std::uint64_t begin = lines.first_of_piece[piece.index];
    const std::uint64_t end = lines.first_of_piece[piece.index + 1];
    LineParser parser(file, piece);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::uint64_t first = std::max(begin, lines.first_of_rows[i]);
      const std::uint64_t last = std::min(end, lines.first_of_rows[i + 1]);
      if (first >= last) continue;
      parser.rows(rows[i], rows[i].pieces[piece.index], static_cast<std::size_t>(first - lines.first_of_rows[i]),
                  static_cast<std::size_t>(last - first));
    }
  });
}

}  // namespace azulejo
