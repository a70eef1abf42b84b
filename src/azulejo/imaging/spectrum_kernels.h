#pragma once

#include <cstddef>

namespace azulejo::kernels {

/// re[i] becomes ln(1 + √(re[i]² + im[i]²)), within 3·10⁻⁷ · max(1, the value); NaN where that is not finite.
/// count  a multiple of 16
void log_magnitudes(float* re, const float* im, std::size_t count);

}  // namespace azulejo::kernels
