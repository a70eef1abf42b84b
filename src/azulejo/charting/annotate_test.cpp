#include "azulejo/charting/annotate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "azulejo/charting/palette.h"
#include "azulejo/core/error.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

CsvTable table(const char* text) { return parse_csv(text, "parts.csv"); }

Path square(float x, float y, float size) {
  Path path;
  path.move_to({x, y}).line_to({x + size, y}).line_to({x + size, y + size}).line_to({x, y + size}).close();
  return path;
}

/// Two squares; the second in a group that is moved by (100, 0).
Drawing two_squares() {
  Drawing drawing;
  drawing.width = 400;
  drawing.height = 300;
  DrawingStyle lines;
  lines.fill.reset();
  lines.stroke = Paint(glm::vec4(0, 0, 1, 1));
  drawing.add_path(square(20, 100, 80), drawing.add_style({}), "left");
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 100, 0});
  drawing.groups[group].id = "right";
  drawing.add_path(square(100, 100, 80), drawing.add_style(lines), {}, group);
  return drawing;
}

std::uint32_t group_of(const Drawing& drawing, const char* id) {
  const auto found = std::ranges::find(drawing.groups, id, &DrawingGroup::id);
  EXPECT_NE(found, drawing.groups.end()) << id;
  return static_cast<std::uint32_t>(found - drawing.groups.begin());
}

/// What is written, and the middle of it on the page.
std::map<std::string, glm::vec2> labels_of(const Drawing& drawing) {
  std::map<std::string, glm::vec2> labels;
  for (const PlacedPath& placed : walk(drawing)) {
    const DrawingPath& path = drawing.paths[placed.path];
    if (!path.text || placed.group != group_of(drawing, "labels")) continue;
    const Box2 box = bounds(drawing.view(path), placed.page_from_path);
    labels[drawing.texts[*path.text].text] = 0.5F * (box.lower + box.upper);
  }
  return labels;
}

/// Marks, without their halos, at their points with their colors.
std::vector<std::pair<glm::vec2, glm::vec4>> marks_of(const Drawing& drawing) {
  std::vector<std::pair<glm::vec2, glm::vec4>> marks;
  for (const DrawingItem& item : drawing.groups[group_of(drawing, "marks")].items) {
    const DrawingPath& path = drawing.paths[item.index];
    marks.emplace_back(drawing.points[path.first_point], drawing.styles[path.style].points->color);
  }
  return marks;
}

AnnotateOptions plain() {
  AnnotateOptions options;
  options.halo.a = 0;
  return options;
}

TEST(Annotate, PathsAndGroupsHaveLabelsInTheirMiddle) {
  const Drawing drawing = annotate(two_squares(), table("id,text\nleft,one\nright,two\n"), plain());
  const auto labels = labels_of(drawing);
  ASSERT_EQ(labels.size(), 2U);
  // Glyphs are not as high as the line: half of a font's size is near enough.
  EXPECT_NEAR(labels.at("one").x, 60, 2);
  EXPECT_NEAR(labels.at("one").y, 140, 7);
  EXPECT_NEAR(labels.at("two").x, 240, 2);
  EXPECT_NEAR(labels.at("two").y, 140, 7);
  drawing.check("annotate");
}

TEST(Annotate, ValuesAreColorsOfFillsOrElseLines) {
  const Drawing drawing = annotate(two_squares(), table("name,value\nleft,2\nright,6\n"), plain());
  const std::vector<glm::vec4> colors = map_colors(ColorMap::Viridis, 256);
  EXPECT_EQ(drawing.styles[drawing.paths[0].style].fill->color, colors.front());
  EXPECT_FALSE(drawing.styles[drawing.paths[0].style].stroke.has_value());
  EXPECT_EQ(drawing.styles[drawing.paths[1].style].stroke->color, colors.back());
  EXPECT_FALSE(drawing.styles[drawing.paths[1].style].fill.has_value());
  EXPECT_TRUE(labels_of(drawing).contains("6"));
  EXPECT_FALSE(drawing.groups[group_of(drawing, "color-bar")].items.empty());
  AnnotateOptions without = plain();
  without.bar = without.labels = false;
  const Drawing bare = annotate(two_squares(), table("name,value\nleft,2\nright,6\n"), without);
  EXPECT_TRUE(bare.groups[group_of(bare, "color-bar")].items.empty());
  EXPECT_TRUE(labels_of(bare).empty());
}

TEST(Annotate, PointsOfAnImage) {
  const Image image(200, 100, 3);
  const Drawing drawing = annotate(image, nullptr, table("x,y,label,value\n50,40,a,0\n150,60,b,10\n"), plain());
  EXPECT_EQ(drawing.width, 200);
  const auto marks = marks_of(drawing);
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].first, glm::vec2(50, 40));
  EXPECT_EQ(marks[1].second, map_colors(ColorMap::Viridis, 256).back());
  const auto labels = labels_of(drawing);
  EXPECT_GT(labels.at("a").x, 50);  // to the right of its mark
  EXPECT_NEAR(labels.at("a").y, 40, 7);
}

/// A region like a U: its middle is no part of it, the label's place is.
TEST(Annotate, RegionsOfAnImage) {
  const Image image(90, 60, 3);
  Image regions(90, 60, 1);
  const auto ids = regions.view<std::uint8_t>();
  for (int y = 10; y < 50; ++y) {
    for (int x = 10; x < 70; ++x) ids(x, y) = x < 20 || x >= 60 || y >= 44 ? 7 : 0;
  }
  AnnotateOptions options = plain();
  options.font_size = 40;  // doesn't fit: beside its place
  int warnings = 0;
  azulejo::Run run;
  run.warn = [&](const std::string& text) {
    ++warnings;
    EXPECT_EQ(text, "parts.csv: 2 of 3 rows are about nothing that is here, or outside of the picture");
  };
  options.labels = false;
  const auto marks = marks_of(annotate(image, &regions, table("id,text\n7,U\n8,none\n0,none\n"), options, run));
  EXPECT_EQ(warnings, 1);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(ids(static_cast<int>(marks[0].first.x), static_cast<int>(marks[0].first.y)), 7);
  const Image smaller(89, 60, 1);
  EXPECT_THROW(annotate(image, &smaller, table("id\n7\n"), options), Error);
}

TEST(Annotate, NodesAndPointsOfAScene) {
  Scene scene = scene_of(primitive({.kind = PrimitiveKind::Cube}));
  scene.nodes[0].name = "cube";
  CameraOptions camera;
  camera.view = ViewDirection::Front;
  AnnotateOptions options = plain();
  options.labels = false;
  const auto marks = marks_of(
      annotate(scene, camera, 400, 300, table("id,x,y,z,text\ncube,,,,all\n,0,0,99,behind\n,1,1,1,corner\n"), options));
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_NEAR(marks[0].first.x, 200, 0.1);
  EXPECT_NEAR(marks[0].first.y, 150, 0.1);
  // The cube fills nine tenths of the height: its nearer corner is there.
  EXPECT_NEAR(marks[1].first.x, 200 + 135, 0.5);
  EXPECT_NEAR(marks[1].first.y, 150 - 135, 0.5);
}

TEST(Annotate, ReadsJson) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "annotate.json").string();
  const auto read = [&](const char* text) {
    std::ofstream(path) << text;
    return read_annotations(path);
  };
  const CsvTable list = read(R"([{"id": "a", "value": 2}, {"id": "b", "text": "B", "extra": true}, {"value": 3}])");
  EXPECT_EQ(list.rows, 3U);
  EXPECT_EQ(list.column("id", "id").texts, (std::vector<std::string>{"a", "b", ""}));
  EXPECT_EQ(list.column("value", "value").numbers[2], 3);
  EXPECT_TRUE(std::isnan(list.column("value", "value").numbers[1]));
  EXPECT_EQ(list.column("text", "text").texts, (std::vector<std::string>{"", "B", ""}));
  const CsvTable ids = read(R"({"a": "first", "b": 2.5, "c": {"text": "third", "value": 1}})");
  EXPECT_EQ(ids.column("id", "id").texts, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(ids.column("text", "text").texts, (std::vector<std::string>{"first", "", "third"}));
  EXPECT_EQ(ids.column("value", "value").numbers[1], 2.5);
  for (const char* wrong : {"[]", "{}", "3", "[1, 2]", "{", ""}) EXPECT_THROW(read(wrong), Error) << wrong;
}

TEST(Annotate, RefusesTablesThatSayNothing) {
  EXPECT_THROW(annotate(two_squares(), table("a,b\n1,2\n")), Error);
  EXPECT_THROW(annotate(two_squares(), table("id,b\n1,2\n"), {.text = "none"}), Error);
  std::string rows = "id\n";
  for (int i = 0; i < 100001; ++i) rows += "a\n";
  EXPECT_THROW(annotate(two_squares(), table(rows.c_str())), Error);
  // Values of NaN, of one number, and none at all.
  const Drawing drawing = annotate(two_squares(), table("id,value\nleft,nan\nright,nan\n"));
  EXPECT_TRUE(drawing.groups[group_of(drawing, "color-bar")].items.empty());
  EXPECT_NO_THROW(annotate(two_squares(), table("id,value\nleft,3\nright,3\n")));
  EXPECT_NO_THROW(annotate(Drawing(), table("id,value\nleft,3\nright,3\n")));
}

}  // namespace
}  // namespace azulejo
