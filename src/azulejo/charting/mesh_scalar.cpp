#include "azulejo/charting/mesh_scalar.h"

#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

std::string names_of(const Mesh& mesh) {
  std::string names = "x, y, z";
  for (const Attribute& each : mesh.attributes) names += ", " + each.name;
  return names;
}

template <class T>
void gather(const Array<T>& values, std::size_t components, std::optional<int> component, Array<float>& result) {
  for (std::size_t i = 0; i < result.size(); ++i) {
    const T* const element = values.data() + i * components;
    if (component || components == 1) {
      result[i] = static_cast<float>(element[component.value_or(0)]);
      continue;
    }
    double sum = 0;
    for (std::size_t c = 0; c < components; ++c)
      sum += static_cast<double>(element[c]) * static_cast<double>(element[c]);
    result[i] = static_cast<float>(std::sqrt(sum));
  }
}

}  // namespace

MeshScalar mesh_scalar(const Mesh& mesh, const std::string& attribute, std::optional<int> component) {
  MeshScalar scalar;
  const Attribute* const found = mesh.find(attribute);
  if (found == nullptr) {
    if (attribute != "x" && attribute != "y" && attribute != "z") {
      throw Error(Error::Argument, fmt::format("attribute: {}, expected one of {}", attribute, names_of(mesh)));
    }
    if (component)
      throw Error(Error::Argument, fmt::format("component: {}, but {} is a number", *component, attribute));
    const int axis = attribute[0] - 'x';
    scalar.values.resize(mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) scalar.values[v] = mesh.positions[v][axis];
    return scalar;
  }
  if (component && *component >= found->components) {
    throw Error(Error::Argument,
                fmt::format("component: {}, but {} has {}, counted from 0", *component, attribute, found->components));
  }
  scalar.domain = found->domain;
  scalar.values.resize(found->size());
  std::visit(
      [&](const auto& values) {
        gather(values, static_cast<std::size_t>(found->components), component, scalar.values);
      },
      found->values);
  return scalar;
}

}  // namespace azulejo
