#include <algorithm>
#include <cmath>
#include <numbers>

#include "azulejo/modelling/subdivision_rules.h"
#include "azulejo/modelling/subdivision_values.h"

namespace azulejo::subdivision {
namespace {

/// What the mean of so many neighbors counts in Kobbelt's rule.
double sqrt3_weight(std::size_t neighbors) {
  return (4 - 2 * std::cos(2 * std::numbers::pi / static_cast<double>(neighbors))) / 9;
}

/// What stands for the center of a corner's face in the triangles beside the corner's edge, and whether that is the
/// point on a sharp edge of the face which is next to the beginning, or to the end, of the corner's edge.
struct Opposite {
  std::uint32_t vertex;
  bool near_begin = false;
  bool near_end = false;
};

class Sqrt3Splitter {
 public:
  Sqrt3Splitter(const Level& from, bool even) : from_(from), faces_(from) {
    number_vertices(even);
    step_.next.sides = 3;
    step_.next.oriented = from.oriented;
  }

  Sqrt3Step split(bool whole, const Run& run) {
    const std::size_t corners = from_.corner_count();
    step_.next.corners.resize(3 * corners);
    Array<std::uint8_t> sharp(3 * corners);
    for_each(corners, run, [&](std::size_t corner) {
      split_corner(corner, step_.next.corners.data() + 3 * corner, sharp.data() + 3 * corner);
    });
    if (!whole) return std::move(step_);
    connect(step_.next, sharp, run);
    step_.next.rules.assign(step_.next.vertex_count, Rule::Smooth);
    std::copy(from_.rules.begin(), from_.rules.end(), step_.next.rules.begin());
    for (const std::uint32_t first : step_.thirds) {
      if (first == kNone) continue;
      step_.next.rules[first] = Rule::Crease;
      step_.next.rules[first + 1] = Rule::Crease;
    }
    return std::move(step_);
  }

 private:
  bool is_sharp(std::size_t corner) const { return from_.sharp[from_.edge_of_corner[corner]] != 0; }

  /// The sharp corner of a face whose sharp edge is cut in three; kNone. After an odd level faces have no more than one.
  std::uint32_t cut_corner(std::size_t face) const {
    for (std::size_t c = 3 * face; c < 3 * face + 3; ++c) {
      if (is_sharp(c) && !step_.thirds.empty()) return static_cast<std::uint32_t>(c);
    }
    return kNone;
  }

  void number_vertices(bool even) {
    if (even) step_.thirds.assign(from_.edges.size(), kNone);
    auto next = static_cast<std::uint32_t>(from_.vertex_count);
    step_.centers.resize(from_.face_count());
    for (std::size_t f = 0; f < step_.centers.size(); ++f) step_.centers[f] = cut_corner(f) == kNone ? next++ : kNone;
    for (std::size_t e = 0; e < step_.thirds.size(); ++e) {
      if (from_.sharp[e] == 0) continue;
      step_.thirds[e] = next;
      next += 2;
    }
    step_.next.vertex_count = next;
  }

  /// The point on the sharp edge of a corner that is near a vertex of it.
  std::uint32_t third(std::size_t corner, std::uint32_t vertex) const {
    const std::uint32_t edge = from_.edge_of_corner[corner];
    return step_.thirds[edge] + (from_.edges[edge][0] == vertex ? 0 : 1);
  }

  Opposite opposite(std::size_t corner) const {
    const std::size_t face = corner / 3;
    const std::uint32_t cut = cut_corner(face);
    if (cut == kNone) return {step_.centers[face]};
    const bool behind = faces_.next(cut) == corner;
    return {third(cut, from_.corners[behind ? corner : cut]), behind, !behind};
  }

  void split_corner(std::size_t corner, std::uint32_t* corners, std::uint8_t* sharp) const {
    const std::uint32_t vertex = from_.corners[corner];
    const std::size_t next = faces_.next(corner);
    std::fill_n(sharp, 3, std::uint8_t{0});
    if (is_sharp(corner)) {
      sharp[0] = 1;
      if (step_.thirds.empty()) {
        const std::uint32_t triangle[] = {vertex, from_.corners[next], step_.centers[corner / 3]};
        std::copy_n(triangle, 3, corners);
        return;
      }
      const std::uint32_t triangle[] = {third(corner, vertex), third(corner, from_.corners[next]),
                                        from_.corners[faces_.previous(corner)]};
      std::copy_n(triangle, 3, corners);
      return;
    }
    const auto uses = from_.uses_of(from_.edge_of_corner[corner]);
    const Opposite own = opposite(corner);
    const Opposite other = opposite(uses[0] == corner ? uses[1] : uses[0]);
    corners[0] = vertex;
    corners[1] = other.vertex;
    corners[2] = own.vertex;
    sharp[0] = other.near_end ? 1 : 0;  // it runs the other way
    sharp[2] = own.near_begin ? 1 : 0;
  }

  const Level& from_;
  Faces<3> faces_;
  Sqrt3Step step_;
};

/// The vertex on a sharp edge from a to b that is near a.
template <std::size_t kCount>
void set_third(const Level& level, std::uint32_t a, std::uint32_t b, const float* in, float* out) {
  WeightedSum<kCount> sum;
  if (level.rules[a] == Rule::Crease) {
    const auto neighbors = crease_neighbors(level, a);
    sum.add(in + kCount * (neighbors[0] == b ? neighbors[1] : neighbors[0]));
    sum.add(in + kCount * a, 16);
    sum.add(in + kCount * b, 10);
    sum.scale(1.0 / 27);
  } else {
    sum.add(in + kCount * a, 2);
    sum.add(in + kCount * b);
    sum.scale(1.0 / 3);
  }
  sum.store(out);
}

template <std::size_t kCount>
void move_smooth(const Level& level, std::size_t vertex, bool limit, const float* in, float* out) {
  const std::size_t n = level.corners_at(vertex).size();
  const double once = sqrt3_weight(n);
  const double weight = limit ? 3 * once / (1 + 3 * once) : once;
  WeightedSum<kCount> sum;
  sum.add(sum_of_neighbors<kCount>(level, Faces<3>(level), vertex, in), weight / static_cast<double>(n));
  sum.add(in + kCount * vertex, 1 - weight);
  sum.store(out);
}

template <std::size_t kCount>
void refine(const Level& level, const Sqrt3Step& step, const float* in, float* out, const Run& run) {
  const bool even = !step.thirds.empty();
  for_each(level.vertex_count, run, [&](std::size_t vertex) {
    float* const to = out + kCount * vertex;
    if (is_smooth(level.rules[vertex])) return move_smooth<kCount>(level, vertex, false, in, to);
    move_sharp<kCount>(level, vertex, even ? 19.0 / 27 : 1, in, to);
  });
  for_each(level.face_count(), run, [&](std::size_t face) {
    if (step.centers[face] == kNone) return;
    WeightedSum<kCount> sum;
    for (std::size_t c = 3 * face; c < 3 * face + 3; ++c) sum.add(in + kCount * level.corners[c]);
    sum.scale(1.0 / 3);
    sum.store(out + kCount * step.centers[face]);
  });
  for_each(step.thirds.size(), run, [&](std::size_t edge) {
    if (step.thirds[edge] == kNone) return;
    const auto [a, b] = level.edges[edge];
    set_third<kCount>(level, a, b, in, out + kCount * step.thirds[edge]);
    set_third<kCount>(level, b, a, in, out + kCount * (step.thirds[edge] + 1));
  });
}

}  // namespace

Sqrt3Step split_sqrt3(const Level& level, bool even, bool whole, const Run& run) {
  return Sqrt3Splitter(level, even).split(whole, run);
}

void refine_sqrt3(const Level& level, const Sqrt3Step& step, int components, const float* in, float* out,
                  const Run& run) {
  with_count(components, [&](auto count) { refine<count()>(level, step, in, out, run); });
}

void sqrt3_limit(const Level& level, int components, const float* in, float* out, const Run& run) {
  with_count(components, [&](auto count) {
    for_each(level.vertex_count, run, [&](std::size_t vertex) {
      float* const to = out + count() * vertex;
      if (is_smooth(level.rules[vertex])) return move_smooth<count()>(level, vertex, true, in, to);
      move_sharp<count()>(level, vertex, 2.0 / 3, in, to);
    });
  });
}

}  // namespace azulejo::subdivision
