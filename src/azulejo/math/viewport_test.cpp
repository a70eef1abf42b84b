#include "azulejo/math/viewport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

Window random_window(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> place(-reach, reach);
  std::uniform_real_distribution<double> size(0.01 * reach, reach);
  Window box;
  box.x0 = place(random);
  box.y0 = place(random);
  box.x1 = box.x0 + size(random);
  box.y1 = box.y0 + size(random);
  return box;
}

template <class Try>
std::string refusal(Try attempt) {
  try {
    attempt();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Argument);
    return error.what();
  }
  return "";
}

void expect_near(const glm::dmat3& a, const glm::dmat3& b, double tolerance) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance) << c << "," << r;
  }
}

/// The window −1…1 in a viewport of 640 × 480 pixels at (100, 50), worked by hand.
TEST(Viewport, HasTheClosedForms) {
  const Window window;
  const Window viewport{100, 50, 740, 530};
  const glm::dmat3 matrix = viewport_from_window(window, viewport);
  EXPECT_EQ(matrix[0][0], 320);  // sx = 640 ÷ 2
  EXPECT_EQ(matrix[1][1], 240);  // sy = 480 ÷ 2
  EXPECT_EQ(matrix[2][0], 420);  // tx = (1 · 100 + 1 · 740) ÷ 2
  EXPECT_EQ(matrix[2][1], 290);  // ty = (1 · 50 + 1 · 530) ÷ 2
  EXPECT_EQ(matrix[0][1], 0);
  EXPECT_EQ(matrix[1][0], 0);
  EXPECT_EQ(matrix[0][2], 0);
  EXPECT_EQ(matrix[1][2], 0);
  EXPECT_EQ(matrix[2][2], 1);
  EXPECT_EQ(transformed(matrix, {0, 0}), glm::dvec2(420, 290));
  EXPECT_EQ(transformed(matrix, {-1, -1}), glm::dvec2(100, 50));
  EXPECT_EQ(transformed(matrix, {1, 1}), glm::dvec2(740, 530));
}

/// S scales about (xw_min, yw_min): sx 0 xw_min·(1 − sx); T moves by xv_min − xw_min.
TEST(Viewport, HasTwoSteps) {
  const Window window{2, 3, 6, 11};
  const Window viewport{10, 20, 110, 60};
  const glm::dmat3 scaling = scaling_to_viewport(window, viewport);
  EXPECT_EQ(scaling[0][0], 25);
  EXPECT_EQ(scaling[1][1], 5);
  EXPECT_EQ(scaling[2][0], 2.0 * (1 - 25));
  EXPECT_EQ(scaling[2][1], 3.0 * (1 - 5));
  EXPECT_EQ(transformed(scaling, {2, 3}), glm::dvec2(2, 3));
  EXPECT_EQ(transformed(scaling, {6, 11}), glm::dvec2(102, 43));  // of the viewport's size
  const glm::dmat3 translation = translation_to_viewport(window, viewport);
  EXPECT_EQ(translation[0][0], 1);
  EXPECT_EQ(translation[1][1], 1);
  EXPECT_EQ(translation[2][0], 8);
  EXPECT_EQ(translation[2][1], 17);
  EXPECT_EQ(translation * scaling, viewport_from_window(window, viewport));
}

/// Each matrix has at most three roundings of numbers up to `size`, a product of two three more.
TEST(Viewport, StepsAndInverseAgreeForAnyRectangles) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const Window window = random_window(random, 10);
    const Window viewport = random_window(random, 1000);
    const glm::dmat3 matrix = viewport_from_window(window, viewport);
    const double size = 2000 + std::abs(matrix[0][0]) * 20 + std::abs(matrix[1][1]) * 20;
    expect_near(translation_to_viewport(window, viewport) * scaling_to_viewport(window, viewport), matrix,
                8 * kEpsilon * size);
    const glm::dmat3 inverse = window_from_viewport(window, viewport);
    for (const glm::dvec2 at : {glm::dvec2(window.x0, window.y1), window.center()}) {
      const glm::dvec2 back = transformed(inverse, transformed(matrix, at));
      EXPECT_NEAR(back.x, at.x, 16 * kEpsilon * size / matrix[0][0] + 16 * kEpsilon * 20) << "window " << i;
      EXPECT_NEAR(back.y, at.y, 16 * kEpsilon * size / matrix[1][1] + 16 * kEpsilon * 20) << "window " << i;
    }
  }
}

/// (xv − xv_min) ÷ (xv_max − xv_min) = (xw − xw_min) ÷ (xw_max − xw_min).
TEST(Viewport, KeepsRelativeLengths) {
  const Window window{-3, 1, 5, 2};
  const Window viewport{64, 0, 192, 512};
  const glm::dmat3 matrix = viewport_from_window(window, viewport);
  for (const double part : {0.0, 0.125, 0.5, 0.75, 1.0}) {
    const glm::dvec2 seen = transformed(matrix, {-3 + part * 8, 1 + part});
    EXPECT_NEAR((seen.x - 64) / 128, part, 1e-14);
    EXPECT_NEAR(seen.y / 512, part, 1e-14);
  }
}

TEST(Viewport, MovingTheWindowPansAndSizingItZooms) {
  const Window viewport{0, 0, 400, 300};
  const glm::dmat3 before = viewport_from_window({0, 0, 4, 3}, viewport);
  const glm::dmat3 panned = viewport_from_window({1, 0.5, 5, 3.5}, viewport);
  const glm::dmat3 zoomed = viewport_from_window({1, 0.75, 3, 2.25}, viewport);  // half of it, about its middle
  const glm::dvec2 middle(200, 150);
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(2, 1.5), glm::dvec2(3, 1)}) {
    EXPECT_EQ(transformed(panned, at), transformed(before, at) - glm::dvec2(100, 50));
    EXPECT_EQ(transformed(zoomed, at), middle + 2.0 * (transformed(before, at) - middle));
  }
}

TEST(Viewport, MovingAndSizingTheViewportMovesAndSizesThePicture) {
  const Window window{0, 0, 4, 3};
  const glm::dmat3 before = viewport_from_window(window, {0, 0, 400, 300});
  const glm::dmat3 moved = viewport_from_window(window, {30, 70, 430, 370});
  const glm::dmat3 halved = viewport_from_window(window, {0, 0, 200, 150});
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(4, 3), glm::dvec2(3, 1)}) {
    EXPECT_EQ(transformed(moved, at), transformed(before, at) + glm::dvec2(30, 70));
    EXPECT_EQ(transformed(halved, at), 0.5 * transformed(before, at));
  }
}

TEST(Viewport, TheFlipIsTheLastStep) {
  const glm::dmat3 flip = raster_from_viewport(480);
  EXPECT_EQ(transformed(flip, {12, 0}), glm::dvec2(12, 480));
  EXPECT_EQ(transformed(flip, {12, 480}), glm::dvec2(12, 0));
  EXPECT_EQ(flip * flip, glm::dmat3(1.0));
  // A viewport given from the top of the picture, as rasters have it.
  const Window from_top{100, 50, 200, 90};
  const Window from_bottom = flipped(from_top, 480);
  EXPECT_EQ(from_bottom, (Window{100, 390, 200, 430}));
  EXPECT_EQ(flipped(from_bottom, 480), from_top);
  const glm::dmat3 raster_from_window = flip * viewport_from_window({}, from_bottom);
  EXPECT_EQ(transformed(raster_from_window, {-1, 1}), glm::dvec2(100, 50));  // up is the first row
  EXPECT_EQ(transformed(raster_from_window, {1, -1}), glm::dvec2(200, 90));
}

TEST(Viewport, AspectPolicies) {
  const Window wide{0, 0, 4, 1};
  const Window square{10, 10, 110, 110};
  EXPECT_EQ(aspect_mismatch(wide, square), 0.25);
  EXPECT_EQ(aspect_mismatch({0, 0, 3, 3}, square), 1);
  const FittedWindow fit = fitted(wide, square, AspectPolicy::Fit);
  EXPECT_EQ(fit.window, wide);
  EXPECT_EQ(fit.viewport, (Window{10, 47.5, 110, 72.5}));
  const FittedWindow fill = fitted(wide, square, AspectPolicy::Fill);
  EXPECT_EQ(fill.window, (Window{1.5, 0, 2.5, 1}));
  EXPECT_EQ(fill.viewport, square);
  const FittedWindow stretch = fitted(wide, square, AspectPolicy::Stretch);
  EXPECT_EQ(stretch.window, wide);
  EXPECT_EQ(stretch.viewport, square);
  for (const FittedWindow& each : {fit, fill}) EXPECT_EQ(aspect_mismatch(each.window, each.viewport), 1);
}

/// A third of a pixel is left: the window grows to whole pixels, one scale for both axes.
TEST(Viewport, FitsWholePixels) {
  const FittedPixels fit = fitted(Window{0, 0, 3, 1}, Rect{5, 5, 100, 100}, AspectPolicy::Fit);
  EXPECT_EQ(fit.viewport, (Rect{5, 38, 100, 33}));
  EXPECT_NEAR(aspect_mismatch(fit.window, window_of(fit.viewport)), 1, 4 * kEpsilon);
  EXPECT_NEAR(fit.window.width(), 3, 1e-14);
  EXPECT_NEAR(fit.window.height(), 0.99, 1e-14);
  // A line of a window has a row of pixels at least.
  const FittedPixels thin = fitted(Window{0, 0, 1e6, 1}, Rect{0, 0, 10, 10}, AspectPolicy::Fit);
  EXPECT_EQ(thin.viewport, (Rect{0, 4, 10, 1}));
  const FittedPixels fill = fitted(Window{0, 0, 4, 1}, Rect{0, 0, 10, 10}, AspectPolicy::Fill);
  EXPECT_EQ(fill.viewport, (Rect{0, 0, 10, 10}));
}

TEST(Viewport, RefusesWhatHasNoArea) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal([] {
              viewport_from_window({0, 0, 0, 1}, {0, 0, 4, 4});
            }),
            "window: 0,0,0,1, expected x0,y0,x1,y1 with x0 < x1 and y0 < y1");
  EXPECT_EQ(refusal([] {
              viewport_from_window({}, {0, 0, 4, 0});
            }),
            "viewport: 0,0,4,0, expected x0,y0,x1,y1 with x0 < x1 and y0 < y1");
  EXPECT_NE(refusal([] { scaling_to_viewport({1, 0, 0, 1}, {0, 0, 4, 4}); }), "");
  EXPECT_NE(refusal([&] { translation_to_viewport({0, nan, 1, 1}, {0, 0, 4, 4}); }), "");
  EXPECT_NE(refusal([&] { window_from_viewport({0, 0, infinity, 1}, {0, 0, 4, 4}); }), "");
  EXPECT_NE(refusal([] { fitted({0, 0, 1, 0}, Rect{0, 0, 4, 4}, AspectPolicy::Fit); }), "");
  EXPECT_NE(refusal([] { fitted({0, 0, 1, 1}, Rect{0, 0, 4, 0}, AspectPolicy::Fill); }), "");
  EXPECT_NE(refusal([] { viewport_from_window({0, 0, 1e-310, 1}, {0, 0, 4, 4}); }), "");
  EXPECT_NE(refusal([] { viewport_from_window({0, 0, 1e300, 1}, {0, 0, 1e-20, 4}); }), "");
}

}  // namespace
}  // namespace azulejo
