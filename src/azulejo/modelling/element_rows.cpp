#include "azulejo/modelling/element_rows.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace azulejo {
namespace {

std::size_t components(const Attribute& attribute) { return static_cast<std::size_t>(attribute.components); }

double stored(const Attribute& attribute, std::size_t element, std::size_t component) {
  return std::visit(
      [&](const auto& values) { return static_cast<double>(values[element * components(attribute) + component]); },
      attribute.values);
}

template <class T>
T rounded(double value) {
  if constexpr (std::is_same_v<T, float>) {
    return static_cast<float>(value);
  } else {
    const double top = static_cast<double>(std::numeric_limits<T>::max());
    return static_cast<T>(std::clamp(std::round(value), 0.0, top));
  }
}

}  // namespace

ElementRows::ElementRows(const Mesh& mesh) : mesh_(mesh), places_(mesh.attributes.size()) {
  for (std::size_t a = 0; a < mesh.attributes.size(); ++a) {
    const Attribute& attribute = mesh.attributes[a];
    if (attribute.domain == Domain::Face) continue;
    places_[a].at_corner = corner_size_;
    corner_size_ += components(attribute);
    if (attribute.domain != Domain::Vertex) continue;
    places_[a].at_vertex = vertex_size_;
    vertex_size_ += components(attribute);
  }
  for (std::size_t i = 0; i < mesh.morph_targets.size(); ++i) {
    morph_places_.push_back(vertex_size_);
    vertex_size_ += 6;
  }
}

void ElementRows::add_vertex_row(std::uint32_t row, double weight, double* sum) const {
  if (row >= mesh_.vertex_count()) {
    const double* added = vertex_rows_.data() + (row - mesh_.vertex_count()) * vertex_size_;
    for (std::size_t i = 0; i < vertex_size_; ++i) sum[i] += weight * added[i];
    return;
  }
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Attribute& attribute = mesh_.attributes[a];
    if (attribute.domain != Domain::Vertex) continue;
    for (std::size_t c = 0; c < components(attribute); ++c) {
      sum[places_[a].at_vertex + c] += weight * stored(attribute, row, c);
    }
  }
  for (std::size_t i = 0; i < morph_places_.size(); ++i) {
    const MorphTarget& target = mesh_.morph_targets[i];
    for (int c = 0; c < 3; ++c) {
      double* const to = sum + morph_places_[i] + c;
      if (!target.positions.empty()) to[0] += weight * static_cast<double>(target.positions[row][c]);
      if (!target.normals.empty()) to[3] += weight * static_cast<double>(target.normals[row][c]);
    }
  }
}

void ElementRows::add_corner_row(std::uint32_t row, double weight, double* sum) const {
  if (row >= mesh_.corner_count()) {
    const double* added = corner_rows_.data() + (row - mesh_.corner_count()) * corner_size_;
    for (std::size_t i = 0; i < corner_size_; ++i) sum[i] += weight * added[i];
    return;
  }
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Attribute& attribute = mesh_.attributes[a];
    if (attribute.domain == Domain::Face) continue;
    const std::size_t element = attribute.domain == Domain::Corner ? row : mesh_.corners[row];
    for (std::size_t c = 0; c < components(attribute); ++c) {
      sum[places_[a].at_corner + c] += weight * stored(attribute, element, c);
    }
  }
}

std::uint32_t ElementRows::mix_vertices(std::span<const std::uint32_t> rows, std::span<const double> weights) {
  std::vector<double> sum(vertex_size_, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) add_vertex_row(rows[i], weights[i], sum.data());
  vertex_rows_.insert(vertex_rows_.end(), sum.begin(), sum.end());
  return static_cast<std::uint32_t>(mesh_.vertex_count() + added_vertices_++);
}

std::uint32_t ElementRows::mix_corners(std::span<const std::uint32_t> rows, std::span<const double> weights) {
  std::vector<double> sum(corner_size_, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) add_corner_row(rows[i], weights[i], sum.data());
  corner_rows_.insert(corner_rows_.end(), sum.begin(), sum.end());
  return static_cast<std::uint32_t>(mesh_.corner_count() + added_corners_++);
}

void ElementRows::set_vertex_normal(std::uint32_t row, const glm::vec3& normal) {
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Attribute& attribute = mesh_.attributes[a];
    if (attribute.name != "NORMAL" || attribute.domain != Domain::Vertex || attribute.components != 3) continue;
    double* const to = &vertex_rows_[(row - mesh_.vertex_count()) * vertex_size_ + places_[a].at_vertex];
    for (int c = 0; c < 3; ++c) to[c] = static_cast<double>(normal[c]);
  }
}

void ElementRows::set_corner_normal(std::uint32_t row, const glm::vec3& normal) {
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Attribute& attribute = mesh_.attributes[a];
    if (attribute.name != "NORMAL" || attribute.domain == Domain::Face || attribute.components != 3) continue;
    double* const to = &corner_rows_[(row - mesh_.corner_count()) * corner_size_ + places_[a].at_corner];
    for (int c = 0; c < 3; ++c) to[c] = static_cast<double>(normal[c]);
  }
}

double ElementRows::value(std::size_t attribute, bool at_corner, std::uint32_t row, int component) const {
  const Attribute& of = mesh_.attributes[attribute];
  const auto c = static_cast<std::size_t>(component);
  if (at_corner) {
    if (row >= mesh_.corner_count()) {
      return corner_rows_[(row - mesh_.corner_count()) * corner_size_ + places_[attribute].at_corner + c];
    }
    return stored(of, of.domain == Domain::Corner ? row : mesh_.corners[row], c);
  }
  if (of.domain == Domain::Vertex && row >= mesh_.vertex_count()) {
    return vertex_rows_[(row - mesh_.vertex_count()) * vertex_size_ + places_[attribute].at_vertex + c];
  }
  return stored(of, row, c);
}

Attribute ElementRows::chosen(std::size_t attribute, bool at_corner, const Array<std::uint32_t>& rows) const {
  const Attribute& of = mesh_.attributes[attribute];
  Attribute result{of.name, at_corner ? Domain::Corner : of.domain, of.components, {}};
  const std::size_t own = at_corner                     ? mesh_.corner_count()
                          : of.domain == Domain::Vertex ? mesh_.vertex_count()
                                                        : mesh_.face_count();
  std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        std::decay_t<decltype(values)> all(rows.size() * components(of));
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const bool added = rows[i] >= own;
          const std::size_t element = added                                      ? 0
                                      : at_corner && of.domain == Domain::Vertex ? mesh_.corners[rows[i]]
                                                                                 : rows[i];
          for (int c = 0; c < of.components; ++c) {
            const std::size_t to = i * components(of) + static_cast<std::size_t>(c);
            all[to] = added ? rounded<T>(value(attribute, at_corner, rows[i], c))
                            : values[element * components(of) + static_cast<std::size_t>(c)];
          }
        }
        result.values = std::move(all);
      },
      of.values);
  return result;
}

Attribute ElementRows::picked(std::size_t attribute, const Array<std::uint32_t>& rows) const {
  return chosen(attribute, mesh_.attributes[attribute].domain == Domain::Corner, rows);
}

Attribute ElementRows::picked_at_corners(std::size_t attribute, const Array<std::uint32_t>& corners) const {
  return chosen(attribute, true, corners);
}

bool ElementRows::differs(std::size_t attribute, const Array<std::uint32_t>& corner_rows,
                          const Array<std::uint32_t>& rows_of_their_vertices) const {
  const Attribute& of = mesh_.attributes[attribute];
  for (std::size_t i = 0; i < corner_rows.size(); ++i) {
    if (corner_rows[i] >= mesh_.corner_count()) continue;
    const std::uint32_t own = mesh_.corners[corner_rows[i]];
    if (own == rows_of_their_vertices[i]) continue;
    for (int c = 0; c < of.components; ++c) {
      const double here = value(attribute, true, corner_rows[i], c);
      const double there = value(attribute, false, rows_of_their_vertices[i], c);
      if (!(here == there) && !(std::isnan(here) && std::isnan(there))) return true;
    }
  }
  return false;
}

MorphTarget ElementRows::picked(const MorphTarget& target, std::size_t index,
                                const Array<std::uint32_t>& vertices) const {
  MorphTarget result;
  result.name = target.name;
  for (const bool normals : {false, true}) {
    const Array<glm::vec3>& from = normals ? target.normals : target.positions;
    if (from.empty()) continue;
    Array<glm::vec3>& to = normals ? result.normals : result.positions;
    to.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (vertices[i] < from.size()) {
        to[i] = from[vertices[i]];
        continue;
      }
      const double* const added =
          &vertex_rows_[(vertices[i] - mesh_.vertex_count()) * vertex_size_ + morph_places_[index] + (normals ? 3 : 0)];
      to[i] = glm::vec3(glm::dvec3(added[0], added[1], added[2]));
    }
  }
  return result;
}

}  // namespace azulejo
