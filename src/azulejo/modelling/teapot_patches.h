#pragma once

#include <array>
#include <cstdint>

namespace azulejo {

/// Martin Newell's teapot of 1975, with the bottom that it got later: 32 bicubic Bézier patches, each four rows of
/// four control points; z points up, the spout along x. From the first column to the last, then from the first row to
/// the last, turns counter-clockwise as seen from outside.
extern const std::array<std::array<std::uint16_t, 16>, 32> kTeapotPatches;
extern const std::array<std::array<float, 3>, 306> kTeapotPoints;

}  // namespace azulejo
