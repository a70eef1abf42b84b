#include "azulejo/charting/color_by.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

/// Two triangles that rise along y from 0 to 2.
Mesh slope() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 5}};
  mesh.corners = {0, 1, 2, 2, 1, 3};
  return mesh;
}

using Bytes = Array<std::uint8_t>;

const Attribute& colors(const ColoredMesh& colored) { return *colored.mesh.find("COLOR_0"); }

TEST(ColorBy, CoordinatesRunThroughTheMap) {
  const ColoredMesh colored = color_by(slope(), {.attribute = "y", .map = ColorMap::Gray});
  EXPECT_EQ(colors(colored).domain, Domain::Vertex);
  EXPECT_EQ(*colors(colored).get<std::uint8_t>(), (Bytes{0, 0, 0, 128, 128, 128, 255, 255, 255, 255, 255, 255}));
  colored.mesh.check("mesh");
  colored.bar.check("bar");
}

TEST(ColorBy, ARangeIsKeptTo) {
  const ColoredMesh colored = color_by(slope(), {.attribute = "z", .map = ColorMap::Gray, .range = glm::vec2(-5, 5)});
  EXPECT_EQ((*colors(colored).get<std::uint8_t>())[0], 128);
  EXPECT_EQ((*colors(colored).get<std::uint8_t>())[9], 255);
}

TEST(ColorBy, FacesColorTheirCorners) {
  Mesh mesh = slope();
  mesh.attributes.push_back({"quality", Domain::Face, 1, Array<float>{3, 7}});
  const ColoredMesh colored = color_by(mesh, {.attribute = "quality", .map = ColorMap::Gray});
  EXPECT_EQ(colors(colored).domain, Domain::Corner);
  EXPECT_EQ(*colors(colored).get<std::uint8_t>(),
            (Bytes{0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255}));
}

TEST(ColorBy, VectorsCountByTheirLengthOrAComponent) {
  Mesh mesh = slope();
  mesh.attributes.push_back({"flow", Domain::Vertex, 2, Array<float>{3, 4, 0, 0, -10, 0, 0, 1}});
  const Bytes lengths = *colors(color_by(mesh, {.attribute = "flow", .map = ColorMap::Gray})).get<std::uint8_t>();
  EXPECT_EQ(lengths[0], 128);
  EXPECT_EQ(lengths[6], 255);
  const Bytes x =
      *colors(color_by(mesh, {.attribute = "flow", .component = 0, .map = ColorMap::Gray})).get<std::uint8_t>();
  EXPECT_EQ(x[6], 0);
  EXPECT_EQ(x[0], 255);
  EXPECT_THROW(color_by(mesh, {.attribute = "flow", .component = 2}), Error);
  EXPECT_THROW(color_by(mesh, {.attribute = "x", .component = 0}), Error);
}

TEST(ColorBy, WhatIsNoNumberHasAColorOfItsOwn) {
  Mesh mesh = slope();
  mesh.positions[1].y = NAN;
  const Bytes bytes =
      *colors(color_by(mesh, {.attribute = "y", .map = ColorMap::Gray, .nan_color = {1, 0, 0, 1}})).get<std::uint8_t>();
  EXPECT_EQ(bytes[3], 255);
  EXPECT_EQ(bytes[4], 0);
  EXPECT_EQ(bytes[0], 0);
  EXPECT_EQ(bytes[6], 255);
}

TEST(ColorBy, AnEarlierColorIsReplaced) {
  Mesh mesh = slope();
  mesh.attributes.push_back({"COLOR_0", Domain::Corner, 4, Array<float>(24, 1)});
  const ColoredMesh colored = color_by(mesh, {.attribute = "y"});
  EXPECT_EQ(std::count_if(colored.mesh.attributes.begin(), colored.mesh.attributes.end(),
                          [](const Attribute& each) { return each.name == "COLOR_0"; }),
            1);
}

TEST(ColorBy, TheBarSaysWhatColorsMean) {
  const ColoredMesh colored = color_by(slope(), {.attribute = "y", .label = "height (m)"});
  std::vector<std::string> texts;
  for (const DrawingText& text : colored.bar.texts) texts.push_back(text.text);
  EXPECT_NE(std::find(texts.begin(), texts.end(), "height (m)"), texts.end());
  EXPECT_NE(std::find(texts.begin(), texts.end(), "1.0"), texts.end());
  const Box2 box = bounds(colored.bar);
  EXPECT_GE(box.lower.x, 0);
  EXPECT_GE(box.lower.y, 0);
  EXPECT_LE(box.upper.x, colored.bar.width);
  EXPECT_LE(box.upper.y, colored.bar.height);
}

TEST(ColorBy, NamesWhatThereIs) {
  Mesh mesh = slope();
  mesh.attributes.push_back({"quality", Domain::Face, 1, Array<float>{3, 7}});
  try {
    (void)color_by(mesh, {.attribute = "depth"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "attribute: depth, expected one of x, y, z, quality");
  }
}

}  // namespace
}  // namespace azulejo
