#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace azulejo {

/// A cell where it lies in the text.
struct CsvCell {
  std::string_view text;  ///< without the quotes and blanks around it
  bool doubled = false;   ///< has quotes in it, which stand there twice
};

/// What a cell says: quotes single, UTF-8 (what isn't is taken for Latin-1).
std::string utf8_of(const CsvCell& cell);

struct CsvPlace {
  std::size_t offset = 0;
  std::uint64_t line = 1;
};

/// Cuts a text into rows of cells, as csv.h says.
class CsvRows {
 public:
  CsvRows(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// The separator that a first line `sep=;` names, and goes behind it; 0: there is no such line.
  char take_separator();
  CsvPlace place() const { return place_; }
  void go_to(const CsvPlace& place, char separator) {
    place_ = place;
    separator_ = separator;
  }
  /// The cells of the next row; false: there is none. Throws Error(Data).
  bool next(std::vector<CsvCell>& cells);
  /// The line that the next row begins with.
  std::string_view line_at(const CsvPlace& place) const;
  /// Throws Error(Data) with the line that the row began at.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool at_end() const { return place_.offset >= text_.size(); }
  char here() const { return at_end() ? '\n' : text_[place_.offset]; }
  bool at_line_end() const { return here() == '\n' || here() == '\r'; }
  bool is_blank(char c) const { return c == ' ' || (c == '\t' && separator_ != '\t'); }
  void skip_blanks();
  void skip_to_line_end();
  void take_line_end();
  bool find_row();
  CsvCell plain_cell();
  CsvCell quoted_cell();

  std::string_view text_;
  const std::string& name_;
  CsvPlace place_;
  char separator_ = ',';
  std::uint64_t row_line_ = 1;  ///< where the row began
};

}  // namespace azulejo
