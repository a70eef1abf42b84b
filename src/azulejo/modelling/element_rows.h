#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// What the vertices and corners of a mesh have beside their places, as rows of numbers that can be mixed; and further
/// rows for elements that are added, numbered on from the mesh's own.
///
/// A vertex has its vertex attributes and what morph targets add; a corner its corner attributes and all of its vertex.
class ElementRows {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  explicit ElementRows(const Mesh& mesh);

  /// Adds the sum of rows, each times its weight; returns its number.
  std::uint32_t mix_vertices(std::span<const std::uint32_t> rows, std::span<const double> weights);
  std::uint32_t mix_corners(std::span<const std::uint32_t> rows, std::span<const double> weights);
  /// Sets NORMAL of added rows.
  void set_vertex_normal(std::uint32_t row, const glm::vec3& normal);
  void set_corner_normal(std::uint32_t row, const glm::vec3& normal);

  /// The attribute with the values of these vertices, corners or (of the mesh only) faces, as its domain is.
  Attribute picked(std::size_t attribute, const Array<std::uint32_t>& rows) const;
  /// A vertex attribute with the values of these corners.
  Attribute picked_at_corners(std::size_t attribute, const Array<std::uint32_t>& corners) const;
  /// Whether some corner's own vertex has another value of a vertex attribute than the vertex that it now has.
  bool differs(std::size_t attribute, const Array<std::uint32_t>& corner_rows,
               const Array<std::uint32_t>& rows_of_their_vertices) const;
  MorphTarget picked(const MorphTarget& target, std::size_t index, const Array<std::uint32_t>& vertices) const;

 private:
  /// Where an attribute's numbers stand in a row.
  struct Place {
    std::size_t at_vertex = 0;
    std::size_t at_corner = 0;
  };
  void add_vertex_row(std::uint32_t row, double weight, double* sum) const;
  void add_corner_row(std::uint32_t row, double weight, double* sum) const;
  double value(std::size_t attribute, bool at_corner, std::uint32_t row, int component) const;
  Attribute chosen(std::size_t attribute, bool at_corner, const Array<std::uint32_t>& rows) const;

  const Mesh& mesh_;
  std::vector<Place> places_;
  std::vector<std::size_t> morph_places_;  ///< in a vertex's row: positions, then normals
  std::size_t vertex_size_ = 0;
  std::size_t corner_size_ = 0;
  std::vector<double> vertex_rows_;  ///< of added ones
  std::vector<double> corner_rows_;
  std::size_t added_vertices_ = 0;
  std::size_t added_corners_ = 0;
};

}  // namespace azulejo
