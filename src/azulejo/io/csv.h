#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"

namespace azulejo {

struct CsvColumn {
  std::string name;                ///< of the header; without one, or where it is empty there: "1", "2", …
  std::vector<double> numbers;     ///< one a row; NaN where the cell holds none
  std::vector<std::string> texts;  ///< empty where all cells are numbers or nothing; else one a row, as written, UTF-8
  bool is_text() const { return !texts.empty(); }
};

/// Rows of cells. Columns have as many values as there are rows.
struct AZULEJO_EXPORT CsvTable {
  std::string source;  ///< file, for messages
  std::vector<CsvColumn> columns;
  std::size_t rows = 0;

  /// The first column of that name; else, where `which` is a whole number from 1, the so-many-th.
  /// Throws Error(Argument) that begins with `argument` and names the columns that there are.
  const CsvColumn& column(std::string_view which, std::string_view argument) const;
};

struct CsvOptions {
  /// One of `,` `;` tab blank; a blank stands for any run of blanks and tabs. Auto: the first of tab ; , blank that cuts
  /// all of the first rows into as many cells, more than one; none does: the first that stands in the first row.
  std::optional<char> separator = std::nullopt;
  /// Whether the first row names the columns. Auto: it does where none of its cells is a number, or where a cell of it
  /// isn't and all below are.
  std::optional<bool> header = std::nullopt;
};

/// Reads a table as spreadsheets and programs write it.
///
/// text      UTF-8, UTF-16 with its mark; what isn't UTF-8 is taken for Latin-1. Lines end with \n, \r\n or \r
/// rows      all of one length. Empty lines and those that begin with # are left out; a first line `sep=;` names the
///           separator
/// cells     without the blanks around them. In double quotes they may hold separators and line ends; "" is a quote
/// numbers   1, -.5, +2e-3, inf; with a decimal comma where the separator isn't a comma. Nothing, nan, na, n/a and null
///           in any case are NaN; they make no column a text
/// Throws    Error(Io), Error(Data) with the line for a row of another length, a quote that isn't closed or that
///           something follows, a byte 0, and for a file without rows; Error(Resource) beyond run.limits.memory_bytes
/// Cost      O(bytes); the file, 8 bytes a cell, and the texts
/// Source    RFC 4180, and what programs make of it
AZULEJO_EXPORT CsvTable read_csv(const std::string& path, const CsvOptions& options = {}, const Run& run = {});

/// The same from memory; `name` stands in messages.
AZULEJO_EXPORT CsvTable parse_csv(std::string_view text, const std::string& name, const CsvOptions& options = {},
                                  const Run& run = {});

}  // namespace azulejo
