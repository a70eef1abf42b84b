#include "azulejo/data/drawing.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Box2 bounds_of(const Path& path, const glm::mat3x2& matrix = {1, 0, 0, 1, 0, 0}) {
  return bounds(PathView{path.commands, path.points}, matrix);
}

void expect_box(const Box2& box, float left, float top, float right, float bottom) {
  EXPECT_NEAR(box.lower.x, left, 1e-5F);
  EXPECT_NEAR(box.lower.y, top, 1e-5F);
  EXPECT_NEAR(box.upper.x, right, 1e-5F);
  EXPECT_NEAR(box.upper.y, bottom, 1e-5F);
}

TEST(Drawing, BoundsAreThoseOfCurves) {
  expect_box(bounds_of(Path().move_to({1, 2}).line_to({4, -3}).close()), 1, -3, 4, 2);
  // A parabola's top is half as high as its control point; a symmetric cubic's three quarters.
  expect_box(bounds_of(Path().move_to({0, 0}).quadratic_to({1, 2}, {2, 0})), 0, 0, 2, 1);
  expect_box(bounds_of(Path().move_to({0, 0}).cubic_to({0, 4}, {3, 4}, {3, 0})), 0, 0, 3, 3);
  // An S beyond both ends: the derivative of x, 3 (−1 + 8 t − 8 t²), vanishes at 1/2 ± √2/4.
  const float turn = 0.5F - std::sqrt(2.0F) / 4;
  const auto x = [](float t) { return -3 * t * (1 - t) * (1 - t) + 6 * t * t * (1 - t) + t * t * t; };
  expect_box(bounds_of(Path().move_to({0, 0}).cubic_to({-1, 0}, {2, 0}, {1, 0})), x(turn), 0, x(1 - turn), 0);
}

TEST(Drawing, BoundsHoldAllSampledPointsAndTouchThem) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> place(-10, 10);
  const auto point = [&] { return glm::vec2(place(random), place(random)); };
  for (int i = 0; i < 200; ++i) {
    const glm::vec2 p[4] = {point(), point(), point(), point()};
    const glm::mat3x2 matrix(point(), point(), point());
    const Box2 box = bounds_of(Path().move_to(p[0]).cubic_to(p[1], p[2], p[3]), matrix);
    Box2 sampled;
    for (int k = 0; k <= 2000; ++k) {
      const float t = static_cast<float>(k) / 2000;
      const float s = 1 - t;
      const glm::vec2 at =
          transformed(matrix, s * s * s * p[0] + 3 * t * s * s * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3]);
      for (int axis = 0; axis < 2; ++axis) {
        sampled.lower[axis] = std::min(sampled.lower[axis], at[axis]);
        sampled.upper[axis] = std::max(sampled.upper[axis], at[axis]);
      }
    }
    // Between samples a curve bulges by its second derivative, up to 6 · 40 · 200, times a step squared over 8.
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(box.lower[axis], sampled.lower[axis], 2e-3F);
      EXPECT_NEAR(box.upper[axis], sampled.upper[axis], 2e-3F);
    }
  }
}

TEST(Drawing, BoundsLeaveOutWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_box(bounds_of(Path().move_to({0, 0}).line_to({1, 1}).line_to({nan, 5}).line_to({9, 9}).move_to({50, 50})), 0,
             0, 1, 1);
  EXPECT_TRUE(bounds_of(Path().move_to({3, 3})).empty());
  EXPECT_TRUE(bounds(Drawing()).empty());
}

TEST(Drawing, WalksInTheOrderOfPaintingWithConcatenatedTransforms) {
  Drawing drawing;
  drawing.width = drawing.height = 100;
  const std::uint32_t style = drawing.add_style({});
  const Path unit = Path().move_to({0, 0}).line_to({1, 0}).line_to({1, 1}).close();
  drawing.add_path(unit, style, "below");
  const std::uint32_t moved = drawing.add_group({1, 0, 0, 1, 10, 20}, 0.5F);
  const std::uint32_t turned = drawing.add_group({0, 2, -2, 0, 0, 0}, 0.5F, moved);  // a quarter, twice as large
  drawing.add_path(unit, style, "inner", turned);
  drawing.add_path(unit, style, "outer", moved);
  drawing.add_path(unit, style, "above");
  drawing.check("drawing");

  const std::vector<PlacedPath> placed = walk(drawing);
  ASSERT_EQ(placed.size(), 4U);
  const char* const ids[] = {"below", "inner", "outer", "above"};
  const float opacities[] = {1, 0.25F, 0.5F, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(drawing.paths[placed[i].path].id, ids[i]);
    EXPECT_EQ(placed[i].opacity, opacities[i]);
  }
  EXPECT_EQ(placed[1].group, turned);
  EXPECT_EQ(transformed(placed[1].page_from_path, {1, 0}), glm::vec2(10, 22));
  EXPECT_EQ(transformed(placed[1].page_from_path, {0, 1}), glm::vec2(8, 20));
  expect_box(bounds(drawing), 0, 0, 11, 22);
}

TEST(Drawing, WalksAnyDepthAndStopsAtCycles) {
  Drawing drawing;
  const std::uint32_t style = drawing.add_style({});
  std::uint32_t group = 0;
  for (int i = 0; i < 200000; ++i) group = drawing.add_group({1, 0, 0, 1, 1, 0}, 1, group);
  drawing.add_path(Path().move_to({0, 0}).line_to({0, 1}), style, "deep", group);
  drawing.check("drawing");
  EXPECT_EQ(walk(drawing)[0].page_from_path[2].x, 200000);
  drawing.groups[group].items.push_back({true, 1});
  EXPECT_THROW(drawing.check("drawing"), Error);
  EXPECT_THROW(walk(drawing), Error);
}

TEST(Drawing, KeepsEqualStylesOnce) {
  Drawing drawing;
  DrawingStyle red;
  red.stroke = glm::vec4(1, 0, 0, 1);
  red.dash = {3, 1};
  EXPECT_EQ(drawing.add_style({}), 0U);
  EXPECT_EQ(drawing.add_style(red), 1U);
  EXPECT_EQ(drawing.add_style({}), 0U);
  EXPECT_EQ(drawing.add_style(red), 1U);
  EXPECT_EQ(drawing.styles.size(), 2U);
}

TEST(Drawing, CheckFindsWhatIsBroken) {
  const auto good = [] {
    Drawing drawing;
    drawing.add_path(Path().move_to({0, 0}).cubic_to({1, 1}, {2, 1}, {3, 0}), drawing.add_style({}));
    return drawing;
  };
  EXPECT_NO_THROW(good().check("drawing"));
  const auto refused = [&](auto change) {
    Drawing drawing = good();
    change(drawing);
    EXPECT_THROW(drawing.check("drawing"), Error);
  };
  refused([](Drawing& d) { d.commands[1] = PathCommand::Quadratic; });
  refused([](Drawing& d) { d.commands[0] = PathCommand::Line; });
  refused([](Drawing& d) { d.points.pop_back(); });
  refused([](Drawing& d) { d.paths[0].first_point = ~std::size_t{0}; });
  refused([](Drawing& d) { d.paths[0].style = 1; });
  refused([](Drawing& d) { d.styles[0].stroke_width = -1; });
  refused([](Drawing& d) { d.styles[0].dash = {1, std::numeric_limits<float>::infinity()}; });
  refused([](Drawing& d) { d.styles[0].fill = glm::vec4(2, 0, 0, 1); });
  refused([](Drawing& d) { d.styles[0].fill->pattern = 0; });
  refused([](Drawing& d) { d.styles[0].point_size = -1; });
  refused([](Drawing& d) { d.add_pattern(Gradient{.stops = {{0.5F, {}}, {0.25F, {}}}}); });
  refused([](Drawing& d) { d.add_pattern(Gradient{.to_radius = -1, .stops = {}}); });
  refused([](Drawing& d) { d.add_pattern(Hatch{.spacing = 0}); });
  refused([](Drawing& d) { d.paths[0].text = 0; });
  refused([](Drawing& d) { d.texts.push_back({.size = -2}); });
  refused([](Drawing& d) { d.groups[0].items.push_back({false, 1}); });
  refused([](Drawing& d) { d.groups[0].items.push_back({false, 0}); });
  refused([](Drawing& d) { d.groups[0].items.push_back({true, 0}); });
  refused([](Drawing& d) { d.groups.clear(); });
  refused([](Drawing& d) { d.width = std::numeric_limits<float>::quiet_NaN(); });
}

TEST(Drawing, ClipsAreGroupsOfTheirOwn) {
  Drawing drawing;
  const std::uint32_t style = drawing.add_style({});
  const Path square = Path().move_to({0, 0}).line_to({1, 0}).line_to({1, 1}).close();
  const std::uint32_t shown = drawing.add_group({1, 0, 0, 1, 0, 0});
  const std::uint32_t clip = drawing.add_clip();
  const std::uint32_t clip_of_clip = drawing.add_clip();
  const std::uint32_t part = drawing.add_group({2, 0, 0, 2, 0, 0}, 1, clip);
  drawing.add_path(square, style, "shown", shown);
  drawing.add_path(square, style, "clip", part);
  drawing.add_path(square, style, "clip of clip", clip_of_clip);
  drawing.groups[shown].clip = clip;
  drawing.groups[0].clip = clip;
  drawing.groups[part].clip = clip_of_clip;
  EXPECT_NO_THROW(drawing.check("drawing"));
  ASSERT_EQ(walk(drawing).size(), 1U);
  const auto refused = [&](auto change) {
    Drawing changed = drawing.clone();
    change(changed);
    EXPECT_THROW(changed.check("drawing"), Error);
  };
  refused([&](Drawing& d) { d.groups[shown].clip = 99; });
  refused([&](Drawing& d) { d.groups[shown].clip = 0; });
  refused([&](Drawing& d) { d.groups[shown].clip = part; });
  refused([&](Drawing& d) { d.groups[clip].clip = clip; });
  refused([&](Drawing& d) { d.groups[clip_of_clip].clip = clip; });
}

TEST(Drawing, LineStippleBecomesDashes) {
  const auto bit = [](const LineStipple& stipple, float at) {
    float total = 0;
    for (const float length : stipple.dash) total += length;
    at = std::fmod(at + stipple.dash_offset, total);
    std::size_t i = 0;
    while (at >= stipple.dash[i]) at -= stipple.dash[i++];
    return i % 2 == 0;
  };
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const auto pattern = static_cast<std::uint16_t>(i < 16 ? 1 << i : random());
    const int factor = 1 + static_cast<int>(random() % 5);
    const LineStipple stipple = line_stipple(pattern, factor);
    if (pattern == 0xFFFF) continue;
    EXPECT_EQ(stipple.dash.size() % 2, 0U);
    for (int step = 0; step < 32 * factor; ++step) {
      ASSERT_EQ(bit(stipple, static_cast<float>(step) + 0.5F), (pattern >> (step / factor & 15) & 1) != 0)
          << pattern << " × " << factor << " at " << step;
    }
  }
  EXPECT_TRUE(line_stipple(0xFFFF, 3).dash.empty());
}

TEST(Drawing, IsCopiedByClone) {
  Drawing drawing;
  drawing.add_path(Path().move_to({0, 0}).line_to({5, 5}), drawing.add_style({}));
  const Drawing copy = drawing.clone();
  drawing.points[1] = {7, 7};
  EXPECT_EQ(bounds(copy).upper, glm::vec2(5, 5));
}

}  // namespace
}  // namespace azulejo
