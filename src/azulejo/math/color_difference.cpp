#include "azulejo/math/color_difference.h"

#include <cmath>
#include <numbers>

#include "azulejo/math/arctangent.h"
#include "azulejo/math/exponential.h"

namespace azulejo {
namespace {

double square(double x) { return x * x; }

/// C⁷ / (C⁷ + 25⁷), under the root.
double chroma_share(double chroma) {
  const double cube = chroma * chroma * chroma;
  const double seventh = cube * cube * chroma;
  return std::sqrt(seventh / (seventh + 6103515625.0));
}

/// A direction in the plane of a' and b'.
struct Direction {
  double cosine;
  double sine;
};

Direction turned(const Direction& a, const Direction& b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

/// Halfway between two hues, on the shorter side.
Direction mean(const Direction& first, const Direction& second) {
  const double cosine = first.cosine + second.cosine;
  const double sine = first.sine + second.sine;
  const double length = std::sqrt(square(cosine) + square(sine));
  if (length > 0) return {cosine / length, sine / length};
  // Opposite: a quarter turn ahead of the smaller of both angles in [0, 2π).
  const bool first_is_smaller = first.sine > 0 || (first.sine == 0 && first.cosine > 0);
  const Direction& smaller = first_is_smaller ? first : second;
  return {-smaller.sine, smaller.cosine};
}

/// sin x for 0 ≤ x ≤ π/3 to the thirteenth power: within 2·10⁻¹².
double small_sine(double x) {
  double sum = 1;
  for (int k = 12; k >= 2; k -= 2) sum = 1 - sum * (x * x) / (k * (k + 1));
  return x * sum;
}

/// T of equation (15).
double hue_weight(const Direction& hue) {
  const Direction twice = turned(hue, hue);
  const Direction thrice = turned(twice, hue);
  const Direction four_times = turned(twice, twice);
  // cos(angle − offset) with the offsets' cosines and sines: 30°, −6°, 63°.
  const auto shifted = [](const Direction& of, double cosine, double sine) {
    return of.cosine * cosine + of.sine * sine;
  };
  return 1 - 0.17 * shifted(hue, 0.86602540378443865, 0.5) + 0.24 * twice.cosine +
         0.32 * shifted(thrice, 0.99452189536827333, -0.10452846326765347) -
         0.20 * shifted(four_times, 0.45399049973954675, 0.89100652418836786);
}

/// The angle Δθ of equation (16), in radians.
double rotation_angle(const Direction& hue) {
  const double angle =
      static_cast<double>(atan2_deterministic(static_cast<float>(hue.sine), static_cast<float>(hue.cosine)));
  const double degrees = angle * (180 / std::numbers::pi);
  const double from_blue = (degrees < 0 ? degrees + 360 : degrees) - 275;
  return std::numbers::pi / 6 * exp_deterministic(-square(from_blue / 25));
}

}  // namespace

double color_difference_1976(const Lab& first, const Lab& second) {
  return std::sqrt(square(first.l - second.l) + square(first.a - second.a) + square(first.b - second.b));
}

double ciede2000(const Lab& first, const Lab& second) {
  const auto chroma_of = [](double a, double b) { return std::sqrt(square(a) + square(b)); };
  const double mean_ab = (chroma_of(first.a, first.b) + chroma_of(second.a, second.b)) / 2;
  const double stretch = 1 + 0.5 * (1 - chroma_share(mean_ab));
  const double a1 = stretch * first.a;
  const double a2 = stretch * second.a;
  const double c1 = chroma_of(a1, first.b);
  const double c2 = chroma_of(a2, second.b);
  const bool gray = c1 == 0 || c2 == 0;  // one has no hue: the mean is the other's, the difference 0

  const auto direction = [](double a, double b, double c) {
    return c == 0 ? Direction{0, 0} : Direction{a / c, b / c};
  };
  const Direction h1 = direction(a1, first.b, c1);
  const Direction h2 = direction(a2, second.b, c2);
  const Direction hue = c1 == 0 && c2 == 0 ? Direction{1, 0} : mean(h1, h2);
  // ΔH' = 2 √(C1' C2') sin(Δh'/2); of the angle between, half the distance of the directions is that sine.
  const double apart = std::sqrt(square(h1.cosine - h2.cosine) + square(h1.sine - h2.sine));
  const bool backwards = h1.cosine * h2.sine - h1.sine * h2.cosine < 0;
  const double hue_difference = gray ? 0 : (backwards ? -apart : apart) * std::sqrt(c1 * c2);

  const double mean_l = (first.l + second.l) / 2;
  const double mean_c = (c1 + c2) / 2;
  const double lightness =
      (second.l - first.l) / (1 + 0.015 * square(mean_l - 50) / std::sqrt(20 + square(mean_l - 50)));
  const double chroma = (c2 - c1) / (1 + 0.045 * mean_c);
  const double turn = hue_difference / (1 + 0.015 * mean_c * hue_weight(hue));
  const double rotation = -2 * chroma_share(mean_c) * small_sine(2 * rotation_angle(hue));
  return std::sqrt(square(lightness) + square(chroma) + square(turn) + rotation * chroma * turn);
}

}  // namespace azulejo
