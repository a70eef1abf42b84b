#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "azulejo/math/transform2d.h"
#include "azulejo/math/transform3d.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr std::size_t kPoints = 1'000'000;

template <class Point>
struct Arrays {
  std::vector<Point> source = std::vector<Point>(kPoints);
  std::vector<Point> ours = std::vector<Point>(kPoints);
  std::vector<Point> peer = std::vector<Point>(kPoints);
};

/// A row of points of kSize numbers; Eigen has them as columns of a matrix.
template <int kSize, class Point, class Matrix>
void points_row(Bench& bench, const std::string& name, const Matrix& m, bool projective) {
  bench.row(name, [=] {
    auto arrays = std::make_shared<Arrays<Point>>();
    for (std::size_t i = 0; i < kPoints; ++i) {
      for (int k = 0; k < kSize; ++k)
        arrays->source[i][k] = static_cast<float>((i * 37 + static_cast<std::size_t>(k) * 11) % 1999) / 100;
    }
    using Points = Eigen::Map<Eigen::Matrix<float, kSize, Eigen::Dynamic>>;
    Eigen::Matrix<float, kSize + 1, kSize + 1> matrix;
    for (int c = 0; c <= kSize; ++c) {
      for (int r = 0; r <= kSize; ++r) matrix(r, c) = m[c][r];
    }
    const auto count = static_cast<Eigen::Index>(kPoints);
    Row row;
    row.work = static_cast<double>(kPoints);
    row.unit = "Mpoint/s";
    row.threads = {1};
    row.ours = [=](int) { transform_points(m, arrays->source, arrays->ours); };
    row.peer_name = "Eigen";
    row.peer = [=](int) {
      const Points source(&arrays->source[0].x, kSize, count);
      Points target(&arrays->peer[0].x, kSize, count);
      const auto linear = matrix.template topLeftCorner<kSize, kSize>();
      const auto shift = matrix.template topRightCorner<kSize, 1>();
      target.noalias() = linear.lazyProduct(source);
      target.colwise() += shift;
      if (!projective) return;
      const auto h = (matrix.template bottomLeftCorner<1, kSize>().lazyProduct(source).array() + matrix(kSize, kSize));
      target.array().rowwise() /= h.eval();
    };
    row.limit = copy_limit(kPoints * sizeof(Point), kPoints * sizeof(Point));
    row.check = [=] {
      double largest = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        for (int k = 0; k < kSize; ++k)
          largest = std::max(largest, std::fabs(double{arrays->ours[i][k]} - double{arrays->peer[i][k]}));
      }
      return Check{largest < 1e-4, "largest difference " + std::to_string(largest)};
    };
    return row;
  });
}

const Rows kRows([](Bench& bench) {
  glm::mat3 plane(Rotation2d(0.3, {1, 2}).matrix());
  glm::mat4 space(Rotation3d(0.3, {1, 2, 3}, {4, 5, 6}).matrix());
  points_row<2, glm::vec2>(bench, "transform_points affine, 2D", plane, false);
  points_row<3, glm::vec3>(bench, "transform_points affine, 3D", space, false);
  plane[0].z = 0.01F;
  space[1].w = 0.01F;
  points_row<2, glm::vec2>(bench, "transform_points projective, 2D", plane, true);
  points_row<3, glm::vec3>(bench, "transform_points projective, 3D", space, true);
});

}  // namespace
}  // namespace azulejo::bench
