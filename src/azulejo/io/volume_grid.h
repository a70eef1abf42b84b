#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/volume.h"

namespace azulejo {

/// Sets the size of a volume from numbers of a file, not yet its samples.
/// Throws Error(Data) where one is below 1, Error(Resource) where the samples would pass run.limits.memory_bytes.
void set_size(Volume& volume, const std::array<std::int64_t, 3>& size, const std::string& file, const Run& run);

/// Where samples lie: position = origin + x · axes[0] + y · axes[1] + z · axes[2].
struct GridPlacement {
  std::array<std::array<double, 3>, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> origin = {0, 0, 0};
};

/// Sets spacing and origin. Axes that aren't those of the world keep their lengths and lose their directions, with a
/// warning; so do steps and origins that are no numbers, or steps of 0: 1 and 0 take their places.
void set_placement(Volume& volume, const GridPlacement& placement, const std::string& file, const Run& run);

/// Metres in a unit of length as files write it ("mm", "micron"); 0: unknown.
float metres_in(const std::string& unit);

}  // namespace azulejo
