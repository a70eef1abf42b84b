#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

enum class Pattern : std::uint8_t {
  ZonePlate,    ///< rings around the middle, finer outwards: all frequencies in all directions
  Ramp,         ///< dark to light along the angle, over the whole image
  Checker,      ///< squares of half a period, the first one dark
  Stripes,      ///< a sine along the angle
  Edge,         ///< dark to light through the middle, along the angle
  SiemensStar,  ///< spokes, dark and light, finer inwards
};

constexpr auto enum_names(Pattern) {
  return std::array<std::string_view, 6>{"zone_plate", "ramp", "checker", "stripes", "edge", "siemens_star"};
}

struct TestPatternOptions {
  Pattern kind = Pattern::ZonePlate;
  int width = 512;
  int height = 512;
  PixelType type = PixelType::U8;
  int channels = 1;  ///< 1, or 3 of the same
  float low = 0;     ///< intensity of what is dark, 0–1
  float high = 1;    ///< of what is light
  float frequency =
      0.5F;             ///< of the zone plate where the shorter side ends, cycles a pixel; 0.5 is the finest there is
  float period = 32;    ///< of checker and stripes, pixels
  int spokes = 36;      ///< light ones of the star
  float angle_deg = 0;  ///< of ramp, stripes and edge: the direction in which they change, counter-clockwise
  float softness = 0;   ///< pixels in which the edge rises linearly; 0: an ideal one
};

/// Makes an image that tests others: how sampling, filters, edge detectors and displays treat what is known exactly.
///
/// Intensities are those at the centers of the pixels; nothing is filtered, so that patterns too fine for the pixels
/// have their aliases. They are stored as they are, and marked as sRGB. Noisy edges are edges with `noise` behind them.
///
/// zone_plate    ½ + ½ cos(2π · frequency · r² / (2 R)), r from the middle of the image, R half the shorter side: at r
///               the frequency is frequency · r / R
/// ramp          0 and 1 at the outermost pixels' centers; 0 of an image of one pixel in that direction
/// checker       ⌊2 x / period⌋ + ⌊2 y / period⌋ is odd
/// stripes       ½ + ½ cos(2π t / period), t from the middle along the angle
/// edge          ½ + t / softness, cut to 0–1; an ideal one is 1 for t > 0, ½ for t = 0
/// siemens_star  sin(spokes · angle) is above 0
/// Cost          O(pixels)
/// Throws        Error(Argument) for options out of range
AZULEJO_EXPORT void test_pattern(const AnyView& result, const TestPatternOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image test_pattern(const TestPatternOptions& options = {}, const Run& run = {});

}  // namespace azulejo
