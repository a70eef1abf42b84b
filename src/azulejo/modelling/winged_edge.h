#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <iterator>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// No vertex, edge, face or loop.
inline constexpr std::uint32_t kNoElement = 0xFFFFFFFF;

/// The surface of solids as explicit vertices, edges and faces: from an edge to its two vertices, two faces and four
/// neighbors in one step, from a vertex to all its edges in as many steps as it has.
///
/// An edge runs from its first to its second vertex; seen from outside, its first face lies to the left of it and the
/// second to the right. Its wings are the edges next to it around these faces: [0] left face at the first vertex, [1]
/// right face at the first, [2] left at the second, [3] right at the second. A border edge has kNoElement in place of a
/// face; its wings there lead along the border, so that every border is a loop of its own.
///
/// A face is bounded by one loop or several: the first is its outer one, the others are holes. A loop without edges is
/// a lone vertex. Seen from outside, loops run counter-clockwise (holes clockwise): the face is to the left.
///
/// It holds orientable 2-manifolds with border, whose edges have two different ends: an edge with three faces, or a vertex
/// in two fans of faces, can't be said in it. `winged_edge` splits them.
///
/// Elements keep their numbers. What was killed has `alive` false and its number is used again by what is made next, the
/// last killed first, so that an operator's inverse gives back the numbers, too.
///
/// Memory  32 bytes an edge, 20 a vertex, 24 a face with one loop: about 66 bytes a triangle of a large mesh
/// Source  Baumgart, Winged edge polyhedron representation, 1972; Mäntylä, An Introduction to Solid Modeling, 1988
class AZULEJO_EXPORT WingedEdge {
 public:
  struct Vertex {
    glm::vec3 position{0, 0, 0};
    std::uint32_t edge = kNoElement;    ///< one of its edges; none: a lone vertex
    std::uint32_t source = kNoElement;  ///< of the mesh that it came from
  };
  struct Edge {
    std::array<std::uint32_t, 2> vertex{kNoElement, kNoElement};
    std::array<std::uint32_t, 2> face{kNoElement, kNoElement};
    std::array<std::uint32_t, 4> wing{kNoElement, kNoElement, kNoElement, kNoElement};
    friend bool operator==(const Edge&, const Edge&) = default;
  };
  struct Face {
    std::uint32_t loop = kNoElement;    ///< its outer one; none: the face is not alive
    std::uint32_t source = kNoElement;  ///< of the mesh that it came from
  };
  struct Loop {
    std::uint32_t half = kNoElement;    ///< one of its halves; none: a lone vertex
    std::uint32_t vertex = kNoElement;  ///< the lone vertex
    std::uint32_t face = kNoElement;    ///< none: the loop is not alive
    std::uint32_t next = kNoElement;    ///< of the same face
  };

  /// One way along an edge: edge · 2, from its first vertex to its second with its first face to the left; + 1, the way
  /// back.
  using Half = std::uint32_t;

  // What there is. Numbers below `*_slots` may be of something killed.
  std::size_t vertex_slots() const { return vertices_.size(); }
  std::size_t edge_slots() const { return edges_.size(); }
  std::size_t face_slots() const { return faces_.size(); }
  std::size_t vertex_count() const { return vertices_.size() - free_vertices_.size(); }
  std::size_t edge_count() const { return edges_.size() - free_edges_.size(); }
  std::size_t face_count() const { return faces_.size() - free_faces_.size(); }
  std::size_t loop_count() const { return loops_.size() - free_loops_.size(); }
  bool vertex_alive(std::uint32_t vertex) const;
  bool edge_alive(std::uint32_t edge) const { return edges_[edge].vertex[0] != kNoElement; }
  bool face_alive(std::uint32_t face) const { return faces_[face].loop != kNoElement; }

  const Vertex& vertex(std::uint32_t index) const { return vertices_[index]; }
  const Edge& edge(std::uint32_t index) const { return edges_[index]; }
  const Face& face(std::uint32_t index) const { return faces_[index]; }
  const Loop& loop(std::uint32_t index) const { return loops_[index]; }
  void move(std::uint32_t vertex, const glm::vec3& position) { vertices_[vertex].position = position; }

  // One step along. O(1).
  std::uint32_t from(Half half) const { return edges_[half >> 1].vertex[half & 1]; }
  std::uint32_t to(Half half) const { return edges_[half >> 1].vertex[(half ^ 1) & 1]; }
  std::uint32_t left(Half half) const { return edges_[half >> 1].face[half & 1]; }
  static Half twin(Half half) { return half ^ 1; }
  /// The next one of the loop to the left of it.
  Half next(Half half) const {
    const std::uint32_t wing = edges_[half >> 1].wing[(half & 1) == 0 ? 2 : 1];
    return wing << 1 | (edges_[wing].vertex[0] == to(half) ? 0U : 1U);
  }
  Half previous(Half half) const {
    const std::uint32_t wing = edges_[half >> 1].wing[(half & 1) == 0 ? 0 : 3];
    return wing << 1 | (edges_[wing].vertex[1] == from(half) ? 0U : 1U);
  }
  /// The next one that leaves the same vertex, counter-clockwise seen from outside.
  Half around(Half half) const { return twin(previous(half)); }
  bool is_border(std::uint32_t edge) const {
    return edges_[edge].face[0] == kNoElement || edges_[edge].face[1] == kNoElement;
  }

  /// Halves that follow each other, once around.
  template <Half (WingedEdge::*step)(Half) const>
  class Ring {
   public:
    class Iterator {
     public:
      using iterator_category = std::forward_iterator_tag;
      using value_type = Half;
      using difference_type = std::ptrdiff_t;
      using pointer = const Half*;
      using reference = Half;
      Iterator() = default;
      Iterator(const WingedEdge* solid, Half at, Half first) : solid_(solid), at_(at), first_(first) {}
      Half operator*() const { return at_; }
      Iterator& operator++() {
        at_ = (solid_->*step)(at_);
        if (at_ == first_) at_ = kNoElement;
        return *this;
      }
      Iterator operator++(int) {
        const Iterator before = *this;
        ++*this;
        return before;
      }
      bool operator==(const Iterator& other) const { return at_ == other.at_; }

     private:
      const WingedEdge* solid_ = nullptr;
      Half at_ = kNoElement;
      Half first_ = kNoElement;
    };
    Ring(const WingedEdge& solid, Half first) : solid_(&solid), first_(first) {}
    Iterator begin() const { return {solid_, first_, first_}; }
    Iterator end() const { return {solid_, kNoElement, first_}; }
    bool empty() const { return first_ == kNoElement; }

   private:
    const WingedEdge* solid_;
    Half first_;  ///< kNoElement: there are none
  };

  /// The halves that leave a vertex, counter-clockwise: edges_of(v) are their edges (half >> 1).
  Ring<&WingedEdge::around> edges_of(std::uint32_t vertex) const { return {*this, leaving(vertex)}; }
  /// The halves of a loop; a lone vertex has none.
  Ring<&WingedEdge::next> halves_of(std::uint32_t loop) const { return {*this, loops_[loop].half}; }
  /// The halves from this one on, once around its face or border.
  Ring<&WingedEdge::next> loop_of(Half half) const { return {*this, half}; }
  /// The vertices of a face, loop by loop.
  std::vector<std::uint32_t> vertices_of(std::uint32_t face) const;
  /// The faces around a vertex, counter-clockwise; a border is left out.
  std::vector<std::uint32_t> faces_of(std::uint32_t vertex) const;
  std::vector<std::uint32_t> loops_of(std::uint32_t face) const;
  /// Of the face to the left of a half: the loop that it is in. O(edges of the face's loops but one).
  std::uint32_t loop_with(Half half) const;
  std::size_t degree(std::uint32_t vertex) const;
  /// The half from one vertex to another; kNoElement if no edge joins them. Of several, the first around.
  Half find(std::uint32_t from_vertex, std::uint32_t to_vertex) const;

  // Euler operators: each keeps V + F − E − (L − F) − 2 (S − G) = 0. Each throws Error(Argument) and changes nothing
  // where it isn't possible, and each undoes the other of its pair, numbers included.

  /// A vertex and a face that it lies in: a shell of its own.
  struct Made {
    std::uint32_t vertex = kNoElement;
    std::uint32_t edge = kNoElement;
    std::uint32_t face = kNoElement;
    std::uint32_t loop = kNoElement;
  };
  Made make_vertex_face_shell(const glm::vec3& position);
  void kill_vertex_face_shell(std::uint32_t face);

  /// An edge from a vertex to a new one, a spur into the face to the left of `before`, a half that leaves the vertex: it
  /// follows the half before that one around the face.
  Made make_edge_vertex(Half before, const glm::vec3& position);
  /// The same from the lone vertex of a loop.
  Made make_edge_vertex_at(std::uint32_t loop, const glm::vec3& position);
  /// The edge and the second end of a half, whose only edge it is.
  void kill_edge_vertex(Half half);

  /// An edge from the vertex that `begin` leaves to that which `end` leaves, both of one loop; a new face gets the part
  /// of the loop from `begin` on up to `end`, and the new edge back. Both halves must be different, and so their vertices.
  Made make_edge_face(Half begin, Half end);
  /// The edge of a half and the face to the left of it, which has one loop; that to the right gets its edges.
  void kill_edge_face(Half half);

  /// An edge with the same loop on both sides goes: what the half leads to becomes a hole, or a lone vertex, of the face.
  /// Where it comes from there must be other edges.
  Made kill_edge_make_loop(Half half);
  /// An edge from the vertex that `outer` leaves to that which `inner` leaves, of two loops of one face: one is left,
  /// that of `outer`. Of the inverse, `outer` follows the edge's half back, `inner` its half there.
  Made make_edge_kill_loop(Half outer, Half inner);
  /// The same, to the lone vertex of a loop.
  Made make_edge_kill_loop_at(Half outer, std::uint32_t lone_loop);

  /// A face with one loop goes, which becomes a hole of the other: two shells become one, or one gets a handle.
  Made kill_face_make_loop(std::uint32_t kept, std::uint32_t killed);
  /// A loop of a face that has others becomes a face of its own.
  Made make_face_kill_loop(std::uint32_t loop);
  /// A hole goes to another face: where an edge has divided the one that it was in.
  void move_loop(std::uint32_t loop, std::uint32_t face);

  // Changes of an edge, composed of the above where they touch faces.

  /// A new vertex on an edge, which keeps its first end; the new edge goes from there to its second. Undone by
  /// `join_edges`.
  Made split_edge(std::uint32_t edge, const glm::vec3& position);
  /// The vertex between two edges that has no others, and the edge `edge`, go.
  void join_edges(std::uint32_t edge, std::uint32_t vertex);

  /// Why an edge can't be collapsed or flipped; nullptr if it can.
  const char* why_not_collapse(std::uint32_t edge) const;
  const char* why_not_flip(std::uint32_t edge) const;
  /// The second end of an edge becomes the first; triangles beside it go, other faces lose a vertex. The link condition
  /// keeps the surface a manifold of the same genus: else Error(Argument).
  void collapse_edge(std::uint32_t edge, const glm::vec3& position);
  /// The edge between two triangles becomes the other diagonal, turned counter-clockwise; flipping it four times is
  /// nothing. Error(Argument) where that edge is there already, or a border.
  void flip_edge(std::uint32_t edge);

  /// What breaks the structure, a line each, naming elements; empty: it is sound. Cost O(elements).
  std::vector<std::string> faults(std::size_t at_most = 20) const;

  /// From the records of a table, unchecked: ask `faults` before anything else. Faces have one loop.
  /// face_edges  one of the edges of each face
  static WingedEdge from_records(std::vector<Vertex> vertices, std::vector<Edge> edges,
                                 const std::vector<std::uint32_t>& face_edges);

  /// As the text of a course on it would print: faces with their edges, edges with vertices, faces and wings, vertices
  /// with their positions and edges.
  std::string table() const;

  /// Of its records, those killed included.
  std::size_t memory_bytes() const {
    return vertices_.size() * sizeof(Vertex) + edges_.size() * sizeof(Edge) + faces_.size() * sizeof(Face) +
           loops_.size() * sizeof(Loop);
  }

  std::size_t shell_count() const;
  std::size_t border_loop_count() const;

 private:
  friend class WingedEdgeBuilder;

  Half leaving(std::uint32_t vertex) const {
    const std::uint32_t edge = vertices_[vertex].edge;
    return edge == kNoElement ? kNoElement : edge << 1 | (edges_[edge].vertex[0] == vertex ? 0U : 1U);
  }
  void link(Half before, Half after);
  void set_left(Half half, std::uint32_t face) { edges_[half >> 1].face[half & 1] = face; }
  void hang(std::uint32_t face, std::uint32_t loop);
  void unhang(std::uint32_t loop);
  void point_at(std::uint32_t vertex, Half half) { vertices_[vertex].edge = half >> 1; }
  std::uint32_t new_vertex(const glm::vec3& position, std::uint32_t source);
  std::uint32_t new_edge(std::uint32_t first, std::uint32_t second);
  std::uint32_t new_face(std::uint32_t source);
  std::uint32_t new_loop(std::uint32_t face);
  void free_vertex(std::uint32_t vertex);
  void free_edge(std::uint32_t edge);
  void free_face(std::uint32_t face);
  void free_loop(std::uint32_t loop);

  Array<Vertex> vertices_;
  Array<Edge> edges_;
  Array<Face> faces_;
  Array<Loop> loops_;
  std::vector<std::uint32_t> free_vertices_;
  std::vector<std::uint32_t> free_edges_;
  std::vector<std::uint32_t> free_faces_;
  std::vector<std::uint32_t> free_loops_;
};

}  // namespace azulejo
