#include "azulejo/modelling/subdivision_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/subdivision_values.h"

namespace azulejo::subdivision {
namespace {

/// Steps around a dart until nothing moves: the slowest ones shrink to less than 2 ÷ 3 each time.
constexpr int kDartSteps = 100;

/// Weight of each neighbor in Loop's rule, of a vertex with so many.
double loop_weight(std::size_t neighbors) {
  const auto n = static_cast<double>(neighbors);
  const double root = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / n);
  return (0.625 - root * root) / n;
}

/// The weights of small vertices, worked out once.
class LoopWeights {
 public:
  LoopWeights() {
    for (std::size_t n = 1; n < kKnown; ++n) known_[n] = loop_weight(n);
  }
  double operator()(std::size_t neighbors) const {
    return neighbors < kKnown ? known_[neighbors] : loop_weight(neighbors);
  }

 private:
  static constexpr std::size_t kKnown = 32;
  double known_[kKnown] = {};
};

template <std::size_t kCount>
void set_middle(const Level& level, std::size_t edge, const float* in, float* out) {
  WeightedSum<kCount> sum;
  for (const std::uint32_t end : level.edges[edge]) sum.add(in + kCount * end, 0.5);
  sum.store(out);
}

/// Means of the corners of faces.
template <std::size_t kCount>
void set_centers(const Level& level, const float* in, float* out, const Run& run) {
  with_faces(level, [&](auto faces) {
    for_each(level.face_count(), run, [&](std::size_t face) {
      WeightedSum<kCount> sum;
      for (std::size_t c = faces.begin(face); c < faces.end(face); ++c) sum.add(in + kCount * level.corners[c]);
      sum.scale(1.0 / static_cast<double>(faces.end(face) - faces.begin(face)));
      sum.store(out + kCount * face);
    });
  });
}

template <std::size_t kCount>
void loop(const Level& level, const float* in, float* out, const Run& run) {
  const Faces<3> faces(level);
  const LoopWeights weights;
  float* const of_edges = out + kCount * level.vertex_count;
  for_each(level.edges.size(), run, [&](std::size_t edge) {
    float* const to = of_edges + kCount * edge;
    if (level.sharp[edge] != 0) return set_middle<kCount>(level, edge, in, to);
    WeightedSum<kCount> sum;
    for (const std::uint32_t end : level.edges[edge]) sum.add(in + kCount * end, 3);
    for (const std::uint32_t use : level.uses_of(edge)) sum.add(in + kCount * level.corners[faces.previous(use)]);
    sum.scale(0.125);
    sum.store(to);
  });
  for_each(level.vertex_count, run, [&](std::size_t vertex) {
    float* const to = out + kCount * vertex;
    if (!is_smooth(level.rules[vertex])) return move_sharp<kCount>(level, vertex, 0.75, in, to);
    const double weight = weights(level.corners_at(vertex).size());
    WeightedSum<kCount> sum;
    sum.add(sum_of_neighbors<kCount>(level, faces, vertex, in), weight);
    sum.add(in + kCount * vertex, 1 - weight * static_cast<double>(level.corners_at(vertex).size()));
    sum.store(to);
  });
}

template <std::size_t kCount>
void catmull_clark(const Level& level, const float* in, float* out, const Run& run) {
  float* const of_edges = out + kCount * level.vertex_count;
  float* const of_faces = of_edges + kCount * level.edges.size();
  set_centers<kCount>(level, in, of_faces, run);
  with_faces(level, [&](auto faces) {
    for_each(level.edges.size(), run, [&](std::size_t edge) {
      float* const to = of_edges + kCount * edge;
      if (level.sharp[edge] != 0) return set_middle<kCount>(level, edge, in, to);
      WeightedSum<kCount> sum;
      for (const std::uint32_t end : level.edges[edge]) sum.add(in + kCount * end);
      for (const std::uint32_t use : level.uses_of(edge)) sum.add(of_faces + kCount * faces.face_of(use));
      sum.scale(0.25);
      sum.store(to);
    });
    for_each(level.vertex_count, run, [&](std::size_t vertex) {
      float* const to = out + kCount * vertex;
      if (!is_smooth(level.rules[vertex])) return move_sharp<kCount>(level, vertex, 0.75, in, to);
      const auto corners = level.corners_at(vertex);
      const auto n = static_cast<double>(corners.size());
      WeightedSum<kCount> around = sum_of_neighbors<kCount>(level, faces, vertex, in);
      for (const std::uint32_t corner : corners) around.add(of_faces + kCount * faces.face_of(corner));
      WeightedSum<kCount> sum;
      sum.add(around, 1 / (n * n));
      sum.add(in + kCount * vertex, (n - 2) / n);
      sum.store(to);
    });
  });
}

template <std::size_t kCount>
void linear(const Level& level, bool with_centers, const float* in, float* out, const Run& run) {
  std::copy_n(in, kCount * level.vertex_count, out);
  float* const of_edges = out + kCount * level.vertex_count;
  for_each(level.edges.size(), run,
           [&](std::size_t edge) { set_middle<kCount>(level, edge, in, of_edges + kCount * edge); });
  if (with_centers) set_centers<kCount>(level, in, of_edges + kCount * level.edges.size(), run);
}

/// The surroundings of a dart, in double precision: spokes in turn, the first one sharp, and what is between them.
template <std::size_t kCount>
struct DartRing {
  WeightedSum<kCount> center;
  std::vector<WeightedSum<kCount>> spokes;
  std::vector<WeightedSum<kCount>> between;  ///< of quads: the corner beyond; between a spoke and the next

  DartRing(const Level& level, std::size_t vertex, const float* in) {
    center.add(in + kCount * vertex);
    const auto sharp_first = [&](std::uint32_t corner) {
      std::vector<Spoke> ring = ring_around(level, vertex, corner);
      const auto first =
          std::find_if(ring.begin(), ring.end(), [&](const Spoke& spoke) { return level.sharp[spoke.edge_in] != 0; });
      std::rotate(ring.begin(), first, ring.end());
      return ring;
    };
    for (const Spoke& spoke : sharp_first(level.corners_at(vertex)[0])) {
      const auto& ends = level.edges[spoke.edge_in];
      spokes.emplace_back().add(in + kCount * (ends[0] == vertex ? ends[1] : ends[0]));
      if (level.sides != 4) continue;
      const std::uint32_t beyond = spoke.corner / 4 * 4 + (spoke.corner + 2) % 4;
      between.emplace_back().add(in + kCount * level.corners[beyond]);
    }
  }

  void step_loop() {
    const std::size_t n = spokes.size();
    const double weight = loop_weight(n);
    DartRing next = *this;
    next.center.scale(1 - weight * static_cast<double>(n));
    for (std::size_t i = 0; i < n; ++i) {
      next.center.add(spokes[i], weight);
      next.spokes[i] = {};
      next.spokes[i].add(center, i == 0 ? 0.5 : 0.375);
      next.spokes[i].add(spokes[i], i == 0 ? 0.5 : 0.375);
      if (i == 0) continue;
      next.spokes[i].add(spokes[i - 1], 0.125);
      next.spokes[i].add(spokes[i + 1 == n ? 0 : i + 1], 0.125);
    }
    *this = std::move(next);
  }

  void step_catmull_clark() {
    const std::size_t n = spokes.size();
    const double valence = static_cast<double>(n);
    DartRing next = *this;
    for (std::size_t i = 0; i < n; ++i) {
      next.between[i].add(center, 1);
      next.between[i].add(spokes[i], 1);
      next.between[i].add(spokes[i + 1 == n ? 0 : i + 1], 1);
      next.between[i].scale(0.25);
    }
    next.center.scale((valence - 2) / valence);
    for (std::size_t i = 0; i < n; ++i) {
      next.center.add(spokes[i], 1 / (valence * valence));
      next.center.add(next.between[i], 1 / (valence * valence));
      next.spokes[i].add(center, 1);
      if (i == 0) {
        next.spokes[i].scale(0.5);
        continue;
      }
      next.spokes[i].add(next.between[i - 1], 1);
      next.spokes[i].add(next.between[i], 1);
      next.spokes[i].scale(0.25);
    }
    *this = std::move(next);
  }
};

template <std::size_t kCount>
void limit_of_loop(const Level& level, const float* in, float* out, const Run& run) {
  const Faces<3> faces(level);
  const LoopWeights weights;
  for_each(level.vertex_count, run, [&](std::size_t vertex) {
    float* const to = out + kCount * vertex;
    if (level.rules[vertex] == Rule::Dart) {
      DartRing<kCount> ring(level, vertex, in);
      for (int i = 0; i < kDartSteps; ++i) ring.step_loop();
      return ring.center.store(to);
    }
    if (level.rules[vertex] != Rule::Smooth) return move_sharp<kCount>(level, vertex, 2.0 / 3, in, to);
    const auto n = static_cast<double>(level.corners_at(vertex).size());
    const double own = 0.375 / weights(level.corners_at(vertex).size());
    WeightedSum<kCount> sum = sum_of_neighbors<kCount>(level, faces, vertex, in);
    sum.add(in + kCount * vertex, own);
    sum.scale(1 / (own + n));
    sum.store(to);
  });
}

template <std::size_t kCount>
void limit_of_catmull_clark(const Level& level, const float* in, float* out, const Run& run) {
  const Faces<4> faces(level);
  for_each(level.vertex_count, run, [&](std::size_t vertex) {
    float* const to = out + kCount * vertex;
    if (level.rules[vertex] == Rule::Dart) {
      DartRing<kCount> ring(level, vertex, in);
      for (int i = 0; i < kDartSteps; ++i) ring.step_catmull_clark();
      return ring.center.store(to);
    }
    if (level.rules[vertex] != Rule::Smooth) return move_sharp<kCount>(level, vertex, 2.0 / 3, in, to);
    const auto corners = level.corners_at(vertex);
    const auto n = static_cast<double>(corners.size());
    WeightedSum<kCount> sum;
    sum.add(sum_of_neighbors<kCount>(level, faces, vertex, in), 4);
    for (const std::uint32_t corner : corners) {
      sum.add(in + kCount * level.corners[faces.next(faces.next(corner))]);
    }
    sum.add(in + kCount * vertex, n * n);
    sum.scale(1 / (n * (n + 5)));
    sum.store(to);
  });
}

}  // namespace

void refine_loop(const Level& level, int components, const float* in, float* out, const Run& run) {
  with_count(components, [&](auto count) { loop<count()>(level, in, out, run); });
}

void refine_catmull_clark(const Level& level, int components, const float* in, float* out, const Run& run) {
  with_count(components, [&](auto count) { catmull_clark<count()>(level, in, out, run); });
}

void refine_linear(const Level& level, bool with_centers, int components, const float* in, float* out, const Run& run) {
  with_count(components, [&](auto count) { linear<count()>(level, with_centers, in, out, run); });
}

void loop_limit(const Level& level, int components, const float* in, float* out, const Run& run) {
  with_count(components, [&](auto count) { limit_of_loop<count()>(level, in, out, run); });
}

void catmull_clark_limit(const Level& level, int components, const float* in, float* out, const Run& run) {
  with_count(components, [&](auto count) { limit_of_catmull_clark<count()>(level, in, out, run); });
}

}  // namespace azulejo::subdivision
