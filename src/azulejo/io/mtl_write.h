#pragma once

#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// Where a model's other files go, and what their names begin with.
struct MtlPlace {
  std::string folder;
  std::string stem;
};

/// A name without blanks and what else a line of a file can't hold; `otherwise` for an empty one.
std::string plain_name(const std::string& name, const std::string& otherwise);

/// The names of a scene's materials in an MTL: plain, no two equal.
std::vector<std::string> mtl_names(const Scene& scene);

/// Writes <stem>.mtl and the textures that its materials use, <stem>_<texture>.png; returns the library's name.
/// What an MTL has no place for is left out, with a warning.
/// Throws Error(Io).
std::string write_mtl(const Scene& scene, const std::vector<std::string>& names, const MtlPlace& place, const Run& run);

}  // namespace azulejo
