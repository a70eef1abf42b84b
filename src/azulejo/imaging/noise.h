#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

enum class NoiseKind : std::uint8_t {
  Gaussian,    ///< v + amount · z, z normally distributed: of electronics
  SaltPepper,  ///< a share `amount` of the values becomes black or white, half each: of transmission
  Poisson,     ///< counts of 1 / amount² events where v is 1, so that amount is the deviation there: of light
  Speckle,     ///< v · (1 + amount · z): of coherent waves
};

constexpr auto enum_names(NoiseKind) {
  return std::array<std::string_view, 4>{"gaussian", "salt_pepper", "poisson", "speckle"};
}

struct NoiseOptions {
  NoiseKind kind = NoiseKind::Gaussian;
  float amount = 0.05F;     ///< standard deviation, or share of values; intensities are 0–1
  int seed = 0;             ///< other noise for each
  bool monochrome = false;  ///< all channels of a pixel get the same noise
};

/// Adds noise. It depends on the seed, on the pixel's place and its channel: a crop of the image gets other noise, the
/// same image on any machine the same.
///
/// source   any size, 1–4 channels, any pixel type
/// result   same shape and type; may be the source itself. Rounded and saturated in integers; f32 may leave 0–1
/// Alpha    is copied; premultiplied color gets the noise of straight color, times alpha
/// Values   as they are stored. Poisson noise of real light is that of linear light: convert before and after
/// NaN      passes; so do, in Poisson noise, values that are not positive
/// Cost     O(pixels)
/// Source   random bits: math/random.h, normal deviates: math/normal.h. Counts below a mean of 32 by inversion of their
///          distribution, from there on by the expansion Q̃N3 of their quantiles, whose shares below a count are right
///          to 10⁻⁵: Giles, Algorithm 955: approximation of the inverse Poisson cumulative distribution function, ACM
///          TOMS 42(1), 2016
AZULEJO_EXPORT void noise(const ConstAnyView& source, const AnyView& result, const NoiseOptions& options = {},
                          const Run& run = {});
AZULEJO_EXPORT Image noise(const Image& source, const NoiseOptions& options = {}, const Run& run = {});

}  // namespace azulejo
