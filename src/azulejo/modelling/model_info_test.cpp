#include "azulejo/modelling/model_info.h"

#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "azulejo/modelling/scene_tree.h"

namespace azulejo {
namespace {

/// Two triangles and a quad in one plane; the second triangle has no area.
Mesh flat_pieces() {
  Mesh mesh;
  mesh.name = "pieces";
  for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 1}, {0, 1}, {4, 0}, {9, 9}})
    mesh.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
  for (const std::uint32_t corner : {0, 1, 2, 3, 1, 4, 2, 0, 1, 4}) mesh.corners.push_back(corner);
  for (const std::uint32_t offset : {0, 4, 7, 10}) mesh.face_offsets.push_back(offset);
  mesh.attributes.push_back({"COLOR_0", Domain::Face, 3, Array<std::uint8_t>(9)});
  mesh.check("pieces");
  return mesh;
}

/// A square to look at from above, one unit wide.
Mesh square() {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
    mesh.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
  for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) mesh.corners.push_back(corner);
  return mesh;
}

Node named(const char* name, glm::vec3 moved = {0, 0, 0}) {
  Node node;
  node.name = name;
  node.placement = Placement{.translation = moved};
  return node;
}

/// root → (left with the square, right → deep with the square, hidden with the square)
Scene small_scene() {
  Scene scene;
  scene.meshes.push_back(std::make_shared<const Mesh>(square()));
  scene.nodes = {named("root"), named("left"), named("right", {10, 0, 0}), named("deep", {0, 5, 0}), named("hidden")};
  scene.nodes[0].children = {NodeId(1), NodeId(2)};
  scene.nodes[2].children = {NodeId(3), NodeId(4)};
  scene.nodes[4].visible = false;
  for (const std::size_t node : {1, 3, 4}) scene.nodes[node].mesh = MeshId(0);
  scene.roots = {NodeId(0)};
  scene.cameras.push_back({.name = "eye"});
  scene.nodes[1].camera = CameraId(0);
  scene.textures.emplace_back();
  scene.textures.back().source = "gone.png";
  scene.check("small scene");
  return scene;
}

TEST(ModelInfo, CountsAMesh) {
  const ModelInfo info = model_info(flat_pieces());
  EXPECT_EQ(info.kind, "mesh");
  EXPECT_EQ(info.name, "pieces");
  ASSERT_TRUE(info.mesh);
  EXPECT_EQ(info.mesh->vertices, 6U);
  EXPECT_EQ(info.mesh->faces, 3U);
  EXPECT_EQ(info.mesh->triangles, 4U);
  EXPECT_EQ(info.mesh->corners, 10U);
  EXPECT_EQ(info.mesh->polygons, (std::map<std::size_t, std::size_t>{{3, 2}, {4, 1}}));
  EXPECT_EQ(info.mesh->flat_faces, 1U);
  EXPECT_EQ(info.bounds, (Box3{{0, 0, 0}, {9, 9, 0}}));
  ASSERT_EQ(info.mesh->attributes.size(), 1U);
  EXPECT_EQ(info.mesh->attributes[0].type, "u8");
}

TEST(ModelInfo, TellsWhatIsNotFinite) {
  Mesh mesh = square();
  mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[2].z = std::numeric_limits<float>::infinity();
  const ModelInfo info = model_info(std::move(mesh));
  EXPECT_EQ(info.mesh->not_finite_vertices, 2U);
  EXPECT_EQ(info.bounds, (Box3{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(info.mesh->flat_faces, 0U) << "of a face without numbers nothing is known";
}

TEST(ModelInfo, OfNothing) {
  for (Model& model : std::vector<Model>([] {
         std::vector<Model> models;
         models.emplace_back(Mesh());
         models.emplace_back(Scene());
         models.emplace_back(Volume());
         return models;
       }())) {
    const ModelInfo info = model_info(model);
    EXPECT_FALSE(to_text(info).empty());
    EXPECT_FALSE(to_json(info).dump().empty());
  }
  EXPECT_EQ(scene_tree(Scene()), "");
}

TEST(ModelInfo, CountsInstancesThatAreShown) {
  const ModelInfo info = model_info(small_scene());
  ASSERT_TRUE(info.scene);
  EXPECT_EQ(info.scene->nodes, 5U);
  EXPECT_EQ(info.scene->shown_nodes, 4U);
  EXPECT_EQ(info.scene->depth, 3U);
  EXPECT_EQ(info.scene->instances, 2U);
  EXPECT_EQ(info.scene->shown_triangles, 4U);
  EXPECT_EQ(info.scene->closed_meshes, 0U);
  EXPECT_EQ(info.mesh->vertices, 4U) << "a mesh counts once";
  EXPECT_EQ(info.scene->each_mesh[0].uses, 2U);
  EXPECT_EQ(info.bounds, (Box3{{0, 0, 0}, {11, 6, 0}}));
}

TEST(ModelInfo, MeasuresAVolume) {
  Volume volume;
  volume.width = 2;
  volume.height = 1;
  volume.depth = 3;
  volume.spacing = {-2, 1, 0.5F};
  volume.origin = {1, 1, 1};
  for (const float each : {1.0F, -3.0F, std::nanf(""), 4.0F, INFINITY, 6.0F}) volume.samples.push_back(each);
  const ModelInfo info = model_info(std::move(volume));
  EXPECT_EQ(info.volume->lowest, -3.0F);
  EXPECT_EQ(info.volume->highest, 6.0F);
  EXPECT_EQ(info.volume->mean, 2.0);
  EXPECT_EQ(info.volume->not_finite, 2U);
  EXPECT_EQ(info.bounds, (Box3{{-1, 1, 1}, {1, 1, 2}}));
}

TEST(ModelInfo, TextHasALineForEach) {
  Mesh mesh = flat_pieces();
  mesh.space = {UpAxis::Z, 0.001F};
  EXPECT_EQ(to_text(model_info(std::move(mesh))),
            "  name        \"pieces\"\n"
            "  vertices    6\n"
            "  faces       3: 2 triangles, 1 quad\n"
            "  attributes  COLOR_0      3 × u8, of each face\n"
            "  closed      no: 4 edges with one face, 2 edges between faces turned against each other\n"
            "  flat        1 face without area\n"
            "  bounds      (0, 0, 0) to (9, 9, 0)\n"
            "  size        9 × 9 × 0\n"
            "  unit        millimetre\n"
            "  up          z\n");
}

TEST(ModelInfo, JsonHasTheSame) {
  const Json json = to_json(model_info(small_scene()));
  EXPECT_EQ(json["kind"].text(), "scene");
  EXPECT_EQ(json["vertices"].number(), 4);
  EXPECT_EQ(json["nodes"].number(), 5);
  EXPECT_EQ(json["meshes"][0]["uses"].number(), 2);
  EXPECT_EQ(json["bounds"]["upper"][0].number(), 11);
  EXPECT_TRUE(json["textures"][0]["missing"].truth());
  EXPECT_EQ(json["cameras"][0]["name"].text(), "eye");
  EXPECT_FALSE(json["closed"].truth(true));
  EXPECT_TRUE(json["metres_per_unit"].is_null());
}

TEST(SceneTree, DrawsChildrenBelowTheirParents) {
  EXPECT_EQ(scene_tree(small_scene()),
            "root\n"
            "├─ left  [mesh 0, 2 faces]  [camera \"eye\"]\n"
            "└─ right  moved 10 0 0\n"
            "   ├─ deep  [mesh 0, 2 faces]  moved 0 5 0\n"
            "   └─ hidden  [mesh 0, 2 faces]  [hidden]\n");
}

TEST(SceneTree, SaysHowNodesArePlaced) {
  Scene scene;
  scene.nodes.resize(4);
  scene.nodes[0].placement = glm::mat4(1.0F);
  scene.nodes[1].placement = glm::mat4(2.0F);
  scene.nodes[2].placement = Placement{.rotation = {0.70710678F, 0, 0.70710678F, 0}, .scale = {2, 2, 2}};
  scene.nodes[3].placement = Placement{.scale = {1, 2, 3}};
  for (std::size_t i = 0; i < 4; ++i) scene.roots.emplace_back(i);
  EXPECT_EQ(scene_tree(scene), "node 0\nnode 1  matrix\nnode 2  turned 90°, scaled 2\nnode 3  scaled 1 2 3\n");
  EXPECT_EQ(nodes_json(scene)[1]["matrix"].size(), 16U);
  EXPECT_EQ(nodes_json(scene)[3]["scale"][1].number(), 2);
  EXPECT_EQ(roots_json(scene).size(), 4U);
}

TEST(SceneTree, AnyDepthAndAMillionNodes) {
  constexpr std::size_t kNodes = 1'000'000;
  Scene chain;
  chain.nodes.resize(kNodes);
  for (std::size_t i = 0; i + 1 < kNodes; ++i) chain.nodes[i].children = {NodeId(i + 1)};
  chain.roots = {NodeId(0)};
  const std::string tree = scene_tree(chain);
  EXPECT_LT(tree.size(), kNodes * 160) << "the lines of deep nodes grow no longer";
  EXPECT_NE(tree.find("(999999 deep) node 999999\n"), std::string::npos);
  EXPECT_EQ(model_info(std::move(chain)).scene->depth, kNodes);
}

TEST(ModelInfo, ManyInstancesOfALargeMeshHaveABoxOfBoxes) {
  Scene scene;
  Mesh points;
  points.positions.resize(1'000'000, glm::vec3(1, 2, 3));
  scene.meshes.push_back(std::make_shared<const Mesh>(std::move(points)));
  scene.nodes.resize(1000);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    scene.nodes[i].mesh = MeshId(0);
    scene.nodes[i].placement = Placement{.translation = {static_cast<float>(i), 0, 0}};
    scene.roots.emplace_back(i);
  }
  const ModelInfo info = model_info(std::move(scene));
  EXPECT_FALSE(info.bounds_exact);
  EXPECT_EQ(info.bounds, (Box3{{1, 2, 3}, {1000, 2, 3}}));
}

TEST(ModelInfo, TellsADrawing) {
  Drawing drawing;
  drawing.width = 210;
  drawing.height = 297;
  drawing.unit = DrawingUnit::Millimetre;
  DrawingStyle style;
  style.fill = Paint({1, 1, 1, 1}, drawing.add_pattern(Gradient()));
  const std::uint32_t index = drawing.add_style(style);
  const std::uint32_t group = drawing.add_group({1, 0, 0, 1, 10, 20}, 1, drawing.add_group({1, 0, 0, 1, 0, 0}));
  drawing.add_path(Path().move_to({0, 0}).line_to({5, 0}).cubic_to({6, 1}, {6, 2}, {5, 3}).close(), index, "", group);
  const std::uint32_t clip = drawing.add_clip();
  drawing.add_path(Path().move_to({0, 0}).line_to({std::numeric_limits<float>::quiet_NaN(), 0}), index, "", clip);
  drawing.groups[group].clip = clip;

  const ModelInfo info = model_info(Model(drawing.clone()));
  EXPECT_EQ(info.kind, "drawing");
  EXPECT_FLOAT_EQ(info.metres_per_unit, 1e-3F);
  ASSERT_TRUE(info.drawing.has_value());
  EXPECT_EQ(info.drawing->paths, 2U);
  EXPECT_EQ(info.drawing->shown_paths, 1U);
  EXPECT_EQ(info.drawing->segments, 4U);
  EXPECT_EQ(info.drawing->curves, 1U);
  EXPECT_EQ(info.drawing->not_finite_points, 1U);
  EXPECT_EQ(info.drawing->groups, 4U);
  EXPECT_EQ(info.drawing->depth, 3U);
  EXPECT_EQ(info.drawing->gradients, 1U);
  EXPECT_EQ(info.drawing->clips, 1U);
  EXPECT_EQ(info.bounds.lower, glm::vec3(10, 20, 0));
  EXPECT_EQ(to_json(info)["unit"].text(), "mm");
  EXPECT_NE(to_text(info).find("210 × 297 mm"), std::string::npos);
}

}  // namespace
}  // namespace azulejo
