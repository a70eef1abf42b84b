#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"

namespace azulejo {

/// Which vertices become one.
enum class WeldMethod : std::uint8_t {
  Distance,  ///< no farther apart than the tolerance
  Grid,      ///< in the same cell of a grid, whose edge is the tolerance
};
constexpr std::array<std::string_view, 2> enum_names(WeldMethod) { return {"distance", "grid"}; }

/// What becomes of vertex attributes that differ between vertices that become one.
enum class WeldAttributes : std::uint8_t {
  Corner,    ///< they become attributes of corners: nothing is lost
  First,     ///< the first vertex's stay
  Separate,  ///< vertices with different attributes don't become one
};
constexpr std::array<std::string_view, 3> enum_names(WeldAttributes) { return {"corner", "first", "separate"}; }

struct WeldOptions {
  float tolerance = 0;           ///< in units of the mesh; 0: vertices at exactly equal positions
  float relative_tolerance = 0;  ///< of the diagonal of the bounding box; the larger of both tolerances counts
  WeldMethod method = WeldMethod::Distance;
  WeldAttributes attributes = WeldAttributes::Corner;
  bool drop_degenerate = true;  ///< faces left with fewer than three sides and lines left with one vertex go
};

/// A mesh with fewer vertices, and what was done.
struct WeldedMesh {
  Mesh mesh;
  Array<std::uint32_t> vertices;  ///< of each vertex before, the one that it is now
  double tolerance = 0;           ///< that counted
  std::size_t welded = 0;         ///< vertices that became part of another one
  double largest_distance = 0;    ///< between such a vertex and that one
  std::size_t dropped_faces = 0;
  std::size_t dropped_corners = 0;  ///< of faces that stay: the same vertex twice in turn
  std::size_t dropped_lines = 0;
  std::vector<std::string> corner_attributes;  ///< that vertices had before
};

/// Makes one vertex of those that are within a tolerance.
///
/// distance   in the order of the vertices each goes to the nearest vertex that stayed, if one is within the tolerance,
///            else it stays: no vertex goes farther than the tolerance, so rows of near vertices don't run together; of
///            vertices just within it one may stay, and the other go elsewhere. Those at equal places go together.
///            Idempotent
/// grid       cells are centered at whole multiples of the tolerance; the first vertex of a cell stays where it is. Near
///            vertices on two sides of a border stay two
/// equal      -0 is 0; NaN equals nothing; infinities equal themselves only
/// stays      positions and order of the vertices that stay, unused ones too; where nothing is done, every byte
/// attributes see WeldAttributes; differing values that no corner can hold, of points and lines, are the first vertex's.
///            Vertices that move differently (positions of morph targets, JOINTS, WEIGHTS) always stay apart; normals of
///            morph targets are the first vertex's
/// Cost       O(vertices + corners), also where all are within the tolerance; exactly, on all threads
/// Throws     Error(Argument) for an option out of range
AZULEJO_EXPORT WeldedMesh weld(const Mesh& mesh, const WeldOptions& options = {}, const Run& run = {});

/// What was done, as JSON.
AZULEJO_EXPORT Report report_of(const WeldedMesh& welded, const Mesh& before);

}  // namespace azulejo
