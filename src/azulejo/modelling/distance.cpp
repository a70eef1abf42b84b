#include "azulejo/modelling/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/math/random.h"
#include "azulejo/modelling/distance_surface.h"

namespace azulejo {

extern const Operation kDistance;

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 11;  ///< points of one task
constexpr std::size_t kPieces = 64;                   ///< pieces of one task
constexpr std::size_t kSearches = 64;                 ///< most searches in one piece before it is given back

/// The farthest point so far.
struct Farthest {
  double distance = -1;
  glm::dvec3 place{0, 0, 0};
  std::uint32_t slot = NearestTriangle::kNone;

  void look_at(double other, const glm::dvec3& other_place, std::uint32_t other_slot) {
    if (other > distance) *this = {other, other_place, other_slot};
  }
  void look_at(const Farthest& other) { look_at(other.distance, other.place, other.slot); }
};

/// Distances of many points.
struct Sums {
  Farthest farthest;
  std::size_t count = 0;
  double sum = 0;
  double squares = 0;

  void add(double distance, const glm::dvec3& place, std::uint32_t slot) {
    farthest.look_at(distance, place, slot);
    ++count;
    sum += distance;
    squares += distance * distance;
  }
};
Sums combined(Sums a, const Sums& b) {
  a.farthest.look_at(b.farthest);
  a.count += b.count;
  a.sum += b.sum;
  a.squares += b.squares;
  return a;
}

/// A part of a triangle, the distances of its corners, and what they are nearest to.
struct Piece {
  std::array<glm::dvec3, 3> corner;
  std::array<double, 3> distance;
  std::array<std::uint32_t, 3> slot;
};

/// From one surface to another.
class OneSided {
 public:
  OneSided(const DistanceSurface& from, const DistanceSurface& to, const MeshDistanceOptions& options, const Run& run)
      : from_(from), to_(to), options_(options), run_(run) {}

  SurfaceDistance measure(double diagonal, std::size_t refinements) {
    const Sums vertices = look_at_vertices();
    Sums samples;
    if (from_.area().total() > 0) samples = look_at_samples();
    farthest_ = vertices.farthest;
    farthest_.look_at(samples.farthest);
    result_.vertices = vertices.count;
    result_.samples = samples.count;

    const Sums& even = samples.count > 0 ? samples : vertices;
    const auto count = static_cast<double>(even.count);
    result_.mean = even.sum / count;
    result_.rms = std::sqrt(even.squares / count);
    if (samples.count > 1) {
      result_.mean_error = std::sqrt(std::max(0.0, even.squares / count - result_.mean * result_.mean) / (count - 1));
    }

    tolerance_ = static_cast<double>(options_.tolerance) * diagonal;
    asked_ = std::numeric_limits<double>::infinity();
    if (options_.at_most && options_.metric == DistanceMetric::Maximum) {
      asked_ = static_cast<double>(*options_.at_most) * (options_.relative ? diagonal : 1);
    }
    refine(refinements);
    result_.maximum = farthest_.distance;
    result_.place = farthest_.place;
    result_.nearest = closest_point(farthest_.place, to_.tree().corners(farthest_.slot)).point;
    return result_;
  }

  Array<float> vertex_distances() const {
    Array<float> values(distances_.size());
    std::transform(distances_.begin(), distances_.end(), values.begin(),
                   [](double distance) { return static_cast<float>(distance); });
    return values;
  }

 private:
  Sums look_at_vertices() {
    const Mesh& mesh = from_.mesh();
    distances_.resize(mesh.vertex_count());
    slots_.resize(mesh.vertex_count());
    return parallel_reduce(
        mesh.vertex_count(), kChunk, run_, Sums(),
        [&](std::size_t begin, std::size_t end) {
          Sums sums;
          std::uint32_t guess = NearestTriangle::kNone;
          for (std::size_t v = begin; v < end; ++v) {
            const glm::dvec3 place(mesh.positions[v]);
            if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) {
              distances_[v] = std::numeric_limits<double>::quiet_NaN();
              slots_[v] = NearestTriangle::kNone;
              continue;
            }
            const NearestTriangle::Found found = to_.tree().find(place, guess);
            guess = slots_[v] = found.slot;
            distances_[v] = std::sqrt(found.squared);
            if (from_.has(v)) sums.add(distances_[v], place, found.slot);
          }
          return sums;
        },
        combined);
  }

  Sums look_at_samples() const {
    const SurfaceArea& area = from_.area();
    const std::size_t automatic = std::clamp<std::size_t>(2 * area.triangle_count(), 10'000, 2'000'000);
    const std::size_t count = options_.samples ? static_cast<std::size_t>(*options_.samples) : automatic;
    const double step = area.total() / static_cast<double>(count);
    return parallel_reduce(
        count, kChunk, run_, Sums(),
        [&](std::size_t begin, std::size_t end) {
          Sums sums;
          std::uint32_t guess = NearestTriangle::kNone;
          std::size_t triangle = area.at(static_cast<double>(begin) * step);
          for (std::size_t i = begin; i < end; ++i) {
            const auto bits =
                philox({static_cast<std::uint32_t>(i), 0, 0, 0}, {static_cast<std::uint32_t>(options_.seed), 0});
            const auto number = [&](std::size_t word) { return (static_cast<double>(bits[word]) + 0.5) * 0x1p-32; };
            triangle = area.at((static_cast<double>(i) + number(0)) * step, triangle);
            const CornerShares shares = even_shares(number(1), number(2));
            const auto corner = area.positions(triangle);
            const glm::dvec3 place = corner[0] * shares[0] + corner[1] * shares[1] + corner[2] * shares[2];
            const NearestTriangle::Found found = to_.tree().find(place, guess);
            guess = found.slot;
            sums.add(std::sqrt(found.squared), place, found.slot);
          }
          return sums;
        },
        combined);
  }

  /// Looks where the maximum may still be, until it can't be larger than what is known by more than the tolerance.
  void refine(std::size_t most) {
    std::vector<Piece> pieces;
    if (!from_.triangles().empty()) {
      pieces = work_on(from_.triangles().size(), 0, [&](std::size_t i) { return whole(from_.triangles()[i]); });
    }
    while (!pieces.empty()) {
      const std::size_t each = std::min(kSearches, (most - result_.refinements) / pieces.size());
      if (each == 0) break;
      pieces = work_on(pieces.size(), each, [&](std::size_t i) { return pieces[i]; });
    }
    for (const Piece& piece : pieces) settled_ = std::max(settled_, bound(piece, limit(farthest_)));
    result_.maximum_bound = std::max(settled_, farthest_.distance);
  }

  Piece whole(std::uint32_t triangle) const {
    Piece piece;
    const auto corners = from_.area().corners(triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = from_.mesh().corners[corners[i]];
      piece.corner[i] = glm::dvec3(from_.mesh().positions[vertex]);
      piece.distance[i] = distances_[vertex];
      piece.slot[i] = slots_[vertex];
    }
    return piece;
  }

  /// What came of one task.
  struct Work {
    Farthest farthest;
    double settled = 0;  ///< no point that needs no more work is farther
    std::size_t searches = 0;
    std::vector<Piece> left;
  };

  template <class Get>
  std::vector<Piece> work_on(std::size_t count, std::size_t searches, Get get) {
    const std::size_t chunk = searches > 0 ? kPieces : kChunk;
    Work all = parallel_reduce(
        count, chunk, run_, Work(),
        [&](std::size_t begin, std::size_t end) {
          Work work;
          work.farthest = farthest_;
          for (std::size_t i = begin; i < end; ++i) split(get(i), searches, work);
          return work;
        },
        [](Work a, Work b) {
          a.farthest.look_at(b.farthest);
          a.settled = std::max(a.settled, b.settled);
          a.searches += b.searches;
          a.left.insert(a.left.end(), b.left.begin(), b.left.end());
          return a;
        });
    farthest_ = all.farthest;
    settled_ = std::max(settled_, all.settled);
    result_.refinements += all.searches;
    return std::move(all.left);
  }

  /// Halves a piece and its parts while they may hold a point that is too far.
  void split(const Piece& whole_piece, std::size_t searches, Work& work) const {
    std::vector<Piece> waiting{whole_piece};
    while (!waiting.empty()) {
      const Piece piece = waiting.back();
      const double farthest = bound(piece, limit(work.farthest));
      if (farthest <= limit(work.farthest)) {
        waiting.pop_back();
        work.settled = std::max(work.settled, farthest);
        continue;
      }
      if (searches == 0) break;
      --searches;
      ++work.searches;
      waiting.pop_back();
      halve(piece, waiting, work);
    }
    work.left.insert(work.left.end(), waiting.begin(), waiting.end());
  }

  void halve(const Piece& piece, std::vector<Piece>& halves, Work& work) const {
    std::size_t i = 0;
    double longest = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = squared(piece.corner[k] - piece.corner[(k + 1) % 3]);
      if (length > longest) {
        longest = length;
        i = k;
      }
    }
    const std::size_t j = (i + 1) % 3;
    const glm::dvec3 middle = (piece.corner[i] + piece.corner[j]) * 0.5;
    const NearestTriangle::Found found = to_.tree().find(middle, piece.slot[i]);
    const double distance = std::sqrt(found.squared);
    work.farthest.look_at(distance, middle, found.slot);
    for (const std::size_t end : {i, j}) {
      Piece& half = halves.emplace_back(piece);
      half.corner[end] = middle;
      half.distance[end] = distance;
      half.slot[end] = found.slot;
    }
  }

  /// Points that are no farther than this are no reason to look further.
  double limit(const Farthest& farthest) const {
    const double enough = farthest.distance + tolerance_;
    // Where it is to be told whether the maximum is at most something, up to that.
    return farthest.distance <= asked_ ? std::min(enough, asked_) : enough;
  }

  /// How far a point of a piece can be at most; what is found first that isn't more than `enough`.
  double bound(const Piece& piece, double enough) const {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, squared(piece.corner[i] - piece.corner[(i + 1) % 3]));
    }
    // No point of a triangle is farther from its nearest corner than the longest edge ÷ √3.
    const double farthest = *std::max_element(piece.distance.begin(), piece.distance.end());
    double best = farthest + std::sqrt(longest / 3);
    for (std::size_t k = 0; k < 3 && best > enough; ++k) {
      if (std::find(piece.slot.begin(), piece.slot.begin() + static_cast<std::ptrdiff_t>(k), piece.slot[k]) !=
          piece.slot.begin() + static_cast<std::ptrdiff_t>(k)) {
        continue;
      }
      const auto triangle = to_.tree().corners(piece.slot[k]);
      double worst = 0;
      for (std::size_t i = 0; i < 3 && worst < best; ++i) {
        const bool known = piece.slot[i] == piece.slot[k];
        worst =
            std::max(worst, known ? piece.distance[i] : std::sqrt(closest_point(piece.corner[i], triangle).squared));
      }
      best = std::min(best, worst);
    }
    return best;
  }

  static double squared(const glm::dvec3& v) { return glm::dot(v, v); }

  const DistanceSurface& from_;
  const DistanceSurface& to_;
  const MeshDistanceOptions& options_;
  const Run& run_;
  Array<double> distances_;     ///< of vertices
  Array<std::uint32_t> slots_;  ///< nearest to vertices
  Farthest farthest_;
  double settled_ = 0;
  double tolerance_ = 0;
  double asked_ = 0;
  SurfaceDistance result_;
};

/// Of the box around what is finite, in double.
double diagonal_of(const Mesh& mesh) {
  const Box3 box = bounds(mesh);
  return box.empty() ? 0 : glm::length(glm::dvec3(box.upper) - glm::dvec3(box.lower));
}

double larger(const MeshDistance& distance, double SurfaceDistance::*of) {
  return distance.backward ? std::max(distance.forward.*of, (*distance.backward).*of) : distance.forward.*of;
}

}  // namespace

double MeshDistance::maximum() const { return larger(*this, &SurfaceDistance::maximum); }
double MeshDistance::maximum_bound() const { return larger(*this, &SurfaceDistance::maximum_bound); }
double MeshDistance::mean() const { return larger(*this, &SurfaceDistance::mean); }
double MeshDistance::rms() const { return larger(*this, &SurfaceDistance::rms); }

MeshDistance distance(const Mesh& source, const Mesh& reference, const MeshDistanceOptions& options, const Run& run) {
  kDistance.check(&options);
  const DistanceSurface a(source, "source", run);
  const DistanceSurface b(reference, "reference", run);
  const std::size_t refinements =
      options.refinements ? static_cast<std::size_t>(*options.refinements) : 2 * (a.size() + b.size()) + 1'000'000;
  MeshDistance result;
  result.diagonal = diagonal_of(reference);
  OneSided forward(a, b, options, run);
  result.forward = forward.measure(result.diagonal, refinements);
  result.of_vertices = forward.vertex_distances();
  if (options.symmetric) result.backward = OneSided(b, a, options, run).measure(result.diagonal, refinements);
  return result;
}

}  // namespace azulejo
