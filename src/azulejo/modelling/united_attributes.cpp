#include "azulejo/modelling/united_attributes.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace azulejo {
namespace {

Attribute::Values empty_like(const Attribute::Values& values) {
  return std::visit([](const auto& array) -> Attribute::Values { return std::decay_t<decltype(array)>(); }, values);
}

void widen(UnitedAttribute& united, const Attribute& attribute) {
  if (united.domain != attribute.domain) united.domain = Domain::Corner;
  united.components = std::max(united.components, attribute.components);
  if (united.values.index() != attribute.values.index()) united.values = Array<float>();
}

}  // namespace

std::vector<UnitedAttribute> unite_attributes(const std::vector<const Mesh*>& meshes, const std::string& but) {
  std::vector<UnitedAttribute> united;
  std::unordered_map<std::string, std::size_t> place;
  std::unordered_set<const Mesh*> seen;
  for (const Mesh* mesh : meshes) {
    if (!seen.insert(mesh).second) continue;
    for (const Attribute& each : mesh->attributes) {
      if (each.name == but) continue;
      const auto [at, is_new] = place.try_emplace(each.name, united.size());
      if (is_new) {
        united.push_back({each.name, each.domain, each.components, empty_like(each.values)});
      } else {
        widen(united[at->second], each);
      }
    }
  }
  return united;
}

std::size_t component_bytes(const Attribute::Values& values) {
  return std::visit([](const auto& array) { return sizeof(array[0]); }, values);
}

}  // namespace azulejo
