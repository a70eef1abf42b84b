#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// An image as a material of an MTL names it.
struct MtlMap {
  std::string file;  ///< empty: none
  glm::vec2 scale{1, 1};
  glm::vec2 offset{0, 0};
  bool clamp = false;
  char channel = 0;   ///< of -imfchan: r, g, b, m, l, z; 0: not given
  std::string words;  ///< all that stands behind the keyword
};

/// A material without its textures.
struct MtlMaterial {
  Material material;
  MtlMap base_color;  ///< map_Kd
  MtlMap alpha;       ///< map_d
  MtlMap specular;    ///< map_Ks
  MtlMap emissive;    ///< map_Ke
  MtlMap normal;      ///< norm
  MtlMap roughness;   ///< map_Pr
  MtlMap metallic;    ///< map_Pm
};

/// Parses a material library, which must end in a line feed. Keywords may be in any case.
///
/// Colours    what stands in the file is what viewers show: sRGB, made linear; above 1 it is taken for linear
/// Phong      Kd, Ks, Ns; Ka, which stands for itself in MTL, becomes a factor of Kd. Without a highlight if Ns is 0 or
///            illum is 1
/// MetalRough with Pr (roughness) or Pm (metallic)
/// Unlit      with illum 0
/// Opacity    d, else 1 − Tr; Tr 1 without d is opaque, as many programs mean it. Below 1: AlphaMode::Blend
/// Textures   a map under a black Kd or Ke is shown as it is
/// Others     are kept in `extensions` by their keyword, as text; the first 64 of a material
/// Sides      all materials are double-sided: OBJ says nothing of the order of corners
///
/// Lines that can't be understood are left out, with one warning.
/// Throws Error(Resource) for more materials than run.limits.memory_bytes may hold.
std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& name, const Run& run);

/// The texture transform of a map, for v that counts down.
TextureUse texture_use(const MtlMap& map, TextureId texture);

/// A number of an MTL as linear light, and back.
float mtl_to_linear(float value);
float linear_to_mtl(float value);

}  // namespace azulejo
