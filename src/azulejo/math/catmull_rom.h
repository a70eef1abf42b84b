#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace azulejo {

/// How long a Catmull–Rom curve takes from a point to the next: (distance) to the power 0, ½, 1.
enum class SplineTiming : std::uint8_t {
  Uniform,      ///< loops and overshoots where distances differ
  Centripetal,  ///< no loops and cusps within a piece
  Chordal,
};
constexpr std::array<std::string_view, 3> enum_names(SplineTiming) { return {"uniform", "centripetal", "chordal"}; }

namespace catmull_rom_parts {

template <class P>
double step_between(const P& from, const P& to, SplineTiming timing) {
  double square = 0;
  for (int k = 0; k < P::length(); ++k) square += (to[k] - from[k]) * (to[k] - from[k]);
  const double distance = std::sqrt(square);
  return timing == SplineTiming::Uniform ? 1 : timing == SplineTiming::Chordal ? distance : std::sqrt(distance);
}

}  // namespace catmull_rom_parts

/// The smooth curve through all points, as cubic Bézier curves from each point to the next; closed: and back to the first.
///
/// ends      the point before the first is its mirror image of the second, so the curve begins in their direction
/// equal     points that equal the one before them are left out; fewer than two others give nothing
/// smooth    tangents are continuous; the derivative in the timing's own parameter is
/// Same      + − × ÷ √ only
/// Source    Catmull & Rom, A class of local interpolating splines, 1974; Barry & Goldman, 1988 (non-uniform);
///           Yuksel, Schaefer & Keyser, Parameterization and applications of Catmull–Rom curves, 2011
template <class P>
std::vector<std::array<P, 4>> catmull_rom(std::span<const P> points, bool closed, SplineTiming timing) {
  std::vector<P> p;
  for (const P& each : points) {
    if (p.empty() || each != p.back()) p.push_back(each);
  }
  if (closed && p.size() > 1 && p.front() == p.back()) p.pop_back();
  std::vector<std::array<P, 4>> pieces;
  if (p.size() < 2) return pieces;
  const std::size_t n = p.size();
  // Padded: before the first, behind the last.
  std::vector<P> q;
  q.push_back(closed ? p[n - 1] : 2.0 * p[0] - p[1]);
  q.insert(q.end(), p.begin(), p.end());
  q.push_back(closed ? p[0] : 2.0 * p[n - 1] - p[n - 2]);
  if (closed) q.push_back(p[1]);
  std::vector<double> step;
  for (std::size_t i = 0; i + 1 < q.size(); ++i)
    step.push_back(catmull_rom_parts::step_between(q[i], q[i + 1], timing));
  const auto tangent = [&](std::size_t i) {
    const P before = (q[i] - q[i - 1]) / step[i - 1];
    const P behind = (q[i + 1] - q[i]) / step[i];
    return (step[i] * before + step[i - 1] * behind) / (step[i - 1] + step[i]);
  };
  for (std::size_t i = 1; i + 2 < q.size(); ++i) {
    pieces.push_back({q[i], q[i] + (step[i] / 3) * tangent(i), q[i + 1] - (step[i] / 3) * tangent(i + 1), q[i + 1]});
  }
  return pieces;
}

}  // namespace azulejo
