#include "azulejo/lifting.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/stages.h"

namespace azulejo {
namespace {

struct MoveOptions {
  float by = 1;
};

int calls = 0;

/// Moves a mesh along x, and says how many vertices it has.
std::vector<Value> move(std::span<const Value> inputs, const MoveOptions& options, const Run& run) {
  ++calls;
  Mesh mesh = inputs[0].mesh()->clone();
  for (glm::vec3& position : mesh.positions) position.x += options.by;
  mesh.morph_targets.clear();
  if (run.stages != nullptr) run.stages->report("move", "vertices", Json(0));
  Report report;
  report.json.set("vertices", static_cast<std::uint64_t>(mesh.vertex_count())).set("axis", "x").set("by", options.by);
  report.verdict = mesh.vertex_count() < 4;
  return {Value(std::move(mesh)), Value(std::move(report))};
}

Operation move_operation() {
  return value_operation<MoveOptions>("move", "Moves.", {{"source", "the mesh", ValueKind::Mesh}},
                                      {{"mesh", "moved", ValueKind::Mesh}, {"report", "what", ValueKind::Report}},
                                      {field("by", &MoveOptions::by, {0, 9}, "", "how far")}, move);
}

std::shared_ptr<const Mesh> points(const std::string& name, std::size_t count) {
  Mesh mesh;
  mesh.name = name;
  mesh.positions.assign(count, glm::vec3(0, 0, 0));
  return std::make_shared<const Mesh>(std::move(mesh));
}

/// Three assets, two of them one and the same; four nodes, two of which show one asset.
Scene three_meshes() {
  Scene scene;
  const auto same = points("two", 2);
  scene.meshes = {same, points("three", 3), same};
  scene.materials.resize(2);
  for (const std::size_t mesh : {0U, 1U, 2U, 1U}) {
    scene.roots.emplace_back(scene.nodes.size());
    scene.nodes.emplace_back().mesh = MeshId(mesh);
  }
  return scene;
}

TEST(Lifting, IsForOperationsOnOneMesh) {
  Operation operation = move_operation();
  EXPECT_TRUE(is_liftable(operation));
  operation.inputs.push_back({"picture", "", ValueKind::Image});
  EXPECT_TRUE(is_liftable(operation));
  operation.inputs.push_back({"other", "", ValueKind::Mesh});
  EXPECT_FALSE(is_liftable(operation));
  operation.inputs.resize(1);
  operation.outputs.push_back({"picture", "", ValueKind::Image});
  EXPECT_FALSE(is_liftable(operation));
  operation.outputs.resize(2);
  operation.inputs[0].kind = ValueKind::Scene;
  EXPECT_FALSE(is_liftable(operation));
  operation.inputs.clear();
  EXPECT_FALSE(is_liftable(operation));
}

TEST(Lifting, RunsOnceForEachAssetAndKeepsTheRest) {
  calls = 0;
  const MoveOptions options{2};
  const Value inputs[] = {Value(three_meshes())};
  const auto results = invoke_lifted(move_operation(), &options, inputs, {}, "1-move");
  EXPECT_EQ(calls, 2);
  const Scene* const scene = results[0].scene();
  ASSERT_NE(scene, nullptr);
  EXPECT_NO_THROW(scene->check("scene"));
  EXPECT_EQ(scene->nodes.size(), 4U);
  EXPECT_EQ(scene->materials.size(), 2U);
  EXPECT_EQ(scene->meshes[0], scene->meshes[2]);
  EXPECT_EQ(scene->meshes[1]->positions[2], glm::vec3(2, 0, 0));
  EXPECT_EQ(inputs[0].scene()->meshes[1]->positions[2], glm::vec3(0, 0, 0));
}

TEST(Lifting, ReportsTellEachMeshAndTheSums) {
  const MoveOptions options{1.5F};
  const Value inputs[] = {Value(three_meshes())};
  const auto results = invoke_lifted(move_operation(), &options, inputs, {}, "1-move");
  const Report* const report = results[1].report();
  ASSERT_NE(report, nullptr);
  EXPECT_TRUE(report->verdict);
  EXPECT_EQ(report->json.dump(-1),
            R"({"vertices":7,"by":4.5,"meshes":[{"name":"two","vertices":2,"axis":"x","by":1.5},)"
            R"({"name":"three","vertices":3,"axis":"x","by":1.5},{"name":"two","vertices":2,"axis":"x","by":1.5}]})");
  Scene large = three_meshes();
  large.meshes[1] = points("four", 4);
  const Value again[] = {Value(std::move(large))};
  EXPECT_FALSE(invoke_lifted(move_operation(), &options, again, {}, "1-move")[1].report()->verdict);
}

TEST(Lifting, CountsAreDividedInProportionToTriangles) {
  struct CountOptions {
    std::optional<int> count = std::nullopt;
    int seed = 5;
  };
  const auto told = [](std::span<const Value>, const CountOptions& options, const azulejo::Run&) {
    Report report;
    report.json.set("count", options.count.value_or(-1)).set("seed", options.seed);
    return std::vector<Value>{Value(std::move(report))};
  };
  const Operation operation = value_operation<CountOptions>(
      "count", "Counts.", {{"source", "the mesh", ValueKind::Mesh}}, {{"report", "what", ValueKind::Report}},
      {shared_by_meshes(field("count", &CountOptions::count, {0, 1e6}, "", "how many")),
       field("seed", &CountOptions::seed, {0, 9}, "", "of chance")},
      told);
  Scene scene;
  for (const std::size_t triangles : {1U, 0U, 4U, 2U}) {
    Mesh mesh;
    mesh.positions.resize(3);
    mesh.corners.assign(3 * triangles, 0);
    scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  }
  scene.meshes.push_back(scene.meshes[2]);
  const Value source(std::move(scene));
  CountOptions options;
  options.count = 100;
  options.seed = 8;
  const auto counts = [&] {
    const std::vector<Value> results = invoke_lifted(operation, &options, std::span(&source, 1), {}, "count");
    const Json& meshes = results[0].report()->json["meshes"];
    std::vector<double> list;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      list.push_back(meshes[i]["count"].number());
      EXPECT_EQ(meshes[i]["seed"].number(), 8);
    }
    return list;
  };
  // 100/7 = 14.3, 500/7 = 71.4: each share is what a sum rounded down grows by. The last mesh is the third once more.
  EXPECT_EQ(counts(), (std::vector<double>{14, 0, 57, 29, 57}));
  options.count.reset();
  EXPECT_EQ(counts(), (std::vector<double>{-1, -1, -1, -1, -1}));
}

TEST(Lifting, ASceneWithoutMeshesStaysOne) {
  const MoveOptions options;
  const Value inputs[] = {Value(Scene())};
  const auto results = invoke_lifted(move_operation(), &options, inputs, {}, "1-move");
  EXPECT_NE(results[0].scene(), nullptr);
  EXPECT_EQ(results[1].report()->json.dump(-1), R"({"meshes":[]})");
  const MoveOptions wrong{-1};
  EXPECT_THROW(invoke_lifted(move_operation(), &wrong, inputs, {}, "1-move"), Error);
}

TEST(Lifting, NamesTheStagesOfEachMesh) {
  struct Collect final : Stages {
    void image(const std::string&, const std::string&, const Image&) override {}
    void report(const std::string& step, const std::string&, const Json&) override { seen += step + " "; }
    std::string seen;
  } collect;
  azulejo::Run run;
  run.stages = &collect;
  const MoveOptions options;
  const Value several[] = {Value(three_meshes())};
  invoke_lifted(move_operation(), &options, several, run, "2-move");
  EXPECT_EQ(collect.seen, "2-move-0 2-move-1 ");
}

TEST(Lifting, MorphWeightsGoWithTheShapesTheyAreFor) {
  Scene scene = three_meshes();
  Mesh shaped = points("shaped", 1)->clone();
  shaped.morph_targets.resize(1);
  shaped.morph_targets[0].positions.assign(1, glm::vec3(1, 0, 0));
  scene.meshes[1] = std::make_shared<const Mesh>(std::move(shaped));
  scene.nodes[1].morph_weights = {0};
  Animation& animation = scene.animations.emplace_back();
  animation.channels.resize(2);
  animation.channels[0].node = NodeId(1);
  animation.channels[0].property = AnimatedProperty::MorphWeights;
  animation.channels[1].node = NodeId(1);
  const MoveOptions options;
  const Value inputs[] = {Value(std::move(scene))};
  const auto results = invoke_lifted(move_operation(), &options, inputs, {}, "1-move");
  EXPECT_TRUE(results[0].scene()->nodes[1].morph_weights.empty());
  ASSERT_EQ(results[0].scene()->animations[0].channels.size(), 1U);
  EXPECT_EQ(results[0].scene()->animations[0].channels[0].property, AnimatedProperty::Translation);
}

TEST(Lifting, PosesSkinnedScenesWithAWarning) {
  Scene scene = three_meshes();
  // A vertex of weight 1 on a joint that stands at x = 10.
  Mesh skinned = points("skinned", 1)->clone();
  skinned.attributes.push_back({"JOINTS_0", Domain::Vertex, 4, Array<std::uint32_t>{0, 0, 0, 0}});
  skinned.attributes.push_back({"WEIGHTS_0", Domain::Vertex, 4, Array<float>{1, 0, 0, 0}});
  scene.meshes[1] = std::make_shared<const Mesh>(std::move(skinned));
  scene.roots.emplace_back(scene.nodes.size());
  scene.nodes.emplace_back().placement = Placement{.translation = {10, 0, 0}, .rotation = {1, 0, 0, 0}};
  scene.skins.emplace_back().joints = {NodeId(4)};
  scene.nodes[1].skin = SkinId(0);
  std::vector<std::string> warnings;
  azulejo::Run run;
  run.warn = [&](const std::string& text) { warnings.push_back(text); };
  const MoveOptions options;
  const Value inputs[] = {Value(std::move(scene))};
  const auto results = invoke_lifted(move_operation(), &options, inputs, run, "1-move");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with("move: ")) << warnings[0];
  const Box3 box = bounds(*results[0].scene());
  EXPECT_EQ(box.upper.x, 11);
}

}  // namespace
}  // namespace azulejo
