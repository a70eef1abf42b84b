#include "azulejo/io/csv_rows.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/text_numbers.h"
#include "azulejo/io/utf8.h"

namespace azulejo {

std::string utf8_of(const CsvCell& cell) {
  std::string text(cell.text);
  if (cell.doubled) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < text.size(); ++i, ++length) {
      text[length] = text[i];
      if (text[i] == '"') ++i;
    }
    text.resize(length);
  }
  return is_utf8(text) ? text : utf8_from_latin1(text);
}

void CsvRows::fail(const std::string& what) const {
  throw Error(Error::Data, fmt::format("{}: line {}: {}", name_, row_line_, what));
}

char CsvRows::take_separator() {
  constexpr std::string_view kHint = "sep=";
  if (!text_.starts_with(kHint) || text_.size() <= kHint.size()) return '\0';
  const char named = text_[kHint.size()];
  if (std::string_view(",;\t ").find(named) == std::string_view::npos) return '\0';
  const CsvPlace before = place_;
  place_.offset = kHint.size() + 1;
  if (at_line_end()) {
    take_line_end();
    return named;
  }
  place_ = before;
  return '\0';
}

void CsvRows::skip_blanks() {
  while (!at_end() && is_blank(here())) ++place_.offset;
}

void CsvRows::skip_to_line_end() {
  while (!at_line_end()) ++place_.offset;
}

void CsvRows::take_line_end() {
  if (at_end()) return;
  const bool two = here() == '\r' && place_.offset + 1 < text_.size() && text_[place_.offset + 1] == '\n';
  place_.offset += two ? 2 : 1;
  ++place_.line;
}

/// Goes to the first line that is neither empty nor a comment; false: there is none.
bool CsvRows::find_row() {
  while (!at_end()) {
    const std::size_t begin = place_.offset;
    skip_blanks();
    if (here() == '#') {
      skip_to_line_end();
    } else if (!at_line_end()) {
      if (separator_ != ' ') place_.offset = begin;
      row_line_ = place_.line;
      return true;
    }
    take_line_end();
  }
  return false;
}

bool CsvRows::next(std::vector<CsvCell>& cells) {
  cells.clear();
  if (!find_row()) return false;
  for (;;) {
    skip_blanks();
    cells.push_back(here() == '"' ? quoted_cell() : plain_cell());
    if (separator_ == ' ') {
      skip_blanks();
    } else if (!at_line_end()) {
      ++place_.offset;  // the separator
      continue;
    }
    if (at_line_end()) break;
  }
  take_line_end();
  return true;
}

CsvCell CsvRows::plain_cell() {
  const std::size_t begin = place_.offset;
  while (!at_line_end() && here() != separator_ && !(separator_ == ' ' && is_blank(here()))) {
    if (here() == '\0') fail("a byte 0, expected text");
    ++place_.offset;
  }
  std::size_t end = place_.offset;
  while (end > begin && is_blank(text_[end - 1])) --end;
  return {text_.substr(begin, end - begin), false};
}

CsvCell CsvRows::quoted_cell() {
  const std::size_t begin = ++place_.offset;
  CsvCell cell;
  for (;;) {
    if (at_end()) fail("a quote that isn't closed, expected \"");
    if (here() == '\0') fail("a byte 0, expected text");
    if (here() == '"') {
      const bool doubled = place_.offset + 1 < text_.size() && text_[place_.offset + 1] == '"';
      if (!doubled) break;
      cell.doubled = true;
      ++place_.offset;
    }
    if (at_line_end()) {
      take_line_end();
    } else {
      ++place_.offset;
    }
  }
  cell.text = text_.substr(begin, place_.offset - begin);
  ++place_.offset;
  skip_blanks();
  const bool ended = at_line_end() || here() == separator_ || (separator_ == ' ' && is_blank(text_[place_.offset - 1]));
  if (!ended) {
    fail(fmt::format(
        "\"{}\" behind a closed quote, expected a separator",
        quoted_word(text_.substr(place_.offset, text_.find_first_of("\r\n", place_.offset) - place_.offset))));
  }
  return cell;
}

std::string_view CsvRows::line_at(const CsvPlace& place) const {
  CsvRows rows = *this;
  rows.go_to(place, ',');
  if (!rows.find_row()) return {};
  const std::size_t begin = rows.place_.offset;
  rows.skip_to_line_end();
  return text_.substr(begin, rows.place_.offset - begin);
}

}  // namespace azulejo
