#include "azulejo/modelling/clip_drawing.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/modelling/path_boolean.h"
#include "azulejo/modelling/path_polygon.h"
#include "azulejo/modelling/tessellate.h"

namespace azulejo {
namespace {

Path box(float x, float y, float size) {
  return Path().move_to({x, y}).line_to({x + size, y}).line_to({x + size, y + size}).line_to({x, y + size}).close();
}

Drawing drawing_of(const Path& path, const DrawingStyle& style) {
  Drawing drawing;
  drawing.width = drawing.height = 10;
  drawing.add_path(path, drawing.add_style(style), "it");
  return drawing;
}

DrawingStyle line_only() {
  DrawingStyle style;
  style.fill.reset();
  style.stroke = Paint({0, 0, 0, 1});
  return style;
}

TEST(ClipDrawing, ConcaveFillsFallIntoSeparateRings) {
  // A U whose bar lies outside of the page.
  const Path u = Path()
                     .move_to({1, -3})
                     .line_to({9, -3})
                     .line_to({9, 5})
                     .line_to({7, 5})
                     .line_to({7, -1})
                     .line_to({3, -1})
                     .line_to({3, 5})
                     .line_to({1, 5})
                     .close();
  const Drawing result = clip(drawing_of(u, DrawingStyle()));
  ASSERT_EQ(result.paths.size(), 1U);
  const Polygon polygon = polygon_of(result.view(result.paths[0]), glm::mat3x2(1, 0, 0, 1, 0, 0), 0.1F);
  ASSERT_EQ(polygon.ring_count(), 2U);
  EXPECT_EQ(signed_area(polygon), 20);
  EXPECT_EQ(result.paths[0].id, "it");
}

TEST(ClipDrawing, LinesEndAtTheWindowAndDashesGoOn) {
  DrawingStyle style = line_only();
  style.dash = {3, 1};
  const Drawing result = clip(
      drawing_of(Path().move_to({-4, 5}).line_to({5, 5}).line_to({5, 25}).line_to({8, 25}).line_to({8, 2}), style));
  ASSERT_EQ(result.paths.size(), 2U);
  EXPECT_EQ(result.points, (Array<glm::vec2>{{0, 5}, {5, 5}, {5, 10}, {8, 10}, {8, 2}}));
  EXPECT_EQ(result.styles[result.paths[0].style].dash_offset, 4);
  EXPECT_EQ(result.styles[result.paths[1].style].dash_offset, 9 + 20 + 3 + 15);
  result.check("clip");
}

TEST(ClipDrawing, WhatIsInsideStaysClosed) {
  const Drawing result = clip(drawing_of(box(2, 2, 3), line_only()));
  ASSERT_EQ(result.paths.size(), 1U);
  EXPECT_EQ(result.view(result.paths[0]).commands.back(), PathCommand::Close);
  EXPECT_EQ(result.points.size(), 4U);
  EXPECT_TRUE(clip(drawing_of(box(12, 2, 3), line_only())).paths.empty());
  EXPECT_TRUE(clip(drawing_of(box(12, 2, 3), DrawingStyle())).paths.empty());
}

TEST(ClipDrawing, GradientsGoWithThePathAndOpacitiesOfGroupsToo) {
  Drawing drawing;
  drawing.width = drawing.height = 10;
  Gradient gradient;
  gradient.stops = {{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 1}}};
  DrawingStyle style;
  style.fill = Paint({1, 1, 1, 1}, drawing.add_pattern(gradient));
  style.stroke = style.fill;
  const std::uint32_t group = drawing.add_group({2, 0, 0, 2, 3, 1}, 0.5F);
  drawing.add_path(box(0, 0, 1), drawing.add_style(style), "", group);
  drawing.add_path(box(1, 1, 1), drawing.add_style(style), "", group);
  const Drawing result = clip(drawing);
  ASSERT_EQ(result.paths.size(), 4U);
  EXPECT_EQ(result.patterns.size(), 2U);  // as it was, and as it is shown
  for (const DrawingPath& path : result.paths) {
    const DrawingStyle& shown = result.styles[path.style];
    EXPECT_EQ(shown.opacity, 0.5F);
    const Paint& paint = shown.fill ? *shown.fill : *shown.stroke;
    EXPECT_EQ(std::get<Gradient>(result.patterns[*paint.pattern]).path_from_gradient, glm::mat3x2(2, 0, 0, 2, 3, 1));
  }
}

TEST(ClipDrawing, RefusesAWindowWithoutSize) {
  EXPECT_THROW(clip(Drawing(), {.window = glm::vec4(1, 0, 1, 5)}), Error);
  EXPECT_TRUE(clip(Drawing()).paths.empty());
}

TEST(PathBoolean, KeepsTheFirstDrawingsStyle) {
  DrawingStyle red;
  red.fill = Paint({1, 0, 0, 1});
  const Drawing a = drawing_of(box(0, 0, 6), red);
  const Drawing b = drawing_of(box(2, 2, 2), DrawingStyle());
  const Drawing result = path_boolean(a, b, {.mode = BooleanMode::Difference});
  ASSERT_EQ(result.paths.size(), 1U);
  EXPECT_EQ(result.styles[result.paths[0].style].fill, red.fill);
  EXPECT_EQ(result.points.size(), 8U);
  EXPECT_EQ(path_boolean(a, b).points.size(), 4U);
  EXPECT_EQ(path_boolean(b, a, {.mode = BooleanMode::Difference}).points.size(), 0U);
}

TEST(Tessellate, ADrawingIsUprightAndColored) {
  DrawingStyle red;
  red.fill = Paint({1, 0, 0, 1});
  red.opacity = 0.5F;
  Drawing drawing = drawing_of(box(1, 2, 3), red);
  drawing.add_path(Path().move_to({5, 5}).quadratic_to({7, 9}, {9, 5}).close(), drawing.add_style(DrawingStyle()));
  const Mesh mesh = tessellate(drawing, {.tolerance = 0.001F});
  mesh.check("tessellate");
  const Box3 box3 = bounds(mesh);
  EXPECT_EQ(box3.lower.x, 1);
  EXPECT_EQ(box3.upper.y, -2);
  double area = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const glm::dvec3 a = mesh.positions[mesh.corners[3 * f]];
    const glm::dvec3 b = mesh.positions[mesh.corners[3 * f + 1]];
    const glm::dvec3 c = mesh.positions[mesh.corners[3 * f + 2]];
    const double each = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    EXPECT_GT(each, 0);  // looks along +z
    area += each;
  }
  // Of a parabola's segment, two thirds of chord times height; chords lack at most 0.001 along the curve, of length < 7.
  EXPECT_NEAR(area, 9 + 2.0 / 3 * 4 * 2, 0.001 * 7);
  const Attribute* color = mesh.find("COLOR_0");
  ASSERT_NE(color, nullptr);
  EXPECT_EQ((*color->get<std::uint8_t>())[0], 255);
  EXPECT_EQ((*color->get<std::uint8_t>())[3], 128);
  EXPECT_EQ(mesh.find("path")->get<std::uint32_t>()->back(), 1U);
}

}  // namespace
}  // namespace azulejo
