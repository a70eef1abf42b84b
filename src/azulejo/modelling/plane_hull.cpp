#include "azulejo/modelling/plane_hull.h"

#include <algorithm>
#include <numeric>

#include "azulejo/core/parallel.h"
#include "azulejo/math/predicates.h"

namespace azulejo {
namespace {

/// The points below or above: from the first to the last in order, turning left all the way.
template <class Iterator>
void append_chain(std::span<const glm::vec2> points, Iterator begin, Iterator end, std::vector<std::uint32_t>& chain) {
  const std::size_t first = chain.size();
  for (Iterator each = begin; each != end; ++each) {
    while (chain.size() >= first + 2 &&
           orient2d(points[chain[chain.size() - 2]], points[chain.back()], points[*each]) <= 0) {
      chain.pop_back();
    }
    chain.push_back(*each);
  }
  chain.pop_back();  // the other chain begins with it
}

}  // namespace

std::vector<std::uint32_t> plane_hull(std::span<const glm::vec2> points, const Run& run) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  parallel_sort(order.begin(), order.end(), run, [&](std::uint32_t a, std::uint32_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  const auto same = [&](std::uint32_t a, std::uint32_t b) { return points[a] == points[b]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 2) return order;
  std::vector<std::uint32_t> hull;
  append_chain(points, order.begin(), order.end(), hull);
  append_chain(points, order.rbegin(), order.rend(), hull);
  return hull;
}

}  // namespace azulejo
