#include "azulejo/modelling/tangents.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/io/weld.h"
#include "azulejo/math/arctangent.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = 4096;
constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// The values of an attribute at corners.
class AtCorners {
 public:
  AtCorners(const Mesh& mesh, const Attribute& attribute)
      : values_(attribute.get<float>()->data()),
        components_(static_cast<std::size_t>(attribute.components)),
        of_(attribute.domain == Domain::Vertex ? mesh.corners.data() : nullptr) {}
  const float* operator[](std::size_t corner) const {
    return values_ + components_ * (of_ != nullptr ? of_[corner] : corner);
  }

 private:
  const float* values_;
  std::size_t components_;
  const std::uint32_t* of_;  ///< null: values are of corners
};

bool usable(const Attribute* attribute, int components) {
  return attribute != nullptr && attribute->domain != Domain::Face && attribute->components == components &&
         attribute->get<float>() != nullptr;
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

/// The part of a vector that is across a unit normal, of length 1; 0.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& normal) {
  return unit_or_zero(v - glm::dot(normal, v) * normal);
}

struct Tangent {
  glm::vec3 along{1, 0, 0};
  float sign = 1;
  friend bool operator==(const Tangent&, const Tangent&) = default;
};

Tangent any_across(const glm::dvec3& normal) {
  const bool along_x = std::abs(normal.x) > 0.9;
  const glm::dvec3 found = across(along_x ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), unit_or_zero(normal));
  return {found == glm::dvec3(0) ? glm::vec3(1, 0, 0) : glm::vec3(found), 1};
}

struct Triangle {
  glm::vec3 along{0, 0, 0};  ///< to where u rises, unit
  bool positive = false;     ///< its corners turn the same way in the texture as in space, u to the right and v up
  bool flat = false;         ///< without an area in the texture
  bool point = false;        ///< two corners at one position
};

/// One pass over the positions of a mesh: corners of triangles that lie there, joined into groups.
class Builder {
 public:
  Builder(const Mesh& mesh, const Attribute& normals, const Attribute& texture, const Run& run)
      : mesh_(mesh), normal_(mesh, normals), texture_(mesh, texture), run_(run) {
    divide();
    const Welded welded = weld_exactly(mesh.positions, run);
    Mesh at_positions;
    at_positions.positions = welded.positions;
    at_positions.corners.resize(corners_.size());
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      at_positions.corners[i] = welded.corners[mesh.corners[corners_[i]]];
    }
    around_ = corners_of_vertices(at_positions, run);
    measure();
  }

  /// Of the mesh's corners.
  std::vector<Tangent> tangents() {
    const std::size_t positions = around_.first.size() - 1;
    equal_.resize(corners_.size());
    example_.assign(corners_.size(), kNone);
    of_triangles_.resize(corners_.size());
    parallel_for(positions, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      std::vector<Key> keys;
      for (std::size_t p = begin; p < end; ++p) find_equal(p, keys);
    });
    parallel_for(positions, kChunk, run_, [&](std::size_t begin, std::size_t end) {
      Place place;
      for (std::size_t p = begin; p < end; ++p) join(p, place);
    });
    return of_corners();
  }

 private:
  using Key = std::pair<std::array<std::uint32_t, 5>, std::uint32_t>;
  struct Side {
    std::uint32_t own;    ///< what its corner equals
    std::uint32_t other;  ///< and the one at the other end of the edge
    std::uint32_t at;     ///< in the list of the position
    friend auto operator<=>(const Side&, const Side&) = default;
  };
  /// What is known of a position while it is looked at.
  struct Place {
    std::vector<Side> leaving;
    std::vector<Side> arriving;
    std::vector<std::array<std::uint32_t, 2>> links;  ///< neighbors in the list, across both edges
    std::vector<std::uint32_t> group;                 ///< of each of the list
    std::vector<std::uint32_t> waiting;
    std::vector<std::uint32_t> members;
  };

  glm::dvec3 position(std::uint32_t i) const { return glm::dvec3(mesh_.positions[mesh_.corners[corners_[i]]]); }
  glm::dvec2 uv(std::uint32_t i) const {
    const float* const t = texture_[corners_[i]];
    return {t[0], t[1]};
  }
  glm::dvec3 normal(std::uint32_t i) const {
    const float* const n = normal_[corners_[i]];
    return {n[0], n[1], n[2]};
  }
  static std::uint32_t next(std::uint32_t i) { return i % 3 == 2 ? i - 2 : i + 1; }
  static std::uint32_t previous(std::uint32_t i) { return i % 3 == 0 ? i + 2 : i - 1; }

  /// Into triangles, of the mesh's corners.
  void divide() {
    Triangulation triangles = triangulate(mesh_, run_);
    corners_ = std::move(triangles.corners);
    quad_of_.assign(corners_.size() / 3, kNone);
    if (mesh_.all_triangles()) return;
    for (std::size_t t = 0; t + 1 < triangles.face.size(); ++t) {
      const std::uint32_t face = triangles.face[t];
      const auto first = static_cast<std::uint32_t>(mesh_.face_begin(face));
      if (mesh_.face_end(face) - first != 4 || triangles.face[t + 1] != face) continue;
      const auto size = [&](std::uint32_t a, std::uint32_t b) {
        const float* const s = texture_[a];
        const float* const e = texture_[b];
        const glm::vec2 in_texture(e[0] - s[0], e[1] - s[1]);
        const glm::vec3 in_space = mesh_.positions[mesh_.corners[b]] - mesh_.positions[mesh_.corners[a]];
        return std::pair(glm::dot(in_texture, in_texture), glm::dot(in_space, in_space));
      };
      const std::uint32_t shift = size(first + 1, first + 3) < size(first, first + 2) ? 1 : 0;
      const std::array<std::uint32_t, 6> corners =
          shift == 0 ? std::array<std::uint32_t, 6>{0, 1, 2, 0, 2, 3} : std::array<std::uint32_t, 6>{0, 1, 3, 1, 2, 3};
      for (std::size_t i = 0; i < 6; ++i) corners_[3 * t + i] = first + corners[i];
      quad_of_[t] = quad_of_[t + 1] = static_cast<std::uint32_t>(t);
    }
  }

  void measure() {
    triangles_.resize(corners_.size() / 3);
    std::vector<float> areas(triangles_.size());
    parallel_for(triangles_.size(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) areas[t] = measure(static_cast<std::uint32_t>(t));
    });
    // Both halves of a quad have the handedness of the larger.
    for (std::size_t t = 0; t + 1 < triangles_.size(); ++t) {
      if (quad_of_[t] != t) continue;
      Triangle& a = triangles_[t];
      Triangle& b = triangles_[t + 1];
      if (a.point || b.point || a.positive == b.positive || (a.flat && b.flat)) continue;
      const bool first_counts = !a.flat && (b.flat || areas[t] >= areas[t + 1]);
      (first_counts ? b : a).positive = first_counts ? a.positive : b.positive;
    }
  }

  /// Gives its area in the texture.
  float measure(std::uint32_t t) {
    Triangle& triangle = triangles_[t];
    const std::uint32_t i = 3 * t;
    const glm::dvec3 p = position(i);
    const glm::dvec3 d1 = position(i + 1) - p;
    const glm::dvec3 d2 = position(i + 2) - p;
    triangle.point = d1 == glm::dvec3(0) || d2 == glm::dvec3(0) || d1 == d2;
    const glm::dvec2 t1 = uv(i + 1) - uv(i);
    const glm::dvec2 t2 = uv(i + 2) - uv(i);
    const double area = t1.x * t2.y - t1.y * t2.x;
    triangle.positive = area > 0;
    triangle.along = glm::vec3(unit_or_zero((area > 0 ? 1.0 : -1.0) * (t2.y * d1 - t1.y * d2)));
    triangle.flat = !(std::abs(area) > 0) || triangle.along == glm::vec3(0);
    return static_cast<float>(std::abs(area));
  }

  /// Of each corner at a position the first that has the same normal and texture coordinate.
  void find_equal(std::size_t p, std::vector<Key>& keys) {
    keys.clear();
    for (std::uint32_t k = around_.first[p]; k < around_.first[p + 1]; ++k) {
      const std::uint32_t i = around_.corners[k];
      const float* const n = normal_[corners_[i]];
      const float* const t = texture_[corners_[i]];
      Key& key = keys.emplace_back();
      key.second = i;
      // + 0: −0 is 0.
      key.first = {std::bit_cast<std::uint32_t>(n[0] + 0.0F), std::bit_cast<std::uint32_t>(n[1] + 0.0F),
                   std::bit_cast<std::uint32_t>(n[2] + 0.0F), std::bit_cast<std::uint32_t>(t[0] + 0.0F),
                   std::bit_cast<std::uint32_t>(t[1] + 0.0F)};
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0, first = 0; i < keys.size(); ++i) {
      if (keys[i].first != keys[first].first) first = i;
      equal_[keys[i].second] = keys[first].second;
    }
  }

  void join(std::size_t p, Place& place) {
    const std::uint32_t begin = around_.first[p];
    const std::uint32_t count = around_.first[p + 1] - begin;
    const auto corner = [&](std::uint32_t at) { return around_.corners[begin + at]; };
    link(begin, count, place);
    place.group.assign(count, kNone);
    for (std::uint32_t at = 0; at < count; ++at) {
      const Triangle& triangle = triangles_[corner(at) / 3];
      if (place.group[at] != kNone || triangle.flat || triangle.point) continue;
      collect(begin, at, place);
      const Tangent tangent = sum_of(begin, triangle.positive, place.members);
      for (const std::uint32_t each : place.members) of_triangles_[corner(each)] = tangent;
    }
    // What is in no group takes after an equal corner.
    for (std::uint32_t at = 0; at < count; ++at) {
      if (place.group[at] != kNone) example_[equal_[corner(at)]] = corner(at);
    }
    for (std::uint32_t at = 0; at < count; ++at) {
      if (place.group[at] != kNone) continue;
      const std::uint32_t like = example_[equal_[corner(at)]];
      of_triangles_[corner(at)] = like != kNone ? of_triangles_[like] : any_across(normal(corner(at)));
    }
  }

  /// Pairs the edges that leave the position with those that arrive there along the same way.
  void link(std::uint32_t begin, std::uint32_t count, Place& place) {
    place.leaving.clear();
    place.arriving.clear();
    place.links.assign(count, {kNone, kNone});
    for (std::uint32_t at = 0; at < count; ++at) {
      const std::uint32_t i = around_.corners[begin + at];
      if (triangles_[i / 3].point) continue;
      place.leaving.push_back({equal_[i], equal_[next(i)], at});
      place.arriving.push_back({equal_[i], equal_[previous(i)], at});
    }
    std::sort(place.leaving.begin(), place.leaving.end());
    std::sort(place.arriving.begin(), place.arriving.end());
    auto from = place.arriving.begin();
    for (const Side& to : place.leaving) {
      const auto way = [](const Side& side) { return std::pair(side.own, side.other); };
      while (from != place.arriving.end() && way(*from) < way(to)) ++from;
      if (from == place.arriving.end() || way(*from) != way(to)) continue;
      place.links[to.at][0] = from->at;
      place.links[from->at][1] = to.at;
      ++from;
    }
  }

  /// All that are joined to one over edges with the same handedness on both sides; rising.
  void collect(std::uint32_t begin, std::uint32_t seed, Place& place) const {
    const auto triangle = [&](std::uint32_t at) -> const Triangle& {
      return triangles_[around_.corners[begin + at] / 3];
    };
    place.members.clear();
    place.waiting.assign(1, seed);
    place.group[seed] = seed;
    while (!place.waiting.empty()) {
      const std::uint32_t at = place.waiting.back();
      place.waiting.pop_back();
      place.members.push_back(at);
      for (const std::uint32_t other : place.links[at]) {
        if (other == kNone || place.group[other] != kNone) continue;
        if (!triangle(other).flat && triangle(other).positive != triangle(seed).positive) continue;
        place.group[other] = seed;
        place.waiting.push_back(other);
      }
    }
    std::sort(place.members.begin(), place.members.end());
  }

  Tangent sum_of(std::uint32_t begin, bool positive, const std::vector<std::uint32_t>& members) const {
    const glm::dvec3 up = unit_or_zero(normal(around_.corners[begin + members[0]]));
    glm::dvec3 sum(0);
    for (const std::uint32_t at : members) {
      const std::uint32_t i = around_.corners[begin + at];
      const Triangle& triangle = triangles_[i / 3];
      if (triangle.flat) continue;
      const glm::dvec3 p = position(i);
      const glm::dvec3 a = across(position(previous(i)) - p, up);
      const glm::dvec3 b = across(position(next(i)) - p, up);
      const double sine = glm::length(glm::cross(a, b));
      const double angle =
          static_cast<double>(atan2_deterministic(static_cast<float>(sine), static_cast<float>(glm::dot(a, b))));
      sum += angle * across(glm::dvec3(triangle.along), up);
    }
    const glm::dvec3 along = unit_or_zero(sum);
    const Tangent other = any_across(up);
    return {along == glm::dvec3(0) ? other.along : glm::vec3(along), positive ? -1.0F : 1.0F};
  }

  /// A corner of several triangles of its face has the mean of their tangents, and the handedness of the first.
  std::vector<Tangent> of_corners() const {
    std::vector<Tangent> result(mesh_.corner_count());
    std::vector<std::uint8_t> known(mesh_.corner_count(), 0);
    for (std::size_t c = 0; c < result.size(); ++c) {
      const float* const n = normal_[c];
      result[c] = any_across({n[0], n[1], n[2]});
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Tangent& tangent = result[corners_[i]];
      if (known[corners_[i]] == 0) {
        tangent = of_triangles_[i];
      } else if (!(tangent == of_triangles_[i])) {
        const glm::dvec3 mean = unit_or_zero(glm::dvec3(tangent.along) + glm::dvec3(of_triangles_[i].along));
        if (mean != glm::dvec3(0)) tangent.along = glm::vec3(mean);
      }
      known[corners_[i]] = 1;
    }
    return result;
  }

  const Mesh& mesh_;
  AtCorners normal_;
  AtCorners texture_;
  const Run& run_;
  Array<std::uint32_t> corners_;        ///< of triangles, into the mesh's
  std::vector<std::uint32_t> quad_of_;  ///< of each triangle, the first of its quad; kNone
  VertexCorners around_;                ///< of each position, into corners_
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> equal_;    ///< of each of corners_
  std::vector<std::uint32_t> example_;  ///< of each that others equal, the last one in a group; kNone
  std::vector<Tangent> of_triangles_;
};

Attribute attribute_of(const Mesh& mesh, const std::vector<Tangent>& tangents) {
  std::vector<Tangent> of_vertices(mesh.vertex_count());
  std::vector<std::uint8_t> known(mesh.vertex_count(), 0);
  bool agree = true;
  for (std::size_t c = 0; c < tangents.size() && agree; ++c) {
    const std::uint32_t v = mesh.corners[c];
    agree = known[v] == 0 || of_vertices[v] == tangents[c];
    of_vertices[v] = tangents[c];
    known[v] = 1;
  }
  Array<float> values;
  values.reserve(4 * (agree ? mesh.vertex_count() : mesh.corner_count()));
  for (const Tangent& each : agree ? of_vertices : tangents) {
    values.insert(values.end(), {each.along.x, each.along.y, each.along.z, each.sign});
  }
  return {"TANGENT", agree ? Domain::Vertex : Domain::Corner, 4, std::move(values)};
}

}  // namespace

Mesh tangents(const Mesh& mesh, const TangentsOptions& options, const Run& run) {
  Mesh result = mesh.clone();
  const std::string name = fmt::format("TEXCOORD_{}", options.texcoord);
  if (mesh.face_count() == 0 || !usable(mesh.find(name), 2)) {
    warn(run, fmt::format("tangents: mesh \"{}\" has no {}, it gets none", mesh.name,
                          mesh.face_count() == 0 ? "faces" : name));
    return result;
  }
  std::erase_if(result.attributes, [](const Attribute& each) { return each.name == "TANGENT"; });
  if (!usable(result.find("NORMAL"), 3)) {
    std::erase_if(result.attributes, [](const Attribute& each) { return each.name == "NORMAL"; });
    result.attributes.push_back(vertex_normals(mesh, {}, run));
  }
  Attribute tangents =
      attribute_of(result, Builder(result, *result.find("NORMAL"), *result.find(name), run).tangents());
  result.attributes.push_back(std::move(tangents));
  return result;
}

extern const Operation kTangents =
    with_examples(value_operation<TangentsOptions>(
                      "tangents", "Gives a surface the tangents that normal textures need.",
                      {{"source", "the mesh", ValueKind::Mesh}}, {{"mesh", "the mesh with TANGENT", ValueKind::Mesh}},
                      {field("texcoord", &TangentsOptions::texcoord, {0, 7}, "", "number of the texture coordinates")},
                      [](std::span<const Value> inputs, const TangentsOptions& options, const Run& run) {
                        return std::vector<Value>{Value(tangents(*inputs[0].mesh(), options, run))};
                      }),
                  {{"primitive:kind=torus tangents render:width=480,height=360",
                    "It looks as before: tangents are for textures of normals."}});

}  // namespace azulejo
