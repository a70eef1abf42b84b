#pragma once

#include <algorithm>
#include <type_traits>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/subdivision_level.h"
#include "azulejo/modelling/weighted_sum.h"

namespace azulejo::subdivision {

/// Calls body with the number of values side by side, 1–4, as a constant.
template <class Body>
void with_count(int count, Body body) {
  switch (count) {
    case 1: return body(std::integral_constant<std::size_t, 1>());
    case 2: return body(std::integral_constant<std::size_t, 2>());
    case 3: return body(std::integral_constant<std::size_t, 3>());
    default: return body(std::integral_constant<std::size_t, 4>());
  }
}

template <class Body>
void for_each(std::size_t count, const Run& run, Body body) {
  parallel_for(count, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Of the vertices at the other ends of the edges at a vertex, all of which have two faces. There are as many as
/// corners.
template <std::size_t kCount, class FacesOf>
WeightedSum<kCount> sum_of_neighbors(const Level& level, const FacesOf& faces, std::size_t vertex, const float* in) {
  WeightedSum<kCount> sum;
  for (const std::uint32_t corner : level.corners_at(vertex)) sum.add(in + kCount * level.corners[faces.next(corner)]);
  if (level.oriented) return sum;
  // Each edge has two corners at the vertex, but not always one that begins it.
  for (const std::uint32_t corner : level.corners_at(vertex)) {
    sum.add(in + kCount * level.corners[faces.previous(corner)]);
  }
  sum.scale(0.5);
  return sum;
}

/// On a crease the vertex with the weight `own` and its neighbors there with the rest; on a corner itself.
template <std::size_t kCount>
void move_sharp(const Level& level, std::size_t vertex, double own, const float* in, float* out) {
  if (level.rules[vertex] == Rule::Corner) {
    std::copy_n(in + kCount * vertex, kCount, out);
    return;
  }
  WeightedSum<kCount> sum;
  sum.add(in + kCount * vertex, own);
  for (const std::uint32_t neighbor : crease_neighbors(level, vertex)) {
    sum.add(in + kCount * neighbor, 0.5 * (1 - own));
  }
  sum.store(out);
}

inline bool is_smooth(Rule rule) { return rule == Rule::Smooth || rule == Rule::Dart; }

}  // namespace azulejo::subdivision
