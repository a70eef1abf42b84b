#pragma once

#include <cstddef>
#include <cstdint>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/surface_area.h"

namespace azulejo {

/// A point of a surface.
struct SurfaceSample {
  std::uint32_t triangle = 0;
  CornerShares shares{0, 0, 0};
};

/// Points at random on a surface with an area, from the number `first` on; each depends on the seed and its number only.
Array<SurfaceSample> random_samples(const SurfaceArea& surface, std::size_t first, std::size_t count, int seed,
                                    const Run& run);

/// Points at random that keep a distance.
struct SpacedSamples {
  Array<SurfaceSample> samples;  ///< in the order in which they were picked
  double radius = 0;             ///< the distance that all keep
};

/// Of so many points at random, in their order, those that keep `radius` from all before.
SpacedSamples spaced_by(const SurfaceArea& surface, double radius, std::size_t candidates, int seed, const Run& run);
/// As many as are asked for, of so many candidates, which are no fewer; the radius shrinks until there are as many.
SpacedSamples spaced_count(const SurfaceArea& surface, std::size_t count, std::size_t candidates, int seed,
                           const Run& run);

/// The point cloud: positions and attributes, as sample_points.h says.
Mesh cloud_of(const Mesh& mesh, const SurfaceArea& surface, const Array<SurfaceSample>& samples, const Run& run);

}  // namespace azulejo
