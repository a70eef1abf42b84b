#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "azulejo/modelling/hole_patch.h"

namespace azulejo {
namespace {

/// Neighbors of each point of a patch, in it.
std::vector<std::vector<std::uint32_t>> neighbors_of(const HoleRim& rim, const HolePatch& patch) {
  std::vector<std::vector<std::uint32_t>> lists(rim.size() + patch.points.size());
  for (const auto& t : patch.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      lists[t[i]].push_back(t[(i + 1) % 3]);
      lists[t[i]].push_back(t[(i + 2) % 3]);
    }
  }
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return lists;
}

/// Least squares of rows: the sum of new points, each times its weight, and a fixed vector.
class Equations {
 public:
  explicit Equations(std::size_t unknowns) : unknowns_(static_cast<Eigen::Index>(unknowns)) {}

  void begin_row() { fixed_.emplace_back(0); }
  void add(std::size_t unknown, double weight) {
    entries_.emplace_back(static_cast<int>(fixed_.size() - 1), static_cast<int>(unknown), weight);
  }
  void add_fixed(const glm::dvec3& value) { fixed_.back() += value; }

  /// False where they can't be solved.
  bool solve(std::vector<glm::dvec3>& result) const {
    const auto rows = static_cast<Eigen::Index>(fixed_.size());
    Eigen::SparseMatrix<double> matrix(rows, unknowns_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    Eigen::MatrixXd right(rows, 3);
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (int axis = 0; axis < 3; ++axis) right(i, axis) = -fixed_[static_cast<std::size_t>(i)][axis];
    }
    const Eigen::SparseMatrix<double> transposed = matrix.transpose();
    const Eigen::SparseMatrix<double> normal = transposed * matrix;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
    if (solver.info() != Eigen::Success) return false;
    const Eigen::MatrixXd found = solver.solve(transposed * right);
    if (!found.allFinite()) return false;
    for (Eigen::Index i = 0; i < unknowns_; ++i) {
      result[static_cast<std::size_t>(i)] = {found(i, 0), found(i, 1), found(i, 2)};
    }
    return true;
  }

 private:
  Eigen::Index unknowns_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<glm::dvec3> fixed_;
};

/// Each point, of the rim too, is to lie in the middle of its neighbors, those beyond the rim among them.
void add_umbrellas(const HoleRim& rim, const HolePatch& patch, const glm::dvec3& origin, Equations& equations) {
  const auto lists = neighbors_of(rim, patch);
  for (std::size_t v = 0; v < lists.size(); ++v) {
    const bool at_rim = v < rim.size();
    const double count = static_cast<double>(lists[v].size() + (at_rim ? rim.neighbors[v] : 0));
    equations.begin_row();
    for (const std::uint32_t other : lists[v]) {
      if (other < rim.size()) {
        equations.add_fixed((rim.points[other] - origin) / count);
      } else {
        equations.add(other - rim.size(), 1 / count);
      }
    }
    if (at_rim) {
      equations.add_fixed((rim.outside[v] - static_cast<double>(rim.neighbors[v]) * origin) / count -
                          (rim.points[v] - origin));
    } else {
      equations.add(v - rim.size(), -1);
    }
  }
}

/// Edges are to be short.
void add_springs(const HoleRim& rim, const HolePatch& patch, const glm::dvec3& origin, Equations& equations) {
  const auto lists = neighbors_of(rim, patch);
  for (std::size_t v = rim.size(); v < lists.size(); ++v) {
    for (const std::uint32_t other : lists[v]) {
      if (other > v) continue;
      equations.begin_row();
      equations.add(v - rim.size(), 1);
      if (other < rim.size()) {
        equations.add_fixed(origin - rim.points[other]);
      } else {
        equations.add(other - rim.size(), -1);
      }
    }
  }
}

}  // namespace

Fairing fairing_of(const HoleRim& rim, const HolePatch& patch) {
  double smooth = 0;
  double all = 0;
  for (const auto& t : patch.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (a >= rim.size() || b != (a + 1) % rim.size() || rim.normals[a] == glm::dvec3(0)) continue;
      const glm::dvec3 normal = glm::cross(
          rim.points[b] - rim.points[a],
          (t[(i + 2) % 3] < rim.size() ? rim.points[t[(i + 2) % 3]] : patch.points[t[(i + 2) % 3] - rim.size()]) -
              rim.points[a]);
      const double length = glm::length(normal);
      if (!(length > 0)) continue;
      const double edge = glm::distance(rim.points[a], rim.points[b]);
      smooth += edge * glm::dot(normal / length, rim.normals[a]);
      all += edge;
    }
  }
  return smooth >= 0.5 * all ? Fairing::Curvature : Fairing::Area;
}

void fair_patch(const HoleRim& rim, HolePatch& patch, Fairing fairing) {
  if (patch.points.empty()) return;
  const glm::dvec3 origin = rim.points[0];
  Equations equations(patch.points.size());
  if (fairing == Fairing::Curvature) {
    add_umbrellas(rim, patch, origin, equations);
  } else {
    add_springs(rim, patch, origin, equations);
  }
  std::vector<glm::dvec3> found(patch.points.size());
  if (!equations.solve(found)) return;
  for (std::size_t i = 0; i < found.size(); ++i) patch.points[i] = found[i] + origin;
}

}  // namespace azulejo
