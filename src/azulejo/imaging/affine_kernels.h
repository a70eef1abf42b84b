#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// Positions are worked out afresh after so many columns.
inline constexpr int kAffineBlock = 64;
/// Taps of the widest window, lanczos at a hundredth: 2 · 300, and up to 3 that fill it up to a multiple of 4.
inline constexpr int kAffineMostTaps = 608;

/// Pixels of a result row, within a block of columns, and where they lie in a patch of the source.
struct AffineSpan {
  int begin = 0;  ///< in the block
  int count = 0;
  float x = 0;  ///< of the block's first pixel, beyond `column`
  float y = 0;
  float step_x = 0;  ///< to the next pixel
  float step_y = 0;
  int column = 0;
  int row = 0;
};

/// Whole parts and rests (0–1) of the positions of a span's pixels.
struct AffinePlaces {
  alignas(64) std::int32_t column[kAffineBlock];
  alignas(64) std::int32_t row[kAffineBlock];
  alignas(64) float x[kAffineBlock];
  alignas(64) float y[kAffineBlock];
};

/// Weights of a window for `phases` + 1 rests from 0 to 1, between which they are interpolated.
struct AffineWeights {
  const float* values = nullptr;
  int taps = 0;  ///< a multiple of 4
  int phases = 0;
};

/// Rows of f32, channels interleaved. Windows begin at the places' columns and rows.
struct AffinePatch {
  const float* values = nullptr;
  std::ptrdiff_t stride = 0;  ///< values
  int channels = 0;

  const float* at(const AffinePlaces& places, int i) const {
    return values + places.row[i] * stride + std::ptrdiff_t{places.column[i]} * channels;
  }
};

void affine_places(const AffineSpan& span, AffinePlaces& places);
/// `result` has 4 values behind its end that lose what is there, in all of these.
void affine_bilinear(const AffinePatch& patch, const AffinePlaces& places, int count, float* result);
void affine_weighted(const AffinePatch& patch, const AffinePlaces& places, const AffineWeights& across,
                     const AffineWeights& down, int count, float* result);

/// Bytes as they are stored; windows of 2 × 2 are at the places' columns and rows. Of 1, 3 or 4 channels.
struct AffineBytes {
  const std::uint8_t* values = nullptr;  ///< up to 3 bytes behind each window may be read
  std::ptrdiff_t stride = 0;
  int channels = 0;
};
/// affine_bilinear of bytes, rounded half up.
void affine_bilinear_bytes(const AffineBytes& source, const AffinePlaces& places, int count, std::uint8_t* result);

// The definitions.

inline void affine_places_reference(const AffineSpan& span, AffinePlaces& places) {
  for (int i = 0; i < span.count; ++i) {
    const auto n = static_cast<float>(span.begin + i);
    const float x = span.x + n * span.step_x;
    const float y = span.y + n * span.step_y;
    const float left = std::floor(x);
    const float upper = std::floor(y);
    places.column[i] = static_cast<std::int32_t>(left) + span.column;
    places.row[i] = static_cast<std::int32_t>(upper) + span.row;
    places.x[i] = x - left;
    places.y[i] = y - upper;
  }
}

/// One channel of one pixel, of the window that begins at `upper`.
inline float affine_mix(const float* upper, std::ptrdiff_t stride, int channels, float x, float y) {
  const float* const lower = upper + stride;
  const float left = upper[0] + (lower[0] - upper[0]) * y;
  const float right = upper[channels] + (lower[channels] - upper[channels]) * y;
  return left + (right - left) * x;
}

inline void affine_bilinear_reference(const AffinePatch& patch, const AffinePlaces& places, int count, float* result) {
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < patch.channels; ++c) {
      *result++ = affine_mix(patch.at(places, i) + c, patch.stride, patch.channels, places.x[i], places.y[i]);
    }
  }
}

/// Weight `tap` for a rest.
inline float affine_weight(const AffineWeights& weights, float rest, int tap) {
  const float place = rest * static_cast<float>(weights.phases);
  const int whole = static_cast<int>(place);
  const int phase = whole < weights.phases ? whole : weights.phases - 1;
  const float* const near = weights.values + static_cast<std::ptrdiff_t>(phase) * weights.taps + tap;
  return near[0] + (near[weights.taps] - near[0]) * (place - static_cast<float>(phase));
}

/// With one channel, every fourth tap of a row is summed by itself; with more, all in their order.
inline void affine_weighted_reference(const AffinePatch& patch, const AffinePlaces& places, const AffineWeights& across,
                                      const AffineWeights& down, int count, float* result) {
  const int groups = patch.channels == 1 ? 4 : 1;
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < patch.channels; ++c) {
      float sums[4] = {};
      for (int g = 0; g < groups; ++g) {
        for (int k = 0; k < down.taps; ++k) {
          const float* const row = patch.at(places, i) + k * patch.stride + c;
          float sum = affine_weight(across, places.x[i], g) * row[g * patch.channels];
          for (int j = g + groups; j < across.taps; j += groups)
            sum = sum + affine_weight(across, places.x[i], j) * row[j * patch.channels];
          const float weighted = affine_weight(down, places.y[i], k) * sum;
          sums[g] = k == 0 ? weighted : sums[g] + weighted;
        }
      }
      *result++ = groups == 1 ? sums[0] : (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }
  }
}

}  // namespace azulejo::kernels
