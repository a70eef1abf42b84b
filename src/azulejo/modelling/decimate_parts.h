#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/decimate.h"
#include "azulejo/modelling/decimate_quadric.h"

/// The parts of `decimate`.
namespace azulejo::decimation {

inline constexpr std::uint32_t kNone = 0xFFFFFFFF;
inline constexpr std::size_t kStarRoom = 7;       ///< a face: about what stars grow to until half of the faces are gone
inline constexpr std::size_t kMostWings = 8;      ///< faces that go with an edge
inline constexpr std::size_t kLargestStar = 512;  ///< faces at a vertex that takes part in collapses

/// Where a vertex may go.
enum class Freedom : std::uint8_t {
  Surface,
  Line,  ///< along the two edges of a border or seam that meet there
  None,
};

enum EdgeFlag : std::uint8_t {
  kBorder = 1,  ///< one face
  kLine = 2,    ///< a border, a seam, or where materials change
  kOdd = 4,     ///< not two faces that turn alike
};

/// Values at wedges that are interpolated: all columns of attributes side by side, scaled for the metric.
///
/// A wedge is what the corners have in common that lie around one vertex without a seam between them.
struct WedgeValues {
  struct Column {
    std::size_t attribute;  ///< of the source
    int component;
    float scale;  ///< value in the metric ÷ value; 0: not in it
    float lower;  ///< of the values
    float upper;
  };
  std::vector<Column> columns;
  std::size_t metric = 0;                  ///< the first ones, which are in the metric
  Array<double> values;                    ///< columns.size() a wedge, scaled
  Array<Quadric> quadrics;                 ///< of each wedge: Σ weight · (g·p + d)² over columns
  Array<std::array<double, 4>> gradients;  ///< metric a wedge: Σ weight · (g, d)
  bool in_metric() const { return metric > 0; }
};

/// All that is looked at together, in one line of the cache.
struct alignas(64) Vertex {
  glm::vec3 position;
  NearQuadric quadric;       ///< scaled, around the position
  std::uint32_t star_first;  ///< into `Surface::stars`
  std::uint32_t star_size;
};

/// The surface while it shrinks. Corners of triangle t are 3 t … 3 t + 2. What is gone: triangles whose first corner is
/// kNone, edges whose first end is kNone.
struct Surface {
  glm::dvec3 center{0, 0, 0};
  double scale = 1;  ///< 1 ÷ largest side: what is computed is within a unit box
  Array<std::uint32_t> corners;
  Array<std::uint32_t> edge_of_corner;  ///< from it to the next
  Array<std::uint32_t> wedges;          ///< of corners; empty: the vertices
  Array<std::uint32_t> home;    ///< of wedges: the vertex of the source that it belongs to; empty: the same number
  Array<std::uint32_t> origin;  ///< of wedges: a corner of the source whose values are taken as they are
  Array<std::uint32_t> source_corners;  ///< of corners, into the source's; empty: the same number
  Array<std::uint32_t> source_faces;    ///< of triangles; empty: the same number
  Array<std::array<std::uint32_t, 2>> ends;
  Array<std::uint8_t> flags;  ///< of edges
  Array<float> costs;         ///< of edges; infinite: can't collapse
  Array<Vertex> vertices;
  Array<Freedom> freedoms;     ///< of vertices
  Array<std::uint32_t> stars;  ///< corners, some of which may be gone
  WedgeValues values;
  std::size_t faces = 0;

  glm::dvec3 scaled(const glm::vec3& position) const { return scale * (glm::dvec3(position) - center); }
  glm::dvec3 place(std::uint32_t vertex) const { return scaled(vertices[vertex].position); }
  /// From one position to another, scaled.
  glm::dvec3 step(const glm::vec3& from, const glm::vec3& to) const {
    return scale * (glm::dvec3(to) - glm::dvec3(from));
  }
  std::uint32_t wedge(std::uint32_t corner) const { return wedges.empty() ? corners[corner] : wedges[corner]; }
  std::uint32_t source_corner(std::size_t corner) const {
    return source_corners.empty() ? static_cast<std::uint32_t>(corner) : source_corners[corner];
  }
  std::size_t source_face(std::size_t triangle) const {
    return source_faces.empty() ? triangle : source_faces[triangle];
  }
  bool gone(std::uint32_t corner) const { return corners[corner - corner % 3] == kNone; }
  /// The corners at a vertex, some of which may be gone.
  std::span<const std::uint32_t> star(std::uint32_t vertex) const {
    return {stars.data() + vertices[vertex].star_first, vertices[vertex].star_size};
  }
  /// Calls f(corner) for each that is left at a vertex.
  template <class F>
  void each_corner(std::uint32_t vertex, F f) const {
    for (const std::uint32_t corner : star(vertex)) {
      if (!gone(corner)) f(corner);
    }
  }
};
inline std::uint32_t next_of(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
inline std::uint32_t previous_of(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

/// The source as a surface: triangles, vertices by position, edges, seams, stars, quadrics. No costs yet.
Surface build_surface(const Mesh& mesh, const DecimateOptions& options, const Attribute*& faceted, const Run& run);

/// A pair of wedges that becomes one.
struct WedgePair {
  std::uint32_t gone;
  std::uint32_t kept;
};
/// Those of an edge: one of each side of a seam.
struct WedgePairs {
  std::array<WedgePair, 4> pairs;
  std::size_t count = 0;
  const WedgePair* begin() const { return pairs.data(); }
  const WedgePair* end() const { return pairs.data() + count; }
  /// False where it doesn't go with the others: each wedge has one partner.
  bool add(const WedgePair& pair) {
    for (const WedgePair& each : *this) {
      if (each.gone == pair.gone && each.kept == pair.kept) return true;
      if (each.gone == pair.gone || each.kept == pair.kept) return false;
    }
    if (count == pairs.size()) return false;
    pairs[count++] = pair;
    return true;
  }
};

/// What would become of an edge.
struct Plan {
  std::uint32_t gone = kNone;  ///< the vertex that goes
  std::uint32_t kept = kNone;
  glm::vec3 place{0, 0, 0};
  double cost = 0;
  double weight = 0;   ///< of the faces in the cost
  bool fixed = false;  ///< `place` is that of `kept`
};

/// Finds where an edge would collapse to; an infinite cost where it must not.
class Planner {
 public:
  Planner(const Surface& surface, const DecimateOptions& options);
  Plan plan(std::uint32_t edge) const;
  /// What edges are ordered by; infinite above `error`.
  float cost(std::uint32_t edge) const;

 private:
  struct Best;
  Best best(std::uint32_t edge) const;

  const Surface& surface_;
  double largest_error_;  ///< squared, of the metric
};

/// A collapse that was chosen.
struct Collapse {
  std::uint32_t edge = kNone;
  Plan plan;
  std::uint32_t removed = 0;     ///< faces
  std::uint32_t star_first = 0;  ///< room for the stars of both
  bool legal = false;
};

/// Whether a collapse keeps topology, seams, and the faces around it upright.
void check_collapse(const Surface& surface, bool keep_topology, Collapse& collapse);
/// Does it, and gives the number of faces that went; its star has been given room. Different collapses, of which no vertices are neighbors, may run at once.
std::uint32_t apply_collapse(Surface& surface, bool keep_topology, const Collapse& collapse);

/// Gives stars without corners that are gone, one after another; `triangles`: what number each becomes, where they do.
void renew_stars(Surface& surface, const Array<std::uint32_t>& triangles = {});
/// Closes up triangles and edges, of which some are gone. `source_corners` goes. Returns the new numbers of edges; kNone:
/// gone.
Array<std::uint32_t> compact(Surface& surface);

/// The pairs of wedges at an edge; false where they are no pairs.
bool wedge_pairs(const Surface& surface, std::uint32_t gone, std::uint32_t kept, WedgePairs& pairs);

/// Columns, their values and quadrics.
void build_values(const Mesh& mesh, const DecimateOptions& options, const Attribute* faceted, Surface& surface,
                  const Run& run);
/// The values' part of what a pair costs, with the best values at each place.
Quadric value_quadric(const WedgeValues& values, const WedgePair& pair);
/// What keeping the values of `kept` adds, at its place.
double value_cost(const WedgeValues& values, const WedgePair& pair, const glm::dvec3& place);
/// Gives the kept wedge of a pair the values of both.
void merge_values(Surface& surface, const WedgePair& pair, const Plan& plan);

/// Collapses edges, round by round.
struct Reached {
  double error = 0;
  DecimateStop stopped = DecimateStop::Nothing;
};
Reached collapse_edges(Surface& surface, const DecimateOptions& options, std::size_t target, const Run& run);

/// What is left, as a mesh.
Mesh mesh_of(const Mesh& source, const Surface& surface, const Attribute* faceted, const Run& run);

}  // namespace azulejo::decimation
