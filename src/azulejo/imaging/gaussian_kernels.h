#pragma once

#include <cstddef>
#include <cstdint>

#include "azulejo/engine/scratch.h"
#include "azulejo/imaging/window_tile.h"

namespace azulejo::kernels {

/// What is weighted: the stored values, colors multiplied by alpha, linear light.
struct GaussianPixels {
  int channels = 1;
  float full = 1;              ///< stored value of intensity 1
  bool alpha = false;          ///< the last channel is alpha
  bool premultiplied = false;  ///< colors are stored multiplied by it
  bool decode = false;         ///< colors are stored in sRGB, weighted in linear light
};

template <class T>
using GaussianTile = WindowTile<T>;

/// The columns, then the rows of each tile, by weights[0 … radius], in f32. For each result value of both passes
///   sum = weights[radius] · (a + b) + … + weights[1] · (a + b), a and b being `radius` … 1 before and after;
///   u8: result = sum + weights[0] · center;
///   u16, f32: each (a + b) is (a + b) − 2 · center and result = center + sum, so that equal values stay equal.
void gaussian_tile(const GaussianTile<std::uint8_t>& tile, const GaussianPixels& pixels, const float* weights,
                   int radius, Scratch& scratch);
void gaussian_tile(const GaussianTile<std::uint16_t>& tile, const GaussianPixels& pixels, const float* weights,
                   int radius, Scratch& scratch);
void gaussian_tile(const GaussianTile<float>& tile, const GaussianPixels& pixels, const float* weights, int radius,
                   Scratch& scratch);

/// The same for stored bytes in integers. The weights of the taps −radius … radius are weights[1 … 2 · radius + 1], in
/// 2⁻¹⁵, between two zeros. Both passes sum exactly in 32 bits and round half up, the first to 1/64 of a level.
constexpr int kGaussianWeightBits = 15;
constexpr int kGaussianLevelBits = 6;  ///< of the results of the first pass, beyond a level
constexpr int kGaussianFirstShift = kGaussianWeightBits - kGaussianLevelBits;
constexpr int kGaussianSecondShift = kGaussianWeightBits + kGaussianLevelBits;
void gaussian_tile(const GaussianTile<std::uint8_t>& tile, int channels, const std::int16_t* weights, int radius,
                   Scratch& scratch);
/// The same into levels with kGaussianLevelBits more, to both passes' end: tile.result is not used.
void gaussian_levels(const GaussianTile<std::uint8_t>& tile, std::int16_t* result, std::ptrdiff_t result_stride,
                     int channels, const std::int16_t* weights, int radius, Scratch& scratch);

}  // namespace azulejo::kernels
