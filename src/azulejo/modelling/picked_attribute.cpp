#include "azulejo/modelling/picked_attribute.h"

#include <type_traits>
#include <utility>
#include <variant>

namespace azulejo {

Attribute picked(const Attribute& attribute, const Array<std::uint32_t>& elements) {
  constexpr std::uint32_t kZeros = 0xFFFFFFFF;
  Attribute result{attribute.name, attribute.domain, attribute.components, {}};
  std::visit(
      [&](const auto& values) {
        const auto count = static_cast<std::size_t>(attribute.components);
        std::decay_t<decltype(values)> chosen(elements.size() * count);
        for (std::size_t i = 0; i < elements.size(); ++i) {
          for (std::size_t c = 0; c < count; ++c) {
            chosen[i * count + c] = elements[i] == kZeros ? 0 : values[elements[i] * count + c];
          }
        }
        result.values = std::move(chosen);
      },
      attribute.values);
  return result;
}

MorphTarget picked(const MorphTarget& target, const Array<std::uint32_t>& vertices) {
  const auto chosen = [&](const Array<glm::vec3>& values) {
    Array<glm::vec3> result;
    if (values.empty()) return result;
    result.resize(vertices.size(), glm::vec3(0));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (vertices[i] < values.size()) result[i] = values[vertices[i]];
    }
    return result;
  };
  return {target.name, chosen(target.positions), chosen(target.normals)};
}

}  // namespace azulejo
