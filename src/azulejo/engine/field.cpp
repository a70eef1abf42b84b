#include "azulejo/engine/field.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

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

template <class T>
T parse_number(const Field& field, std::string_view text) {
  T value{};
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure != std::errc() || end != digits.data() + digits.size() || digits.empty()) {
    fields::refuse(field, fmt::format("\"{}\"", text));
  }
  const auto number = static_cast<double>(value);
  if (!(number >= field.range.minimum && number <= field.range.maximum)) fields::refuse(field, text);
  return value;
}

}  // namespace

std::string expected(const Field& field) {
  std::string text;
  switch (field.type) {
    case FieldType::Bool: text = "true or false"; break;
    case FieldType::Choice: text = joined(field.choices); break;
    case FieldType::Text: text = "text"; break;
    case FieldType::Int:
    case FieldType::Float: {
      const auto [low, high] = field.range;
      text = field.type == FieldType::Int ? "a whole number" : "a number";
      if (std::isfinite(low) && std::isfinite(high)) {
        text += fmt::format(" from {} to {}", low, high);
      } else if (std::isfinite(low)) {
        text += fmt::format(" of at least {}", low);
      } else if (std::isfinite(high)) {
        text += fmt::format(" of at most {}", high);
      }
      if (!field.unit.empty()) text += " " + field.unit;
      break;
    }
  }
  if (field.optional) text += ", or auto";
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

std::string print(std::int64_t value) { return fmt::format("{}", value); }
std::string print(float value) { return fmt::format("{}", value); }

}  // namespace fields
}  // namespace azulejo
