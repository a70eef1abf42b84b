#include "azulejo/io/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/io/csv_rows.h"
#include "azulejo/io/input.h"
#include "azulejo/io/read_text.h"
#include "azulejo/io/text_numbers.h"

namespace azulejo {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kRowsLookedAt = 32;
constexpr std::array<char, 4> kSeparators = {'\t', ';', ',', ' '};

bool is_nothing(std::string_view text) {
  static constexpr std::array<std::string_view, 5> kWords = {"", "nan", "na", "n/a", "null"};
  return std::any_of(kWords.begin(), kWords.end(), [&](std::string_view word) {
    return std::equal(word.begin(), word.end(), text.begin(), text.end(),
                      [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
  });
}

/// 0 or infinite: a number of digits that is too small or too large, whichever it is.
double out_of_range(std::string_view text) {
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::size_t point = std::min(text.find('.'), end);
  const std::size_t first = text.find_first_of("123456789");
  const bool whole = first < point;
  const bool small = end < text.size() && text[end + 1] == '-';
  std::int64_t exponent = 0;
  std::string_view digits = text.substr(std::min(end + (small ? 2 : 1), text.size()));
  if (digits.starts_with('+')) digits.remove_prefix(1);
  constexpr std::int64_t kFar = std::int64_t{1} << 60;
  const auto status = std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec;
  if (status == std::errc::result_out_of_range) exponent = kFar;
  const auto places = static_cast<std::int64_t>(whole ? point - first : first - point);
  const bool large = (whole ? places : -places) + (small ? -exponent : exponent) > 0;
  return (large ? std::numeric_limits<double>::infinity() : 0.0) * (text[0] == '-' ? -1 : 1);
}

/// Whether all of `text` is a number, which may have a decimal comma.
bool parse_number(std::string_view text, bool comma, double& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  std::array<char, 64> with_point{};
  const std::size_t at = comma ? text.find(',') : std::string_view::npos;
  if (at != std::string_view::npos) {
    if (text.size() > with_point.size() || text.find('.') != std::string_view::npos) return false;
    std::copy(text.begin(), text.end(), with_point.begin());
    with_point[at] = '.';
    text = {with_point.data(), text.size()};
  }
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status == std::errc::invalid_argument || end != text.data() + text.size()) return false;
  if (status == std::errc::result_out_of_range) number = out_of_range(text);
  return true;
}

enum class CellKind { Number, Nothing, Text };

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name, const CsvOptions& options, const Run& run)
      : rows_(text, name), name_(name), options_(options), run_(run) {
    const char named = rows_.take_separator();
    start_ = rows_.place();
    separator_ = options.separator.value_or(named != '\0' ? named : guessed_separator());
    decimal_comma_ = separator_ != ',';
  }

  CsvTable read() {
    CsvTable table;
    table.source = name_;
    rows_.go_to(start_, separator_);
    if (!rows_.next(cells_)) throw Error(Error::Data, name_ + ": no rows, expected a table");
    table.columns.resize(cells_.size());
    is_text_.resize(cells_.size());
    const bool header = options_.header.value_or(guessed_header());
    rows_.go_to(start_, separator_);
    if (header && rows_.next(cells_)) {
      for (std::size_t c = 0; c < cells_.size(); ++c) table.columns[c].name = utf8_of(cells_[c]);
    }
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (table.columns[c].name.empty()) table.columns[c].name = std::to_string(c + 1);
    }
    const CsvPlace first = rows_.place();
    read_numbers(table);
    rows_.go_to(first, separator_);
    read_texts(table);
    return table;
  }

 private:
  CellKind kind_of(const CsvCell& cell, double& number) const {
    number = kNothing;
    if (parse_number(cell.text, decimal_comma_, number)) return CellKind::Number;
    return is_nothing(cell.text) ? CellKind::Nothing : CellKind::Text;
  }

  /// How many cells each of the first rows has; 0: not all the same.
  std::size_t cells_with(char separator) {
    std::size_t count = 0;
    rows_.go_to(start_, separator);
    try {
      for (std::size_t row = 0; row < kRowsLookedAt && rows_.next(cells_); ++row) {
        if (row > 0 && cells_.size() != count) return 0;
        count = cells_.size();
      }
    } catch (const Error&) {  // what is wrong is told when the table is read
      return 0;
    }
    return count;
  }

  char guessed_separator() {
    for (const char separator : kSeparators) {
      if (cells_with(separator) > 1) return separator;
    }
    const std::string_view line = rows_.line_at(start_);
    for (const char separator : kSeparators) {
      if (line.find(separator) != std::string_view::npos) return separator;
    }
    return ',';
  }

  /// With the first row in cells_.
  bool guessed_header() {
    std::vector<bool> named(cells_.size());
    double number = 0;
    bool numbers = false;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const CellKind kind = kind_of(cells_[c], number);
      named[c] = kind == CellKind::Text;
      numbers = numbers || kind == CellKind::Number;
    }
    if (!numbers) return std::find(named.begin(), named.end(), true) != named.end();
    std::vector<bool> numbers_below(cells_.size());
    while (rows_.next(cells_)) {
      for (std::size_t c = 0; c < std::min(cells_.size(), named.size()); ++c) {
        const CellKind kind = kind_of(cells_[c], number);
        if (kind == CellKind::Text) named[c] = false;
        if (kind == CellKind::Number) numbers_below[c] = true;
      }
    }
    for (std::size_t c = 0; c < named.size(); ++c) {
      if (named[c] && numbers_below[c]) return true;
    }
    return false;
  }

  void check_memory(std::size_t cells, std::size_t texts) const {
    constexpr std::size_t kColumnBytes = 256;
    const std::size_t bytes = is_text_.size() * kColumnBytes + cells * sizeof(double) + texts * sizeof(std::string);
    if (bytes > static_cast<std::size_t>(run_.limits.memory_bytes)) {
      throw Error(Error::Resource, fmt::format("{}: {} cells to hold, the limit of memory is {} bytes", name_, cells,
                                               run_.limits.memory_bytes));
    }
  }

  void read_numbers(CsvTable& table) {
    check_memory(0, 0);
    while (rows_.next(cells_)) {
      if (cells_.size() != table.columns.size()) {
        rows_.fail(fmt::format("{} cells, expected {} as in the first row", cells_.size(), table.columns.size()));
      }
      if (table.rows % 1024 == 0) check_memory((table.rows + 1024) * table.columns.size(), 0);
      double number = 0;
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (kind_of(cells_[c], number) == CellKind::Text) is_text_[c] = true;
        table.columns[c].numbers.push_back(number);
      }
      ++table.rows;
    }
  }

  void read_texts(CsvTable& table) {
    const auto columns = static_cast<std::size_t>(std::count(is_text_.begin(), is_text_.end(), true));
    if (columns == 0) return;
    check_memory(table.rows * table.columns.size(), table.rows * columns);
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (is_text_[c]) table.columns[c].texts.reserve(table.rows);
    }
    while (rows_.next(cells_)) {
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (is_text_[c]) table.columns[c].texts.push_back(utf8_of(cells_[c]));
      }
    }
  }

  CsvRows rows_;
  const std::string& name_;
  const CsvOptions& options_;
  const Run& run_;
  CsvPlace start_;
  char separator_ = ',';
  bool decimal_comma_ = false;
  std::vector<CsvCell> cells_;
  std::vector<bool> is_text_;  ///< of each column
};

}  // namespace

CsvTable parse_csv(std::string_view text, const std::string& name, const CsvOptions& options, const Run& run) {
  if (options.separator && std::find(kSeparators.begin(), kSeparators.end(), *options.separator) == kSeparators.end()) {
    throw Error(Error::Argument, fmt::format("separator: \"{}\", expected a comma, a semicolon, a tab or a blank",
                                             quoted_word(std::string(1, *options.separator))));
  }
  return TableReader(text, name, options, run).read();
}

CsvTable read_csv(const std::string& path, const CsvOptions& options, const Run& run) {
  const Text text = read_text(*open_input(path, run.limits.memory_bytes), run);
  return parse_csv(text.view(), path, options, run);
}

const CsvColumn& CsvTable::column(std::string_view which, std::string_view argument) const {
  const auto named = std::find_if(columns.begin(), columns.end(), [&](const auto& each) { return each.name == which; });
  if (named != columns.end()) return *named;
  std::size_t number = 0;
  const auto [end, status] = std::from_chars(which.data(), which.data() + which.size(), number);
  if (status == std::errc() && end == which.data() + which.size() && number >= 1 && number <= columns.size()) {
    return columns[number - 1];
  }
  constexpr std::size_t kMostNamed = 12;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < std::min(columns.size(), kMostNamed); ++c) names.push_back(quoted_word(columns[c].name));
  const std::string more = columns.size() > kMostNamed ? ", …" : "";
  throw Error(Error::Argument, fmt::format("{}: \"{}\"{}, expected a column of {}: {}{}, or a number from 1 to {}",
                                           argument, quoted_word(which), did_you_mean(which, names), source,
                                           fmt::join(names, ", "), more, columns.size()));
}

}  // namespace azulejo
