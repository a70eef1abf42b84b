#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "azulejo/core/parallel.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/decimate_parts.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/triangulate.h"
#include "azulejo/modelling/union_find.h"

namespace azulejo::decimation {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 12;
constexpr double kSeamShare = 0.1;  ///< of the weight of borders

bool finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

class Builder {
 public:
  Builder(const Mesh& mesh, const DecimateOptions& options, const Run& run)
      : mesh_(mesh), options_(options), run_(run) {}

  Surface build(const Attribute*& faceted) {
    set_box();
    set_triangles();
    find_edges();
    faceted = faceted_normals();
    set_wedges(faceted);
    set_stars();
    set_freedom();
    set_quadrics();
    build_values(mesh_, options_, faceted, surface_, run_);
    return std::move(surface_);
  }

 private:
  void set_box() {
    const Box3 box = bounds(mesh_);
    if (box.empty()) return;
    surface_.center = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper));
    const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    const double largest = std::max({size.x, size.y, size.z});
    if (largest > 0) surface_.scale = 1 / largest;
  }

  /// Triangles over positions, without those that have one twice.
  void set_triangles() {
    Welded welded = weld_exactly(mesh_.positions, run_);
    split_ = welded.positions.size() != mesh_.positions.size();
    Triangulation parts;
    if (!mesh_.all_triangles()) parts = triangulate(mesh_, run_);
    const bool divided = !mesh_.all_triangles();
    const std::size_t triangles = divided ? parts.face.size() : mesh_.face_count();
    vertex_of_ = std::move(welded.corners);
    positions_ = std::move(welded.positions);
    surface_.corners.resize(3 * triangles);
    std::atomic<bool> degenerate = false;
    parallel_for(triangles, kPiece, run_, [&](std::size_t begin, std::size_t end) {
      bool found = false;
      for (std::size_t t = begin; t < end; ++t) {
        std::uint32_t* const three = &surface_.corners[3 * t];
        for (std::size_t k = 0; k < 3; ++k) {
          three[k] = vertex_of_[mesh_.corners[divided ? parts.corners[3 * t + k] : 3 * t + k]];
        }
        found = found || three[0] == three[1] || three[1] == three[2] || three[2] == three[0];
      }
      if (found) degenerate = true;
    });
    if (divided) {
      surface_.source_corners = std::move(parts.corners);
      surface_.source_faces = std::move(parts.face);
    }
    if (degenerate) drop_degenerate(triangles);
    surface_.faces = surface_.corners.size() / 3;
  }

  void drop_degenerate(std::size_t triangles) {
    Surface& s = surface_;
    Array<std::uint32_t> source_corners;
    Array<std::uint32_t> source_faces;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
      const std::array<std::uint32_t, 3> three{s.corners[3 * t], s.corners[3 * t + 1], s.corners[3 * t + 2]};
      if (three[0] == three[1] || three[1] == three[2] || three[2] == three[0]) continue;
      source_faces.push_back(static_cast<std::uint32_t>(s.source_face(t)));
      for (std::size_t k = 0; k < 3; ++k) {
        source_corners.push_back(s.source_corner(3 * t + k));
        s.corners[3 * kept + k] = three[k];
      }
      ++kept;
    }
    s.corners.resize(3 * kept);
    s.source_corners = std::move(source_corners);
    s.source_faces = std::move(source_faces);
  }

  void find_edges() {
    Mesh welded;
    welded.positions.resize(positions_.size());
    welded.corners = std::move(surface_.corners);
    uses_ = edge_uses(welded, {}, run_);
    star_ = corners_of_vertices(welded, run_);
    surface_.corners = std::move(welded.corners);
    Surface& s = surface_;
    s.flags.resize(uses_.size());
    parallel_for(uses_.size(), kPiece, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        const std::span<const std::uint32_t> uses = uses_.uses_of(e);
        std::uint8_t flags = 0;
        if (uses.size() == 1) {
          flags = kBorder | kLine;
        } else if (uses.size() > 2) {
          flags = kOdd | kLine;
        } else {
          if (s.corners[uses[0]] == s.corners[uses[1]]) flags = kOdd;
          if (!mesh_.material.empty() &&
              mesh_.material[s.source_face(uses[0] / 3)] != mesh_.material[s.source_face(uses[1] / 3)]) {
            flags |= kLine;
          }
        }
        s.flags[e] = flags;
      }
    });
  }

  /// Calls f(edge, corner, corner at the same vertex) for both ends of edges of two faces.
  template <class F>
  void each_crossing(F f) const {
    for (std::size_t e = 0; e < uses_.size(); ++e) {
      const std::span<const std::uint32_t> uses = uses_.uses_of(e);
      if (uses.size() != 2) continue;
      const std::uint32_t a = uses[0];
      const std::uint32_t b = uses[1];
      const bool turned = surface_.corners[a] == surface_.corners[b];
      f(e, a, turned ? b : next_of(b));
      f(e, next_of(a), turned ? next_of(b) : b);
    }
  }

  bool same(const Attribute& attribute, std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t source_a = surface_.source_corner(a);
    const std::uint32_t source_b = surface_.source_corner(b);
    const std::size_t first = attribute.domain == Domain::Corner ? source_a : mesh_.corners[source_a];
    const std::size_t second = attribute.domain == Domain::Corner ? source_b : mesh_.corners[source_b];
    if (first == second) return true;
    return std::visit(
        [&](const auto& values) {
          const auto count = static_cast<std::size_t>(attribute.components);
          return std::equal(&values[first * count], &values[first * count] + count, &values[second * count]);
        },
        attribute.values);
  }

  /// NORMAL, where it differs along more than half of the edges.
  const Attribute* faceted_normals() const {
    const Attribute* const normals = mesh_.find("NORMAL");
    if (normals == nullptr || normals->domain == Domain::Face) return nullptr;
    if (normals->domain == Domain::Vertex && !split_) return nullptr;
    std::size_t crossings = 0;
    std::size_t apart = 0;
    each_crossing([&](std::size_t, std::uint32_t a, std::uint32_t b) {
      ++crossings;
      apart += same(*normals, a, b) ? 0 : 1;
    });
    return 2 * apart > crossings ? normals : nullptr;
  }

  /// Corners around a vertex that no seam divides are one wedge.
  void set_wedges(const Attribute* faceted) {
    std::vector<const Attribute*> dividing;
    for (const Attribute& each : mesh_.attributes) {
      if (&each == faceted || each.domain == Domain::Face || (each.domain == Domain::Vertex && !split_)) continue;
      dividing.push_back(&each);
    }
    if (!split_ && dividing.empty()) return;
    UnionFind wedges(surface_.corners.size());
    UnionFind homes(mesh_.vertex_count());
    each_crossing([&](std::size_t edge, std::uint32_t a, std::uint32_t b) {
      if (std::all_of(dividing.begin(), dividing.end(), [&](const Attribute* each) { return same(*each, a, b); })) {
        wedges.unite(a, b);
        homes.unite(mesh_.corners[surface_.source_corner(a)], mesh_.corners[surface_.source_corner(b)]);
      } else {
        surface_.flags[edge] |= kLine;
      }
    });
    Surface& s = surface_;
    s.wedges.resize(s.corners.size());
    for (std::uint32_t c = 0; c < s.corners.size(); ++c) {
      const std::uint32_t root = wedges.root(c);  // the lowest
      if (root == c) {
        s.wedges[c] = static_cast<std::uint32_t>(s.home.size());
        s.home.push_back(homes.root(mesh_.corners[s.source_corner(c)]));
        s.origin.push_back(s.source_corner(c));
      } else {
        s.wedges[c] = s.wedges[root];
      }
    }
    drop_wedges();
  }

  /// Where each vertex has one wedge, they are the vertices.
  void drop_wedges() {
    Surface& s = surface_;
    Array<std::uint32_t> home(positions_.size());
    Array<std::uint32_t> wedge_of(positions_.size());
    std::fill(home.begin(), home.end(), 0);
    std::fill(wedge_of.begin(), wedge_of.end(), kNone);
    for (std::size_t c = 0; c < s.corners.size(); ++c) {
      std::uint32_t& wedge = wedge_of[s.corners[c]];
      if (wedge != kNone && wedge != s.wedges[c]) return;
      wedge = s.wedges[c];
      home[s.corners[c]] = s.home[wedge];
    }
    s.wedges.clear();
    s.origin.clear();
    s.home = std::move(home);
  }

  void set_stars() {
    Surface& s = surface_;
    const std::size_t vertices = positions_.size();
    s.vertices.resize(vertices);
    s.freedoms.resize(vertices);
    parallel_for(vertices, kPiece, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        s.vertices[v].position = positions_[v];
        s.vertices[v].star_first = star_.first[v];
        s.vertices[v].star_size = star_.first[v + 1] - star_.first[v];
      }
    });
    s.stars = std::move(star_.corners);
    s.ends = std::move(uses_.vertices);
    s.edge_of_corner = std::move(uses_.of_corner);
    if (s.wedges.empty()) {  // they are the vertices
      s.origin.resize(vertices);
      for (std::size_t v = 0; v < vertices; ++v) {
        s.origin[v] = s.vertices[v].star_size > 0 ? s.source_corner(s.stars[s.vertices[v].star_first]) : kNone;
      }
    }
  }

  void set_freedom() {
    Surface& s = surface_;
    parallel_for(positions_.size(), kPiece, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) s.freedoms[v] = freedom_of(static_cast<std::uint32_t>(v));
    });
    for (const std::uint32_t vertex : mesh_.lines) s.freedoms[vertex_of_[vertex]] = Freedom::None;
  }

  Freedom freedom_of(std::uint32_t vertex) const {
    const Surface& s = surface_;
    if (s.vertices[vertex].star_size == 0 || !finite(positions_[vertex])) return Freedom::None;
    constexpr std::size_t kWhole = 2520;  // can be divided by 1 … 10, the faces of an edge that are met one by one
    std::size_t lines = 0;
    std::size_t borders = 0;
    bool odd = false;
    std::uint32_t start = s.stars[s.vertices[vertex].star_first];
    s.each_corner(vertex, [&](std::uint32_t corner) {
      for (const std::uint32_t side : {corner, previous_of(corner)}) {
        const std::uint32_t edge = s.edge_of_corner[side];
        const std::uint8_t flags = s.flags[edge];
        odd = odd || (flags & kOdd) != 0;
        if ((flags & kBorder) != 0) {
          ++borders;
          if (side != corner) start = corner;  // from here the fan goes on over edges that begin at the vertex
        }
        if ((flags & kLine) != 0) lines += kWhole / uses_.uses_of(edge).size();
      }
    });
    if (options_.lock_borders && borders > 0) return Freedom::None;
    if (options_.keep_topology &&
        (odd || fan_length(start, s.vertices[vertex].star_size) != s.vertices[vertex].star_size)) {
      return Freedom::None;
    }
    return lines == 0 ? Freedom::Surface : lines == 2 * kWhole ? Freedom::Line : Freedom::None;
  }

  /// How many corners are reached over edges, from one to the next.
  std::uint32_t fan_length(std::uint32_t start, std::uint32_t most) const {
    std::uint32_t corner = start;
    for (std::uint32_t length = 1; length <= most; ++length) {
      // The face on the other side of the edge that ends in the corner, turned alike, begins the edge there.
      const std::uint32_t edge = surface_.edge_of_corner[corner];
      const std::span<const std::uint32_t> uses = uses_.uses_of(edge);
      if (uses.size() != 2) return length;
      const std::uint32_t across = uses[0] == corner ? uses[1] : uses[0];
      corner = next_of(across);
      if (corner == start) return length;
    }
    return most + 1;
  }

  void set_quadrics() {
    Surface& s = surface_;
    parallel_for(positions_.size(), kPiece, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) s.vertices[v].quadric = quadric_of(static_cast<std::uint32_t>(v));
    });
  }

  NearQuadric quadric_of(std::uint32_t vertex) const {
    const Surface& s = surface_;
    Quadric sum;
    const glm::vec3& here = positions_[vertex];
    s.each_corner(vertex, [&](std::uint32_t corner) {
      const glm::dvec3 ahead = s.step(here, positions_[s.corners[next_of(corner)]]);
      const glm::dvec3 behind = s.step(here, positions_[s.corners[previous_of(corner)]]);
      const glm::dvec3 product = glm::cross(ahead, behind);
      const double length = glm::length(product);
      if (!(length > 0) || !std::isfinite(length)) return;
      const glm::dvec3 normal = product / length;
      const double weight = face_weight(0.5 * length);
      sum.add(normal, 0, weight);
      sum.weight += weight;
      add_line(s.edge_of_corner[corner], normal, ahead, sum);
      add_line(s.edge_of_corner[previous_of(corner)], normal, behind, sum);
    });
    LocalQuadric local;
    local.add(sum, glm::dvec3(0));
    return local.near();
  }

  /// A plane through a border or seam, upright on the face.
  void add_line(std::uint32_t edge, const glm::dvec3& normal, const glm::dvec3& along, Quadric& sum) const {
    const std::uint8_t flags = surface_.flags[edge];
    if ((flags & kLine) == 0) return;
    const double squared = glm::dot(along, along);
    const double weight = options_.border_weight * ((flags & kBorder) != 0 ? 1 : kSeamShare);
    sum.add(glm::cross(normal, along) / std::sqrt(squared), 0, weight * face_weight(squared));
  }

  const Mesh& mesh_;
  const DecimateOptions& options_;
  const Run& run_;
  Surface surface_;
  Array<glm::vec3> positions_;
  Array<std::uint32_t> vertex_of_;  ///< of vertices of the source
  bool split_ = false;              ///< vertices have equal positions
  EdgeUses uses_;
  VertexCorners star_;
};

}  // namespace

Surface build_surface(const Mesh& mesh, const DecimateOptions& options, const Attribute*& faceted, const Run& run) {
  return Builder(mesh, options, run).build(faceted);
}

}  // namespace azulejo::decimation
