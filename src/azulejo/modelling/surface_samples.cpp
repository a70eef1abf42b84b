#include "azulejo/modelling/surface_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/math/random.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 12;
constexpr std::size_t kBatch = std::size_t{1} << 18;  ///< points whose places are known at a time
constexpr double kShrinking = 0.97;
constexpr std::uint32_t kNone = 0xFFFFFFFF;

glm::dvec3 place_of(const SurfaceArea& surface, const SurfaceSample& sample) {
  const auto corner = surface.positions(sample.triangle);
  return corner[0] * sample.shares[0] + corner[1] * sample.shares[1] + corner[2] * sample.shares[2];
}

/// Points in cells as wide as the distance that they keep: what is near a point is in its cell or around it.
class Cells {
 public:
  /// room  for as many points
  Cells(double width, std::size_t room)
      : width_(width), mask_(std::bit_ceil(2 * room + 1) - 1), first_(mask_ + 1, kNone) {
    next_.reserve(room);
    places_.reserve(room);
  }

  void add(const glm::dvec3& place) {
    std::uint32_t& first = first_[slot(cell(place))];
    next_.push_back(first);
    first = static_cast<std::uint32_t>(places_.size());
    places_.push_back(place);
  }

  /// The square of the distance of a point that is nearer than the width; infinite if there is none. The first one found.
  double near(const glm::dvec3& place) const {
    const Cell at = cell(place);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          for (std::uint32_t i = first_[slot({at.x + x, at.y + y, at.z + z})]; i != kNone; i = next_[i]) {
            const glm::dvec3 apart = places_[i] - place;
            if (const double squared = glm::dot(apart, apart); squared < width_ * width_) return squared;
          }
        }
      }
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  struct Cell {
    std::int64_t x, y, z;
  };
  Cell cell(const glm::dvec3& place) const {
    const auto number = [&](double value) {
      // Beyond 2⁶⁰ cells doubles are farther apart than cells are wide.
      return static_cast<std::int64_t>(std::floor(std::clamp(value / width_, -0x1p60, 0x1p60)));
    };
    return {number(place.x), number(place.y), number(place.z)};
  }
  std::size_t slot(const Cell& cell) const {
    std::uint64_t hash = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15U;
    hash = (hash ^ (hash >> 29) ^ static_cast<std::uint64_t>(cell.y)) * 0xBF58476D1CE4E5B9U;
    hash = (hash ^ (hash >> 32) ^ static_cast<std::uint64_t>(cell.z)) * 0x94D049BB133111EBU;
    return static_cast<std::size_t>(hash >> 31) & mask_;
  }

  double width_;
  std::size_t mask_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
  std::vector<glm::dvec3> places_;
};

std::vector<glm::dvec3> places_of(const SurfaceArea& surface, const Array<SurfaceSample>& samples, const Run& run) {
  std::vector<glm::dvec3> places(samples.size());
  parallel_for(samples.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) places[i] = place_of(surface, samples[i]);
  });
  return places;
}

}  // namespace

Array<SurfaceSample> random_samples(const SurfaceArea& surface, std::size_t first, std::size_t count, int seed,
                                    const Run& run) {
  Array<SurfaceSample> samples(count);
  parallel_for(count, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto bits = philox({static_cast<std::uint32_t>(first + i), 0, 1, 0}, {static_cast<std::uint32_t>(seed), 0});
      const auto number = [&](std::size_t word) { return (static_cast<double>(bits[word]) + 0.5) * 0x1p-32; };
      // Two words, so that small triangles of large meshes have their chance, too.
      const double along = (static_cast<double>(bits[0]) + number(3)) * 0x1p-32;
      samples[i] = {static_cast<std::uint32_t>(surface.at(along * surface.total())), even_shares(number(1), number(2))};
    }
  });
  return samples;
}

SpacedSamples spaced_by(const SurfaceArea& surface, double radius, std::size_t candidates, int seed, const Run& run) {
  SpacedSamples result;
  result.radius = radius;
  Cells cells(radius, std::min(candidates, kBatch));
  for (std::size_t first = 0; first < candidates; first += kBatch) {
    const Array<SurfaceSample> samples =
        random_samples(surface, first, std::min(kBatch, candidates - first), seed, run);
    const std::vector<glm::dvec3> places = places_of(surface, samples, run);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (std::isfinite(cells.near(places[i]))) continue;
      cells.add(places[i]);
      result.samples.push_back(samples[i]);
    }
  }
  return result;
}

SpacedSamples spaced_count(const SurfaceArea& surface, std::size_t count, std::size_t candidates, int seed,
                           const Run& run) {
  const Array<SurfaceSample> samples = random_samples(surface, 0, candidates, seed, run);
  const std::vector<glm::dvec3> places = places_of(surface, samples, run);
  SpacedSamples result;
  if (count == 0) return result;
  // Of points in a plane none keep more than this: those of a lattice of triangles.
  const double most = std::sqrt(2 * surface.total() / (std::sqrt(3.0) * static_cast<double>(count)));
  std::vector<std::uint32_t> waiting(samples.size());
  for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i] = static_cast<std::uint32_t>(i);
  std::vector<double> nearest(samples.size(), std::numeric_limits<double>::infinity());  // a square, of some picked one
  std::vector<std::uint32_t> picked;
  for (double radius = most; picked.size() < count; radius *= kShrinking) {
    check_cancelled(run);
    if (radius < most * 1e-4) radius = 0;  // more points than places
    result.radius = radius;
    Cells cells(std::max(radius, most * 1e-4), count);
    for (const std::uint32_t i : picked) cells.add(places[i]);
    std::size_t left = 0;
    for (const std::uint32_t i : waiting) {
      if (picked.size() < count && nearest[i] >= radius * radius) {
        nearest[i] = std::min(nearest[i], cells.near(places[i]));
        if (nearest[i] >= radius * radius) {
          cells.add(places[i]);
          picked.push_back(i);
          continue;
        }
      }
      waiting[left++] = i;
    }
    waiting.resize(left);
  }
  for (const std::uint32_t i : picked) result.samples.push_back(samples[i]);
  return result;
}

}  // namespace azulejo
