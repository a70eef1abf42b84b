#include "azulejo/io/mtl_write.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "azulejo/io/image_io.h"
#include "azulejo/io/mtl.h"
#include "azulejo/io/text_file.h"

namespace azulejo {
namespace {

/// Adds _2, _3, … to a name that is taken.
std::string unique_name(const std::string& name, std::set<std::string>& taken) {
  std::string result = name;
  for (int n = 2; !taken.insert(result).second; ++n) result = fmt::format("{}_{}", name, n);
  return result;
}

std::string color(const glm::vec3& linear) {
  return fmt::format("{} {} {}", linear_to_mtl(linear.x), linear_to_mtl(linear.y), linear_to_mtl(linear.z));
}

/// The pixels without their fourth channel.
Image without_alpha(const Image& image) {
  ImageInfo info = image.info();
  info.alpha = AlphaState::None;
  info.channels = image.info().color_channels();
  Image result(info);
  for (int y = 0; y < info.height; ++y) {
    const std::uint8_t* from = image.view<std::uint8_t>().row(y);
    std::uint8_t* to = result.view<std::uint8_t>().row(y);
    for (int x = 0; x < info.width; ++x, from += image.channels(), to += info.channels) {
      std::copy_n(from, info.channels, to);
    }
  }
  return result;
}

class MtlWriter {
 public:
  MtlWriter(const Scene& scene, const MtlPlace& place, const Run& run) : scene_(scene), place_(place), run_(run) {}

  void material(const Material& material, const std::string& name);
  const std::string& text() const { return text_; }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...);
    text_ += '\n';
  }
  void phong(const Material& material);
  void opacity(const Material& material);
  void kept(const Material& material);
  void map(const char* keyword, const TextureUse& use, bool with_alpha = false);
  std::string options(const TextureUse& use, const Texture& texture);
  std::string file_of(TextureId id, bool with_alpha);
  std::string path(const std::string& file) const { return place_.folder + "/" + file; }

  const Scene& scene_;
  const MtlPlace& place_;
  const Run& run_;
  std::string text_;
  std::map<std::pair<const Image*, bool>, std::string> files_;  ///< by image and whether its opacity is kept
  std::set<std::string> taken_;
};

/// Writes the image at its first use.
std::string MtlWriter::file_of(TextureId id, bool with_alpha) {
  const Texture& texture = scene_.textures[id.index];
  if (texture.image == nullptr) return texture.source;
  const Image& image = *texture.image;
  const bool strip = !with_alpha && image.info().alpha != AlphaState::None;
  const auto [place, fresh] = files_.try_emplace({&image, strip});
  if (!fresh) return place->second;
  std::string name = texture.name;
  if (name.empty()) {
    name = texture.source.substr(texture.source.find_last_of("/\\") + 1);
    name = name.substr(0, name.find_last_of('.'));
  }
  place->second =
      unique_name(fmt::format("{}_{}", place_.stem, plain_name(name, fmt::format("texture{}", id.index))), taken_) +
      ".png";
  write_image(strip ? without_alpha(image) : image.clone(), path(place->second), {}, run_);
  return place->second;
}

/// What MTL says of a lookup; the rest is warned of.
std::string MtlWriter::options(const TextureUse& use, const Texture& texture) {
  std::string result;
  const float up = 1 - use.scale.y - use.offset.y;
  if (use.offset.x != 0 || up != 0) result += fmt::format("-o {} {} 0 ", use.offset.x, up);
  if (use.scale != glm::vec2(1, 1)) result += fmt::format("-s {} {} 1 ", use.scale.x, use.scale.y);
  if (texture.wrap_u == TextureWrap::Clamp && texture.wrap_v == TextureWrap::Clamp) result += "-clamp on ";
  const bool says = texture.wrap_u == texture.wrap_v && texture.wrap_u != TextureWrap::Mirror && use.rotation == 0 &&
                    use.texcoord == 0;
  if (!says) {
    warn(run_, fmt::format("MTL: texture '{}': mirrored, rotated and second coordinates are left out", texture.name));
  }
  return result;
}

void MtlWriter::map(const char* keyword, const TextureUse& use, bool with_alpha) {
  if (!use.texture) return;
  const std::string file = file_of(use.texture, with_alpha);
  if (!file.empty()) line("{} {}{}", keyword, options(use, scene_.textures[use.texture.index]), file);
}

void MtlWriter::phong(const Material& material) {
  const bool highlight = material.specular != glm::vec3(0.0F);
  line("Ka {}", color(material.ambient * glm::vec3(material.base_color)));
  line("Ks {}", color(material.specular));
  line("Ns {}", material.shininess);
  line("illum {}", highlight ? 2 : 1);
  if (highlight) map("map_Ks", material.specular_texture);
}

void MtlWriter::opacity(const Material& material) {
  const bool opaque = material.alpha_mode == AlphaMode::Opaque;
  if (!opaque) line("d {}", material.base_color.w);
  map("map_Kd", material.base_color_texture, !opaque);
  const TextureUse& use = material.base_color_texture;
  const auto image = use.texture ? scene_.textures[use.texture.index].image : nullptr;
  // Programs that look for opacity in map_d alone find it.
  if (!opaque && image != nullptr && image->info().alpha != AlphaState::None) map("map_d", use, true);
}

/// What the reader of an MTL kept as text.
void MtlWriter::kept(const Material& material) {
  for (const std::string& key : material.extensions.keys()) {
    const std::string words = material.extensions[key].text("\n");
    if (words.find_first_of("\r\n") == std::string::npos && plain_name(key, "") == key) line("{} {}", key, words);
  }
}

void MtlWriter::material(const Material& material, const std::string& name) {
  line("newmtl {}", name);
  line("Kd {}", color(glm::vec3(material.base_color)));
  if (material.emissive != glm::vec3(0.0F)) line("Ke {}", color(material.emissive));
  switch (material.model) {
    case MaterialModel::Phong: phong(material); break;
    case MaterialModel::Unlit: line("illum 0"); break;
    case MaterialModel::MetalRough:
      line("Pr {}", material.roughness);
      line("Pm {}", material.metallic);
      map("map_Pr -imfchan g", material.metallic_roughness_texture);
      map("map_Pm -imfchan b", material.metallic_roughness_texture);
      break;
  }
  opacity(material);
  map("map_Ke", material.emissive_texture);
  map("norm", material.normal_texture);
  if (material.occlusion_texture.texture) warn(run_, fmt::format("MTL: material '{}': occlusion is left out", name));
  kept(material);
  text_ += '\n';
}

}  // namespace

std::string plain_name(const std::string& name, const std::string& otherwise) {
  std::string result = name;
  for (char& c : result) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || byte == 0x7F || c == '/' || c == '\\' || c == '#' || c == ':') c = '_';
  }
  return result.empty() ? otherwise : result;
}

std::vector<std::string> mtl_names(const Scene& scene) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    names.push_back(unique_name(plain_name(scene.materials[m].name, fmt::format("material{}", m)), taken));
  }
  return names;
}

std::string write_mtl(const Scene& scene, const std::vector<std::string>& names, const MtlPlace& place,
                      const Run& run) {
  MtlWriter writer(scene, place, run);
  for (std::size_t m = 0; m < names.size(); ++m) writer.material(scene.materials[m], names[m]);
  std::string file = place.stem + ".mtl";
  write_text_file(place.folder + "/" + file, writer.text());
  return file;
}

}  // namespace azulejo
