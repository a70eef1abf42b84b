#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/imaging/pseudo_color.h"

namespace azulejo {

enum class GlyphKind : std::uint8_t {
  Arrow,   ///< from the vertex along its vector
  Cone,    ///< likewise, its base at the vertex
  Sphere,  ///< around the vertex, as wide as the vector is long
};
constexpr std::array<std::string_view, 3> enum_names(GlyphKind) { return {"arrow", "cone", "sphere"}; }

struct GlyphsOptions {
  GlyphKind kind = GlyphKind::Arrow;
  std::string attribute = "NORMAL";  ///< of vertices, 3 components; NORMAL is made where vertices have none
  float size = 0.08F;                ///< of the longest glyph, in diagonals of the mesh's box
  bool scaled = true;                ///< glyphs are as long as their vectors; else all are alike
  int most = 1000;                   ///< glyphs: of more vertices every so-many-th has one
  int segments = 12;                 ///< faces around
  ColorMap map = ColorMap::Viridis;  ///< colors of lengths
  std::optional<glm::vec2> range = std::nullopt;  ///< lengths of the map's first and last color; auto: 0 to the longest
  bool surface = true;                            ///< the operation's scene shows the mesh, too
};

/// Small bodies at the vertices of a mesh that show vectors by their direction, length and color.
///
/// mesh    any; vertices without a finite place and vector, or whose vector is 0, have no glyph
/// Result  one mesh of all glyphs: COLOR_0 and NORMAL of corners, and "value", the vector's length, of vertices. Without
///         any vector it is empty
/// Throws  Error(Argument) for an attribute that isn't there, or not three numbers of a vertex; Error(Resource) beyond
///         run.limits.memory_bytes
/// Cost    O(vertices + glyphs · segments)
AZULEJO_EXPORT Mesh glyphs(const Mesh& mesh, const GlyphsOptions& options = {}, const Run& run = {});

}  // namespace azulejo
