#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/mesh.h"
#include "azulejo/imaging/pseudo_color.h"
#include "azulejo/math/color.h"

namespace azulejo {

struct ColorByOptions {
  std::string attribute = "y";                  ///< x, y, z: the position; or an attribute's name
  std::optional<int> component = std::nullopt;  ///< of the attribute, 0–3; auto: the length of a vector
  ColorMap map = ColorMap::Viridis;
  std::optional<glm::vec2> range = std::nullopt;    ///< values that have the map's first and last color; auto: all
  std::optional<int> bands = std::nullopt;          ///< as many colors, 2–256; auto: no bands
  Color nan_color{0.6F, 0.6F, 0.6F, 1};             ///< of what is not a number; its alpha does not count
  std::optional<std::string> label = std::nullopt;  ///< of the color bar; auto: what it shows
  int bar_height = 360;                             ///< px, of the page with the color bar
  float font_size = 12;                             ///< px
};

/// A mesh whose colors are values, and what they mean.
struct ColoredMesh {
  Mesh mesh;
  Drawing bar;  ///< a page with the color bar alone
};

/// Colors a mesh by a scalar: a coordinate, or an attribute.
///
/// mesh    any; f32, u8 and u32 attributes of vertices, corners or faces
/// Result  the mesh with COLOR_0, 3 × u8, of vertices or corners (an attribute of faces: of their corners); an earlier
///         COLOR_0 is replaced. Between vertices renderers mix colors, not values
/// range   finite values count; beyond it values have the colors of the ends
/// Throws  Error(Argument) for an attribute that isn't there (the message names those that are), a component that it
///         hasn't
/// Cost    O(vertices + corners)
AZULEJO_EXPORT ColoredMesh color_by(const Mesh& mesh, const ColorByOptions& options = {}, const Run& run = {});

}  // namespace azulejo
