#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/io/output.h"

namespace azulejo {

using GltfObject = nlohmann::ordered_json;

/// A GLB that is being written: its JSON, and its binary chunk with the views and accessors into it.
class GltfOutput {
 public:
  GltfOutput(std::string name, const Run& run) : name_(std::move(name)), run_(run) {}

  static constexpr int kVertices = 34962;  ///< what a view is for
  static constexpr int kIndices = 34963;

  const Run& run() const { return run_; }
  /// One line, with the file's name before it.
  void warn(const std::string& what) const { azulejo::warn(run_, name_ + ": " + what); }
  Error error(Error::Kind kind, const std::string& what) const { return Error(kind, name_ + ": " + what); }

  /// Appends to the binary chunk; returns the view's index. Error(Resource) above 4 GiB.
  std::size_t add_view(std::span<const std::byte> bytes, int target = 0, std::size_t stride = 0);
  /// An accessor of all of a new view.
  std::size_t add_accessor(std::span<const std::byte> bytes, std::uint32_t component, const char* type,
                           std::size_t count, int target = 0, std::size_t stride = 0);
  /// Tightly packed floats of 1, 2, 3, 4 or 16 components; `bounds` writes the least and largest of each.
  std::size_t add_floats(std::span<const float> values, std::size_t components, bool bounds, int target = 0);
  /// The same; equal ones share an accessor.
  std::size_t add_shared_floats(std::span<const float> values, std::size_t components, bool bounds);

  /// The shortest decimal number that reads as the same float. Error(Data) if it isn't finite; `what` says of what.
  GltfObject number(float value, const char* what) const;
  GltfObject numbers(std::span<const float> values, const char* what) const {
    GltfObject list = GltfObject::array();
    for (const float each : values) list.push_back(number(each, what));
    return list;
  }
  template <glm::length_t kCount>
  GltfObject numbers(const glm::vec<kCount, float>& values, const char* what) const {
    return numbers({&values.x, static_cast<std::size_t>(kCount)}, what);
  }

  void use_extension(std::string_view name) { extensions_.emplace(name); }
  /// A list of the root, left out if it is empty, as glTF wants it.
  void set(const char* name, GltfObject list);
  void write(Output& output);

 private:
  std::string name_;
  const Run& run_;
  GltfObject root_;
  GltfObject views_ = GltfObject::array();
  GltfObject accessors_ = GltfObject::array();
  std::set<std::string, std::less<>> extensions_;
  std::vector<std::byte> binary_;
  std::unordered_map<std::string, std::size_t> shared_;
};

/// Writes a mesh that has vertices; returns what stands for it in `meshes`.
GltfObject write_gltf_mesh(GltfOutput& output, const Mesh& mesh);
/// `materials`, `textures`, `samplers` and `images`.
void write_gltf_materials(GltfOutput& output, const Scene& scene);
/// `skins` and `animations`.
void write_gltf_animations(GltfOutput& output, const Scene& scene);

}  // namespace azulejo
