#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/charting/annotate.h"
#include "azulejo/core/error.h"
#include "azulejo/core/json.h"
#include "azulejo/io/input.h"

namespace azulejo {
namespace {

constexpr std::int64_t kMostBytes = std::int64_t{256} << 20;

/// Cells as they come, row by row, into columns.
class Columns {
 public:
  explicit Columns(std::string source) { table_.source = std::move(source); }

  void begin_row() { ++table_.rows; }

  void add(const std::string& name, const Json& cell) {
    CsvColumn& column = this->column(name);
    const std::string text = cell.text();
    const double number = cell.number(std::numeric_limits<double>::quiet_NaN());
    fill(column, table_.rows - 1);
    if (!text.empty() && column.texts.empty()) {
      for (const double each : column.numbers) column.texts.push_back(std::isnan(each) ? "" : fmt::format("{}", each));
    }
    if (column.numbers.size() == table_.rows) return;  // given twice
    column.numbers.push_back(number);
    if (column.is_text() || !text.empty()) {
      column.texts.push_back(!text.empty() || std::isnan(number) ? text : fmt::format("{}", number));
    }
  }

  CsvTable take() {
    for (CsvColumn& column : table_.columns) fill(column, table_.rows);
    return std::move(table_);
  }

 private:
  CsvColumn& column(const std::string& name) {
    const auto found = std::ranges::find(table_.columns, name, &CsvColumn::name);
    if (found != table_.columns.end()) return *found;
    constexpr std::size_t kMostColumns = 1000;
    if (table_.columns.size() == kMostColumns) {
      throw Error(Error::Data,
                  fmt::format("{}: more than {} names, expected rows of the same", table_.source, kMostColumns));
    }
    table_.columns.push_back({name, {}, {}});
    return table_.columns.back();
  }

  static void fill(CsvColumn& column, std::size_t rows) {
    const bool text = column.is_text();
    if (column.numbers.size() < rows) column.numbers.resize(rows, std::numeric_limits<double>::quiet_NaN());
    if (text && column.texts.size() < rows) column.texts.resize(rows);
  }

  CsvTable table_;
};

CsvTable from_json(const Json& json, const std::string& source) {
  Columns columns(source);
  const auto add_members = [&](const Json& object) {
    for (const std::string& key : object.keys()) columns.add(key, object[key]);
  };
  const std::vector<std::string> ids = json.keys();
  if (ids.empty()) {
    for (std::size_t row = 0; row < json.size(); ++row) {
      columns.begin_row();
      add_members(json[row]);
    }
  }
  for (const std::string& id : ids) {
    columns.begin_row();
    const Json value = json[id];
    columns.add("id", Json(id));
    if (value.keys().empty()) columns.add(value.text().empty() ? "value" : "text", value);
    add_members(value);
  }
  CsvTable table = columns.take();
  if (table.columns.empty()) {
    throw Error(Error::Data, fmt::format("{}: expected a list of objects, or an object of ids", source));
  }
  return table;
}

}  // namespace

CsvTable read_annotations(const std::string& path, const Run& run) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".json") return read_csv(path, {}, run);
  const std::shared_ptr<const Input> input = open_input(path, run.limits.memory_bytes);
  const std::vector<std::byte> bytes = input->read_all(std::min(run.limits.memory_bytes, kMostBytes));
  return from_json(Json::parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path), path);
}

}  // namespace azulejo
