#pragma once

#include <cstddef>

namespace azulejo::kernels {

/// Rows that are dithered together: lanes of a vector, each two pixels behind the one above it.
std::size_t diffusion_rows();

/// Values of up to diffusion_rows() rows.
///
/// rows    amounts in units of levels; they become levels. NaN stays, takes nothing and gives nothing. Behind each row,
///         and behind the last one of diffusion_rows(), there are 2 · period · diffusion_rows() values that may be read
/// above   differences of the row above, `period` zeros before and behind; of a whole band, they become those of its last
///         row
/// period  values of a pixel, up to 4
struct DiffusionBand {
  float* rows;
  std::size_t stride;
  std::size_t height;
  std::size_t count;
  std::size_t period;
  float* above;
  float last;  ///< the highest level
};
void diffuse_band(const DiffusionBand& band);

}  // namespace azulejo::kernels
