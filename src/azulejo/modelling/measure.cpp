#include "azulejo/modelling/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/io/weld.h"
#include "azulejo/math/symmetric3.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/triangulate.h"
#include "azulejo/modelling/union_find.h"

namespace azulejo {

extern const Operation kMeasure;

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 12;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Integrals over triangles, about an origin of their shell.
struct Sums {
  double area = 0;
  glm::dvec3 first_of_area{0, 0, 0};
  double volume = 0;
  glm::dvec3 first{0, 0, 0};
  glm::dmat3 second{0};  ///< of the volume
  glm::dmat3 second_of_area{0};

  /// A triangle, and the tetrahedron between it and the origin.
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 sum = (a + b) + c;
    const glm::dmat3 squares =
        glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) + glm::outerProduct(sum, sum);
    const double of_triangle = glm::length(glm::cross(b - a, c - a)) / 2;
    area += of_triangle;
    first_of_area += sum * (of_triangle / 3);
    second_of_area += squares * (of_triangle / 12);
    const double determinant = glm::dot(a, glm::cross(b, c));
    volume += determinant / 6;
    first += sum * (determinant / 24);
    second += squares * (determinant / 120);
  }
  void add(const Sums& other) {
    area += other.area;
    first_of_area += other.first_of_area;
    second_of_area += other.second_of_area;
    volume += other.volume;
    first += other.first;
    second += other.second;
  }
  /// The same, about an origin that is `by` before the old one.
  Sums moved(const glm::dvec3& by) const {
    Sums result = *this;
    const auto second_about = [&](const glm::dmat3& about, const glm::dvec3& moment, double size) {
      return about + glm::outerProduct(moment, by) + glm::outerProduct(by, moment) + glm::outerProduct(by, by) * size;
    };
    result.second = second_about(second, first, volume);
    result.first += by * volume;
    result.second_of_area = second_about(second_of_area, first_of_area, area);
    result.first_of_area += by * area;
    return result;
  }
};

SolidMeasure solid_of(const Sums& sums, const glm::dvec3& origin) {
  SolidMeasure solid;
  solid.volume = sums.volume;
  const glm::dvec3 middle = sums.first / sums.volume;
  solid.centroid = middle + origin;
  if (sums.volume == 0) {
    solid.centroid = glm::dvec3(kNan);
    solid.inertia = glm::dmat3(kNan);
    solid.moments = glm::dvec3(kNan);
    for (glm::dvec3& axis : solid.axes) axis = glm::dvec3(kNan);
    return solid;
  }
  const glm::dmat3 spread = sums.moved(-middle).second;
  const double trace = spread[0][0] + spread[1][1] + spread[2][2];
  solid.inertia = glm::dmat3(trace) - spread;
  const Symmetric3 principal = eigen_of_symmetric(solid.inertia);
  solid.moments = principal.values;
  solid.axes = principal.vectors;
  return solid;
}

/// How many edges of a shell are wrong, and how.
struct Openness {
  std::size_t unbalanced = 0;
  std::size_t turned = 0;  ///< with two faces that run along them in the same direction
  std::size_t not_finite = 0;

  std::string reason() const {
    if (not_finite > 0) return fmt::format("{} triangles are not finite", not_finite);
    if (unbalanced == 0) return "";
    if (turned == unbalanced) return fmt::format("{} edges have two faces that are turned against each other", turned);
    return fmt::format("{} edges have faces on one side only", unbalanced - turned);
  }
};

class Measuring {
 public:
  Measuring(const Mesh& mesh, const MeasureOptions& options, const Run& run)
      : mesh_(mesh), run_(run), parts_(triangulate(mesh, run)) {
    if (options.by_position) welded_ = weld_exactly(mesh.positions, run).corners;
    find_shells();
    sum_up();
    measure_edges();
    measure_quality();
    put_in_a_box();
  }
  MeshMeasure done() { return std::move(result_); }

 private:
  std::array<glm::vec3, 3> corners(std::size_t triangle) const {
    std::array<glm::vec3, 3> list;
    for (std::size_t i = 0; i < 3; ++i) list[i] = mesh_.positions[mesh_.corners[parts_.corners[3 * triangle + i]]];
    return list;
  }
  bool is_finite_triangle(std::size_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    return is_finite(a) && is_finite(b) && is_finite(c);
  }

  /// Numbers the shells in the order of their first faces, and looks which are closed.
  void find_shells() {
    uses_ = edge_uses(mesh_, welded_, run_);
    Array<std::uint32_t> face_of_corner(mesh_.corner_count());
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      for (std::size_t c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
        face_of_corner[c] = static_cast<std::uint32_t>(f);
      }
    }
    UnionFind joined(mesh_.face_count());
    for (std::size_t e = 0; e < uses_.size(); ++e) {
      const auto at = uses_.uses_of(e);
      for (const std::uint32_t corner : at) joined.unite(face_of_corner[at[0]], face_of_corner[corner]);
    }
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    std::vector<std::uint32_t> number(mesh_.face_count(), kNone);
    shell_.resize(mesh_.face_count());
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      std::uint32_t& shell = number[joined.root(static_cast<std::uint32_t>(f))];
      if (shell == kNone) {
        shell = static_cast<std::uint32_t>(result_.shells.size());
        result_.shells.emplace_back();
      }
      shell_[f] = shell;
      ++result_.shells[shell].faces;
    }
    openness_.resize(result_.shells.size());
    for (std::size_t e = 0; e < uses_.size(); ++e) {
      const auto at = uses_.uses_of(e);
      std::ptrdiff_t balance = 0;
      for (const std::uint32_t corner : at) {
        const std::uint32_t vertex = mesh_.corners[corner];
        balance += (welded_.empty() ? vertex : welded_[vertex]) == uses_.vertices[e][0] ? 1 : -1;
      }
      Openness& openness = openness_[shell_[face_of_corner[at[0]]]];
      openness.unbalanced += balance != 0 ? 1 : 0;
      openness.turned += balance != 0 && at.size() == 2 ? 1 : 0;
    }
  }

  /// The integrals of each shell about the middle of its own box, and of all of them.
  void sum_up() {
    std::size_t left_out = 0;
    for (std::size_t t = 0; t < parts_.face.size(); ++t) {
      ShellMeasure& shell = result_.shells[shell_[parts_.face[t]]];
      if (!is_finite_triangle(t)) {
        ++openness_[shell_[parts_.face[t]]].not_finite;
        ++left_out;
        continue;
      }
      for (const glm::vec3& corner : corners(t)) shell.box = united(shell.box, corner);
    }
    if (left_out > 0) warn(run_, fmt::format("measure: {} triangles are not finite and left out", left_out));
    std::vector<glm::dvec3> origins;
    for (const ShellMeasure& shell : result_.shells) {
      origins.push_back(shell.box.empty() ? glm::dvec3(0)
                                          : (glm::dvec3(shell.box.lower) + glm::dvec3(shell.box.upper)) * 0.5);
    }
    const std::vector<Sums> sums = sums_of_shells(origins);
    Sums total;
    Openness open;
    for (const ShellMeasure& shell : result_.shells) result_.all.box = united(result_.all.box, shell.box);
    origin_ = result_.all.box.empty() ? glm::dvec3(0)
                                      : (glm::dvec3(result_.all.box.lower) + glm::dvec3(result_.all.box.upper)) * 0.5;
    for (std::size_t s = 0; s < sums.size(); ++s) {
      finish(result_.shells[s], sums[s], origins[s], openness_[s]);
      total.add(sums[s].moved(origins[s] - origin_));
      open.unbalanced += openness_[s].unbalanced;
      open.turned += openness_[s].turned;
      open.not_finite += openness_[s].not_finite;
      result_.all.faces += result_.shells[s].faces;
    }
    finish(result_.all, total, origin_, open);
    if (result_.shells.empty()) {
      result_.all.open = "there are no faces";
      result_.all.solid.reset();
    }
    const glm::dvec3 middle = total.area > 0 ? total.first_of_area / total.area : glm::dvec3(0);
    const Symmetric3 principal = eigen_of_symmetric(total.moved(-middle).second_of_area);
    surface_axes_ = principal.vectors;
  }

  static void finish(ShellMeasure& shell, const Sums& sums, const glm::dvec3& origin, const Openness& openness) {
    shell.area = sums.area;
    shell.surface_centroid = sums.first_of_area / sums.area + origin;
    if (sums.area == 0) shell.surface_centroid = glm::dvec3(kNan);
    shell.open = openness.reason();
    if (shell.open.empty()) shell.solid = solid_of(sums, origin);
  }

  std::vector<Sums> sums_of_shells(const std::vector<glm::dvec3>& origins) const {
    struct Part {
      std::uint32_t shell;
      Sums sums;
    };
    std::vector<Sums> sums(origins.size());
    // The parts of each chunk, one a shell in it, are added in the order of the chunks.
    std::vector<std::vector<Part>> chunks((parts_.face.size() + kChunk - 1) / kChunk);
    parallel_for(parts_.face.size(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
      std::vector<Part>& list = chunks[begin / kChunk];
      for (std::size_t t = begin; t < end; ++t) {
        if (!is_finite_triangle(t)) continue;
        const std::uint32_t shell = shell_[parts_.face[t]];
        if (list.empty() || list.back().shell != shell) list.push_back({shell, {}});
        const auto [a, b, c] = corners(t);
        const glm::dvec3& origin = origins[shell];
        list.back().sums.add(glm::dvec3(a) - origin, glm::dvec3(b) - origin, glm::dvec3(c) - origin);
      }
      std::stable_sort(list.begin(), list.end(), [](const Part& a, const Part& b) { return a.shell < b.shell; });
      std::size_t count = 0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (count > 0 && list[count - 1].shell == list[i].shell) {
          list[count - 1].sums.add(list[i].sums);
        } else {
          list[count++] = list[i];
        }
      }
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(count), list.end());
    });
    for (const auto& list : chunks) {
      for (const Part& part : list) sums[part.shell].add(part.sums);
    }
    return sums;
  }

  void measure_edges() {
    struct Lengths {
      std::size_t count = 0;
      double minimum = std::numeric_limits<double>::infinity();
      double maximum = 0;
      double sum = 0;
    };
    const Lengths lengths = parallel_reduce(
        uses_.size(), kChunk, run_, Lengths(),
        [&](std::size_t begin, std::size_t end) {
          Lengths found;
          for (std::size_t e = begin; e < end; ++e) {
            const std::uint32_t corner = uses_.uses_of(e)[0];
            const glm::vec3& a = mesh_.positions[mesh_.corners[corner]];
            const glm::vec3& b = mesh_.positions[mesh_.corners[uses_.next[corner]]];
            if (!is_finite(a) || !is_finite(b)) continue;
            const double length = glm::distance(glm::dvec3(a), glm::dvec3(b));
            ++found.count;
            found.minimum = std::min(found.minimum, length);
            found.maximum = std::max(found.maximum, length);
            found.sum += length;
          }
          return found;
        },
        [](Lengths a, const Lengths& b) {
          a.count += b.count;
          a.minimum = std::min(a.minimum, b.minimum);
          a.maximum = std::max(a.maximum, b.maximum);
          a.sum += b.sum;
          return a;
        });
    const auto count = static_cast<double>(lengths.count);
    result_.edges = {lengths.count, lengths.count > 0 ? lengths.minimum : kNan, lengths.sum / count,
                     lengths.count > 0 ? lengths.maximum : kNan};
  }

  void measure_quality() {
    struct Shapes {
      TriangleQuality quality;
      double sum = 0;
      double sharpest = -std::numeric_limits<double>::infinity();  ///< largest cotangent of an angle
      double bluntest = std::numeric_limits<double>::infinity();
    };
    const Shapes shapes = parallel_reduce(
        parts_.face.size(), kChunk, run_, Shapes{.quality = {.minimum = 1}},
        [&](std::size_t begin, std::size_t end) {
          Shapes found{.quality = {.minimum = 1}};
          for (std::size_t t = begin; t < end; ++t) {
            if (!is_finite_triangle(t)) continue;
            const auto list = corners(t);
            const std::array<glm::dvec3, 3> corner{glm::dvec3(list[0]), glm::dvec3(list[1]), glm::dvec3(list[2])};
            const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));  // twice
            double squares = 0;
            for (std::size_t i = 0; i < 3; ++i) {
              const glm::dvec3 to_next = corner[(i + 1) % 3] - corner[i];
              const glm::dvec3 to_previous = corner[(i + 2) % 3] - corner[i];
              squares += glm::dot(to_next, to_next);
              if (area == 0) continue;
              const double cotangent = glm::dot(to_next, to_previous) / area;
              found.sharpest = std::max(found.sharpest, cotangent);
              found.bluntest = std::min(found.bluntest, cotangent);
            }
            const double quality = area > 0 ? std::min(1.0, 2 * std::sqrt(3.0) * area / squares) : 0;
            ++found.quality.triangles;
            found.quality.without_area += area == 0 ? 1 : 0;
            found.quality.minimum = std::min(found.quality.minimum, quality);
            ++found.quality.histogram[std::min<std::size_t>(9, static_cast<std::size_t>(quality * 10))];
            found.sum += quality;
          }
          return found;
        },
        [](Shapes a, const Shapes& b) {
          a.quality.triangles += b.quality.triangles;
          a.quality.without_area += b.quality.without_area;
          a.quality.minimum = std::min(a.quality.minimum, b.quality.minimum);
          for (std::size_t i = 0; i < 10; ++i) a.quality.histogram[i] += b.quality.histogram[i];
          a.sum += b.sum;
          a.sharpest = std::max(a.sharpest, b.sharpest);
          a.bluntest = std::min(a.bluntest, b.bluntest);
          return a;
        });
    result_.quality = shapes.quality;
    result_.quality.mean = shapes.sum / static_cast<double>(shapes.quality.triangles);
    if (shapes.quality.triangles == 0) result_.quality.minimum = kNan;
    const bool any = shapes.quality.triangles > shapes.quality.without_area;
    result_.quality.smallest_angle = any ? std::atan2(1.0, shapes.sharpest) : kNan;
    result_.quality.largest_angle = any ? std::atan2(1.0, shapes.bluntest) : kNan;
  }

  void put_in_a_box() {
    std::vector<std::uint8_t> used(mesh_.vertex_count(), parts_.face.empty() ? 1 : 0);
    for (const std::uint32_t corner : parts_.corners) used[mesh_.corners[corner]] = 1;
    std::vector<glm::vec3> points;
    points.reserve(mesh_.vertex_count());
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
      if (used[v] != 0 && is_finite(mesh_.positions[v])) points.push_back(mesh_.positions[v]);
    }
    if (parts_.face.empty()) {
      for (const glm::vec3& p : points) result_.all.box = united(result_.all.box, p);
    }
    std::vector<glm::dvec3> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    directions.insert(directions.end(), surface_axes_.begin(), surface_axes_.end());
    result_.oriented_box = oriented_box(points, directions, run_);
  }

  const Mesh& mesh_;
  const Run& run_;
  Triangulation parts_;
  Array<std::uint32_t> welded_;  ///< the number of each vertex's position; empty: vertices are taken as they are
  EdgeUses uses_;
  std::vector<std::uint32_t> shell_;  ///< of each face
  std::vector<Openness> openness_;
  glm::dvec3 origin_{0, 0, 0};
  std::array<glm::dvec3, 3> surface_axes_{glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  MeshMeasure result_;
};

}  // namespace

MeshMeasure measure(const Mesh& mesh, const MeasureOptions& options, const Run& run) {
  kMeasure.check(&options);
  return Measuring(mesh, options, run).done();
}

}  // namespace azulejo
