#include "azulejo/conversion.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Mesh triangle() {
  Mesh mesh;
  mesh.name = "triangle";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  mesh.space.up = UpAxis::Z;
  return mesh;
}

TEST(Conversion, IsBetweenFourPairsOnly) {
  using enum ValueKind;
  const ValueKind kinds[] = {Image, Labels, Report, Mesh, Scene, Volume, Frame};
  int others = 0;
  for (const ValueKind from : kinds) {
    for (const ValueKind to : kinds) others += from != to && converts(from, to) ? 1 : 0;
    EXPECT_TRUE(converts(from, from));
  }
  EXPECT_EQ(others, 4);
  EXPECT_TRUE(converts(Mesh, Scene));
  EXPECT_TRUE(converts(Scene, Mesh));
  EXPECT_TRUE(converts(Frame, Image));
  EXPECT_TRUE(converts(Labels, Image));
  EXPECT_THROW(convert(Value(azulejo::Volume()), Image, {}), Error);
}

TEST(Conversion, AMeshIsSharedByTheSceneAroundIt) {
  const Value mesh(triangle());
  const Value scene = convert(mesh, ValueKind::Scene, {});
  ASSERT_NE(scene.scene(), nullptr);
  ASSERT_EQ(scene.scene()->meshes.size(), 1U);
  EXPECT_EQ(scene.scene()->meshes[0].get(), mesh.mesh());
  EXPECT_EQ(scene.scene()->space.up, UpAxis::Z);
  EXPECT_EQ(scene.scene()->nodes[0].name, "triangle");
  EXPECT_NO_THROW(scene.scene()->check("scene"));
}

TEST(Conversion, ASceneAroundAMeshHasNoMaterialsToName) {
  Mesh mesh = triangle();
  mesh.material = {3};
  const Value scene = convert(Value(std::move(mesh)), ValueKind::Scene, {});
  EXPECT_NO_THROW(scene.scene()->check("scene"));
}

TEST(Conversion, ASceneIsFlattened) {
  Scene scene = scene_of(triangle());
  scene.nodes[0].placement = Placement{.translation = {5, 0, 0}, .rotation = {1, 0, 0, 0}, .scale = {1, 1, 1}};
  const Value mesh = convert(Value(std::move(scene)), ValueKind::Mesh, {});
  ASSERT_NE(mesh.mesh(), nullptr);
  ASSERT_EQ(mesh.mesh()->positions.size(), 3U);
  EXPECT_EQ(mesh.mesh()->positions[1], glm::vec3(6, 0, 0));
}

TEST(Conversion, AFrameIsItsColorElseItsFirstLayer) {
  Frame frame;
  frame.layers.push_back({"depth", Image(4, 3, 1)});
  frame.layers.push_back({"color", Image(4, 3, 4)});
  const Value both(std::move(frame));
  EXPECT_EQ(convert(both, ValueKind::Image, {}).image(), &both.frame()->layers[1].image);
  Frame depth;
  depth.layers.push_back({"depth", Image(4, 3, 1)});
  EXPECT_EQ(convert(Value(std::move(depth)), ValueKind::Image, {}).image()->channels(), 1);
  EXPECT_THROW(convert(Value(Frame()), ValueKind::Image, {}), Error);
}

TEST(Conversion, LabelsAreIds) {
  Labels labels(3, 2);
  labels.view()(2, 1) = 65535;
  Value image = convert(Value(labels.clone()), ValueKind::Image, {});
  EXPECT_EQ(image.image()->info(), (ImageInfo{3, 2, 1, PixelType::U16, ColorState::Data, AlphaState::None}));
  EXPECT_EQ(image.image()->view<std::uint16_t>()(2, 1), 65535);
  EXPECT_EQ(image.image()->view<std::uint16_t>()(1, 1), 0);
  labels.view()(0, 0) = 65536;
  image = convert(Value(std::move(labels)), ValueKind::Image, {});
  EXPECT_EQ(image.image()->type(), PixelType::F32);
  EXPECT_EQ(image.image()->view<float>()(0, 0), 65536);
}

}  // namespace
}  // namespace azulejo
