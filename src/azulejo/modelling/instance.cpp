#include "azulejo/modelling/instance.h"

#include <type_traits>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/math/transfer.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/turn_directions.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;  // elements

/// Which element of a mesh's attribute an element of the result takes its values from.
class Sources {
 public:
  Sources(const Mesh& mesh, const Array<std::uint32_t>& order, Domain from, Domain to, const Run& run)
      : mesh_(mesh), order_(order), from_(from), to_(to) {
    if (from == Domain::Face && to == Domain::Corner) faces_ = faces_of_corners(mesh, run);
  }
  std::size_t operator()(std::size_t element) const {
    if (to_ != Domain::Corner) return element;
    const std::size_t corner = order_[element];
    if (from_ == Domain::Corner) return corner;
    if (from_ == Domain::Vertex) return mesh_.corners[corner];
    return faces_.empty() ? corner / 3 : faces_[corner];
  }

 private:
  const Mesh& mesh_;
  const Array<std::uint32_t>& order_;
  Array<std::uint32_t> faces_;
  Domain from_;
  Domain to_;
};

template <class To, class From>
To converted(From value, bool color, int component) {
  if constexpr (std::is_same_v<To, From>) return value;
  if constexpr (std::is_same_v<From, std::uint8_t> && std::is_same_v<To, float>) {
    if (color)
      return component == 3 ? static_cast<float>(value) / 255 : srgb_to_linear(static_cast<float>(value) / 255);
  }
  return static_cast<To>(value);
}

template <class To>
To missing(const UnitedAttribute& attribute, int component, bool whole) {
  constexpr To kOne = std::is_same_v<To, std::uint8_t> ? To(255) : To(1);
  return attribute.is_color() && (whole || component == 3) ? kOne : To(0);
}

template <class To>
void fill_missing(const UnitedAttribute& attribute, std::size_t elements, To* out) {
  for (std::size_t e = 0; e < elements; ++e) {
    for (int k = 0; k < attribute.components; ++k) *out++ = missing<To>(attribute, k, true);
  }
}

template <class To>
void copy_values(const Instance& instance, const Array<std::uint32_t>& order, const Attribute& from,
                 const UnitedAttribute& to, To* out, const Run& run) {
  const Sources source(*instance.mesh, order, from.domain, to.domain, run);
  const bool color = to.is_color();
  std::visit(
      [&](const auto& values) {
        parallel_for(instance.mesh->size_of(to.domain), kChunk, run, [&](std::size_t begin, std::size_t end) {
          for (std::size_t e = begin; e < end; ++e) {
            const std::size_t first = source(e) * static_cast<std::size_t>(from.components);
            To* const element = out + e * static_cast<std::size_t>(to.components);
            for (int k = 0; k < to.components; ++k) {
              element[k] = k < from.components ? converted<To>(values[first + static_cast<std::size_t>(k)], color, k)
                                               : missing<To>(to, k, false);
            }
          }
        });
      },
      from.values);
}

}  // namespace

bool Instance::mirrored() const { return glm::determinant(glm::dmat3(world_from_mesh)) < 0; }

void copy_attribute(const Instance& instance, const Array<std::uint32_t>& order, UnitedAttribute& attribute,
                    const Run& run) {
  const Attribute* const from = instance.mesh->find(attribute.name);
  const std::size_t first = instance.first(attribute.domain) * static_cast<std::size_t>(attribute.components);
  std::visit(
      [&](auto& values) {
        auto* const out = values.data() + first;
        if (from == nullptr) return fill_missing(attribute, instance.mesh->size_of(attribute.domain), out);
        copy_values(instance, order, *from, attribute, out, run);
        if constexpr (std::is_same_v<decltype(out), float* const>) {
          turn_directions(attribute.name, attribute.components, glm::dmat3(instance.world_from_mesh), out,
                          instance.mesh->size_of(attribute.domain), run);
        }
      },
      attribute.values);
}

}  // namespace azulejo
