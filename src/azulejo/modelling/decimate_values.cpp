#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/decimate_parts.h"

namespace azulejo::decimation {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 12;

bool is_interpolated(const Attribute& attribute) {
  return attribute.domain != Domain::Face && attribute.get<std::uint32_t>() == nullptr &&
         attribute.name.rfind("WEIGHTS_", 0) != 0 && attribute.name.rfind("JOINTS_", 0) != 0;
}

/// Whether it is seen: others are carried along.
bool is_appearance(const Attribute& attribute) {
  return attribute.name == "NORMAL" || attribute.name.rfind("TEXCOORD_", 0) == 0 ||
         attribute.name.rfind("COLOR_", 0) == 0;
}

double value_at(const Attribute& attribute, std::size_t index) {
  const double value =
      std::visit([&](const auto& values) { return static_cast<double>(values[index]); }, attribute.values);
  return std::isfinite(value) ? value : 0;
}

/// The columns of an attribute, all with the scale of the one that differs most.
void add_columns(const Mesh& mesh, std::size_t which, double weight, std::vector<WedgeValues::Column>& columns) {
  const Attribute& attribute = mesh.attributes[which];
  const auto components = static_cast<std::size_t>(attribute.components);
  const std::size_t first = columns.size();
  const bool normal = attribute.name == "NORMAL";
  double range = normal ? 1 : 0;
  for (std::size_t c = 0; c < components; ++c) {
    WedgeValues::Column column{which, static_cast<int>(c), 0, std::numeric_limits<float>::max(),
                               std::numeric_limits<float>::lowest()};
    for (std::size_t i = c; i < attribute.size() * components; i += components) {
      const auto value = static_cast<float>(value_at(attribute, i));
      column.lower = std::min(column.lower, value);
      column.upper = std::max(column.upper, value);
    }
    if (!normal) range = std::max(range, static_cast<double>(column.upper) - static_cast<double>(column.lower));
    columns.push_back(column);
  }
  const auto scale = static_cast<float>(range > 0 && is_appearance(attribute) ? weight / range : 0);
  for (std::size_t c = first; c < columns.size(); ++c) columns[c].scale = std::isfinite(scale) ? scale : 0;
}

/// Adds what the columns do over a triangle to the wedge of one of its corners.
void add_triangle(const Surface& surface, std::uint32_t corner, WedgeValues& values) {
  const std::array<std::uint32_t, 3> corners{corner, next_of(corner), previous_of(corner)};
  const glm::dvec3 origin = surface.place(surface.corners[corners[0]]);
  const glm::dvec3 a = surface.place(surface.corners[corners[1]]) - origin;
  const glm::dvec3 b = surface.place(surface.corners[corners[2]]) - origin;
  const glm::dvec3 product = glm::cross(a, b);
  const double squared = glm::dot(product, product);
  // Over faces that are nearly lines values have no slope.
  if (!(squared > 1e-12 * glm::dot(a, a) * glm::dot(b, b)) || !std::isfinite(squared)) return;
  const glm::dvec3 along_a = glm::cross(b, product) / squared;
  const glm::dvec3 along_b = glm::cross(product, a) / squared;
  const double weight = face_weight(0.5 * std::sqrt(squared));
  const std::size_t wedge = surface.wedge(corner);
  const std::size_t width = values.columns.size();
  const auto value = [&](std::size_t k, std::size_t column) {
    return values.values[surface.wedge(corners[k]) * width + column];
  };
  for (std::size_t j = 0; j < values.metric; ++j) {
    const double here = value(0, j);
    const glm::dvec3 slope = (value(1, j) - here) * along_a + (value(2, j) - here) * along_b;
    const double level = here - glm::dot(slope, origin);
    values.quadrics[wedge].add(slope, level, weight);
    std::array<double, 4>& sum = values.gradients[wedge * values.metric + j];
    for (int k = 0; k < 3; ++k) sum[static_cast<std::size_t>(k)] += weight * slope[k];
    sum[3] += weight * level;
  }
  values.quadrics[wedge].weight += weight;
}

/// Σ weight · value of column j at a place, of a pair.
double summed(const WedgeValues& values, const WedgePair& pair, std::size_t j, const glm::dvec3& place) {
  const std::array<double, 4>& a = values.gradients[pair.gone * values.metric + j];
  const std::array<double, 4>& b = values.gradients[pair.kept * values.metric + j];
  return (a[0] + b[0]) * place.x + (a[1] + b[1]) * place.y + (a[2] + b[2]) * place.z + a[3] + b[3];
}

double weight_of(const WedgeValues& values, const WedgePair& pair) {
  return values.quadrics[pair.gone].weight + values.quadrics[pair.kept].weight;
}

}  // namespace

void build_values(const Mesh& mesh, const DecimateOptions& options, const Attribute* faceted, Surface& surface,
                  const Run& run) {
  WedgeValues& values = surface.values;
  for (std::size_t a = 0; a < mesh.attributes.size(); ++a) {
    const Attribute& attribute = mesh.attributes[a];
    if (&attribute == faceted || !is_interpolated(attribute) || attribute.size() == 0) continue;
    add_columns(mesh, a, options.attribute_weight, values.columns);
  }
  if (values.columns.empty()) return;
  std::stable_partition(values.columns.begin(), values.columns.end(),
                        [](const WedgeValues::Column& column) { return column.scale > 0; });
  for (WedgeValues::Column& column : values.columns) {
    if (column.scale > 0) {
      ++values.metric;
    } else {
      column.scale = 1;
    }
  }
  const std::size_t width = values.columns.size();
  const std::size_t wedges = surface.origin.size();
  values.values.resize(wedges * width);
  parallel_for(wedges, kPiece, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
      for (std::size_t j = 0; j < width; ++j) {
        const WedgeValues::Column& column = values.columns[j];
        const Attribute& attribute = mesh.attributes[column.attribute];
        double value = 0;
        if (surface.origin[w] != kNone) {
          const std::size_t element =
              attribute.domain == Domain::Corner ? surface.origin[w] : mesh.corners[surface.origin[w]];
          value = value_at(attribute, element * static_cast<std::size_t>(attribute.components) +
                                          static_cast<std::size_t>(column.component));
        }
        values.values[w * width + j] = value * static_cast<double>(column.scale);
      }
    }
  });
  if (!values.in_metric()) return;
  values.quadrics.assign(wedges, Quadric());
  values.gradients.assign(wedges * values.metric, std::array<double, 4>{});
  parallel_for(surface.vertices.size(), kPiece, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      surface.each_corner(static_cast<std::uint32_t>(v),
                          [&](std::uint32_t corner) { add_triangle(surface, corner, values); });
    }
  });
}

Quadric value_quadric(const WedgeValues& values, const WedgePair& pair) {
  Quadric sum = values.quadrics[pair.gone];
  sum += values.quadrics[pair.kept];
  const double weight = sum.weight;
  sum.weight = 0;
  if (!(weight > 0)) return Quadric();
  for (std::size_t j = 0; j < values.metric; ++j) {
    const std::array<double, 4>& a = values.gradients[pair.gone * values.metric + j];
    const std::array<double, 4>& b = values.gradients[pair.kept * values.metric + j];
    sum.add({a[0] + b[0], a[1] + b[1], a[2] + b[2]}, a[3] + b[3], -1 / weight);
  }
  return sum;
}

double value_cost(const WedgeValues& values, const WedgePair& pair, const glm::dvec3& place) {
  const double weight = weight_of(values, pair);
  if (!(weight > 0)) return 0;
  double cost = 0;
  for (std::size_t j = 0; j < values.metric; ++j) {
    const double apart = values.values[pair.kept * values.columns.size() + j] - summed(values, pair, j, place) / weight;
    cost += weight * apart * apart;
  }
  return cost;
}

void merge_values(Surface& surface, const WedgePair& pair, const Plan& plan) {
  const glm::dvec3 place = surface.scaled(plan.place);
  const glm::dvec3 from = surface.place(plan.kept);
  const glm::dvec3 along = surface.place(plan.gone) - from;
  const double squared = glm::dot(along, along);
  const double share = squared > 0 ? std::clamp(glm::dot(place - from, along) / squared, 0.0, 1.0) : 0;
  if (share > 0.5) surface.origin[pair.kept] = surface.origin[pair.gone];
  WedgeValues& values = surface.values;
  const std::size_t width = values.columns.size();
  const double weight = values.in_metric() ? weight_of(values, pair) : 0;
  for (std::size_t j = 0; j < width && !plan.fixed; ++j) {
    double& kept = values.values[pair.kept * width + j];
    if (j < values.metric && weight > 0) {
      const WedgeValues::Column& column = values.columns[j];
      kept = std::clamp(summed(values, pair, j, place) / weight, static_cast<double>(column.lower) * column.scale,
                        static_cast<double>(column.upper) * column.scale);
    } else {
      kept += share * (values.values[pair.gone * width + j] - kept);
    }
  }
  if (!values.in_metric()) return;
  values.quadrics[pair.kept] += values.quadrics[pair.gone];
  for (std::size_t j = 0; j < values.metric; ++j) {
    std::array<double, 4>& kept = values.gradients[pair.kept * values.metric + j];
    const std::array<double, 4>& gone = values.gradients[pair.gone * values.metric + j];
    for (std::size_t k = 0; k < 4; ++k) kept[k] += gone[k];
  }
}

}  // namespace azulejo::decimation
