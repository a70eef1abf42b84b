#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/scene.h"
#include "azulejo/math/color.h"
#include "azulejo/rendering/camera_choice.h"

namespace azulejo {

enum class WireframeEdges : std::uint8_t {
  All,      ///< of every face
  Feature,  ///< borders, edges of three faces and more, and those where two faces meet at a larger angle
  Border,   ///< of one face
};
constexpr std::array<std::string_view, 3> enum_names(WireframeEdges) { return {"all", "feature", "border"}; }

struct WireframeOptions {
  int width = 1024;  ///< of the page, px
  int height = 768;
  CameraOptions camera = {};
  WireframeEdges edges = WireframeEdges::All;
  float crease_angle_deg = 40;   ///< edges=feature: sharper edges are drawn
  Color color = {0, 0, 0, 1};    ///< of lines and marks
  bool material_colors = false;  ///< faces that have a material lend its base color to their edges
  float line_width = 1;          ///< px
  float point_size = 0;          ///< px, of a mark on each vertex; 0: none
  PointShape point_shape = PointShape::Circle;
  bool edge_ids = false;                       ///< a path for each edge, named by its vertices: "edge-12-57"
  std::string animation = {};                  ///< name or number from 0; empty: the first
  std::optional<float> time_s = std::nullopt;  ///< the scene as it is then; nothing: as the file has it at rest
};

/// Draws the edges of a scene's meshes as lines, seen by a camera as by `render`; nothing hides them.
///
/// edges    each once, also where faces have vertices of their own at equal positions. Faces are drawn as they are: the
///          diagonals of polygons are no edges. Lines of a mesh count but for edges=border; vertices of meshes without
///          faces and lines have marks only
/// clip     edges are cut at the near plane, where they leave the viewport, and at the far plane
/// Result   a page of width × height px. A group for each mesh of each node, named after the node (else the mesh, else
///          "node-3"); in it lines of many edges end to end with round joins, by material: paths "edges", "edges:steel",
///          and "points". Coordinates in steps of 0.01 px. A viewport that is a part of the page clips its group
/// Stages   as render's
/// NaN      edges with a vertex that is not finite are left out
/// Throws   as render; Error(Resource) beyond run.limits.memory_bytes
/// Cost     O(corners + vertices over all nodes); a million edges in about a second
AZULEJO_EXPORT Drawing wireframe(const Scene& scene, const WireframeOptions& options = {}, const Run& run = {});

}  // namespace azulejo
