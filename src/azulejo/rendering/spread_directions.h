#pragma once

#include <cstdint>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// From which a camera sees its target: see CameraOptions.
struct Direction {
  float azimuth_deg = 0;
  float elevation_deg = 0;
};
/// Directions spread evenly over the sphere: a Fibonacci lattice, turned and shaken by `seed`. The i-th depends on its
/// number, their count and the seed only.
AZULEJO_EXPORT std::vector<Direction> spread_directions(int count, std::uint64_t seed);

}  // namespace azulejo
