#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

enum class FieldType { Bool, Int, Float, Choice, Text };

/// Smallest and largest value allowed, both included.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};

/// One option of an operation, described for everything that isn't C++: the command, its help, JSON, tests.
struct Field {
  std::string name;  ///< as in the options' struct
  std::string unit;  ///< "px", "deg", …; empty: none
  std::string help;
  FieldType type = FieldType::Float;
  bool optional = false;             ///< `auto` stands for "decide for me"
  Range range;                       ///< of numbers
  std::vector<std::string> choices;  ///< of FieldType::Choice

  /// Reads text into the options' struct. Throws Error(Argument) that says what was expected.
  std::function<void(void* options, std::string_view text)> parse;
  std::function<std::string(const void* options)> print;
  /// Throws Error(Argument) if the value is out of range.
  std::function<void(const void* options)> check;
};

/// "0 to 1000 px", "mirror, reflect or clamp": what a field takes, for help and messages.
AZULEJO_EXPORT std::string expected(const Field& field);

namespace fields {

AZULEJO_EXPORT bool parse_bool(const Field& field, std::string_view text);
AZULEJO_EXPORT std::int64_t parse_int(const Field& field, std::string_view text);
AZULEJO_EXPORT float parse_float(const Field& field, std::string_view text);
AZULEJO_EXPORT std::size_t parse_choice(const Field& field, std::string_view text);
AZULEJO_EXPORT std::string print(std::int64_t value);
AZULEJO_EXPORT std::string print(float value);
[[noreturn]] AZULEJO_EXPORT void refuse(const Field& field, std::string_view got);

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <class T>
struct ValueType {
  using Type = T;
};
template <class T>
struct ValueType<std::optional<T>> {
  using Type = T;
};

template <class T>
constexpr FieldType type_of() {
  if constexpr (std::same_as<T, bool>) return FieldType::Bool;
  if constexpr (std::is_enum_v<T>) return FieldType::Choice;
  if constexpr (std::is_integral_v<T> && !std::same_as<T, bool>) return FieldType::Int;
  if constexpr (std::is_floating_point_v<T>) return FieldType::Float;
  if constexpr (std::same_as<T, std::string>) return FieldType::Text;
}

template <class T>
T parse(const Field& field, std::string_view text) {
  if constexpr (std::same_as<T, bool>) {
    return parse_bool(field, text);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(parse_choice(field, text));
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(parse_int(field, text));
  } else if constexpr (std::is_floating_point_v<T>) {
    return parse_float(field, text);
  } else {
    return T(text);
  }
}

template <class T>
std::string print_value(const T& value) {
  if constexpr (std::same_as<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(enum_names(T{})[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_integral_v<T>) {
    return print(static_cast<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return print(value);
  } else {
    return value;
  }
}

template <class T>
void check_value(const Field& field, const T& value) {
  if constexpr (std::is_enum_v<T>) {
    if (static_cast<std::size_t>(value) >= enum_names(T{}).size()) refuse(field, "an unknown enumerator");
  } else if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>) {
    const auto number = static_cast<double>(value);
    if (!(number >= field.range.minimum && number <= field.range.maximum)) refuse(field, print_value(value));
  }
}

}  // namespace fields

/// Describes the member of an options' struct: bool, int, float, std::string, an enumeration with
/// `enum_names`, or std::optional of one. The default is the member's own.
template <class Options, class Member>
Field field(std::string name, Member Options::*member, Range range, std::string unit, std::string help) {
  using T = typename fields::ValueType<Member>::Type;
  Field described;
  described.name = std::move(name);
  described.unit = std::move(unit);
  described.help = std::move(help);
  described.type = fields::type_of<T>();
  described.optional = fields::kIsOptional<Member>;
  described.range = range;
  if constexpr (std::is_integral_v<T> && !std::same_as<T, bool>) {
    described.range.minimum = std::max(range.minimum, static_cast<double>(std::numeric_limits<T>::min()));
    described.range.maximum = std::min(range.maximum, static_cast<double>(std::numeric_limits<T>::max()));
  }
  if constexpr (std::is_enum_v<T>) {
    for (const std::string_view choice : enum_names(T{})) described.choices.emplace_back(choice);
  }
  // What the functions below need of the field itself: they outlive this frame and the field may move.
  const Field known = described;
  described.parse = [member, known](void* options, std::string_view text) {
    Member& value = static_cast<Options*>(options)->*member;
    if constexpr (fields::kIsOptional<Member>) {
      if (text == "auto") {
        value.reset();
        return;
      }
    }
    value = fields::parse<T>(known, text);
  };
  described.print = [member](const void* options) {
    const Member& value = static_cast<const Options*>(options)->*member;
    if constexpr (fields::kIsOptional<Member>) {
      return value ? fields::print_value<T>(*value) : std::string("auto");
    } else {
      return fields::print_value<T>(value);
    }
  };
  described.check = [member, known](const void* options) {
    const Member& value = static_cast<const Options*>(options)->*member;
    if constexpr (fields::kIsOptional<Member>) {
      if (value) fields::check_value<T>(known, *value);
    } else {
      fields::check_value<T>(known, value);
    }
  };
  return described;
}

template <class Options, class Member>
Field field(std::string name, Member Options::*member, std::string help) {
  return field(std::move(name), member, Range{}, "", std::move(help));
}

}  // namespace azulejo
