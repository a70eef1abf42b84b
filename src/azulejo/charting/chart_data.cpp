#include "azulejo/charting/chart_data.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostSeries = 1000;
constexpr std::size_t kMostCategories = 100000;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Words and their numbers, in the order in which they come first.
class Names {
 public:
  std::size_t index(const std::string& name) {
    const auto [place, added] = indices_.try_emplace(name, list_.size());
    if (added) list_.push_back(name);
    return place->second;
  }
  std::vector<std::string> take() && { return std::move(list_); }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::unordered_map<std::string, std::size_t> indices_;
  std::vector<std::string> list_;
};

std::string word(const CsvColumn& column, std::size_t row) {
  return column.is_text() ? column.texts[row] : fmt::format("{}", column.numbers[row]);
}

const CsvColumn* named(const CsvTable& table, const std::string& which, const char* argument) {
  return which.empty() ? nullptr : &table.column(which, argument);
}

/// The columns that an option names by name, all at most once.
std::vector<const CsvColumn*> value_columns(const CsvTable& table, const ChartOptions& options) {
  std::vector<const CsvColumn*> columns;
  for (const std::string& which : options.y) columns.push_back(&table.column(which, "y"));
  if (columns.empty()) {
    std::vector<const CsvColumn*> taken;
    for (const auto& [which, argument] :
         {std::pair(options.x, "x"), std::pair(options.group, "group"), std::pair(options.color_by, "color_by"),
          std::pair(options.size_by, "size_by")}) {
      taken.push_back(named(table, which, argument));
    }
    for (const CsvColumn& column : table.columns) {
      if (!column.is_text() && std::find(taken.begin(), taken.end(), &column) == taken.end())
        columns.push_back(&column);
    }
  }
  for (const CsvColumn* column : columns) {
    if (!column->is_text()) continue;
    throw Error(Error::Argument, fmt::format("y: column {} holds words, expected numbers", column->name));
  }
  if (columns.size() > kMostSeries) {
    throw Error(Error::Argument, fmt::format("y: {} columns, expected at most {}", columns.size(), kMostSeries));
  }
  return columns;
}

/// For each row the number of its series, among those of one column.
struct Groups {
  std::vector<std::size_t> of_row;  ///< empty: all in one
  std::vector<std::string> names{""};
};

Groups groups_of(const CsvTable& table, const ChartOptions& options) {
  Groups groups;
  const CsvColumn* const column = named(table, options.group, "group");
  if (column == nullptr) return groups;
  Names names;
  for (std::size_t row = 0; row < table.rows; ++row) {
    groups.of_row.push_back(names.index(word(*column, row)));
    if (names.list().size() > kMostSeries) {
      throw Error(Error::Argument, fmt::format("group: column {} has more than {} different values, expected fewer",
                                               column->name, kMostSeries));
    }
  }
  groups.names = std::move(names).take();
  return groups;
}

std::string series_name(const CsvColumn& column, const std::string& group, bool single) {
  if (group.empty()) return column.name;
  return single ? group : column.name + ", " + group;
}

}  // namespace

ChartData point_data(const CsvTable& table, const ChartOptions& options) {
  const CsvColumn* const x = named(table, options.x, "x");
  const CsvColumn* const colors = named(table, options.color_by, "color_by");
  const CsvColumn* const sizes = named(table, options.size_by, "size_by");
  const std::vector<const CsvColumn*> columns = value_columns(table, options);
  const Groups groups = groups_of(table, options);
  ChartData data;
  data.x_name = x != nullptr ? x->name : "";
  data.y_name = columns.size() == 1 ? columns[0]->name : "";
  data.color_name = colors != nullptr ? colors->name : "";
  if (columns.empty()) throw Error(Error::Data, fmt::format("data: {}: it has no column of numbers", table.source));
  for (const auto& [column, argument] : {std::pair(colors, "color_by"), std::pair(sizes, "size_by")}) {
    if (column != nullptr && column->is_text()) {
      throw Error(Error::Argument, fmt::format("{}: column {} holds words, expected numbers; group tells words apart",
                                               argument, column->name));
    }
  }
  std::vector<double> places(table.rows);
  if (x == nullptr) {
    std::iota(places.begin(), places.end(), 1.0);
  } else if (x->is_text()) {
    Names names;
    for (std::size_t row = 0; row < table.rows; ++row) places[row] = static_cast<double>(names.index(x->texts[row]));
    data.categories = std::move(names).take();
  } else {
    places = x->numbers;
  }
  for (const CsvColumn* column : columns) {
    const std::size_t first = data.series.size();
    for (const std::string& group : groups.names) {
      data.series.emplace_back().name = series_name(*column, group, columns.size() == 1);
    }
    for (std::size_t row = 0; row < table.rows; ++row) {
      ChartSeries& series = data.series[first + (groups.of_row.empty() ? 0 : groups.of_row[row])];
      series.x.push_back(places[row]);
      series.y.push_back(column->numbers[row]);
      if (colors != nullptr) series.colors.push_back(colors->numbers[row]);
      if (sizes != nullptr) series.sizes.push_back(sizes->numbers[row]);
    }
  }
  return data;
}

ChartData bar_data(const CsvTable& table, const ChartOptions& options) {
  const CsvColumn* x = named(table, options.x, "x");
  if (x == nullptr) {
    const auto text = std::find_if(table.columns.begin(), table.columns.end(), [&](const CsvColumn& column) {
      return column.is_text() && &column != named(table, options.group, "group");
    });
    if (text != table.columns.end()) x = &*text;
  }
  ChartOptions asked = options;
  if (x != nullptr) asked.x = x->name;
  const std::vector<const CsvColumn*> columns = value_columns(table, asked);
  const Groups groups = groups_of(table, options);
  ChartData data;
  data.x_name = x != nullptr ? x->name : "";
  Names names;
  std::vector<std::size_t> places(table.rows);
  for (std::size_t row = 0; row < table.rows; ++row) {
    places[row] = names.index(x != nullptr ? word(*x, row) : std::to_string(row + 1));
  }
  data.categories = std::move(names).take();
  if (data.categories.size() > kMostCategories) {
    throw Error(Error::Argument,
                fmt::format("x: {} different values, expected at most {} for bars; kind=histogram counts numbers",
                            data.categories.size(), kMostCategories));
  }
  const bool counts = columns.empty();
  data.y_name = counts ? "count" : columns.size() == 1 ? columns[0]->name : "";
  for (std::size_t c = 0; c < std::max<std::size_t>(1, columns.size()); ++c) {
    const std::size_t first = data.series.size();
    for (const std::string& group : groups.names) {
      ChartSeries& series = data.series.emplace_back();
      series.name = counts ? (group.empty() ? "count" : group) : series_name(*columns[c], group, columns.size() == 1);
      series.y.assign(data.categories.size(), kNothing);
    }
    for (std::size_t row = 0; row < table.rows; ++row) {
      const double value = counts ? 1 : columns[c]->numbers[row];
      if (std::isnan(value)) continue;
      double& sum = data.series[first + (groups.of_row.empty() ? 0 : groups.of_row[row])].y[places[row]];
      sum = std::isnan(sum) ? value : sum + value;
    }
  }
  return data;
}

ChartData value_data(const CsvTable& table, const ChartOptions& options) {
  // A histogram's x is what it counts.
  ChartOptions asked = options;
  if (asked.y.empty() && !asked.x.empty()) asked.y = {asked.x};
  asked.x.clear();
  ChartData data = point_data(table, asked);
  for (ChartSeries& series : data.series) series.x.clear();
  data.x_name = std::exchange(data.y_name, "count");
  return data;
}

ChartField field_data(const CsvTable& table, const ChartOptions& options) {
  const std::vector<const CsvColumn*> columns = value_columns(table, options);
  if (columns.empty() || table.rows == 0) {
    throw Error(Error::Data, fmt::format("data: {}: it has no column of numbers", table.source));
  }
  ChartField field;
  field.width = static_cast<int>(columns.size());
  field.height = static_cast<int>(std::min<std::size_t>(table.rows, std::numeric_limits<int>::max()));
  field.values.reserve(columns.size() * static_cast<std::size_t>(field.height));
  for (std::size_t row = 0; row < static_cast<std::size_t>(field.height); ++row) {
    for (const CsvColumn* column : columns) field.values.push_back(static_cast<float>(column->numbers[row]));
  }
  // Columns that the reader had to number have no names of their own.
  const bool numbered = std::all_of(columns.begin(), columns.end(), [](const CsvColumn* column) {
    return std::all_of(column->name.begin(), column->name.end(), [](char c) { return c >= '0' && c <= '9'; });
  });
  if (!numbered) {
    for (const CsvColumn* column : columns) field.x_names.push_back(column->name);
  }
  const CsvColumn* const names = named(table, options.x, "x");
  const auto text = std::find_if(table.columns.begin(), table.columns.end(),
                                 [](const CsvColumn& column) { return column.is_text(); });
  const CsvColumn* const rows = names != nullptr ? names : text != table.columns.end() ? &*text : nullptr;
  for (std::size_t row = 0; rows != nullptr && row < static_cast<std::size_t>(field.height); ++row) {
    field.y_names.push_back(word(*rows, row));
  }
  return field;
}

}  // namespace azulejo
