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

/// A plan without what only those need that are carried out.
struct Planner::Best {
  enum class Where : std::uint8_t { Kept, Gone, Between };
  std::uint32_t kept = kNone;
  std::uint32_t gone = kNone;
  Where where = Where::Kept;
  bool fixed = false;
  double cost = kInfinite;
  double weight = 0;
  double squared_length = 0;
  glm::dvec3 step{0, 0, 0};  ///< scaled, from the middle; where it is between
};

Planner::Best Planner::best(std::uint32_t edge) const {
  Best best;
  auto [a, b] = surface_.ends[edge];
  if (a == kNone) return best;
  if (surface_.freedoms[b] > surface_.freedoms[a]) std::swap(a, b);
  const Vertex& kept = surface_.vertices[a];
  const Vertex& gone = surface_.vertices[b];
  const Freedom freedom = surface_.freedoms[b];
  if (freedom != Freedom::Surface && (freedom == Freedom::None || (surface_.flags[edge] & kLine) == 0)) return best;
  if (kept.star_size > kLargestStar || gone.star_size > kLargestStar) return best;
  best.kept = a;
  best.gone = b;
  best.fixed = surface_.freedoms[a] != freedom;

  const glm::dvec3 half = 0.5 * surface_.step(kept.position, gone.position);
  best.squared_length = 4 * glm::dot(half, half);
  LocalQuadric local(kept.quadric, gone.quadric, half);
  best.weight = local.weight();
  WedgePairs pairs;
  if (surface_.values.in_metric()) {
    if (!wedge_pairs(surface_, b, a, pairs)) return best;
    const glm::dvec3 middle = surface_.place(a) + half;
    for (const WedgePair& pair : pairs) local.add(value_quadric(surface_.values, pair), middle);
  }
  const auto [back, ahead] = local.at_ends(half);
  best.cost = back;
  if (best.fixed) {
    for (const WedgePair& pair : pairs) best.cost += value_cost(surface_.values, pair, surface_.place(a));
    return best;
  }
  LocalQuadric::Least least = local.least();
  if (!(glm::dot(least.step, least.step) <= best.squared_length)) least = {glm::dvec3(0), local.here()};
  if (ahead < best.cost) {
    best.cost = ahead;
    best.where = Best::Where::Gone;
  }
  if (!(best.cost < kClearly * least.value)) {
    best.cost = least.value;
    best.where = Best::Where::Between;
    best.step = least.step;
  }
  return best;
}

Plan Planner::plan(std::uint32_t edge) const {
  const Best found = best(edge);
  Plan plan;
  plan.kept = found.kept;
  plan.gone = found.gone;
  plan.cost = found.cost;
  plan.weight = found.weight;
  plan.fixed = found.fixed;
  if (found.kept == kNone) return plan;
  const glm::vec3& kept = surface_.vertices[found.kept].position;
  const glm::vec3& gone = surface_.vertices[found.gone].position;
  if (found.where == Best::Where::Between) {
    plan.place = glm::vec3(0.5 * (glm::dvec3(kept) + glm::dvec3(gone)) + found.step / surface_.scale);
  } else {
    plan.place = found.where == Best::Where::Kept ? kept : gone;
  }
  return plan;
}

float Planner::cost(std::uint32_t edge) const {
  const Best found = best(edge);
  if (!(found.cost < kInfinite) || found.cost > largest_error_ * found.weight) {
    return std::numeric_limits<float>::infinity();
  }
  return static_cast<float>(std::max(found.cost, 0.0) + kLengthShare * found.squared_length * found.weight);
}

}  // namespace azulejo::decimation
