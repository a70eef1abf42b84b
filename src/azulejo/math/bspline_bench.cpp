#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <random>
#include <unsupported/Eigen/Splines>
#include <vector>

#include <fmt/format.h>

#include "azulejo/math/bspline.h"
#include "harness.h"

namespace azulejo::bench {
namespace {

constexpr int kControls = 100;
constexpr int kPoints = 200'000;

const Rows kRows([](Bench& bench) {
  bench.row("bspline_point, cubic of 100 points in space", [] {
    using Curve = Eigen::Spline<double, 3, 3>;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1, 1);
    auto controls = std::make_shared<std::vector<glm::dvec3>>();
    Curve::ControlPointVectorType theirs(3, kControls);
    for (int i = 0; i < kControls; ++i) {
      controls->emplace_back(number(random), number(random), number(random));
      theirs.col(i) << controls->back().x, controls->back().y, controls->back().z;
    }
    auto knots = std::make_shared<std::vector<double>>(clamped_knots(kControls, 3));
    const Eigen::Map<const Eigen::RowVectorXd> their_knots(knots->data(), static_cast<Eigen::Index>(knots->size()));
    auto curve = std::make_shared<Curve>(Curve::KnotVectorType(their_knots), theirs);
    auto ours = std::make_shared<std::vector<glm::dvec3>>(kPoints);
    auto peer = std::make_shared<std::vector<glm::dvec3>>(kPoints);
    Row row;
    row.work = kPoints;
    row.unit = "Mpoint/s";
    row.threads = {1};
    row.aim = 0.9;  // both wait for the same divisions
    row.ours = [=](int) {
      for (int i = 0; i < kPoints; ++i) {
        (*ours)[static_cast<std::size_t>(i)] = bspline_point<glm::dvec3>(*controls, *knots, 3, i / (kPoints - 1.0));
      }
    };
    row.peer_name = "Eigen";
    row.peer = [=](int) {
      for (int i = 0; i < kPoints; ++i) {
        const auto at = (*curve)(i / (kPoints - 1.0));
        (*peer)[static_cast<std::size_t>(i)] = {at(0), at(1), at(2)};
      }
    };
    row.check = [=] {
      double apart = 0;
      for (std::size_t i = 0; i < kPoints; ++i) apart = std::max(apart, glm::distance((*ours)[i], (*peer)[i]));
      return Check{apart < 1e-12, fmt::format("{:.1e}", apart)};
    };
    return row;
  });
});

}  // namespace
}  // namespace azulejo::bench
