#include "azulejo/engine/field.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

std::string joined(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += choices[i];
  }
  return text;
}

/// " from 0 to 10 px"
std::string numbers(const Field& field) {
  const auto [low, high] = field.range;
  std::string text;
  if (std::isfinite(low) && std::isfinite(high)) {
    text = fmt::format(" from {} to {}", low, high);
  } else if (std::isfinite(low)) {
    text = fmt::format(" of at least {}", low);
  } else if (std::isfinite(high)) {
    text = fmt::format(" of at most {}", high);
  }
  if (!field.unit.empty()) text += " " + field.unit;
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator = ',') {
  std::vector<std::string_view> parts;
  for (std::size_t end = text.find(separator); end != std::string_view::npos; end = text.find(separator)) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

template <class T>
T parse_number(const Field& field, std::string_view text) {
  T value{};
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure != std::errc() || end != digits.data() + digits.size() || digits.empty()) {
    fields::refuse(field, fmt::format("\"{}\"", text));
  }
  if (fields::outside(value, field.range)) fields::refuse(field, text);
  return value;
}

}  // namespace

std::string expected(const Field& field) {
  std::string text;
  switch (field.type) {
    case FieldType::Bool: text = "true or false"; break;
    case FieldType::Choice: text = joined(field.choices); break;
    case FieldType::Text: text = "text"; break;
    case FieldType::Color: text = "#rrggbb, #rrggbbaa, a CSS color name or a gray from 0 to 1"; break;
    case FieldType::Point:
      text = field.components == 4 ? "a,b,c,d" : "x,y,z";
      text.resize(static_cast<std::size_t>(2 * field.components - 1));
      text += numbers(field);
      break;
    case FieldType::Grid: text = "numbers" + numbers(field) + ", rows with / between: a,b/c,d"; break;
    case FieldType::Int: text = "a whole number" + numbers(field); break;
    case FieldType::Float: text = "a number" + numbers(field); break;
  }
  if (field.list) text += ", several with commas between";
  if (field.list) text += field.optional ? ", none" : ", or none";
  if (field.optional) text += ", or auto";
  if (field.repeated) text += field.list ? "; once or more often" : ", or none; once or more often";
  return text;
}

namespace fields {

void refuse(const Field& field, std::string_view got) {
  throw Error(Error::Argument, fmt::format("{}: {}, expected {}", field.name, got, expected(field)));
}

bool parse_bool(const Field& field, std::string_view text) {
  if (text == "true" || text == "yes" || text == "on" || text == "1") return true;
  if (text == "false" || text == "no" || text == "off" || text == "0") return false;
  refuse(field, fmt::format("\"{}\"", text));
}

std::int64_t parse_int(const Field& field, std::string_view text) { return parse_number<std::int64_t>(field, text); }
float parse_float(const Field& field, std::string_view text) { return parse_number<float>(field, text); }

std::size_t parse_choice(const Field& field, std::string_view text) {
  for (std::size_t i = 0; i < field.choices.size(); ++i) {
    if (field.choices[i] == text) return i;
  }
  refuse(field, fmt::format("\"{}\"", text));
}

Color parse_color(const Field& field, std::string_view text) {
  const std::optional<Color> color = azulejo::parse_color(text);
  if (!color) refuse(field, fmt::format("\"{}\"", text));
  return *color;
}

void parse_point(const Field& field, std::string_view text, std::span<float> point) {
  const std::vector<std::string_view> parts = split(text);
  if (parts.size() != point.size()) refuse(field, fmt::format("\"{}\"", text));
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = parse_float(field, parts[i]);
}

NumberGrid parse_grid(const Field& field, std::string_view text) {
  constexpr std::size_t kMost = 1'000'000;
  NumberGrid grid;
  for (const std::string_view row : split(text, '/')) {
    const std::size_t before = grid.values.size();
    for (const std::string_view number : split(row)) {
      grid.values.push_back(parse_float(field, number));
      if (grid.values.size() > kMost) refuse(field, "more than a million numbers");
    }
    const auto columns = static_cast<int>(grid.values.size() - before);
    if (grid.rows > 0 && columns != grid.columns) {
      refuse(field, fmt::format("row {} of {} numbers after one of {}", grid.rows + 1, columns, grid.columns));
    }
    grid.columns = columns;
    ++grid.rows;
  }
  return grid;
}

std::vector<std::string_view> parse_list(const Field& field, std::string_view text) {
  if (text == "none") return {};
  std::vector<std::string_view> parts = split(text);
  for (const std::string_view part : parts) {
    if (part.empty()) refuse(field, fmt::format("\"{}\"", text));
  }
  return parts;
}

std::string print(std::int64_t value) { return fmt::format("{}", value); }
std::string print(float value) { return fmt::format("{}", value); }
std::string print_point(std::span<const float> point) { return fmt::format("{}", fmt::join(point, ",")); }
std::string print_grid(const NumberGrid& grid) {
  std::vector<std::string> rows;
  for (int r = 0; r < grid.rows; ++r) {
    const auto first = static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns);
    rows.push_back(print_point({grid.values.data() + first, static_cast<std::size_t>(grid.columns)}));
  }
  return fmt::format("{}", fmt::join(rows, "/"));
}
std::string print_list(std::span<const std::string> elements) {
  return elements.empty() ? "none" : fmt::format("{}", fmt::join(elements, ","));
}

}  // namespace fields
}  // namespace azulejo
