#include "azulejo/modelling/nearest_triangle_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/modelling/nearest_triangle_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 4>;
using Floats = hn::Rebind<float, Doubles>;
using V = hn::Vec<Doubles>;

struct V3 {
  V x, y, z;
};
HWY_INLINE V3 operator-(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V dot(const V3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}
HWY_INLINE V load(const float* values) { return hn::PromoteTo(Doubles(), hn::Load(Floats(), values)); }

/// Squares of the distances of four boxes.
HWY_INLINE void box_distances(const BoxNode& node, const V3& p, double* result) {
  const Doubles d;
  const V zero = hn::Zero(d);
  for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
    const V x = hn::Max(hn::Max(hn::Sub(load(node.lower[0] + i), p.x), hn::Sub(p.x, load(node.upper[0] + i))), zero);
    const V y = hn::Max(hn::Max(hn::Sub(load(node.lower[1] + i), p.y), hn::Sub(p.y, load(node.upper[1] + i))), zero);
    const V z = hn::Max(hn::Max(hn::Sub(load(node.lower[2] + i), p.z), hn::Sub(p.z, load(node.upper[2] + i))), zero);
    hn::Store(dot({x, y, z}, {x, y, z}), d, result + i);
  }
}

/// Lowers `nearest` to the distance of an edge; whether the origin is on the inner side of it.
HWY_INLINE hn::Mask<Doubles> look_at_edge(const V3& from, const V3& to, const V3& normal, V& nearest) {
  const Doubles d;
  const V3 edge = to - from;
  const V length = hn::Max(dot(edge, edge), hn::Set(d, 1e-300));
  const V along = hn::Min(hn::Max(hn::Div(hn::Neg(dot(from, edge)), length), hn::Zero(d)), hn::Set(d, 1.0));
  const V3 place{hn::Add(from.x, hn::Mul(edge.x, along)), hn::Add(from.y, hn::Mul(edge.y, along)),
                 hn::Add(from.z, hn::Mul(edge.z, along))};
  nearest = hn::Min(nearest, dot(place, place));
  return hn::Lt(dot(cross(normal, edge), from), hn::Zero(d));
}

/// Squares of the distances of four triangles.
HWY_INLINE void triangle_distances(const TriangleLeaf& leaf, const V3& p, double* result) {
  const Doubles d;
  for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
    const auto corner = [&](std::size_t c) {
      return V3{load(leaf.corner[c][0] + i), load(leaf.corner[c][1] + i), load(leaf.corner[c][2] + i)} - p;
    };
    const V3 a = corner(0);
    const V3 b = corner(1);
    const V3 c = corner(2);
    const V3 normal = cross(b - a, c - a);
    V nearest = hn::Inf(d);
    auto inside = look_at_edge(a, b, normal, nearest);
    inside = hn::And(inside, look_at_edge(b, c, normal, nearest));
    inside = hn::And(inside, look_at_edge(c, a, normal, nearest));
    const V height = dot(normal, a);
    const V above = hn::Div(hn::Mul(height, height), dot(normal, normal));
    hn::Store(hn::IfThenElse(inside, above, nearest), d, result + i);
  }
}

void NearestTriangleOf(const TriangleSearch& tree, const double point[3], double* squared, std::uint32_t* slot) {
  struct Waiting {
    double distance;
    std::size_t node;
  };
  const Doubles d;
  const V3 p{hn::Set(d, point[0]), hn::Set(d, point[1]), hn::Set(d, point[2])};
  Waiting waiting[3 * 16 + 4];  // three more a level, of at most 16
  std::size_t count = 0;
  waiting[count++] = {0, 0};
  HWY_ALIGN double distances[4];
  double best = *squared;
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (!(next.distance < best)) continue;
    if (next.node >= tree.node_count) {
      const std::size_t leaf = next.node - tree.node_count;
      triangle_distances(tree.leaves[leaf], p, distances);
      for (std::size_t i = 0; i < 4; ++i) {
        if (!(distances[i] < best)) continue;
        best = distances[i];
        *slot = static_cast<std::uint32_t>(4 * leaf + i);
      }
      continue;
    }
    box_distances(tree.nodes[next.node], p, distances);
    const std::size_t first = count;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!(distances[i] < best)) continue;
      // The nearest comes last, to be looked at first.
      std::size_t at = count++;
      for (; at > first && waiting[at - 1].distance < distances[i]; --at) waiting[at] = waiting[at - 1];
      waiting[at] = {distances[i], 4 * next.node + 1 + i};
    }
  }
  *squared = best;
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(NearestTriangleOf);

void nearest_triangle(const TriangleSearch& tree, const double point[3], double* squared, std::uint32_t* slot) {
  HWY_DYNAMIC_DISPATCH(NearestTriangleOf)(tree, point, squared, slot);
}

}  // namespace azulejo::kernels
#endif
