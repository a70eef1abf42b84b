#include "azulejo/imaging/affine_weights.h"

#include <algorithm>
#include <cmath>

#include "azulejo/imaging/resampling_kernels.h"

namespace azulejo {
namespace {

/// Half the width of a filter, in pixels of the coarser of both grids.
int support(AffineFilter filter) {
  return filter == AffineFilter::Bilinear ? 1 : filter == AffineFilter::Bicubic ? 2 : 3;
}

/// The filter's value at a distance.
double kernel(AffineFilter filter, double x) {
  if (x >= support(filter)) return 0;
  if (filter == AffineFilter::Bilinear) return 1 - x;
  if (filter == AffineFilter::Bicubic) return catmull_rom(x);
  if (x == 0) return 1;
  return x == std::floor(x) ? 0 : lanczos3(x);
}

}  // namespace

AffineWindow::AffineWindow(AffineFilter filter, double widening) {
  if (filter == AffineFilter::Nearest) return;
  const int half = static_cast<int>(std::ceil(support(filter) * widening - 1e-6));
  before = half - 1;
  taps = 2 * half;
  if (filter == AffineFilter::Bilinear && widening == 1) return;
  taps = (taps + 3) / 4 * 4;
  // Wide windows change slowly with the rest: tables stay small.
  phases = std::max(16, static_cast<int>(1024 / widening));
  std::vector<double> exact(static_cast<std::size_t>(taps));
  for (int phase = 0; phase <= phases; ++phase) {
    const double rest = static_cast<double>(phase) / phases;
    double sum = 0;
    for (int tap = 0; tap < taps; ++tap) {
      const double distance = std::fabs(tap - before - rest) / widening;
      sum += exact[static_cast<std::size_t>(tap)] = tap < 2 * half ? kernel(filter, distance) : 0;
    }
    for (const double weight : exact) values.push_back(static_cast<float>(weight / sum));
  }
}

}  // namespace azulejo
