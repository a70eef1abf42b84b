#pragma once

#include <cstddef>
#include <cstdint>

#include "azulejo/imaging/sobel_kernels.h"

namespace azulejo::kernels {

/// Four:  (((above − at) + (below − at)) + ((left − at) + (right − at))) · scale.
/// Eight: that sum, then ((above left − at) + (above right − at)) + ((below left − at) + (below right − at)) is added.
/// Integers are exact in f32. The rows are as Sobel's.
void laplacian_row(const SobelSource<std::uint8_t>& source, bool eight, float scale, float* result);
void laplacian_row(const SobelSource<std::uint16_t>& source, bool eight, float scale, float* result);
void laplacian_row(const SobelSource<float>& source, bool eight, float scale, float* result);

}  // namespace azulejo::kernels
