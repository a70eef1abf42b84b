#include "azulejo/rendering/point_marks.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include <gtest/gtest.h>

#include "azulejo/modelling/path_testing.h"

namespace azulejo {
namespace {

const Box2 kAll{glm::vec2(-1e30F), glm::vec2(1e30F)};

FlatPath marks(const Path& path, PointShape shape, float size, const Box2& window = kAll) {
  DrawingStyle style;
  style.point_shape = shape;
  style.point_size = size;
  FlatPath result;
  point_marks(view_of(path), style, {2, 0, 0, 2, 10, 0}, 0.1F, window, result);
  return result;
}

TEST(PointMarks, HaveTheSizeThatIsAskedFor) {
  const Path point = Path().move_to({20, 30}).close();
  const auto area = [&](PointShape shape) { return std::abs(signed_area(marks(point, shape, 40))); };
  EXPECT_NEAR(area(PointShape::Circle), 400 * 3.14159265, 0.1 * 40 * 3.15);
  EXPECT_NEAR(area(PointShape::Square), 1600, 1e-3);
  EXPECT_NEAR(area(PointShape::Diamond), 800, 1e-3);
  EXPECT_NEAR(area(PointShape::Triangle), 800, 1e-3);
  EXPECT_NEAR(area(PointShape::Plus), 2 * 40 * 10 - 100, 1e-3);
  for (const PointShape shape : {PointShape::Circle, PointShape::Square, PointShape::Diamond, PointShape::Triangle,
                                 PointShape::Plus, PointShape::Cross}) {
    Box2 box;
    for (const glm::vec2& each : marks(point, shape, 40).points) {
      box.lower = glm::min(box.lower, each);
      box.upper = glm::max(box.upper, each);
    }
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(box.lower[axis], (axis == 0 ? 50 : 60) - 20, 0.1);
      EXPECT_NEAR(box.upper[axis], (axis == 0 ? 50 : 60) + 20, 0.1);
    }
  }
}

TEST(PointMarks, AreWhereSegmentsBeginAndEnd) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Path path = Path()
                        .move_to({0, 0})
                        .line_to({9, 0})
                        .cubic_to({11, 0}, {11, 5}, {9, 9})
                        .close()
                        .move_to({50, 50})
                        .move_to({20, 0})
                        .line_to({25, 0})
                        .line_to({kNan, 0});
  EXPECT_EQ(marks(path, PointShape::Square, 4).contour_count(), 5U);
  EXPECT_EQ(marks(path, PointShape::Square, 4, {{0, 0}, {9, 9}}).contour_count(), 1U);
  EXPECT_EQ(marks(path, PointShape::Square, 0).contour_count(), 0U);
}

}  // namespace
}  // namespace azulejo
