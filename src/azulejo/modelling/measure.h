#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"
#include "azulejo/modelling/oriented_box.h"

namespace azulejo {

struct MeasureOptions {
  bool by_position = false;  ///< vertices at exactly equal positions are one, for what is closed and what is a shell
  int listed = 100;          ///< shells that the report names
};

/// A solid of density 1.
struct SolidMeasure {
  double volume = 0;             ///< negative: it is inside out
  glm::dvec3 centroid{0, 0, 0};  ///< its middle of mass; NaN without a volume
  glm::dmat3 inertia{0};         ///< about the centroid, along the coordinate axes; of an inside-out one negative
  glm::dvec3 moments{0, 0, 0};   ///< about the principal axes, rising
  std::array<glm::dvec3, 3> axes{glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< in this order; right-handed
};

/// A set of faces that are connected by edges, or all of them.
struct ShellMeasure {
  std::size_t faces = 0;
  double area = 0;
  glm::dvec3 surface_centroid{0, 0, 0};  ///< the middle of the surface; NaN without area
  Box3 box;                              ///< of the faces' vertices that are finite
  std::optional<SolidMeasure> solid;     ///< of a closed one
  std::string open;                      ///< why there is no solid; empty: there is one
};

struct EdgeLengths {
  std::size_t count = 0;
  double minimum = 0;
  double mean = 0;
  double maximum = 0;
};

/// The shape of triangles: 4 √3 area ÷ the sum of squares of the edges, 1 for an equilateral one, 0 for one without area.
struct TriangleQuality {
  std::size_t triangles = 0;
  std::size_t without_area = 0;
  double minimum = 0;
  double mean = 0;
  std::array<std::size_t, 10> histogram{};  ///< of tenths
  double smallest_angle = 0;                ///< radians, of triangles with an area
  double largest_angle = 0;
};

struct MeshMeasure {
  ShellMeasure all;
  std::vector<ShellMeasure> shells;  ///< in the order of their first faces
  OrientedBox oriented_box;          ///< of all finite vertices, or of those that faces use if there are faces
  EdgeLengths edges;                 ///< of faces
  TriangleQuality quality;
};

/// Measures a mesh: area, volume, centroids, inertia, boxes, edges, the shape of its triangles; n-gons as the triangles
/// that `triangulate` makes of them.
///
/// closed    a shell has a volume if each of its edges is run along as often in one direction as in the other, whatever
///           else is wrong with it: then sums over its triangles don't depend on the origin. Shells that are not closed
///           have none, and neither has the whole; `open` says why. Shells inside out count negative, so cavities count
///           as what they are; parts that overlap count twice
/// exactness doubles, each shell about the middle of its own box: far from the origin as exact as near to it
/// oriented box  the smallest of those with an edge along a coordinate axis, a principal axis of the surface, or across
///           one of the 500 largest faces of the convex hull: mostly, but not always, the smallest that there is
/// not finite triangles with such a coordinate are left out (their shell is open), as are such vertices; `run.warn`
/// Cost      O(corners), and O(vertices · log vertices) at worst for the hull: 1 M triangles in about half a second
/// Source    Mirtich, Fast and accurate computation of polyhedral mass properties, 1996; Tonon, Explicit exact formulas
///           for the 3-D tetrahedron inertia tensor, 2004
AZULEJO_EXPORT MeshMeasure measure(const Mesh& mesh, const MeasureOptions& options = {}, const Run& run = {});

/// As JSON; what has no meaning is null.
AZULEJO_EXPORT Report report_of(const MeshMeasure& measure, const MeasureOptions& options = {});

}  // namespace azulejo
