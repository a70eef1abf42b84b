#pragma once

#include <cstdint>
#include <span>

namespace azulejo {

/// Orders of the pixels of a square that is repeated over the plane: each number from 0 to size² − 1 once.
struct DitherMask {
  int size;                              ///< a power of two
  std::span<const std::uint16_t> ranks;  ///< of pixel (x, y) at y · size + x

  /// The threshold of a pixel, in (0, 1): the middle of its rank's share.
  float threshold(int x, int y) const {
    const auto at = static_cast<std::size_t>((y & (size - 1)) * size + (x & (size - 1)));
    return (static_cast<float>(ranks[at]) + 0.5F) / static_cast<float>(size * size);
  }
};

/// Bayer's matrix, 8×8.
DitherMask bayer_mask();

/// Blue noise, 64×64, made at the first call, in some 25 milliseconds. The first n pixels are spread evenly for every n:
/// each is put into the largest void that those before leave.
/// Source  Ulichney, The void-and-cluster method for dither array generation, SPIE 1913, 1993, σ = 1.5. His third phase
///         is the second one carried on: on a torus, the tightest cluster of zeros is the largest void of ones
DitherMask blue_noise_mask();

}  // namespace azulejo
