#include "azulejo/io/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

namespace azulejo {
namespace {

using Component = GltfAccessor::Component;

constexpr std::size_t kMostElements = 0xFFFFFFFE;  ///< a Mesh counts its vertices in 32 bits

struct ElementType {
  std::string_view name;
  int components;
  int rows;  ///< of a matrix, whose columns begin at multiples of 4 bytes; 0: not a matrix
};
constexpr std::array<ElementType, 7> kTypes = {{
    {"SCALAR", 1, 0},
    {"VEC2", 2, 0},
    {"VEC3", 3, 0},
    {"VEC4", 4, 0},
    {"MAT2", 4, 2},
    {"MAT3", 9, 3},
    {"MAT4", 16, 4},
}};

std::uint64_t bytes_of(Component component) {
  switch (component) {
    case Component::I8:
    case Component::U8: return 1;
    case Component::I16:
    case Component::U16: return 2;
    case Component::U32:
    case Component::F32: return 4;
  }
  return 4;
}

Component component_of(const GltfValue& value) {
  const std::uint64_t code = value.count(0);
  if (code < Component::I8 || code > Component::F32 || code == 5124) {
    throw value.error(fmt::format("{}, expected 5120, 5121, 5122, 5123, 5125 or 5126", code));
  }
  return static_cast<Component>(code);
}

const ElementType& type_of(const GltfValue& value) {
  const std::string name = value.text();
  const auto* const found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const ElementType& each) { return each.name == name; });
  if (found == kTypes.end()) throw value.error(fmt::format("{}, expected SCALAR, VEC2 … MAT4", printable(name)));
  return *found;
}

/// A component as a T. Normalized as the specification says: −128 and −127 are both −1.
template <class Source, class T>
T converted(Source value, bool normalized) {
  if constexpr (std::is_same_v<T, float> && !std::is_same_v<Source, float>) {
    if (!normalized) return static_cast<float>(value);
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<Source>::max()), -1.0F);
  } else {
    return static_cast<T>(value);
  }
}

template <class Source, class T>
void copy_elements(const std::byte* source, std::uint64_t stride, const GltfAccessor& accessor, std::size_t count,
                   T* target) {
  const auto components = static_cast<std::size_t>(accessor.components);
  if (std::is_same_v<Source, T> && stride == components * sizeof(T)) {
    if (count > 0) std::memcpy(target, source, count * components * sizeof(T));
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::array<Source, 16> element;
    std::memcpy(element.data(), source + i * stride, components * sizeof(Source));
    for (std::size_t c = 0; c < components; ++c) {
      target[i * components + c] = converted<Source, T>(element[c], accessor.normalized);
    }
  }
}

template <class T>
void copy(const std::byte* source, std::uint64_t stride, const GltfAccessor& accessor, std::size_t count, T* target) {
  switch (accessor.component) {
    case Component::I8: return copy_elements<std::int8_t>(source, stride, accessor, count, target);
    case Component::U8: return copy_elements<std::uint8_t>(source, stride, accessor, count, target);
    case Component::I16: return copy_elements<std::int16_t>(source, stride, accessor, count, target);
    case Component::U16: return copy_elements<std::uint16_t>(source, stride, accessor, count, target);
    case Component::U32: return copy_elements<std::uint32_t>(source, stride, accessor, count, target);
    case Component::F32: return copy_elements<float>(source, stride, accessor, count, target);
  }
}

std::uint32_t load_index(const std::byte* bytes, Component component) {
  std::uint32_t index = 0;  // little-endian, as everything in glTF and on the machines that azulejo runs on
  std::memcpy(&index, bytes, bytes_of(component));
  return index;
}

bool is_index(Component component) {
  return component == Component::U8 || component == Component::U16 || component == Component::U32;
}

}  // namespace

GltfAccessors::GltfAccessors(GltfFile& file) : file_(file) {
  const GltfValue list = file.root()["accessors"];
  file.claim(list.size(), sizeof(GltfAccessor));
  accessors_.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) accessors_.push_back(parse(list.at(i)));
}

GltfAccessor GltfAccessors::parse(const GltfValue& value) const {
  GltfAccessor accessor;
  accessor.component = component_of(value.need("componentType"));
  const ElementType& type = type_of(value.need("type"));
  accessor.components = type.components;
  accessor.matrix = type.rows > 0;
  accessor.normalized = value["normalized"].truth(false);
  if (accessor.normalized && (accessor.component == Component::F32 || accessor.component == Component::U32)) {
    throw value.error("normalized, which 8 and 16 bits can be only");
  }
  const std::uint64_t count = value.need("count").count(0);
  if (count > kMostElements) throw value.error(fmt::format("{} elements, expected fewer than 2^32 - 1", count));
  accessor.count = static_cast<std::size_t>(count);
  const std::uint64_t bytes = bytes_of(accessor.component);
  std::uint64_t size = bytes * static_cast<std::uint64_t>(accessor.components);
  if (accessor.matrix) {
    const auto rows = static_cast<std::uint64_t>(type.rows);
    size = (rows * bytes + 3) / 4 * 4 * rows;
  }
  accessor.offset = value["byteOffset"].count(0);
  if (const GltfValue view = value["bufferView"]) {
    accessor.view = view.index(file_.view_count());
    const std::uint64_t stride = file_.view_stride(accessor.view);
    if (stride > 0 && stride < size) {
      throw value.error(fmt::format("elements of {} bytes, byteStride {}", size, stride));
    }
    accessor.stride = stride > 0 ? stride : size;
    check_in_view(value, accessor.view, accessor.offset, count, accessor.stride, size);
  }
  if (const GltfValue sparse = value["sparse"]) parse_sparse(sparse, accessor);
  return accessor;
}

void GltfAccessors::parse_sparse(const GltfValue& value, GltfAccessor& accessor) const {
  if (accessor.matrix) throw value.error(Error::Unsupported, "sparse matrices aren't read");
  const std::uint64_t count = value.need("count").count(0);
  if (count > accessor.count) throw value.error(fmt::format("{} elements, of {}", count, accessor.count));
  accessor.sparse_count = static_cast<std::size_t>(count);
  const GltfValue indices = value.need("indices");
  accessor.sparse_component = component_of(indices.need("componentType"));
  if (!is_index(accessor.sparse_component)) throw indices.error("componentType isn't an unsigned integer");
  accessor.sparse_indices = indices.need("bufferView").index(file_.view_count());
  accessor.sparse_indices_offset = indices["byteOffset"].count(0);
  const std::uint64_t index_size = bytes_of(accessor.sparse_component);
  check_in_view(indices, accessor.sparse_indices, accessor.sparse_indices_offset, count, index_size, index_size);
  const GltfValue values = value.need("values");
  accessor.sparse_values = values.need("bufferView").index(file_.view_count());
  accessor.sparse_values_offset = values["byteOffset"].count(0);
  const std::uint64_t size = bytes_of(accessor.component) * static_cast<std::uint64_t>(accessor.components);
  check_in_view(values, accessor.sparse_values, accessor.sparse_values_offset, count, size, size);
}

void GltfAccessors::check_in_view(const GltfValue& value, std::size_t view, std::uint64_t offset, std::uint64_t count,
                                  std::uint64_t stride, std::uint64_t size) const {
  const std::uint64_t room = file_.view_size(view);
  if (count == 0) return;
  if (offset > room || size > room - offset || (count - 1) > (room - offset - size) / stride) {
    throw value.error(
        fmt::format("{} elements, {} bytes apart from byte {}, in a view of {} bytes", count, stride, offset, room));
  }
}

const GltfAccessor& GltfAccessors::at(const GltfValue& index, int components) const {
  const GltfAccessor& accessor = at(index);
  if (accessor.components != components || (accessor.matrix && components != 16)) {
    throw index.error(fmt::format("an accessor of {} components, expected {}", accessor.components, components));
  }
  return accessor;
}

template <class T>
void GltfAccessors::read_as(const GltfAccessor& accessor, const GltfValue& place, std::span<T> target) {
  if (accessor.matrix && accessor.components != 16) throw place.error(Error::Unsupported, "small matrices aren't read");
  if (accessor.view == GltfAccessor::kNoView) {
    std::fill(target.begin(), target.end(), T{0});
  } else {
    const std::span<const std::byte> bytes = file_.view(accessor.view);
    if (accessor.count > 0) {
      copy(bytes.data() + accessor.offset, accessor.stride, accessor, accessor.count, target.data());
    }
  }
  if (accessor.sparse_count == 0) return;
  const std::byte* const indices = file_.view(accessor.sparse_indices).data() + accessor.sparse_indices_offset;
  const std::byte* const values = file_.view(accessor.sparse_values).data() + accessor.sparse_values_offset;
  const auto components = static_cast<std::size_t>(accessor.components);
  const std::uint64_t index_size = bytes_of(accessor.sparse_component);
  const std::uint64_t size = bytes_of(accessor.component) * components;
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < accessor.sparse_count; ++i) {
    const std::uint32_t at = load_index(indices + i * index_size, accessor.sparse_component);
    if (at < next || at >= accessor.count) {
      throw place.error(fmt::format("sparse index {} is {}, expected {} to {}", i, at, next, accessor.count - 1));
    }
    next = std::uint64_t{at} + 1;
    copy(values + i * size, size, accessor, 1, target.data() + at * components);
  }
}

void GltfAccessors::read(const GltfAccessor& accessor, const GltfValue& place, std::span<float> target) {
  read_as(accessor, place, target);
}

void GltfAccessors::read(const GltfAccessor& accessor, const GltfValue& place, std::span<std::uint32_t> target) {
  if (!is_index(accessor.component) || accessor.normalized) {
    throw place.error(fmt::format("componentType {}, expected an unsigned integer", accessor.component));
  }
  read_as(accessor, place, target);
}

void GltfAccessors::read(const GltfAccessor& accessor, const GltfValue& place, std::span<std::uint8_t> target) {
  if (accessor.component != Component::U8 || accessor.normalized) {
    throw place.error(fmt::format("componentType {}, expected 5121", accessor.component));
  }
  read_as(accessor, place, target);
}

}  // namespace azulejo
