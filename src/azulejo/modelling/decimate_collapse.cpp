#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "azulejo/modelling/decimate_parts.h"

namespace azulejo::decimation {
namespace {

constexpr double kLeastCosine = 0.2;  ///< between a face before and after
constexpr double kThinnest = 0.001;   ///< a face's roundness, unless it was less before; an equilateral triangle's is 1

/// The vertices around a vertex, each once.
struct Ring {
  std::array<std::uint32_t, 2 * kLargestStar> vertices;
  std::size_t count = 0;

  void add(std::uint32_t vertex) { vertices[count++] = vertex; }
  const std::uint32_t* begin() const { return vertices.data(); }
  const std::uint32_t* end() const { return vertices.data() + count; }
};

void gather(const Surface& surface, std::uint32_t vertex, Ring& ring) {
  surface.each_corner(vertex, [&](std::uint32_t corner) {
    ring.add(surface.corners[next_of(corner)]);
    // Around an inner vertex each neighbor is the next one of a corner.
    const std::uint32_t previous = previous_of(corner);
    if ((surface.flags[surface.edge_of_corner[previous]] & (kBorder | kOdd)) != 0) ring.add(surface.corners[previous]);
  });
  constexpr std::size_t kFew = 24;
  if (ring.count > kFew)
    std::sort(ring.vertices.begin(), ring.vertices.begin() + static_cast<std::ptrdiff_t>(ring.count));
  const auto last = ring.vertices.begin() + static_cast<std::ptrdiff_t>(ring.count);
  if (ring.count > kFew) {
    ring.count = static_cast<std::size_t>(std::unique(ring.vertices.begin(), last) - ring.vertices.begin());
  }
}

bool contains(const Ring& ring, std::uint32_t vertex, bool sorted) {
  if (sorted) return std::binary_search(ring.begin(), ring.end(), vertex);
  return std::find(ring.begin(), ring.end(), vertex) != ring.end();
}

/// The faces that go with an edge: their third vertices, and how many lines they have beside it.
struct Wings {
  std::array<std::uint32_t, kMostWings> vertices;
  std::size_t count = 0;
  bool between_lines = false;  ///< one has lines on both other sides
  bool too_many = false;
};

Wings wings_of(const Surface& surface, std::uint32_t gone, std::uint32_t kept) {
  Wings wings;
  surface.each_corner(gone, [&](std::uint32_t corner) {
    const std::uint32_t next = next_of(corner);
    const std::uint32_t previous = previous_of(corner);
    const bool forward = surface.corners[next] == kept;
    if (!forward && surface.corners[previous] != kept) return;
    if (wings.count == wings.vertices.size()) {
      wings.too_many = true;
      return;
    }
    wings.vertices[wings.count++] = surface.corners[forward ? previous : next];
    // The two sides that are not the edge itself.
    const std::uint32_t edge_a = surface.edge_of_corner[forward ? next : corner];
    const std::uint32_t edge_b = surface.edge_of_corner[forward ? previous : next];
    wings.between_lines = wings.between_lines || (surface.flags[edge_a] & surface.flags[edge_b] & kLine) != 0;
  });
  return wings;
}

/// Whether the two vertices have no neighbors in common but the wings, and no face of one over both wings that the other
/// has, too: the link condition.
bool keeps_links(const Surface& surface, std::uint32_t gone, std::uint32_t kept, const Wings& wings) {
  Ring of_gone;
  Ring of_kept;
  gather(surface, gone, of_gone);
  gather(surface, kept, of_kept);
  const bool sorted = of_kept.count > 24;
  for (const std::uint32_t vertex : of_gone) {
    if (vertex == kept || !contains(of_kept, vertex, sorted)) continue;
    if (std::find(wings.vertices.begin(), wings.vertices.begin() + static_cast<std::ptrdiff_t>(wings.count), vertex) ==
        wings.vertices.begin() + static_cast<std::ptrdiff_t>(wings.count)) {
      return false;
    }
  }
  const auto over_wings = [&](std::uint32_t vertex) {
    bool found = false;
    surface.each_corner(vertex, [&](std::uint32_t corner) {
      const auto is_wing = [&](std::uint32_t at) {
        for (std::size_t w = 0; w < wings.count; ++w) {
          if (wings.vertices[w] == surface.corners[at]) return true;
        }
        return false;
      };
      found = found || (is_wing(next_of(corner)) && is_wing(previous_of(corner)));
    });
    return found;
  };
  return wings.count < 2 || !over_wings(gone) || !over_wings(kept);
}

/// A triangle's area and sides.
struct Shape {
  Shape(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 bc = c - b;
    normal = glm::cross(ab, ac);
    squared = glm::dot(normal, normal);
    sides = glm::dot(ab, ab) + glm::dot(ac, ac) + glm::dot(bc, bc);
  }
  /// Whether its roundness, 2 √3 |normal| ÷ sides, is less than kThinnest.
  bool thin() const { return 12 * squared < kThinnest * kThinnest * sides * sides; }

  glm::dvec3 normal;
  double squared;
  double sides;  ///< the sum of their squares
};

/// Whether the faces at `vertex`, but for those that have `but`, look the same way when it moves.
bool keeps_faces(const Surface& surface, std::uint32_t vertex, std::uint32_t but, const glm::vec3& place) {
  const glm::vec3& before = surface.vertices[vertex].position;
  const glm::dvec3 step = surface.step(before, place);
  for (const std::uint32_t corner : surface.star(vertex)) {
    if (surface.gone(corner)) continue;
    const std::uint32_t second = surface.corners[next_of(corner)];
    const std::uint32_t third = surface.corners[previous_of(corner)];
    if (second == but || third == but) continue;
    const glm::dvec3 b = surface.step(before, surface.vertices[second].position);
    const glm::dvec3 c = surface.step(before, surface.vertices[third].position);
    const Shape was(glm::dvec3(0), b, c);
    const Shape is(step, b, c);
    if (is.thin() && is.squared * was.sides * was.sides <= was.squared * is.sides * is.sides) return false;
    const double turn = glm::dot(was.normal, is.normal);
    if (was.squared > 0 && !(turn > 0 && turn * turn > kLeastCosine * kLeastCosine * was.squared * is.squared)) {
      return false;
    }
  }
  return true;
}

bool covers_wedges(const Surface& surface, std::uint32_t gone, const WedgePairs& pairs) {
  bool covered = true;
  surface.each_corner(gone, [&](std::uint32_t corner) {
    const std::uint32_t wedge = surface.wedges[corner];
    covered = covered && std::any_of(pairs.begin(), pairs.end(), [&](const WedgePair& p) { return p.gone == wedge; });
  });
  return covered;
}

/// Faces over the same three vertices go: one of two that turn alike, both of two that face each other.
std::uint32_t drop_doubled(Surface& surface, std::uint32_t* star, std::uint32_t size) {
  std::uint32_t dropped = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t j = i + 1; j < size && !surface.gone(star[i]); ++j) {
      if (surface.gone(star[j])) continue;
      const std::uint32_t a = surface.corners[next_of(star[i])];
      const std::uint32_t b = surface.corners[previous_of(star[i])];
      const std::uint32_t c = surface.corners[next_of(star[j])];
      const std::uint32_t d = surface.corners[previous_of(star[j])];
      const bool alike = a == c && b == d;
      if (!alike && (a != d || b != c)) continue;
      surface.corners[star[j] - star[j] % 3] = kNone;
      ++dropped;
      if (!alike) {
        surface.corners[star[i] - star[i] % 3] = kNone;
        ++dropped;
      }
    }
  }
  return dropped;
}

}  // namespace

void check_collapse(const Surface& surface, bool keep_topology, Collapse& collapse) {
  const std::uint32_t gone = collapse.plan.gone;
  const std::uint32_t kept = collapse.plan.kept;
  const Wings wings = wings_of(surface, gone, kept);
  collapse.removed = static_cast<std::uint32_t>(wings.count);
  if (wings.count == 0 || wings.too_many) return;
  if (keep_topology && (wings.between_lines || !keeps_links(surface, gone, kept, wings))) return;
  if (!surface.wedges.empty()) {
    WedgePairs pairs;
    if (!wedge_pairs(surface, gone, kept, pairs) || !covers_wedges(surface, gone, pairs)) return;
  }
  if (!keeps_faces(surface, gone, kept, collapse.plan.place)) return;
  if (!collapse.plan.fixed && !keeps_faces(surface, kept, gone, collapse.plan.place)) return;
  collapse.legal = true;
}

std::uint32_t apply_collapse(Surface& surface, bool keep_topology, const Collapse& collapse) {
  const std::uint32_t gone = collapse.plan.gone;
  const std::uint32_t kept = collapse.plan.kept;
  WedgePairs pairs;
  wedge_pairs(surface, gone, kept, pairs);
  // Where a face goes, its two other sides become one edge.
  struct Joined {
    std::uint32_t from;
    std::uint32_t to;
  };
  std::array<Joined, kMostWings> joined;
  std::size_t joins = 0;
  std::uint32_t removed = 0;
  surface.each_corner(gone, [&](std::uint32_t corner) {
    const std::uint32_t next = next_of(corner);
    const std::uint32_t previous = previous_of(corner);
    const bool forward = surface.corners[next] == kept;
    if (!forward && surface.corners[previous] != kept) return;
    const std::uint32_t along = surface.edge_of_corner[forward ? corner : previous];
    const std::uint32_t from = surface.edge_of_corner[forward ? previous : corner];
    const std::uint32_t to = surface.edge_of_corner[next];
    surface.ends[along][0] = kNone;
    surface.ends[from][0] = kNone;
    surface.costs[along] = surface.costs[from] = std::numeric_limits<float>::infinity();
    surface.flags[to] = static_cast<std::uint8_t>(surface.flags[to] | surface.flags[from]);
    joined[joins++] = {from, to};
    surface.corners[corner - corner % 3] = kNone;
    ++removed;
  });

  std::uint32_t* const star = surface.stars.data() + collapse.star_first;
  std::uint32_t size = 0;
  surface.each_corner(kept, [&](std::uint32_t corner) { star[size++] = corner; });
  surface.each_corner(gone, [&](std::uint32_t corner) {
    star[size++] = corner;
    surface.corners[corner] = kept;
    if (!surface.wedges.empty()) {
      for (const WedgePair& pair : pairs) {
        if (pair.gone == surface.wedges[corner]) {
          surface.wedges[corner] = pair.kept;
          break;
        }
      }
    }
    for (const std::uint32_t side : {corner, previous_of(corner)}) {
      std::uint32_t& edge = surface.edge_of_corner[side];
      for (std::size_t j = 0; j < joins; ++j) {
        if (joined[j].from == edge) edge = joined[j].to;
      }
      std::array<std::uint32_t, 2>& ends = surface.ends[edge];
      for (std::uint32_t& end : ends) {
        if (end == gone) end = kept;
      }
    }
  });
  for (const WedgePair& pair : pairs) merge_values(surface, pair, collapse.plan);
  if (!keep_topology) removed += drop_doubled(surface, star, size);
  Vertex& left = surface.vertices[kept];
  Vertex& other = surface.vertices[gone];
  LocalQuadric sum;
  sum.add(left.quadric, surface.step(left.position, collapse.plan.place));
  sum.add(other.quadric, surface.step(other.position, collapse.plan.place));
  left.quadric = sum.near();
  left.position = collapse.plan.place;
  left.star_first = collapse.star_first;
  left.star_size = size;
  other.star_size = 0;
  return removed;
}

}  // namespace azulejo::decimation
