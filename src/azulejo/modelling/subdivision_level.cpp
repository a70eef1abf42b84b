#include "azulejo/modelling/subdivision_level.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/normals.h"

namespace azulejo::subdivision {
namespace {

/// One of the two sides that a corner's face has at its vertex: along the edge of this corner.
template <class FacesOf>
class Fan {
 public:
  Fan(const Level& level, FacesOf faces, std::uint32_t vertex) : level_(level), faces_(faces), vertex_(vertex) {}

  std::uint32_t before(std::uint32_t corner) const { return static_cast<std::uint32_t>(faces_.previous(corner)); }
  std::uint32_t edge(std::uint32_t side) const { return level_.edge_of_corner[side]; }
  /// The corner at the vertex of a face that uses an edge of it along `side`.
  std::uint32_t corner_of(std::uint32_t side) const {
    return level_.corners[side] == vertex_ ? side : static_cast<std::uint32_t>(faces_.next(side));
  }
  std::uint32_t opposite(std::uint32_t corner, std::uint32_t side) const {
    return side == corner ? before(corner) : corner;
  }
  /// Steps over the edge of a side; kNone where it isn't between two faces.
  std::uint32_t across(std::uint32_t side) const {
    const auto uses = level_.uses_of(edge(side));
    if (uses.size() != 2) return kNone;
    return uses[0] == side ? uses[1] : uses[0];
  }
  /// Corners from this one on, leaving it over `out`, until they end or come back.
  template <class Visit>
  void walk(std::uint32_t corner, std::uint32_t out, Visit visit) const {
    const std::uint32_t start = corner;
    for (;;) {
      visit(corner, out);
      const std::uint32_t in = across(out);
      if (in == kNone) return;
      corner = corner_of(in);
      out = opposite(corner, in);
      if (corner == start) return;
    }
  }

 private:
  const Level& level_;
  FacesOf faces_;
  std::uint32_t vertex_;
};

/// Whether the faces at a vertex are parts that nothing but the vertex joins, one of them a closed ring.
template <class FacesOf>
bool falls_apart(const Level& level, FacesOf faces, std::uint32_t vertex) {
  const Fan<FacesOf> fan(level, faces, vertex);
  const auto corners = level.corners_at(vertex);
  std::size_t from_ends = 0;
  bool open = false;
  for (const std::uint32_t corner : corners) {
    const std::uint32_t before = fan.before(corner);
    for (const std::uint32_t end : {corner, before}) {
      if (level.uses_of(fan.edge(end)).size() == 2) continue;
      open = true;
      fan.walk(corner, fan.opposite(corner, end), [&](std::uint32_t, std::uint32_t) { ++from_ends; });
    }
  }
  if (open) return from_ends < 2 * corners.size();
  std::size_t count = 0;
  fan.walk(corners[0], corners[0], [&](std::uint32_t, std::uint32_t) { ++count; });
  return count < corners.size();
}

template <class FacesOf>
Rule rule_of(const Level& level, FacesOf faces, std::uint32_t vertex, bool lone_corners) {
  const auto corners = level.corners_at(vertex);
  if (corners.empty() || falls_apart(level, faces, vertex)) return Rule::Corner;
  std::array<std::uint32_t, 2> sharp{};
  std::size_t count = 0;
  for (const std::uint32_t corner : corners) {
    for (const std::size_t side : {std::size_t{corner}, faces.previous(corner)}) {
      const std::uint32_t edge = level.edge_of_corner[side];
      if (level.sharp[edge] == 0 || std::find(sharp.begin(), sharp.begin() + count, edge) != sharp.begin() + count) {
        continue;
      }
      if (count == sharp.size()) return Rule::Corner;
      sharp[count++] = edge;
    }
  }
  if (count == 2) return lone_corners && corners.size() == 1 ? Rule::Corner : Rule::Crease;
  if (corners.size() == 1) return Rule::Corner;
  if (count == 0) return Rule::Smooth;
  return level.uses_of(sharp[0]).size() == 2 ? Rule::Dart : Rule::Corner;
}

/// Whether the faces of an edge with two of them meet at so little of an angle that it is smooth.
bool is_sharp(const Level& level, std::size_t edge, const Sharpness& sharpness, const Array<glm::vec3>& normals,
              const Array<std::uint32_t>& face_of_corner) {
  const auto uses = level.uses_of(edge);
  if (uses.size() != 2) return true;
  const bool turned = level.corners[uses[0]] == level.corners[uses[1]];
  if (turned && sharpness.turned) return true;
  if (normals.empty()) return false;
  const auto normal = [&](std::uint32_t corner) {
    return normals[face_of_corner.empty() ? corner / 3 : face_of_corner[corner]];
  };
  const glm::vec3 a = normal(uses[0]);
  const glm::vec3 b = normal(uses[1]);
  if (a == glm::vec3(0) || b == glm::vec3(0)) return false;
  return glm::dot(a, turned ? -b : b) < sharpness.least_cosine;
}

void take(Level& level, EdgeUses&& edges) {
  level.edges = std::move(edges.vertices);
  level.edge_of_corner = std::move(edges.of_corner);
  level.first_use = std::move(edges.first_use);
  level.uses = std::move(edges.uses);
}

void take(Level& level, VertexCorners&& corners) {
  level.first_at_vertex = std::move(corners.first);
  level.at_vertex = std::move(corners.corners);
}

bool is_oriented(const Level& level, const Run& run) {
  return parallel_reduce(
             level.edges.size(), kChunk, run, 1,
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t e = begin; e < end; ++e) {
                 const auto uses = level.uses_of(e);
                 if (uses.size() == 2 && level.corners[uses[0]] == level.corners[uses[1]]) return 0;
               }
               return 1;
             },
             [](int a, int b) { return a & b; }) != 0;
}

/// A triangle in four: corner k of the face f becomes triangle 4 f + k, (the vertex, the middle behind it, the middle
/// before it); triangle 4 f + 3 is between the middles.
struct TrianglePattern {
  static constexpr std::size_t kSides = 3;
  static constexpr std::size_t kPerUse = 3;  ///< corners at the middle of an edge, for each of its uses
  using FacesOf = Faces<3>;
  FacesOf faces;

  static std::uint32_t at_vertex(std::size_t corner) {
    return static_cast<std::uint32_t>(12 * (corner / 3) + 3 * (corner % 3));
  }
  static std::uint32_t center(std::size_t corner) {
    return static_cast<std::uint32_t>(12 * (corner / 3) + 9 + corner % 3);
  }
  std::uint32_t half_at_start(std::size_t corner) const { return at_vertex(corner); }
  std::uint32_t half_at_end(std::size_t corner) const { return at_vertex(faces.next(corner)) + 2; }
  /// Along the edge made in the face beside the corner.
  std::array<std::uint32_t, 2> inner_uses(std::size_t corner) const {
    return {at_vertex(corner) + 1, center(faces.previous(corner))};
  }
  void at_middle(std::size_t corner, std::uint32_t* out) const {
    out[0] = at_vertex(corner) + 1;
    out[1] = at_vertex(faces.next(corner)) + 2;
    out[2] = center(corner);
  }
};

/// A face into quads, one for each of its corners: (the vertex, the middle behind it, the face's, the middle before it).
template <class Of>
struct QuadPattern {
  static constexpr std::size_t kSides = 4;
  static constexpr std::size_t kPerUse = 2;
  using FacesOf = Of;
  FacesOf faces;

  static std::uint32_t at_vertex(std::size_t corner) { return static_cast<std::uint32_t>(4 * corner); }
  std::uint32_t half_at_start(std::size_t corner) const { return at_vertex(corner); }
  std::uint32_t half_at_end(std::size_t corner) const { return at_vertex(faces.next(corner)) + 3; }
  std::array<std::uint32_t, 2> inner_uses(std::size_t corner) const {
    return {at_vertex(corner) + 1, at_vertex(faces.next(corner)) + 2};
  }
  void at_middle(std::size_t corner, std::uint32_t* out) const {
    out[0] = at_vertex(corner) + 1;
    out[1] = at_vertex(faces.next(corner)) + 3;
  }
};

/// Builds the level below from a pattern of the faces.
template <class Pattern>
class Splitter {
 public:
  Splitter(const Level& from, Pattern pattern, const Run& run)
      : from_(from), pattern_(pattern), run_(run), edges_(from.edges.size()), corners_(from.corner_count()) {
    constexpr bool kQuads = Pattern::kSides == 4;
    next_.sides = Pattern::kSides;
    next_.vertex_count = from.vertex_count + edges_ + (kQuads ? from.face_count() : 0);
    next_.oriented = from.oriented;
  }

  Level split(bool whole) {
    next_.corners.resize(4 * corners_);
    if (whole) next_.edge_of_corner.resize(4 * corners_);
    each(from_.face_count(), [&](std::size_t face) {
      split_face(face, next_.corners.data(), whole ? next_.edge_of_corner.data() : nullptr);
    });
    if (!whole) return std::move(next_);
    split_edges();
    link_vertices();
    return std::move(next_);
  }

 private:
  template <class Body>
  void each(std::size_t count, Body body) const {
    parallel_for(count, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  }
  std::uint32_t middle(std::size_t edge) const { return static_cast<std::uint32_t>(from_.vertex_count + edge); }
  std::uint32_t center(std::size_t face) const {
    return static_cast<std::uint32_t>(from_.vertex_count + edges_ + face);
  }
  /// The half of a corner's edge at a vertex.
  std::uint32_t half(std::size_t corner, std::uint32_t vertex) const {
    const std::uint32_t edge = from_.edge_of_corner[corner];
    return 2 * edge + (from_.edges[edge][0] == vertex ? 0 : 1);
  }
  std::uint32_t inner(std::size_t corner) const { return static_cast<std::uint32_t>(2 * edges_ + corner); }

  void split_face(std::size_t face, std::uint32_t* corners, std::uint32_t* edges) const {
    const std::size_t end = pattern_.faces.end(face);
    std::size_t before = end - 1;
    for (std::size_t c = pattern_.faces.begin(face); c < end; before = c++) {
      const std::uint32_t vertex = from_.corners[c];
      const std::uint32_t at = pattern_.at_vertex(c);
      const std::uint32_t behind = middle(from_.edge_of_corner[c]);
      corners[at] = vertex;
      corners[at + 1] = behind;
      corners[at + Pattern::kSides - 1] = middle(from_.edge_of_corner[before]);
      if constexpr (Pattern::kSides == 4) {
        corners[at + 2] = center(face);
      } else {
        corners[pattern_.center(c)] = behind;
      }
      if (edges == nullptr) continue;
      edges[at] = half(c, vertex);
      edges[at + 1] = inner(c);
      edges[at + Pattern::kSides - 1] = half(before, vertex);
      if constexpr (Pattern::kSides == 4) {
        edges[at + 2] = inner(before);
      } else {
        edges[pattern_.center(before)] = inner(c);
      }
    }
  }

  void split_edges() {
    const std::size_t count = 2 * edges_ + corners_;
    next_.edges.resize(count);
    next_.first_use.resize(count + 1);
    next_.first_use[count] = static_cast<std::uint32_t>(4 * corners_);
    next_.uses.resize(4 * corners_);
    next_.sharp.assign(count, 0);
    each(edges_, [&](std::size_t edge) {
      const auto uses = from_.uses_of(edge);
      std::uint32_t place = 2 * from_.first_use[edge];
      for (std::size_t end = 0; end < 2; ++end) {
        const std::uint32_t vertex = from_.edges[edge][end];
        next_.edges[2 * edge + end] = {vertex, middle(edge)};
        next_.sharp[2 * edge + end] = from_.sharp[edge];
        next_.first_use[2 * edge + end] = place;
        for (const std::uint32_t use : uses) {
          const bool at_start = from_.corners[use] == vertex;
          next_.uses[place++] = at_start ? pattern_.half_at_start(use) : pattern_.half_at_end(use);
        }
      }
    });
    each(corners_, [&](std::size_t corner) {
      const std::size_t edge = inner(corner);
      const std::uint32_t behind = middle(from_.edge_of_corner[corner]);
      if constexpr (Pattern::kSides == 4) {
        next_.edges[edge] = {behind, center(pattern_.faces.face_of(corner))};
      } else {
        next_.edges[edge] = {behind, middle(from_.edge_of_corner[pattern_.faces.previous(corner)])};
      }
      const auto place = static_cast<std::uint32_t>(2 * corners_ + 2 * corner);
      next_.first_use[edge] = place;
      const std::array<std::uint32_t, 2> uses = pattern_.inner_uses(corner);
      next_.uses[place] = uses[0];
      next_.uses[place + 1] = uses[1];
    });
  }

  void link_vertices() {
    next_.first_at_vertex.resize(next_.vertex_count + 1);
    next_.first_at_vertex[next_.vertex_count] = static_cast<std::uint32_t>(4 * corners_);
    next_.at_vertex.resize(4 * corners_);
    next_.rules.assign(next_.vertex_count, Rule::Smooth);
    each(from_.vertex_count, [&](std::size_t vertex) {
      next_.rules[vertex] = from_.rules[vertex];
      next_.first_at_vertex[vertex] = from_.first_at_vertex[vertex];
      std::uint32_t place = from_.first_at_vertex[vertex];
      for (const std::uint32_t corner : from_.corners_at(vertex)) {
        next_.at_vertex[place++] = pattern_.at_vertex(corner);
      }
    });
    each(edges_, [&](std::size_t edge) {
      const std::uint32_t vertex = middle(edge);
      if (from_.sharp[edge] != 0) next_.rules[vertex] = Rule::Crease;
      auto place = static_cast<std::uint32_t>(corners_ + Pattern::kPerUse * from_.first_use[edge]);
      next_.first_at_vertex[vertex] = place;
      for (const std::uint32_t use : from_.uses_of(edge)) {
        pattern_.at_middle(use, next_.at_vertex.data() + place);
        place += Pattern::kPerUse;
      }
    });
    if constexpr (Pattern::kSides == 4) {
      each(from_.face_count(), [&](std::size_t face) {
        const std::size_t begin = pattern_.faces.begin(face);
        next_.first_at_vertex[center(face)] = static_cast<std::uint32_t>(3 * corners_ + begin);
        for (std::size_t c = begin; c < pattern_.faces.end(face); ++c) {
          next_.at_vertex[3 * corners_ + c] = pattern_.at_vertex(c) + 2;
        }
      });
    }
  }

  const Level& from_;
  Pattern pattern_;
  const Run& run_;
  std::size_t edges_;
  std::size_t corners_;
  Level next_;
};

}  // namespace

Level first_level(const Mesh& mesh, const Sharpness& sharpness, Array<std::uint32_t>& line_edges, const Run& run) {
  Level level;
  level.vertex_count = mesh.vertex_count();
  level.corners = mesh.corners;
  level.face_offsets = mesh.face_offsets;
  level.sides = mesh.all_triangles() ? 3 : 0;
  level.face_of_corner = faces_of_corners(mesh, run);
  take(level, edge_uses(mesh, {}, run));
  take(level, corners_of_vertices(mesh, run));
  level.oriented = is_oriented(level, run);
  line_edges = edges_along(level, mesh.lines, run);
  const Array<glm::vec3> normals = sharpness.least_cosine > -1 ? face_normals(mesh, run) : Array<glm::vec3>();
  level.sharp.resize(level.edges.size());
  parallel_for(level.edges.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      level.sharp[e] = is_sharp(level, e, sharpness, normals, level.face_of_corner) ? 1 : 0;
    }
  });
  if (sharpness.lines) {
    for (const std::uint32_t edge : line_edges) {
      if (edge != kNone) level.sharp[edge] = 1;
    }
  }
  level.rules.resize(level.vertex_count);
  with_faces(level, [&](auto faces) {
    parallel_for(level.vertex_count, kChunk, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        level.rules[v] = rule_of(level, faces, static_cast<std::uint32_t>(v), sharpness.lone_corners);
      }
    });
  });
  return level;
}

void connect(Level& level, const Array<std::uint8_t>& sharp_corners, const Run& run) {
  Mesh mesh;
  mesh.positions.resize(level.vertex_count);
  mesh.corners = std::move(level.corners);
  take(level, edge_uses(mesh, {}, run));
  take(level, corners_of_vertices(mesh, run));
  level.corners = std::move(mesh.corners);
  level.sharp.resize(level.edges.size());
  parallel_for(level.edges.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      level.sharp[e] = 0;
      for (const std::uint32_t use : level.uses_of(e)) level.sharp[e] |= sharp_corners[use];
    }
  });
}

Level split_triangles(const Level& level, bool whole, const Run& run) {
  return Splitter(level, TrianglePattern{Faces<3>(level)}, run).split(whole);
}

Level split_into_quads(const Level& level, bool whole, const Run& run) {
  Level next;
  with_faces(level, [&](auto faces) { next = Splitter(level, QuadPattern<decltype(faces)>{faces}, run).split(whole); });
  return next;
}

std::array<std::uint32_t, 2> crease_neighbors(const Level& level, std::size_t vertex) {
  std::array<std::uint32_t, 2> found{kNone, kNone};
  std::uint32_t first_edge = kNone;
  with_faces(level, [&](auto faces) {
    for (const std::uint32_t corner : level.corners_at(vertex)) {
      for (const std::size_t side : {std::size_t{corner}, faces.previous(corner)}) {
        const std::uint32_t edge = level.edge_of_corner[side];
        if (level.sharp[edge] == 0 || edge == first_edge) continue;
        const auto& ends = level.edges[edge];
        const std::uint32_t other = ends[0] == vertex ? ends[1] : ends[0];
        if (first_edge != kNone) {
          found[1] = other;
          return;
        }
        first_edge = edge;
        found[0] = other;
      }
    }
  });
  return found;
}

Array<std::uint32_t> edges_along(const Level& level, const Array<std::uint32_t>& lines, const Run& run) {
  Array<std::uint32_t> found(lines.size() / 2);
  parallel_for(found.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::array ends{std::min(lines[2 * i], lines[2 * i + 1]), std::max(lines[2 * i], lines[2 * i + 1])};
      const auto place = std::lower_bound(level.edges.begin(), level.edges.end(), ends);
      const bool is_edge = place != level.edges.end() && *place == ends;
      found[i] = is_edge ? static_cast<std::uint32_t>(place - level.edges.begin()) : kNone;
    }
  });
  return found;
}

std::vector<Spoke> ring_around(const Level& level, std::size_t vertex, std::uint32_t first_corner) {
  std::vector<Spoke> ring;
  with_faces(level, [&](auto faces) {
    const Fan<decltype(faces)> fan(level, faces, static_cast<std::uint32_t>(vertex));
    fan.walk(first_corner, first_corner, [&](std::uint32_t corner, std::uint32_t out) {
      ring.push_back({corner, fan.edge(fan.opposite(corner, out)), fan.edge(out)});
    });
  });
  return ring;
}

}  // namespace azulejo::subdivision
