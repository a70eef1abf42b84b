#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

enum class SampleMethod : std::uint8_t {
  Random,  ///< each point by itself, everywhere with the same chance: as even as dice are
  Poisson  ///< at random, but none nearer to another than a radius: blue noise
};
constexpr std::array<std::string_view, 2> enum_names(SampleMethod) { return {"random", "poisson"}; }

/// At most one of count, density and radius; without any, count is 10 000.
struct SamplePointsOptions {
  SampleMethod method = SampleMethod::Random;
  std::optional<int> count = std::nullopt;      ///< of points
  std::optional<float> density = std::nullopt;  ///< points on a unit of area; their number is rounded
  std::optional<float> radius = std::nullopt;   ///< of poisson: the smallest distance of two points
  int seed = 0;                                 ///< other points for each
};

struct SampledPoints {
  Mesh points;        ///< a point cloud
  double area = 0;    ///< of the surface
  double radius = 0;  ///< of poisson: no two points are nearer to each other, but for the rounding of their positions
};

/// Spreads points over the surface of a mesh: n-gons as the triangles that `triangulate` makes of them.
///
/// random      the i-th point depends on the seed and i only: more points begin with the fewer
/// poisson     of candidates at random, in their order, those that keep the distance (straight through space, not along
///             the surface) from all before; where a count is asked for, the distance begins with what can't be kept and
///             shrinks by 3 % until there are as many. A count of n takes 8 n candidates; a radius as many as leave few
///             gaps that another point would fit into
/// attributes  NORMAL: the mesh's, between its corners, else the face's; `face`: u32, the index of the face. Other f32 and
///             u8 attributes of vertices and corners are mixed by the shares of the corners, u32 ones have the value of
///             the corner with the largest share, those of faces the face's. TANGENT, JOINTS_n, WEIGHTS_n, morph targets
///             and materials, which mean nothing for a point, are left out
/// nothing     a mesh without area has no points. Triangles that are not finite have none; `run.warn` says how many
/// Cost        O(points · log triangles), of poisson times 10 and on one thread. The same for any number of threads
/// Throws      Error(Argument) for an option out of range, two of count, density and radius, a radius of random points;
///             Error(Resource) for more than 10⁸ points, of poisson 2 · 10⁶
/// Source      Turk, Generating random points in triangles, 1990; McCool, Fiume, Hierarchical Poisson disk sampling
///             distributions, 1992; random numbers by Philox
AZULEJO_EXPORT SampledPoints sample_points(const Mesh& mesh, const SamplePointsOptions& options = {},
                                           const Run& run = {});

}  // namespace azulejo
