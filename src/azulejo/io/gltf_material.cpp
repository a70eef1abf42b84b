#include <array>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/io/gltf_parts.h"

namespace azulejo {
namespace {

constexpr std::size_t kTexcoords = 1000;  ///< sets of texture coordinates that a file may name

glm::vec3 to_vec3(const std::array<float, 3>& values) { return {values[0], values[1], values[2]}; }
glm::vec4 to_vec4(const std::array<float, 4>& values) { return {values[0], values[1], values[2], values[3]}; }

int texcoord_of(const GltfValue& value) { return value ? static_cast<int>(value.index(kTexcoords)) : 0; }

/// A textureInfo, whose third member is called `strength`, if it has one.
TextureUse read_use(const GltfValue& value, std::size_t textures, std::string_view strength = {}) {
  TextureUse use;
  if (!value) return use;
  use.texture = TextureId(value.need("index").index(textures));
  use.texcoord = texcoord_of(value["texCoord"]);
  if (!strength.empty()) use.strength = value[strength].number(1);
  if (const GltfValue transform = value["extensions"]["KHR_texture_transform"]) {
    const std::array<float, 2> offset = transform["offset"].numbers<2>({0, 0});
    const std::array<float, 2> scale = transform["scale"].numbers<2>({1, 1});
    use.offset = {offset[0], offset[1]};
    use.scale = {scale[0], scale[1]};
    use.rotation = transform["rotation"].number(0);
    if (transform["texCoord"]) use.texcoord = texcoord_of(transform["texCoord"]);
  }
  return use;
}

AlphaMode alpha_mode_of(const GltfValue& value) {
  const std::string name = value ? value.text() : "OPAQUE";
  if (name == "OPAQUE") return AlphaMode::Opaque;
  if (name == "MASK") return AlphaMode::Mask;
  if (name == "BLEND") return AlphaMode::Blend;
  throw value.error(fmt::format("{}, expected OPAQUE, MASK or BLEND", printable(name)));
}

void read_metal_rough(const GltfValue& value, std::size_t textures, Material& material) {
  material.base_color = to_vec4(value["baseColorFactor"].numbers<4>({1, 1, 1, 1}));
  material.base_color_texture = read_use(value["baseColorTexture"], textures);
  material.metallic = value["metallicFactor"].number(1);
  material.roughness = value["roughnessFactor"].number(1);
  material.metallic_roughness_texture = read_use(value["metallicRoughnessTexture"], textures);
}

/// The older model, as nearly as the newer one can say it.
void read_specular_glossiness(const GltfValue& value, std::size_t textures, Material& material) {
  material.base_color = to_vec4(value["diffuseFactor"].numbers<4>({1, 1, 1, 1}));
  material.base_color_texture = read_use(value["diffuseTexture"], textures);
  material.metallic = 0;
  material.roughness = 1 - value["glossinessFactor"].number(1);
  material.metallic_roughness_texture = {};
}

void read_extensions(GltfFile& file, const GltfValue& value, std::size_t textures, std::size_t index,
                     Material& material) {
  for (const auto& [name, extension] : value.members()) {
    if (name == "KHR_materials_unlit") {
      material.model = MaterialModel::Unlit;
    } else if (name == "KHR_materials_emissive_strength") {
      material.emissive *= extension["emissiveStrength"].number(1);
    } else if (name == "KHR_materials_pbrSpecularGlossiness") {
      read_specular_glossiness(extension, textures, material);
    } else {
      const Json kept = extension.json();
      if (kept.is_null()) {
        file.warn(fmt::format("material {}: {} is too large and is left out", index, printable(name)));
        continue;
      }
      if (material.extensions.is_null()) material.extensions = Json::object();
      material.extensions.set(name, kept);
    }
  }
}

Material read_material(GltfFile& file, const GltfValue& value, std::size_t textures, std::size_t index) {
  Material material;
  material.name = value["name"].text();
  read_metal_rough(value["pbrMetallicRoughness"], textures, material);
  material.normal_texture = read_use(value["normalTexture"], textures, "scale");
  material.occlusion_texture = read_use(value["occlusionTexture"], textures, "strength");
  material.emissive = to_vec3(value["emissiveFactor"].numbers<3>({0, 0, 0}));
  material.emissive_texture = read_use(value["emissiveTexture"], textures);
  material.alpha_mode = alpha_mode_of(value["alphaMode"]);
  material.alpha_cutoff = value["alphaCutoff"].number(0.5F);
  material.double_sided = value["doubleSided"].truth(false);
  read_extensions(file, value["extensions"], textures, index, material);
  return material;
}

}  // namespace

std::vector<Material> read_gltf_materials(GltfFile& file, std::size_t textures) {
  const GltfValue list = file.root()["materials"];
  file.claim(list.size(), sizeof(Material));
  std::vector<Material> materials;
  materials.reserve(list.size());
  for (std::size_t m = 0; m < list.size(); ++m) materials.push_back(read_material(file, list.at(m), textures, m));
  return materials;
}

}  // namespace azulejo
