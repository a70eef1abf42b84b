#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/common.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/io/gltf_output.h"
#include "azulejo/io/image_io.h"

namespace azulejo {
namespace {

GltfObject extension(GltfOutput& output, const char* name, GltfObject value) {
  output.use_extension(name);
  return {{name, std::move(value)}};
}

/// A textureInfo; `strength` is what it calls use.strength, null if it has none.
GltfObject texture_use(GltfOutput& output, const TextureUse& use, const char* strength = nullptr) {
  GltfObject result = {{"index", use.texture.index}};
  if (use.texcoord != 0) result["texCoord"] = use.texcoord;
  if (strength != nullptr && use.strength != 1) result[strength] = output.number(use.strength, "a texture's strength");
  GltfObject transform;
  if (use.offset != glm::vec2(0, 0)) transform["offset"] = output.numbers(use.offset, "a texture's offset");
  if (use.rotation != 0) transform["rotation"] = output.number(use.rotation, "a texture's rotation");
  if (use.scale != glm::vec2(1, 1)) transform["scale"] = output.numbers(use.scale, "a texture's scale");
  if (!transform.empty()) result["extensions"] = extension(output, "KHR_texture_transform", std::move(transform));
  return result;
}

GltfObject metal_rough(GltfOutput& output, const Material& material) {
  GltfObject result;
  const bool phong = material.model == MaterialModel::Phong;
  const float metallic = phong ? 0 : material.metallic;
  const float roughness = phong ? std::sqrt(2 / (std::max(material.shininess, 0.0F) + 2)) : material.roughness;
  const glm::vec4 color = glm::clamp(material.base_color, 0.0F, 1.0F);
  if (color != glm::vec4(1)) result["baseColorFactor"] = output.numbers(color, "a material's base color");
  if (material.base_color_texture.texture) {
    result["baseColorTexture"] = texture_use(output, material.base_color_texture);
  }
  if (metallic != 1) result["metallicFactor"] = output.number(std::clamp(metallic, 0.0F, 1.0F), "a metallic factor");
  if (roughness != 1) {
    result["roughnessFactor"] = output.number(std::clamp(roughness, 0.0F, 1.0F), "a roughness factor");
  }
  if (material.metallic_roughness_texture.texture && !phong) {
    result["metallicRoughnessTexture"] = texture_use(output, material.metallic_roughness_texture);
  }
  return result;
}

/// Beyond 1 by an extension, whose factor is a power of two: dividing by it loses no bit.
void write_emissive(GltfOutput& output, const Material& material, GltfObject& result, GltfObject& extensions) {
  glm::vec3 emissive = glm::max(material.emissive, 0.0F);
  if (emissive == glm::vec3(0)) return;
  const float most = std::max({emissive.x, emissive.y, emissive.z});
  if (most > 1 && std::isfinite(most)) {
    int exponent = 0;
    if (std::frexp(most, &exponent) == 0.5F) --exponent;
    const float strength = std::ldexp(1.0F, std::min(exponent, 127));
    emissive /= strength;
    extensions.update(extension(output, "KHR_materials_emissive_strength",
                                {{"emissiveStrength", output.number(strength, "an emissive strength")}}));
  }
  result["emissiveFactor"] = output.numbers(emissive, "an emissive color");
}

GltfObject material_object(GltfOutput& output, const Material& material) {
  GltfObject result;
  GltfObject extensions;
  if (!material.name.empty()) result["name"] = material.name;
  if (GltfObject base = metal_rough(output, material); !base.empty()) result["pbrMetallicRoughness"] = std::move(base);
  if (material.normal_texture.texture) {
    result["normalTexture"] = texture_use(output, material.normal_texture, "scale");
  }
  if (material.occlusion_texture.texture) {
    result["occlusionTexture"] = texture_use(output, material.occlusion_texture, "strength");
  }
  write_emissive(output, material, result, extensions);
  if (material.emissive_texture.texture) {
    result["emissiveTexture"] = texture_use(output, material.emissive_texture);
  }
  if (material.alpha_mode != AlphaMode::Opaque) {
    result["alphaMode"] = material.alpha_mode == AlphaMode::Mask ? "MASK" : "BLEND";
  }
  if (material.alpha_cutoff != 0.5F) result["alphaCutoff"] = output.number(material.alpha_cutoff, "an alpha cutoff");
  if (material.double_sided) result["doubleSided"] = true;
  if (material.model == MaterialModel::Unlit) {
    extensions.update(extension(output, "KHR_materials_unlit", GltfObject::object()));
  }
  for (const std::string& name : material.extensions.keys()) {
    output.use_extension(name);
    extensions[name] = GltfObject::parse(material.extensions[name].dump(-1));
  }
  if (!extensions.empty()) result["extensions"] = std::move(extensions);
  return result.is_null() ? GltfObject::object() : result;
}

int wrap_code(TextureWrap wrap) {
  return wrap == TextureWrap::Repeat ? 10497 : wrap == TextureWrap::Mirror ? 33648 : 33071;
}

int filter_code(const Texture& texture) {
  const int linear = texture.minification == TextureFilter::Linear ? 1 : 0;
  switch (texture.mipmaps) {
    case MipFilter::None: return 9728 + linear;
    case MipFilter::Nearest: return 9984 + linear;
    case MipFilter::Linear: return 9986 + linear;
  }
  return 9987;
}

GltfObject sampler_object(const Texture& texture) {
  return {{"magFilter", texture.magnification == TextureFilter::Linear ? 9729 : 9728},
          {"minFilter", filter_code(texture)},
          {"wrapS", wrap_code(texture.wrap_u)},
          {"wrapT", wrap_code(texture.wrap_v)}};
}

/// A file's name as a URI has it.
std::string uri_of(const std::string& source) {
  std::string uri;
  for (const char letter : source) {
    if (letter == ' ')
      uri += "%20";
    else
      uri += letter == '\\' ? '/' : letter;
  }
  return uri;
}

/// The images of textures, each once; of those that weren't read, their files' names.
class ImageList {
 public:
  /// The place of what a texture shows, which it has an image or a name of.
  std::size_t add(const Texture& texture) {
    const std::string uri = texture.image != nullptr ? std::string() : uri_of(texture.source);
    const auto [found, is_new] = known_.try_emplace({texture.image.get(), uri}, order_.size());
    if (is_new) order_.push_back(&texture);
    return found->second;
  }
  GltfObject write(GltfOutput& output) const;

 private:
  std::map<std::pair<const Image*, std::string>, std::size_t> known_;
  std::vector<const Texture*> order_;
};

GltfObject ImageList::write(GltfOutput& output) const {
  std::vector<std::vector<std::byte>> encoded(order_.size());
  Run inner = output.run();
  inner.threads = 1;
  inner.progress = nullptr;
  inner.warn = nullptr;
  parallel_tasks(order_.size(), output.run(), [&](std::size_t i, int) {
    if (order_[i]->image != nullptr) encoded[i] = encode_image(*order_[i]->image, "png", {}, inner);
  });
  GltfObject list = GltfObject::array();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (order_[i]->image == nullptr) {
      list.push_back({{"uri", uri_of(order_[i]->source)}});
    } else {
      list.push_back({{"bufferView", output.add_view(encoded[i])}, {"mimeType", "image/png"}});
    }
  }
  return list;
}

void write_textures(GltfOutput& output, const Scene& scene) {
  GltfObject textures = GltfObject::array();
  GltfObject samplers = GltfObject::array();
  std::map<std::string, std::size_t> known_samplers;
  ImageList images;
  const GltfObject usual = sampler_object({});
  for (const Texture& texture : scene.textures) {
    GltfObject each = GltfObject::object();
    if (!texture.name.empty()) each["name"] = texture.name;
    if (texture.image != nullptr || !texture.source.empty()) {
      each["source"] = images.add(texture);
    }
    GltfObject sampler = sampler_object(texture);
    if (sampler != usual) {
      const auto [found, is_new] = known_samplers.try_emplace(sampler.dump(), samplers.size());
      if (is_new) samplers.push_back(std::move(sampler));
      each["sampler"] = found->second;
    }
    textures.push_back(std::move(each));
  }
  output.set("textures", std::move(textures));
  output.set("samplers", std::move(samplers));
  output.set("images", images.write(output));
}

}  // namespace

void write_gltf_materials(GltfOutput& output, const Scene& scene) {
  GltfObject materials = GltfObject::array();
  for (const Material& material : scene.materials) materials.push_back(material_object(output, material));
  output.set("materials", std::move(materials));
  write_textures(output, scene);
}

}  // namespace azulejo
