#include "azulejo/rendering/spread_directions.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

/// A number in [0, 1) of a counter and a key.
/// Source  Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014 (the finalizer of SplitMix64)
double uniform(std::uint64_t key, std::uint64_t counter) {
  std::uint64_t z = key * 0xD1342543DE82EF95U + (counter + 1) * 0x9E3779B97F4A7C15U;
  for (int round = 0; round < 2; ++round) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    z ^= z >> 31U;
  }
  return static_cast<double>(z >> 11U) * 0x1p-53;
}

}  // namespace

std::vector<Direction> spread_directions(int count, std::uint64_t seed) {
  if (count < 1) throw Error(Error::Argument, fmt::format("views: {}, expected at least 1", count));
  constexpr double kPi = 3.14159265358979323846;
  constexpr double kGoldenTurn = 0.38196601125010515;  // 2 − φ
  // Shaking by half the distance of neighbours keeps them apart.
  const double shake_deg = 0.25 * std::sqrt(4 * kPi / count) * 180 / kPi;
  std::vector<Direction> directions;
  directions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const auto counter = static_cast<std::uint64_t>(i) * 2 + 1;
    const double height = 1 - 2 * (i + uniform(seed, counter)) / count;
    const double elevation = std::asin(std::clamp(height, -1.0, 1.0)) * 180 / kPi;
    const double level = std::max(0.05, std::sqrt(std::max(0.0, 1 - height * height)));
    const double around = 360 * (uniform(seed, 0) + i * kGoldenTurn);
    const double azimuth = around + shake_deg / level * (2 * uniform(seed, counter + 1) - 1);
    directions.push_back({static_cast<float>(std::fmod(azimuth + 720, 360.0)), static_cast<float>(elevation)});
  }
  return directions;
}

}  // namespace azulejo
