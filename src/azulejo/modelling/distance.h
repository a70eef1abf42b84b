#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"

namespace azulejo {

/// What a verdict is about.
enum class DistanceMetric : std::uint8_t { Maximum, Mean, Rms };
constexpr std::array<std::string_view, 3> enum_names(DistanceMetric) { return {"maximum", "mean", "rms"}; }

struct MeshDistanceOptions {
  bool symmetric = true;                      ///< from the reference to the source, too
  float tolerance = 1e-4F;                    ///< of the maximum, as a share of the diagonal, 0–1
  std::optional<int> samples = std::nullopt;  ///< points on each surface; auto: two a triangle, 10 000 to 2 000 000
  std::optional<int> refinements =
      std::nullopt;  ///< most points looked at for `tolerance`, beside vertices and samples;
                     ///< auto: two a triangle of both meshes, and a million
  int seed = 0;      ///< other samples for each
  DistanceMetric metric = DistanceMetric::Maximum;  ///< what at_most is about
  std::optional<float> at_most = std::nullopt;  ///< the verdict is no if it isn't certain that the metric isn't larger
  bool relative = false;                        ///< at_most is a share of the diagonal
};

/// How far the points of one surface are from another one, in the units of the meshes.
struct SurfaceDistance {
  double maximum = 0;        ///< of all points that were looked at: the one-sided Hausdorff distance is at least this
  double maximum_bound = 0;  ///< and at most this
  double mean = 0;           ///< over the area
  double mean_error = 0;     ///< standard error of the mean; 0 for points. Samples are spread so that it is mostly less
  double rms = 0;            ///< root of the mean square, over the area
  glm::dvec3 place{0, 0, 0};    ///< where the maximum is
  glm::dvec3 nearest{0, 0, 0};  ///< the point of the other surface that is nearest to it
  std::size_t vertices = 0;     ///< points that were looked at: vertices
  std::size_t samples = 0;      ///< on the surface
  std::size_t refinements = 0;  ///< and where the maximum might have been
};

struct MeshDistance {
  SurfaceDistance forward;                  ///< from the source to the reference
  std::optional<SurfaceDistance> backward;  ///< from the reference to the source
  double diagonal = 0;                      ///< of the box around the reference
  Array<float> of_vertices;                 ///< from each vertex of the source to the reference; NaN: not finite

  /// The larger ones of both directions.
  double maximum() const;
  double maximum_bound() const;
  double mean() const;
  double rms() const;
};

/// Measures how far two surfaces are apart: each point's distance is that of the nearest point of the other surface.
///
/// surface      faces, n-gons as `triangulate` divides them; of a mesh without triangles, its vertices. Triangles and
///              vertices that are not finite are left out; `run.warn` says how many. Open, crossing and non-manifold
///              surfaces are as good as others: inside and outside are not told apart
/// maximum      not only sampled: vertices, samples, then parts of triangles where it might be, halved until no point of
///              the surface can be farther by more than `tolerance`. What a part's points are at most is the larger of
///              the distances of its corners from one triangle, which is convex, or what its size adds to them.
///              `maximum_bound` is what is certain; it is more than the tolerance only where `refinements` ended it
/// mean, rms    of samples that lie evenly along the surface's area, within a triangle at random (Philox). Of points,
///              and of a surface without area, over the vertices
/// exactness    doubles; coordinates are exact. Distances have a relative error of about 10⁻¹⁵ of the triangles' size
/// Cost         O(points · log triangles): 10⁶ points and more in a second on one thread. The same for any number of
///              threads
/// Throws       Error(Argument) if one of them has no finite vertex, or an option is out of range
/// Source       Cignoni, Rocchini, Scopigno, Metro: measuring error on simplified surfaces, 1998; Aspert, Santa-Cruz,
///              Ebrahimi, MESH: measuring errors between surfaces using the Hausdorff distance, 2002; bounds as Guthe,
///              Borodin, Klein, Fast and accurate Hausdorff distance calculation between meshes, 2005
AZULEJO_EXPORT MeshDistance distance(const Mesh& source, const Mesh& reference, const MeshDistanceOptions& options = {},
                                     const Run& run = {});

/// Whether `at_most` holds; yes where it isn't asked for.
AZULEJO_EXPORT bool is_close(const MeshDistance& distance, const MeshDistanceOptions& options);
/// As JSON, with `is_close` as its verdict.
AZULEJO_EXPORT Report report_of(const MeshDistance& distance, const MeshDistanceOptions& options = {});

}  // namespace azulejo
