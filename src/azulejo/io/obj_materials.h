#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "azulejo/data/scene.h"
#include "azulejo/io/mtl.h"
#include "azulejo/io/mtl_images.h"

namespace azulejo {

/// Fills a scene's materials and textures from the libraries that an OBJ file names.
///
/// Libraries  a missing one is warned of, its materials are there by name, gray as what has no material, or white in a
///            file with vertex colours; of several materials of one name the first holds
/// Textures   one for each file and way to look it up; images are shared (see MtlImages)
/// Opacity    of map_d, or of the base colour's own fourth channel: AlphaMode::Mask if all pixels are 0 or 255
/// map_Pr and map_Pm are a texture where both are channels of one file, g and b; else they stay in `extensions`
class ObjMaterials {
 public:
  ObjMaterials(const ModelFile& file, const ModelReadOptions& options, const Run& run, Scene& scene)
      : file_(file), options_(options), run_(run), images_(file, options, run), scene_(scene) {}

  /// Reads what stands behind `mtllib`: one name with blanks in it, or several names.
  void read_libraries(std::string_view names);
  /// The material of a name, made if there is none, of `unknown` colour; none for an empty name.
  std::uint32_t find(std::string_view name, const glm::vec4& unknown);

 private:
  bool read_library(const std::string& name, std::string& refused);
  void add(MtlMaterial material);
  void set_base_color(MtlMaterial& material);
  void set_metallic_roughness(MtlMaterial& material);
  TextureUse use(const MtlMap& map);
  TextureUse use(const MtlMap& map, const std::string& key, std::shared_ptr<const Image> image);

  const ModelFile& file_;
  const ModelReadOptions& options_;
  const Run& run_;
  MtlImages images_;
  Scene& scene_;
  std::map<std::string, std::uint32_t, std::less<>> by_name_;
  std::map<std::pair<std::string, bool>, TextureId> textures_;  ///< by file and whether it is clamped
  std::set<std::string, std::less<>> libraries_;
};

}  // namespace azulejo
