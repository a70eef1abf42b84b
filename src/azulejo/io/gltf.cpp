#include "azulejo/io/gltf.h"

#include <algorithm>
#include <string_view>

#include "azulejo/io/gltf_parts.h"

namespace azulejo {
namespace {

bool matches(std::span<const std::byte> head, std::uint64_t /*size*/, std::string_view /*name*/) {
  std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  if (text.starts_with("glTF")) return true;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size())); };
  skip_blanks();
  if (!text.starts_with('{')) return false;
  text.remove_prefix(1);
  skip_blanks();
  return text.starts_with('"');  // no other model begins like this
}

Model read(const ModelFile& model, const ModelReadOptions& options, const Run& run) {
  GltfFile file(model, options, run);
  GltfAccessors accessors(file);
  Scene scene;
  scene.space = {UpAxis::Y, 1.0F};
  scene.textures = read_gltf_textures(file);
  scene.materials = read_gltf_materials(file, scene.textures.size());
  scene.meshes = read_gltf_meshes(file, accessors, scene.materials.size());
  scene.skins = read_gltf_skins(file, accessors, file.root()["nodes"].size());
  scene.cameras = read_gltf_cameras(file);
  scene.lights = read_gltf_lights(file);
  read_gltf_nodes(file, accessors, scene);
  scene.animations = read_gltf_animations(file, accessors, scene);
  return scene;
}

}  // namespace

const ModelCodec kGltf = {"gltf", {"glb", "gltf"}, matches, read, nullptr, write_gltf_scene};

}  // namespace azulejo
