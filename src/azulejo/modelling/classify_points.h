#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

enum class PointClass : std::uint8_t { Outside, Inside, Border };

/// Tells of any number of points whether they are inside a polygon. Exact: coordinates are taken as they are, and signs
/// are those of exact arithmetic. With border 0 the border is what lies exactly on a line; else what is nearer to one
/// than that, in doubles.
///
/// NaN, infinite  such a point is outside; such a point of the polygon is left out of its ring
/// Cost           a point looks at the lines in its cell of a grid, a few as a rule: 10⁶ points a second and more for a
///                star of 10⁴ spikes that all are long. The grid has as many cells as the polygon twice lines, at most
///                about nine of which a line is in on the mean
class AZULEJO_EXPORT PointClassifier {
 public:
  explicit PointClassifier(const Polygon& polygon, FillRule rule = FillRule::NonZero, float border = 0);
  ~PointClassifier();
  PointClassifier(PointClassifier&&) noexcept;
  PointClassifier& operator=(PointClassifier&&) noexcept;

  PointClass operator()(const glm::vec2& point) const;
  /// As many results as points; on all threads.
  void classify(std::span<const glm::vec2> points, std::span<PointClass> results, const Run& run = {}) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

struct ClassifyPointsOptions {
  float border = 0;        ///< what is nearer to the outline than this is border
  float tolerance = 0.1F;  ///< of the drawing's unit: how far lines may be from curves
};

struct ClassifiedPoints {
  Mesh points;    ///< with an attribute `class` of each vertex, u32: 0 outside, 1 inside, 2 border
  Report report;  ///< how many there are of each
};

/// Vertices of a mesh against what a drawing fills, both as `tessellate` places drawings: the drawing's (x, y) is
/// (x, −y, 0), z counts for nothing. Exact where the drawing has one path; several are united first, as polygon.h says.
/// Strokes and clips are left out; `run.warn` says so.
AZULEJO_EXPORT ClassifiedPoints classify_points(const Drawing& drawing, const Mesh& points,
                                                const ClassifyPointsOptions& options = {}, const Run& run = {});

struct ClassifyInMeshOptions {
  float border = 0;    ///< what is nearer to a face than this is border
  float accuracy = 2;  ///< of open meshes: how many times its radius away a group of triangles is taken as one, 1–100
};

/// Vertices of a mesh against a surface, by its winding number, as winding_number.h says: a point is inside where the
/// surface goes around it, once or more often, in whatever direction: where the number is above 0.5 or below −0.5. Cavities
/// and shells in shells are what their orientation makes of them.
///
/// attributes  of each vertex `winding`, f32, and `class`, u32: 0 outside, 1 inside, 2 border; those of the same names
///             are replaced
/// closed      exact: both attributes are those of exact arithmetic, whatever shape the surface has
/// open        holes, faces that are turned or missing: what is inside is what would be if they were closed by something
///             smooth; of a mesh with no inside, nothing
/// border      with 0, what is exactly on a face; else what is so near to one, in doubles. `winding` is then that beside
///             the surface
/// NaN, infinite  such a point is outside, of winding number 0; faces with such a corner are left out
/// Report      how many there are of each class; `open_edges`: 0 where the surface is closed
/// Cost        O((faces + points) log faces) as a rule; on all threads
AZULEJO_EXPORT ClassifiedPoints classify_points(const Mesh& surface, const Mesh& points,
                                                const ClassifyInMeshOptions& options = {}, const Run& run = {});

}  // namespace azulejo
