#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/decimate_parts.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/picked_attribute.h"

namespace azulejo::decimation {
namespace {

/// Directions that were interpolated have length 1 again.
void make_unit(Attribute& attribute) {
  auto* const values = std::get_if<Array<float>>(&attribute.values);
  if (values == nullptr || attribute.components < 3) return;
  const auto step = static_cast<std::size_t>(attribute.components);
  for (std::size_t i = 0; i < values->size(); i += step) {
    float* const at = values->data() + i;
    const double length =
        std::hypot(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2]));
    for (std::size_t c = 0; c < 3 && length > 0; ++c) at[c] = static_cast<float>(at[c] / length);
    if (step == 4) at[3] = at[3] < 0 ? -1.0F : 1.0F;
  }
}

class Writer {
 public:
  Writer(const Mesh& source, const Surface& surface, const Attribute* faceted, const Run& run)
      : source_(source), surface_(surface), faceted_(faceted), run_(run) {}

  Mesh write() {
    result_.name = source_.name;
    result_.space = source_.space;
    number_vertices();
    write_faces();
    for (std::size_t a = 0; a < source_.attributes.size(); ++a) write_attribute(a);
    for (const MorphTarget& target : source_.morph_targets) {
      result_.morph_targets.push_back({target.name, picked_points(target.positions), picked_points(target.normals)});
    }
    return std::move(result_);
  }

 private:
  std::uint32_t home(std::uint32_t wedge) const { return surface_.home.empty() ? wedge : surface_.home[wedge]; }

  /// Vertices in the order of those of the source that they stand for.
  void number_vertices() {
    Array<std::uint32_t> wedge_of(source_.vertex_count());
    Array<std::uint32_t> vertex_of(source_.vertex_count());
    std::fill(wedge_of.begin(), wedge_of.end(), kNone);
    std::fill(vertex_of.begin(), vertex_of.end(), kNone);
    const Surface& s = surface_;
    for (std::uint32_t c = 0; c < s.corners.size(); ++c) {
      if (s.gone(c)) continue;
      const std::uint32_t at = home(s.wedge(c));
      wedge_of[at] = std::min(wedge_of[at], s.wedge(c));
      vertex_of[at] = s.corners[c];
    }
    Array<std::uint32_t> kept_lines(source_.lines.size());
    number_.resize(source_.vertex_count());
    std::fill(number_.begin(), number_.end(), kNone);
    for (const std::uint32_t vertex : source_.lines) {
      if (vertex_of[vertex] == kNone) number_[vertex] = kLoose;
    }
    for (std::uint32_t v = 0; v < number_.size(); ++v) {
      const bool loose = vertex_of[v] == kNone && number_[v] == kLoose;
      if (vertex_of[v] == kNone && !loose) continue;
      number_[v] = static_cast<std::uint32_t>(result_.positions.size());
      result_.positions.push_back(loose ? source_.positions[v] : s.vertices[vertex_of[v]].position);
      wedges_.push_back(wedge_of[v]);
      const std::uint32_t corner = wedge_of[v] == kNone ? kNone : s.origin[wedge_of[v]];
      sources_.push_back(corner == kNone ? v : source_.corners[corner]);
    }
    for (std::size_t i = 0; i < source_.lines.size(); ++i) kept_lines[i] = number_[source_.lines[i]];
    result_.lines = std::move(kept_lines);
  }

  void write_faces() {
    const Surface& s = surface_;
    for (std::uint32_t c = 0; c < s.corners.size(); ++c) {
      if (s.gone(c)) continue;
      result_.corners.push_back(number_[home(s.wedge(c))]);
      if (c % 3 == 0) faces_.push_back(static_cast<std::uint32_t>(s.source_face(c / 3)));
    }
    if (source_.material.empty()) return;
    result_.material.resize(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) result_.material[f] = source_.material[faces_[f]];
  }

  /// The wedges of the corners that are left.
  const Array<std::uint32_t>& corner_wedges() {
    if (corner_wedges_.empty()) {
      for (std::uint32_t c = 0; c < surface_.corners.size(); ++c) {
        if (!surface_.gone(c)) corner_wedges_.push_back(surface_.wedge(c));
      }
    }
    return corner_wedges_;
  }

  void write_attribute(std::size_t which) {
    const Attribute& attribute = source_.attributes[which];
    if (&attribute == faceted_) {
      result_.attributes.push_back(flat_normals());
      return;
    }
    Array<std::uint32_t> elements;
    if (attribute.domain == Domain::Face) {
      elements = faces_;
    } else if (attribute.domain == Domain::Vertex) {
      elements = sources_;
    } else {
      for (const std::uint32_t wedge : corner_wedges()) elements.push_back(surface_.origin[wedge]);
    }
    Attribute result = picked(attribute, elements);
    const Array<std::uint32_t>& wedges = attribute.domain == Domain::Vertex ? wedges_ : corner_wedges();
    if (attribute.domain != Domain::Face) write_columns(which, wedges, result);
    result_.attributes.push_back(std::move(result));
  }

  void write_columns(std::size_t which, const Array<std::uint32_t>& wedges, Attribute& result) const {
    const WedgeValues& values = surface_.values;
    bool any = false;
    for (std::size_t j = 0; j < values.columns.size(); ++j) {
      const WedgeValues::Column& column = values.columns[j];
      if (column.attribute != which) continue;
      any = true;
      std::visit(
          [&](auto& array) {
            using T = typename std::decay_t<decltype(array)>::value_type;
            for (std::size_t i = 0; i < wedges.size(); ++i) {
              if (wedges[i] == kNone) continue;
              const double value =
                  values.values[wedges[i] * values.columns.size() + j] / static_cast<double>(column.scale);
              T& at =
                  array[i * static_cast<std::size_t>(result.components) + static_cast<std::size_t>(column.component)];
              at = std::is_integral_v<T> ? static_cast<T>(std::lround(value)) : static_cast<T>(value);
            }
          },
          result.values);
    }
    if (any && (result.name == "NORMAL" || result.name == "TANGENT")) make_unit(result);
  }

  /// The normals of faces, at their corners.
  Attribute flat_normals() const {
    const Array<glm::vec3> normals = face_normals(result_, run_);
    Array<float> values;
    values.reserve(9 * normals.size());
    for (const glm::vec3& normal : normals) {
      for (int k = 0; k < 3; ++k) values.insert(values.end(), {normal.x, normal.y, normal.z});
    }
    return {"NORMAL", Domain::Corner, 3, std::move(values)};
  }

  Array<glm::vec3> picked_points(const Array<glm::vec3>& points) const {
    Array<glm::vec3> result;
    if (points.empty()) return result;
    result.reserve(sources_.size());
    for (const std::uint32_t vertex : sources_) result.push_back(points[vertex]);
    return result;
  }

  static constexpr std::uint32_t kLoose = kNone - 1;

  const Mesh& source_;
  const Surface& surface_;
  const Attribute* faceted_;
  const Run& run_;
  Mesh result_;
  Array<std::uint32_t> number_;   ///< of vertices of the source
  Array<std::uint32_t> wedges_;   ///< of the result's vertices
  Array<std::uint32_t> sources_;  ///< the vertices of the source whose values they take as they are
  Array<std::uint32_t> faces_;    ///< of the source
  Array<std::uint32_t> corner_wedges_;
};

}  // namespace

Mesh mesh_of(const Mesh& source, const Surface& surface, const Attribute* faceted, const Run& run) {
  return Writer(source, surface, faceted, run).write();
}

}  // namespace azulejo::decimation
