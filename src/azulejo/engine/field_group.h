#pragma once

#include <utility>
#include <vector>

#include "azulejo/engine/field.h"

namespace azulejo {

/// The fields of a struct that is a member of another, as fields of that one: options that several operations share
/// are described once.
template <class Outer, class Inner>
std::vector<Field> nested(Inner Outer::*member, std::vector<Field> fields) {
  for (Field& each : fields) {
    each.parse = [member, parse = std::move(each.parse)](void* options, std::string_view text) {
      parse(&(static_cast<Outer*>(options)->*member), text);
    };
    each.print = [member, print = std::move(each.print)](const void* options) {
      return print(&(static_cast<const Outer*>(options)->*member));
    };
    each.check = [member, check = std::move(each.check)](const void* options) {
      check(&(static_cast<const Outer*>(options)->*member));
    };
  }
  return fields;
}

/// One list of several.
inline std::vector<Field> joined(std::initializer_list<std::vector<Field>> lists) {
  std::vector<Field> all;
  for (const std::vector<Field>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace azulejo
