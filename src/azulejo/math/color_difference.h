#pragma once

#include "azulejo/core/export.h"

namespace azulejo {

/// A color in CIELAB, in its natural units: L* 0–100.
struct Lab {
  double l = 0;
  double a = 0;
  double b = 0;
};

/// ΔE*ab of 1976: the distance in CIELAB.
/// Source  CIE 15:2004, 8.2.1.3
AZULEJO_EXPORT double color_difference_1976(const Lab& first, const Lab& second);

/// ΔE00 of 2000, with all weights 1: about 1 is just noticeable. Symmetric; meant for differences up to 5.
///
/// Same bytes everywhere: its hue is within 4·10⁻⁷ of a radian, which changes results by less than 10⁻⁶ of themselves.
/// Opposite hues, whose mean has two values, take the one of (h1 + h2) / 2, as the source's note does.
/// NaN     in any value makes the result NaN
/// Source  G. Sharma, W. Wu, E. N. Dalal, The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary
///         Test Data, and Mathematical Observations, Color Research and Application 30(1), 2005; equations (2)–(22).
///         Mean hue and hue difference come from vectors instead of angles.
AZULEJO_EXPORT double ciede2000(const Lab& first, const Lab& second);

}  // namespace azulejo
