#include "azulejo/io/obj_materials.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/read_text.h"

namespace azulejo {
namespace {

/// A hostile file can name millions.
constexpr std::size_t kMostLibraries = 256;

}  // namespace

/// False if there is no such file; `refused` may say why.
bool ObjMaterials::read_library(const std::string& name, std::string& refused) {
  if (libraries_.contains(name)) return true;
  const auto input = open_near(file_, name, options_, run_, refused);
  if (input == nullptr) return false;
  libraries_.insert(name);
  const Text text = read_text(*input, run_);
  for (MtlMaterial& each : parse_mtl(text.view(), input->name(), run_)) add(std::move(each));
  return true;
}

void ObjMaterials::read_libraries(std::string_view names) {
  std::string refused;
  if (names.empty() || libraries_.size() >= kMostLibraries || read_library(std::string(names), refused)) return;
  for (std::string_view rest = names; !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    const std::string name(rest.substr(0, end));
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t", end), rest.size()));
    refused.clear();
    if (libraries_.size() >= kMostLibraries || read_library(name, refused)) continue;
    libraries_.insert(name);
    warn(run_,
         !refused.empty() ? refused : fmt::format("{}: material library '{}' is missing", file_.input->name(), name));
  }
}

std::uint32_t ObjMaterials::find(std::string_view name, const glm::vec4& unknown) {
  if (name.empty()) return MaterialId::kNone;
  if (const auto known = by_name_.find(name); known != by_name_.end()) return known->second;
  const auto limit = static_cast<std::size_t>(run_.limits.memory_bytes);
  if (scene_.materials.size() >= limit / sizeof(Material)) {
    throw Error(Error::Resource, fmt::format("{}: {} materials take more than {} bytes, the limit of memory",
                                             file_.input->name(), scene_.materials.size() + 1, limit));
  }
  const auto id = static_cast<std::uint32_t>(scene_.materials.size());
  Material& material = scene_.materials.emplace_back();
  material.name = std::string(name);
  material.base_color = unknown;
  material.double_sided = true;
  by_name_.emplace(name, id);
  return id;
}

TextureUse ObjMaterials::use(const MtlMap& map, const std::string& key, std::shared_ptr<const Image> image) {
  const auto [place, fresh] = textures_.try_emplace({key, map.clamp}, TextureId(scene_.textures.size()));
  if (fresh) {
    Texture& texture = scene_.textures.emplace_back();
    texture.source = map.file;
    texture.image = std::move(image);
    if (map.clamp) texture.wrap_u = texture.wrap_v = TextureWrap::Clamp;
  }
  return texture_use(map, place->second);
}

TextureUse ObjMaterials::use(const MtlMap& map) {
  if (map.file.empty()) return {};
  return use(map, map.file, images_.read(map.file));
}

void ObjMaterials::set_base_color(MtlMaterial& each) {
  Material& material = each.material;
  const MtlMap& color = each.base_color;
  const MtlMap& alpha = each.alpha;
  std::shared_ptr<const Image> image = color.file.empty() ? nullptr : images_.read(color.file);
  const bool own = image != nullptr && image->info().alpha != AlphaState::None && color.file == alpha.file;
  const std::shared_ptr<const Image> together =
      alpha.file.empty() || own ? nullptr : images_.with_opacity(color.file, alpha.file);
  if (together != nullptr) {
    // No file's name has a line feed in it.
    material.base_color_texture = use(color.file.empty() ? alpha : color, color.file + "\n" + alpha.file, together);
    image = together;
  } else {
    material.base_color_texture = use(color);
  }
  if (image == nullptr || material.alpha_mode == AlphaMode::Blend) return;
  const Opacity opacity = opacity_of(*image);
  if (opacity == Opacity::Masked) material.alpha_mode = AlphaMode::Mask;
  if (opacity == Opacity::Blended) material.alpha_mode = AlphaMode::Blend;
}

void ObjMaterials::set_metallic_roughness(MtlMaterial& each) {
  const MtlMap& roughness = each.roughness;
  const MtlMap& metallic = each.metallic;
  if (roughness.file.empty() && metallic.file.empty()) return;
  Material& material = each.material;
  if (roughness.file == metallic.file && roughness.channel == 'g' && metallic.channel == 'b') {
    material.metallic_roughness_texture = use(roughness);
    return;
  }
  warn(run_, fmt::format("{}: material '{}': map_Pr and map_Pm are kept and not shown: one file with channels g and b "
                         "expected",
                         file_.input->name(), material.name));
  if (material.extensions.is_null()) material.extensions = Json::object();
  if (!roughness.file.empty()) material.extensions.set("map_Pr", roughness.words);
  if (!metallic.file.empty()) material.extensions.set("map_Pm", metallic.words);
}

void ObjMaterials::add(MtlMaterial each) {
  if (each.material.name.empty() || by_name_.contains(each.material.name)) return;
  set_base_color(each);
  each.material.specular_texture = use(each.specular);
  each.material.emissive_texture = use(each.emissive);
  each.material.normal_texture = use(each.normal);
  set_metallic_roughness(each);
  by_name_.emplace(each.material.name, static_cast<std::uint32_t>(scene_.materials.size()));
  scene_.materials.push_back(std::move(each.material));
}

}  // namespace azulejo
