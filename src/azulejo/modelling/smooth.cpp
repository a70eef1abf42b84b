#include "azulejo/modelling/smooth.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/tessellate.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 13;  // vertices or edges
constexpr float kPassBand = 0.1F;                     // as the paper's: kept by Taubin's two steps

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Neighbors of each vertex, and what they count; those that stay have none.
struct Neighbors {
  Array<std::uint32_t> first;
  Array<std::uint32_t> vertices;
  Array<float> weights;  ///< sum to 1 at each vertex; empty: all the same
};

/// Half the sum of the cotangents opposite to each edge of a mesh of triangles, at least 0.
Array<float> cotangents_of_edges(const Mesh& mesh, const EdgeUses& edges, const Run& run) {
  Array<float> weights(edges.size());
  parallel_for(edges.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      double sum = 0;
      for (const std::uint32_t use : edges.uses_of(e)) {
        const std::uint32_t next = edges.next[use];
        const glm::dvec3 tip = mesh.positions[mesh.corners[edges.next[next]]];
        const glm::dvec3 a = glm::dvec3(mesh.positions[mesh.corners[use]]) - tip;
        const glm::dvec3 b = glm::dvec3(mesh.positions[mesh.corners[next]]) - tip;
        const double cotangent = glm::dot(a, b) / glm::length(glm::cross(a, b));
        if (std::isfinite(cotangent)) sum += cotangent;
      }
      weights[e] = static_cast<float>(std::max(sum / 2, 0.0));
    }
  });
  return weights;
}

/// Which edges count for a vertex at their end.
class Choice {
 public:
  Choice(const Mesh& mesh, const EdgeUses& edges, SmoothBorder border)
      : mesh_(mesh), edges_(edges), border_(border), border_edges_(mesh.vertex_count(), 0) {
    if (border == SmoothBorder::Free) return;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (!is_border(e)) continue;
      for (const std::uint32_t end : edges.vertices[e]) border_edges_[end] = std::min(border_edges_[end] + 1, 3);
    }
  }

  bool counts(std::size_t edge, std::uint32_t vertex) const {
    for (const std::uint32_t end : edges_.vertices[edge]) {
      if (!is_finite(mesh_.positions[end])) return false;
    }
    if (border_edges_[vertex] == 0) return true;
    return on_curve(vertex) && is_border(edge);
  }
  /// Weighs its neighbors alike, whatever the edges say.
  bool on_curve(std::uint32_t vertex) const { return border_ == SmoothBorder::Along && border_edges_[vertex] == 2; }

 private:
  bool is_border(std::size_t edge) const { return edges_.uses_of(edge).size() == 1; }

  const Mesh& mesh_;
  const EdgeUses& edges_;
  SmoothBorder border_;
  Array<int> border_edges_;  ///< at each vertex, at most 3; none where borders are no matter
};

void normalize_weights(Neighbors& neighbors, const Choice& choice, const Run& run) {
  parallel_for(neighbors.first.size() - 1, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      float* const from = neighbors.weights.data() + neighbors.first[v];
      float* const to = neighbors.weights.data() + neighbors.first[v + 1];
      if (choice.on_curve(static_cast<std::uint32_t>(v))) std::fill(from, to, 1.0F);
      double sum = 0;
      for (const float* w = from; w < to; ++w) sum += static_cast<double>(*w);
      const double factor = sum > 0 ? 1 / sum : 0;
      std::for_each(from, to, [&](float& w) { w = static_cast<float>(static_cast<double>(w) * factor); });
    }
  });
}

Neighbors neighbors_of(const Mesh& mesh, const SmoothOptions& options, const Run& run) {
  const EdgeUses edges = edge_uses(mesh, {}, run);
  const Choice choice(mesh, edges, options.border);
  const bool weighted = options.weights == SmoothWeights::Cotangent;
  const Array<float> of_edges = weighted ? cotangents_of_edges(mesh, edges, run) : Array<float>();
  Neighbors neighbors;
  neighbors.first.assign(mesh.vertex_count() + 1, 0);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const std::uint32_t end : edges.vertices[e]) neighbors.first[end] += choice.counts(e, end) ? 1 : 0;
  }
  std::uint32_t total = 0;
  for (std::uint32_t& each : neighbors.first) total += std::exchange(each, total);
  neighbors.vertices.resize(total);
  if (weighted) neighbors.weights.resize(total);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (int i = 0; i < 2; ++i) {
      const std::uint32_t end = edges.vertices[e][static_cast<std::size_t>(i)];
      if (!choice.counts(e, end)) continue;
      const std::uint32_t place = neighbors.first[end]++;
      neighbors.vertices[place] = edges.vertices[e][static_cast<std::size_t>(1 - i)];
      if (weighted) neighbors.weights[place] = of_edges[e];
    }
  }
  // Each start has moved to the next one's place.
  std::move_backward(neighbors.first.begin(), neighbors.first.end() - 1, neighbors.first.end());
  neighbors.first[0] = 0;
  if (weighted) normalize_weights(neighbors, choice, run);
  return neighbors;
}

/// A step of a part of the way to the mean of the neighbors.
void step(const Neighbors& neighbors, double part, const Array<glm::vec3>& in, Array<glm::vec3>& out, const Run& run) {
  parallel_for(in.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t first = neighbors.first[v];
      const std::uint32_t last = neighbors.first[v + 1];
      const glm::dvec3 own(in[v]);
      glm::dvec3 away(0);  // of the mean from the vertex
      if (neighbors.weights.empty()) {
        for (std::uint32_t i = first; i < last; ++i) away += glm::dvec3(in[neighbors.vertices[i]]) - own;
        if (last > first) away *= 1.0 / (last - first);
      } else {
        for (std::uint32_t i = first; i < last; ++i) {
          away += static_cast<double>(neighbors.weights[i]) * (glm::dvec3(in[neighbors.vertices[i]]) - own);
        }
      }
      out[v] = last > first ? glm::vec3(own + part * away) : in[v];
    }
  });
}

void smooth_points(const Neighbors& neighbors, const SmoothOptions& options, double mu, Array<glm::vec3>& points,
                   const Run& run) {
  Array<glm::vec3> other(points.size());
  for (int i = 0; i < options.iterations; ++i) {
    check_cancelled(run);
    step(neighbors, static_cast<double>(options.lambda), points, other, run);
    points.swap(other);
    if (options.method == SmoothMethod::Laplacian) continue;
    step(neighbors, mu, points, other, run);
    points.swap(other);
  }
}

double second_step(const SmoothOptions& options) {
  if (options.method == SmoothMethod::Laplacian) return 0;
  float mu = options.lambda > 0 ? 1 / (kPassBand - 1 / options.lambda) : 0;
  if (options.mu) mu = *options.mu;
  if (!((1 - 2 * options.lambda) * (1 - 2 * mu) >= -1)) {
    throw Error(Error::Argument,
                fmt::format("smooth: lambda is {} and mu is {}, which makes the finest waves grow, expected "
                            "(1 - 2 lambda) (1 - 2 mu) of -1 or more",
                            options.lambda, mu));
  }
  return static_cast<double>(mu);
}

}  // namespace

extern const Operation kSmooth = with_examples(
    value_operation<SmoothOptions>(
        "smooth", "Takes noise from a surface.", {{"source", "the mesh", ValueKind::Mesh}},
        {{"mesh", "the same faces, their vertices moved", ValueKind::Mesh}},
        {field("method", &SmoothOptions::method, "taubin keeps the size, laplacian shrinks"),
         field("weights", &SmoothOptions::weights, "how much each neighbor counts"),
         field("iterations", &SmoothOptions::iterations, {0, 100000}, "", "how often"),
         field("lambda", &SmoothOptions::lambda, {0, 1}, "", "part of the way to the mean of the neighbors"),
         field("mu", &SmoothOptions::mu, {-2, 0}, "",
               "of taubin's second step, away from it; auto: 1 / (0.1 - 1 / lambda)"),
         field("border", &SmoothOptions::border, "how border vertices move: along the border, not, or as all others")},
        [](std::span<const Value> inputs, const SmoothOptions& options, const Run& run) {
          return std::vector<Value>{Value(smooth(*inputs[0].mesh(), options, run))};
        }),
    {{"primitive:kind=torus_knot,around=3,through=5,tube_radius=0.2 smooth:method=laplacian,iterations=200",
      "Laplacian smoothing makes what is thin thinner."},
     {"primitive:kind=teapot,segments=6 smooth:iterations=50,weights=cotangent",
      "Taubin's takes the edges from the teapot, and keeps its size."}});

Mesh smooth(const Mesh& mesh, const SmoothOptions& options, const Run& run) {
  kSmooth.check(&options);
  const double mu = second_step(options);
  Mesh result = mesh.clone();
  const bool triangulated = options.weights == SmoothWeights::Cotangent && !mesh.all_triangles();
  const Neighbors neighbors =
      triangulated ? neighbors_of(tessellate(mesh, run), options, run) : neighbors_of(mesh, options, run);
  smooth_points(neighbors, options, mu, result.positions, run);
  for (MorphTarget& each : result.morph_targets) {
    if (!each.positions.empty()) smooth_points(neighbors, options, mu, each.positions, run);
    each.normals.clear();
  }
  const auto stale = [](const Attribute& each) { return each.name == "NORMAL" || each.name == "TANGENT"; };
  result.attributes.erase(std::remove_if(result.attributes.begin(), result.attributes.end(), stale),
                          result.attributes.end());
  if (mesh.find("NORMAL") != nullptr) result.attributes.push_back(vertex_normals(result, {}, run));
  return result;
}

}  // namespace azulejo
