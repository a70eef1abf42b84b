#pragma once

#include <cstddef>

namespace azulejo::kernels {

/// Turns cotangents into their angles, 0–π, in place. The same bytes as atan2_deterministic(1, value).
void angles_of_cotangents(float* values, std::size_t count);

}  // namespace azulejo::kernels
