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
  glm::dvec3 place{0, 0, 0};  ///< scaled; where it is between
};

Planner::Best Planner::best(std::uint32_t edge) const {
  Best best;
  auto [a, b] = surface_.ends[edge];
  if (a == kNone) return best;
  if (surface_.vertices[b].freedom > surface_.vertices[a].freedom) std::swap(a, b);
  const Vertex& kept = surface_.vertices[a];
  const Vertex& gone = surface_.vertices[b];
  if (gone.freedom != Freedom::Surface && (gone.freedom == Freedom::None || (surface_.flags[edge] & kLine) == 0)) {
    return best;
  }
  if (kept.star_size > kLargestStar || gone.star_size > kLargestStar) return best;
  best.kept = a;
  best.gone = b;
  best.fixed = kept.freedom != gone.freedom;

  Quadric sum = kept.quadric;
  sum += gone.quadric;
  best.weight = sum.weight;
  WedgePairs pairs;
  if (surface_.values.in_metric()) {
    if (!wedge_pairs(surface_, b, a, pairs)) return best;
    for (const WedgePair& pair : pairs) sum += value_quadric(surface_.values, pair);
  }
  const glm::dvec3 middle = 0.5 * (kept.place + gone.place);
  const glm::dvec3 half = 0.5 * (gone.place - kept.place);
  best.squared_length = 4 * glm::dot(half, half);
  const LocalQuadric local(sum, middle);
  best.cost = local.at(-half);
  if (best.fixed) {
    for (const WedgePair& pair : pairs) best.cost += value_cost(surface_.values, pair, kept.place);
    return best;
  }
  glm::dvec3 step = local.least();
  if (!(glm::dot(step, step) <= best.squared_length)) step = glm::dvec3(0);
  const double least = local.at(step);
  const double other = local.at(half);
  if (other < best.cost) {
    best.cost = other;
    best.where = Best::Where::Gone;
  }
  if (!(best.cost < kClearly * least)) {
    best.cost = least;
    best.where = Best::Where::Between;
    best.place = middle + step;
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
  plan.place = found.where == Best::Where::Kept   ? surface_.positions[found.kept]
               : found.where == Best::Where::Gone ? surface_.positions[found.gone]
                                                  : glm::vec3(found.place / surface_.scale + surface_.center);
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
