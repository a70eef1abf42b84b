#include "azulejo/math/bspline.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {

void check_knots(std::span<const double> knots, int degree, std::size_t controls, const char* what) {
  const auto refuse = [&](const std::string& problem) {
    throw Error(Error::Argument, fmt::format("{}: {}", what, problem));
  };
  const auto p = static_cast<std::size_t>(degree);
  if (degree < 0 || controls <= p) {
    refuse(fmt::format("{} control points, expected {} or more for degree {}", controls, degree + 1, degree));
  }
  if (knots.size() != controls + p + 1) {
    refuse(fmt::format("{} knots, expected {}: as many as control points, {}, and degree + 1", knots.size(),
                       controls + p + 1, controls));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) refuse(fmt::format("knot {} is {}, expected a finite number", i + 1, knots[i]));
    if (i > 0 && knots[i] < knots[i - 1]) {
      refuse(fmt::format("knot {} is {}, less than {} before it, expected knots that never fall", i + 1, knots[i],
                         knots[i - 1]));
    }
    if (i > p && knots[i] == knots[i - p - 1]) {
      refuse(fmt::format("knot {} stands there more than {} times, expected degree + 1 at most", knots[i], p + 1));
    }
  }
  if (!(knots[p] < knots[controls])) {
    refuse(fmt::format("knots {} and {} are both {}, expected a domain between them", p + 1, controls + 1, knots[p]));
  }
}

std::vector<double> clamped_knots(std::size_t controls, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> knots(controls + p + 1, 0.0);
  const std::size_t spans = controls - p;
  for (std::size_t i = 1; i < spans; ++i) knots[p + i] = static_cast<double>(i) / static_cast<double>(spans);
  std::fill(knots.begin() + static_cast<std::ptrdiff_t>(controls), knots.end(), 1.0);
  return knots;
}

std::vector<double> even_knots(std::size_t controls, int degree) {
  const auto p = static_cast<double>(degree);
  std::vector<double> knots(controls + static_cast<std::size_t>(degree) + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    knots[i] = (static_cast<double>(i) - p) / (static_cast<double>(controls) - p);
  }
  return knots;
}

std::size_t knot_span(std::span<const double> knots, int degree, double u) {
  const auto first = knots.begin() + degree;
  const auto last = knots.end() - degree - 1;  // the domain's end
  const auto above = u < *last ? std::upper_bound(first, last, u) : std::lower_bound(first, last, *last);
  return static_cast<std::size_t>(std::max(above - knots.begin(), first - knots.begin() + 1)) - 1;
}

std::vector<double> bspline_basis(std::span<const double> knots, int degree, std::size_t span, double u) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> values(p + 1, 0.0);
  values[0] = 1;
  for (std::size_t n = 1; n <= p; ++n) {  // from degree n − 1 to n
    double saved = 0;
    for (std::size_t r = 0; r < n; ++r) {
      const double right = knots[span + r + 1];
      const double left = knots[span + 1 + r - n];
      const double share = values[r] / (right - left);
      values[r] = saved + (right - u) * share;
      saved = (u - left) * share;
    }
    values[n] = saved;
  }
  return values;
}

}  // namespace azulejo
