#include <cmath>
#include <limits>

#include "azulejo/modelling/decimate_parts.h"

namespace azulejo::decimation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of an edge's squared length: where nothing else tells edges apart, short ones go first.
constexpr double kLengthShare = 1e-7;
/// An end is taken where it is clearly better than the best place, which is held back a little.
constexpr double kClearly = 0.9;

}  // namespace

bool wedge_pairs(const Surface& surface, std::uint32_t gone, std::uint32_t kept, WedgePairs& pairs) {
  if (surface.wedges.empty()) return pairs.add({gone, kept});
  bool are_pairs = true;
  surface.each_corner(gone, [&](std::uint32_t corner) {
    for (const std::uint32_t other : {next_of(corner), previous_of(corner)}) {
      if (surface.corners[other] == kept) {
        are_pairs = are_pairs && pairs.add({surface.wedges[corner], surface.wedges[other]});
      }
    }
  });
  return are_pairs;
}

Planner::Planner(const Surface& surface, const DecimateOptions& options)
    : surface_(surface),
      largest_error_(options.error ? static_cast<double>(*options.error) * static_cast<double>(*options.error)
                                   : kInfinite) {}

Plan Planner::plan(std::uint32_t edge) const {
  Plan plan;
  plan.cost = kInfinite;
  auto [a, b] = surface_.ends[edge];
  if (a == kNone) return plan;
  Freedom of_a = surface_.freedom[a];
  Freedom of_b = surface_.freedom[b];
  if (of_a != Freedom::Surface && of_b != Freedom::Surface && (surface_.flags[edge] & kLine) == 0) return plan;
  if (of_a == Freedom::None && of_b == Freedom::None) return plan;
  if (surface_.star_size[a] > kLargestStar || surface_.star_size[b] > kLargestStar) return plan;
  if (of_b > of_a) std::swap(a, b);
  plan.kept = a;
  plan.gone = b;
  plan.fixed = of_a != of_b;

  Quadric sum = surface_.quadrics[a];
  sum += surface_.quadrics[b];
  plan.weight = sum.weight;
  WedgePairs pairs;
  if (surface_.values.in_metric()) {
    if (!wedge_pairs(surface_, b, a, pairs)) return plan;
    for (const WedgePair& pair : pairs) sum += value_quadric(surface_.values, pair);
  }
  const glm::dvec3 at_a = surface_.place(a);
  const glm::dvec3 at_b = surface_.place(b);
  const glm::dvec3 middle = 0.5 * (at_a + at_b);
  const glm::dvec3 half = 0.5 * (at_b - at_a);
  const LocalQuadric local(sum, middle);
  plan.place = surface_.positions[a];
  plan.cost = local.at(-half);
  if (plan.fixed) {
    for (const WedgePair& pair : pairs) plan.cost += value_cost(surface_.values, pair, at_a);
    return plan;
  }
  glm::dvec3 step = local.least();
  if (!(glm::dot(step, step) <= 4 * glm::dot(half, half))) step = glm::dvec3(0);
  const double least = local.at(step);
  const double other = local.at(half);
  if (other < plan.cost) {
    plan.cost = other;
    plan.place = surface_.positions[b];
  }
  if (!(plan.cost < kClearly * least)) {
    plan.cost = least;
    plan.place = glm::vec3((middle + step) / surface_.scale + surface_.center);
  }
  return plan;
}

float Planner::cost(std::uint32_t edge) const {
  const Plan made = plan(edge);
  if (!(made.cost < kInfinite) || made.cost > largest_error_ * made.weight)
    return std::numeric_limits<float>::infinity();
  const glm::dvec3 along = surface_.place(made.kept) - surface_.place(made.gone);
  return static_cast<float>(std::max(made.cost, 0.0) + kLengthShare * glm::dot(along, along) * made.weight);
}

}  // namespace azulejo::decimation
