#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/engine/operation.h"
#include "azulejo/operations.h"

namespace azulejo {

/// All operations, each followed by its variants.
inline std::vector<const Operation*> every_variant() {
  std::vector<const Operation*> list;
  for (const Operation* each : operations()) {
    for (const Operation* variant : variants_of(*each)) list.push_back(variant);
  }
  return list;
}

/// "transform", "transform of mesh"
inline std::string title_of(const Operation& operation) {
  const bool several = !operation.inputs.empty() && !find_operation(operation.name)->variants.empty();
  return several ? operation.name + " of " + to_string(operation.inputs[0].kind) : operation.name;
}

/// A number as often as the field's point has numbers.
inline std::string repeated(const Field& field, double value) {
  const std::string number = field.type == FieldType::Int ? fields::print(static_cast<std::int64_t>(value))
                                                          : fields::print(static_cast<float>(value));
  std::string text = number;
  for (int i = 1; i < field.components; ++i) text.append(",").append(number);
  return text;
}

using OptionSets = std::vector<std::pair<std::string, std::shared_ptr<void>>>;

/// The defaults, and for each field its other choices, both truths and a few values in range.
inline OptionSets option_sets(const Operation& operation) {
  OptionSets sets{{"defaults", operation.make_options()}};
  const auto add = [&](const Field& field, const std::string& text) {
    auto options = operation.make_options();
    field.parse(options.get(), text);
    sets.emplace_back(field.name + "=" + text, options);
  };
  for (const Field& field : operation.fields) {
    if (field.type == FieldType::Bool) {
      add(field, "true");
      add(field, "false");
    } else if (field.type == FieldType::Choice) {
      for (const std::string& choice : field.choices) add(field, choice);
    } else if (field.type == FieldType::Color) {
      for (const char* color : {"#00000000", "orange", "0.5"}) add(field, color);
    } else if (field.type == FieldType::Grid) {
      // What a grid must look like is the operation's own affair: some of these may be refused.
      const double low = std::max(field.range.minimum, -3.0);
      const double high = std::min(field.range.maximum, low + 12);
      for (const double value : {low, high}) {
        const std::string n = fields::print(static_cast<float>(value));
        const std::string zero = fields::print(static_cast<float>(std::clamp(0.0, low, high)));
        add(field, n);
        add(field, fmt::format("{0},{1},{1}/{1},{1},{1}/{1},{1},{0}", n, zero));
        add(field,
            fmt::format("{1},{1}/{2},{0}", n, zero, fields::print(static_cast<float>(std::clamp(1.0, low, high)))));
      }
    } else if (field.type != FieldType::Text) {
      const double low = std::max(field.range.minimum, -3.0);
      const double high = std::min(field.range.maximum, low + 12);
      if (field.type == FieldType::Int) {
        for (const double value : {std::ceil(low), std::floor((low + high) / 2), std::floor(high)}) {
          add(field, std::to_string(static_cast<long>(value)));
        }
      } else {
        for (const double value : {low, low + 0.37 * (high - low), high}) add(field, repeated(field, value));
      }
    }
  }
  return sets;
}

}  // namespace azulejo
