#pragma once

// What the tests of model files share.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/mesh.h"
#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"

namespace azulejo {

/// The folder of sample files that may lie beside the source; tests that need it are skipped where it is absent.
inline std::filesystem::path shared_data() {
  return std::filesystem::path(AZULEJO_SOURCE_FOLDER).parent_path() / "shared" / "data";
}

inline std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }
inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reads a mesh from a file's bytes.
inline Mesh mesh_of(const std::string& file, const std::string& name, const ModelReadOptions& options = {},
                    const Run& run = {}) {
  return std::get<Mesh>(read_model(bytes_of(file), name, options, run));
}

/// Its message, or "" where there is no Error.
template <class F>
std::string error_of(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

template <class T>
bool same_bytes(const Array<T>& a, const Array<T>& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Vertices, faces, lines and attributes, byte for byte.
inline ::testing::AssertionResult same_mesh(const Mesh& a, const Mesh& b) {
  const auto differ = [](const std::string& what) { return ::testing::AssertionFailure() << what << " differ"; };
  if (!same_bytes(a.positions, b.positions)) return differ("positions");
  if (!same_bytes(a.corners, b.corners)) return differ("corners");
  if (!same_bytes(a.face_offsets, b.face_offsets)) return differ("face offsets");
  if (!same_bytes(a.lines, b.lines)) return differ("lines");
  if (!same_bytes(a.material, b.material)) return differ("materials");
  if (a.attributes.size() != b.attributes.size()) return differ("numbers of attributes");
  for (std::size_t i = 0; i < a.attributes.size(); ++i) {
    const Attribute& left = a.attributes[i];
    const Attribute& right = b.attributes[i];
    if (left.name != right.name) return differ("names " + left.name + " and " + right.name);
    const bool same = left.domain == right.domain && left.components == right.components &&
                      left.values.index() == right.values.index() &&
                      std::visit(
                          [&](const auto& values) {
                            return same_bytes(values, std::get<std::decay_t<decltype(values)>>(right.values));
                          },
                          left.values);
    if (!same) return differ(left.name);
  }
  return ::testing::AssertionSuccess();
}

template <class T>
std::vector<T> listed(const Array<T>& values) {
  return {values.begin(), values.end()};
}

/// The values of an attribute, which must be there and of this type.
template <class T>
std::vector<T> values_of(const Mesh& mesh, const std::string& name) {
  const Attribute* const attribute = mesh.find(name);
  if (attribute == nullptr || attribute->get<T>() == nullptr) {
    ADD_FAILURE() << "no attribute " << name << " of this type";
    return {};
  }
  return listed(*attribute->get<T>());
}

/// Triangles, or faces of one to six corners, between random vertices.
inline Mesh random_mesh(std::size_t vertices, std::size_t faces, bool triangles, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random() % 20001) / 1000 - 10; };
  Mesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) mesh.positions.emplace_back(number(), number(), number());
  if (!triangles) mesh.face_offsets.push_back(0);
  for (std::size_t face = 0; face < faces; ++face) {
    const std::size_t corners = triangles ? 3 : 1 + (face * 5 + 3) % 6;
    for (std::size_t i = 0; i < corners; ++i) mesh.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
    if (!triangles) mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

/// Random values, whose differences from 1 are exact too.
template <class T>
Attribute random_attribute(const Mesh& mesh, const std::string& name, Domain domain, int components, unsigned seed) {
  std::mt19937 random(seed);
  Array<T> values(mesh.size_of(domain) * static_cast<std::size_t>(components));
  for (T& value : values) {
    if constexpr (std::is_same_v<T, float>) {
      value = static_cast<float>(random() % 4097) / 4096;
    } else {
      value = static_cast<T>(random());
    }
  }
  return {name, domain, components, std::move(values)};
}

}  // namespace azulejo
