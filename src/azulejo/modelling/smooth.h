#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

enum class SmoothMethod : std::uint8_t {
  Taubin,     ///< in and out again: takes away noise, keeps the size
  Laplacian,  ///< toward the mean of the neighbors: shrinks
};
constexpr std::array<std::string_view, 2> enum_names(SmoothMethod) { return {"taubin", "laplacian"}; }

/// How much each neighbor of a vertex counts.
enum class SmoothWeights : std::uint8_t {
  Uniform,    ///< all the same: evens out the sizes of faces, too
  Cotangent,  ///< by the angles opposite to the edge: vertices hardly move along the surface
};
constexpr std::array<std::string_view, 2> enum_names(SmoothWeights) { return {"uniform", "cotangent"}; }

enum class SmoothBorder : std::uint8_t {
  Along,  ///< border vertices are smoothed among themselves, as curves
  Fixed,  ///< they stay
  Free,   ///< they are smoothed as all others
};
constexpr std::array<std::string_view, 3> enum_names(SmoothBorder) { return {"along", "fixed", "free"}; }

struct SmoothOptions {
  SmoothMethod method = SmoothMethod::Taubin;
  SmoothWeights weights = SmoothWeights::Uniform;
  int iterations = 10;  ///< 0–100000; of Taubin's, each of two steps
  float lambda = 0.5F;  ///< 0–1: the part of the way to the mean of the neighbors
  /// −2–0: of Taubin's second step, which goes away from it. Auto: 1 ÷ (0.1 − 1 ÷ lambda), so that waves whose vertices
  /// are a tenth of their height from the means of their neighbors keep it, and longer ones hardly change.
  std::optional<float> mu = std::nullopt;
  SmoothBorder border = SmoothBorder::Along;
};

/// Moves vertices toward the weighted means of their neighbors, all at once, over and over. Faces stay as they are.
///
/// neighbors   vertices at the other ends of edges of faces; cotangent: of the faces' triangles. Of border vertices, with
///             `along`, the two that border edges lead to; where more such edges meet they stay
/// cotangent   weights are those of the given surface for all steps; an edge whose cotangents sum to less than 0, and
///             triangles without area, weigh 0; a vertex without any weight stays
/// spectrum    a wave on the surface whose vertices are k of its height from the means of their neighbors (0: endlessly
///             long, 2: up and down from vertex to vertex) is multiplied by 1 − lambda k in a step, by 1 − mu k in
///             Taubin's second one
/// seams       vertices at equal positions are not joined: weld the mesh first, or its seams are borders
/// attributes  stay. NORMAL: made new of vertices if there was one; TANGENT and normals of morph targets are dropped;
///             morph targets are smoothed alike
/// others      vertices without faces stay, also those of lines
/// NaN         a vertex with a coordinate that is not finite stays, and counts for no other
/// Result      the same bytes for any thread count; calculated in f64, rounded to f32 after each step
/// Throws      Error(Argument) for an option out of range, or a lambda and mu that would make waves of k = 2 grow:
///             (1 − 2 lambda) (1 − 2 mu) below −1
/// Cost        O(corners) and O(vertices + edges) a step, on all threads; 8 bytes a corner, twice that with cotangents
/// Source      Taubin, A signal processing approach to fair surface design, 1995; weights: Pinkall & Polthier, Computing
///             discrete minimal surfaces and their conjugates, 1993
AZULEJO_EXPORT Mesh smooth(const Mesh& mesh, const SmoothOptions& options = {}, const Run& run = {});

}  // namespace azulejo
