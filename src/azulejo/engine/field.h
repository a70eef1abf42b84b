#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/math/color.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

enum class FieldType : std::uint8_t { Bool, Int, Float, Choice, Text, Color, Point, Grid };

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
  FieldType type = FieldType::Float;  ///< of a list: its elements'
  bool optional = false;              ///< `auto` stands for "decide for me"
  bool list = false;                  ///< several with commas between; `none` is the empty list
  bool repeated = false;  ///< given several times, each is kept, in the order of all that are; `none` adds nothing
  bool shared = false;    ///< a count that the meshes of a scene share, in proportion to their triangles
  int components = 1;     ///< of FieldType::Point: 2 `x,y`, 3 `x,y,z`, 4 `a,b,c,d`
  Range range;            ///< of numbers, and of each number of a point or grid
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
AZULEJO_EXPORT Color parse_color(const Field& field, std::string_view text);
/// As many numbers as `point` has.
AZULEJO_EXPORT void parse_point(const Field& field, std::string_view text, std::span<float> point);
/// Rows of equal length with `/` between; at most a million numbers.
AZULEJO_EXPORT NumberGrid parse_grid(const Field& field, std::string_view text);
/// The elements of a list's text; none is empty.
AZULEJO_EXPORT std::vector<std::string_view> parse_list(const Field& field, std::string_view text);
AZULEJO_EXPORT std::string print(std::int64_t value);
AZULEJO_EXPORT std::string print(float value);
AZULEJO_EXPORT std::string print_point(std::span<const float> point);
AZULEJO_EXPORT std::string print_grid(const NumberGrid& grid);
AZULEJO_EXPORT std::string print_list(std::span<const std::string> elements);
[[noreturn]] AZULEJO_EXPORT void refuse(const Field& field, std::string_view got);

/// What a member is made of: T itself, what is in an optional, what a list has.
template <class T>
struct Kind {
  using Value = T;    ///< without optional
  using Element = T;  ///< without optional and list
  static constexpr bool kOptional = false;
  static constexpr bool kList = false;
};
template <class T>
struct Kind<std::vector<T>> {
  using Value = std::vector<T>;
  using Element = T;
  static constexpr bool kOptional = false;
  static constexpr bool kList = true;
};
template <class T>
struct Kind<std::optional<T>> {
  using Value = T;
  using Element = typename Kind<T>::Element;
  static constexpr bool kOptional = true;
  static constexpr bool kList = Kind<T>::kList;
};

/// Numbers that a point has; 0: T is no point.
template <class T>
inline constexpr int kComponents = 0;
template <int N, glm::qualifier Q>
inline constexpr int kComponents<glm::vec<N, float, Q>> = N;
template <std::size_t N>
inline constexpr int kComponents<std::array<float, N>> = static_cast<int>(N);

template <class T>
constexpr FieldType type_of() {
  if constexpr (std::same_as<T, bool>) return FieldType::Bool;
  if constexpr (std::is_enum_v<T>) return FieldType::Choice;
  if constexpr (std::is_integral_v<T> && !std::same_as<T, bool>) return FieldType::Int;
  if constexpr (std::is_floating_point_v<T>) return FieldType::Float;
  if constexpr (std::same_as<T, std::string>) return FieldType::Text;
  if constexpr (std::same_as<T, Color>) return FieldType::Color;
  if constexpr (std::same_as<T, NumberGrid>) return FieldType::Grid;
  if constexpr (kComponents<T> >= 2) return FieldType::Point;
}

template <class T>
T parse(const Field& field, std::string_view text) {
  if constexpr (Kind<T>::kList) {
    T list;
    for (const std::string_view element : parse_list(field, text)) {
      list.push_back(parse<typename Kind<T>::Element>(field, element));
    }
    return list;
  } else if constexpr (std::same_as<T, bool>) {
    return parse_bool(field, text);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(parse_choice(field, text));
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(parse_int(field, text));
  } else if constexpr (std::is_floating_point_v<T>) {
    return parse_float(field, text);
  } else if constexpr (std::same_as<T, Color>) {
    return parse_color(field, text);
  } else if constexpr (std::same_as<T, NumberGrid>) {
    return parse_grid(field, text);
  } else if constexpr (kComponents<T> > 0) {
    T point{};
    parse_point(field, text, {&point[0], kComponents<T>});
    return point;
  } else {
    return T(text);
  }
}

template <class T>
std::string print_value(const T& value) {
  if constexpr (Kind<T>::kList) {
    std::vector<std::string> elements;
    for (const auto& element : value) elements.push_back(print_value(element));
    return print_list(elements);
  } else if constexpr (std::same_as<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(enum_names(T{})[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_integral_v<T>) {
    return print(static_cast<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return print(value);
  } else if constexpr (std::same_as<T, Color>) {
    return to_string(value);
  } else if constexpr (std::same_as<T, NumberGrid>) {
    return print_grid(value);
  } else if constexpr (kComponents<T> > 0) {
    return print_point({&value[0], kComponents<T>});
  } else {
    return value;
  }
}

/// Whether a number is out of range, or NaN. The ends are taken as a number of its type: 0.7F is at least 0.7.
template <class T>
bool outside(T number, const Range& range) {
  if constexpr (std::is_floating_point_v<T>) {
    return !(number >= static_cast<T>(range.minimum) && number <= static_cast<T>(range.maximum));
  } else {
    return !(static_cast<double>(number) >= range.minimum && static_cast<double>(number) <= range.maximum);
  }
}

template <class T>
void check_value(const Field& field, const T& value) {
  if constexpr (Kind<T>::kList) {
    for (const auto& element : value) check_value(field, element);
  } else if constexpr (std::is_enum_v<T>) {
    if (static_cast<std::size_t>(value) >= enum_names(T{}).size()) refuse(field, "an unknown enumerator");
  } else if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>) {
    if (outside(value, field.range)) refuse(field, print_value(value));
  } else if constexpr (std::same_as<T, Color>) {
    for (const float channel : {value.r, value.g, value.b, value.a}) {
      if (outside(channel, {0, 1})) refuse(field, print_point(std::array{value.r, value.g, value.b, value.a}));
    }
  } else if constexpr (std::same_as<T, NumberGrid>) {
    if (value.rows < 0 || value.columns < 0 ||
        value.values.size() != static_cast<std::size_t>(value.rows) * static_cast<std::size_t>(value.columns)) {
      refuse(field, "a grid without as many numbers as rows and columns");
    }
    for (const float number : value.values) {
      if (outside(number, field.range)) refuse(field, print_value(number));
    }
  } else if constexpr (kComponents<T> > 0) {
    for (int i = 0; i < kComponents<T>; ++i) {
      if (outside(*(&value[0] + i), field.range)) refuse(field, print_value(value));
    }
  }
}

}  // namespace fields

/// Describes the member of an options' struct: bool, int, float, std::string, an enumeration with `enum_names`, Color,
/// a point (glm::vec2 to vec4, or std::array of floats), NumberGrid, a std::vector of one of those but bool, points and
/// grids, or std::optional of any. The default is the member's own.
template <class Options, class Member>
Field field(std::string name, Member Options::*member, Range range, std::string unit, std::string help) {
  using Kind = fields::Kind<Member>;
  using T = typename Kind::Value;
  using Element = typename Kind::Element;
  static_assert(!Kind::kList || (!std::same_as<Element, bool> && !std::same_as<Element, NumberGrid> &&
                                 fields::kComponents<Element> == 0),
                "commas stand between the elements of a list");
  Field described;
  described.name = std::move(name);
  described.unit = std::move(unit);
  described.help = std::move(help);
  described.type = fields::type_of<Element>();
  described.optional = Kind::kOptional;
  described.list = Kind::kList;
  described.components = std::max(1, fields::kComponents<Element>);
  described.range = range;
  if constexpr (std::is_integral_v<Element> && !std::same_as<Element, bool>) {
    described.range.minimum = std::max(range.minimum, static_cast<double>(std::numeric_limits<Element>::min()));
    described.range.maximum = std::min(range.maximum, static_cast<double>(std::numeric_limits<Element>::max()));
  }
  if constexpr (std::is_enum_v<Element>) {
    for (const std::string_view choice : enum_names(Element{})) described.choices.emplace_back(choice);
  }
  // What the functions below need of the field itself: they outlive this frame and the field may move.
  const Field known = described;
  described.parse = [member, known](void* options, std::string_view text) {
    Member& value = static_cast<Options*>(options)->*member;
    if constexpr (Kind::kOptional) {
      if (text == "auto") {
        value.reset();
        return;
      }
    }
    value = fields::parse<T>(known, text);
  };
  described.print = [member](const void* options) {
    const Member& value = static_cast<const Options*>(options)->*member;
    if constexpr (Kind::kOptional) {
      return value ? fields::print_value<T>(*value) : std::string("auto");
    } else {
      return fields::print_value<T>(value);
    }
  };
  described.check = [member, known](const void* options) {
    const Member& value = static_cast<const Options*>(options)->*member;
    if constexpr (Kind::kOptional) {
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

/// The field as `Field::shared`.
inline Field shared_by_meshes(Field described) {
  described.shared = true;
  return described;
}

}  // namespace azulejo
