// Models in a chain: kinds, conversions and files. The operations are the test's own.
#include <array>
#include <filesystem>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/pipeline.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

struct NoOptions {};

Mesh triangle() {
  Mesh mesh;
  mesh.name = "triangle";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  return mesh;
}

/// Two nodes that show one triangle.
Scene pair() {
  Scene scene = scene_of(triangle());
  scene.roots.emplace_back(scene.nodes.size());
  Node& node = scene.nodes.emplace_back();
  node.mesh = MeshId(0);
  node.placement = Placement{.translation = {5, 0, 0}, .rotation = {1, 0, 0, 0}, .scale = {1, 1, 1}};
  return scene;
}

enum class Shade : std::uint8_t { Display, Linear };
constexpr std::array<std::string_view, 2> enum_names(Shade) { return {"display", "linear"}; }
struct RenderOptions {
  std::optional<Shade> output;
  bool depth = false;
};

/// One pixel a mesh, of 188 or of 0.5 in linear light.
std::vector<Value> render(std::span<const Value> inputs, const RenderOptions& options, const Run&) {
  const int width = static_cast<int>(inputs[0].scene()->nodes.size());
  const bool linear = options.output.value_or(Shade::Display) == Shade::Linear;
  Image color({width, 1, 3, linear ? PixelType::F32 : PixelType::U8, linear ? ColorState::Linear : ColorState::Srgb,
               AlphaState::None});
  for (int i = 0; i < 3 * width; ++i) {
    if (linear) {
      color.view<float>().row(0)[i] = 0.5F;
    } else {
      color.view<std::uint8_t>().row(0)[i] = 188;
    }
  }
  Frame frame;
  if (options.depth)
    frame.layers.push_back({"depth", Image({width, 1, 1, PixelType::F32, ColorState::Data, AlphaState::None})});
  frame.layers.push_back({"color", std::move(color)});
  return {Value(std::move(frame)), Value()};
}

std::vector<Value> join(std::span<const Value> inputs, const NoOptions&, const Run&) {
  Mesh mesh;
  for (const Value& each : inputs) {
    const Mesh& part = *each.mesh();
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  }
  return {Value(std::move(mesh))};
}

std::vector<Value> move(std::span<const Value> inputs, const NoOptions&, const Run&) {
  Mesh mesh = inputs[0].mesh()->clone();
  for (glm::vec3& position : mesh.positions) position.z += 3;
  return {Value(std::move(mesh))};
}

std::vector<Value> count(std::span<const Value> inputs, const NoOptions&, const Run&) {
  Report report;
  report.json.set("vertices", static_cast<std::uint64_t>(inputs[0].mesh()->vertex_count()));
  return {Value(std::move(report))};
}

const Operation kCount = value_operation<NoOptions>("count", "Counts.", {{"source", "", ValueKind::Mesh}},
                                                    {{"report", "", ValueKind::Report}}, {}, count);
const Operation kJoin =
    value_operation<NoOptions>("join", "Joins.", {{"source", "", ValueKind::Mesh}, {"other", "", ValueKind::Mesh}},
                               {{"mesh", "", ValueKind::Mesh}}, {}, join);
const Operation kMake = value_operation<NoOptions>(
    "make", "Makes a triangle.", {}, {{"mesh", "", ValueKind::Mesh}}, {},
    [](std::span<const Value>, const NoOptions&, const Run&) { return std::vector<Value>{Value(triangle())}; });
const Operation kMove = value_operation<NoOptions>("move", "Moves.", {{"source", "", ValueKind::Mesh}},
                                                   {{"mesh", "", ValueKind::Mesh}}, {}, move);
const Operation kRender = with_float_output(
    value_operation<RenderOptions>(
        "render", "Draws.", {{"source", "", ValueKind::Scene}},
        {{"frame", "", ValueKind::Frame}, {"depth_layer", "", ValueKind::Image}},
        {field("output", &RenderOptions::output, "pixels"), field("depth", &RenderOptions::depth, "depth too")},
        render),
    "output=linear");

/// A page of 6 × 4, with its outline's bounds as a report and as a map of them.
const Operation kSketch = value_operation<NoOptions>(
    "sketch", "Draws lines.", {},
    {{"report", "", ValueKind::Report}, {"drawing", "", ValueKind::Drawing}, {"mesh", "", ValueKind::Mesh}}, {},
    [](std::span<const Value>, const NoOptions&, const Run&) {
      Drawing drawing;
      drawing.width = 6;
      drawing.height = 4;
      std::vector<Value> values;
      values.emplace_back(Report());
      values.emplace_back(std::move(drawing));
      values.emplace_back(triangle());
      return values;
    });
const Operation kDraw = value_operation<NoOptions>(
    "draw", "Draws.", {{"drawing", "", ValueKind::Drawing}}, {{"image", "", ValueKind::Image}}, {},
    [](std::span<const Value> inputs, const NoOptions&, const Run&) {
      const Drawing& drawing = *inputs[0].drawing();
      std::vector<Value> values;
      values.emplace_back(Image(static_cast<int>(drawing.width), static_cast<int>(drawing.height), 3));
      return values;
    });

class PipelineModels : public testing::Test {
 protected:
  PipelineModels()
      : folder_(fs::path(testing::TempDir()) /
                ("models-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PipelineModels() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Pipeline pipeline() {
    azulejo::Run run;
    run.warn = [this](const std::string& text) { warnings_ += text + "\n"; };
    return Pipeline(run, {}, operations_);
  }

  /// The pixel that a render of the pair has in a file.
  Image rendered(const std::string& stage, const std::vector<std::string>& files) {
    Pipeline chain = pipeline();
    chain.add_value(Value(pair()), "pair");
    chain.add_stage(stage);
    for (const std::string& file : files) chain.add_output(path(file));
    EXPECT_TRUE(chain.execute({}));
    return read_image(path(files[0]));
  }

  std::string warnings_;

 private:
  fs::path folder_;
  const Operation* operations_[8] = {
      find_operation("blend"), &kCount, &kDraw, &kJoin, &kMake, &kMove, &kRender, &kSketch};
};

template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(PipelineModels, AFileIsReadAsWhatItIs) {
  write_model(triangle(), path("a.stl"));
  Pipeline chain = pipeline();
  chain.add_file(path("a.stl"));
  ASSERT_NE(chain.compute().mesh(), nullptr);
  chain.add_output(path("b.obj"));
  EXPECT_TRUE(chain.execute({}));
  const Model model = read_model(path("b.obj"));
  ASSERT_TRUE(std::holds_alternative<Scene>(model));
  EXPECT_EQ(std::get<Scene>(model).meshes.at(0)->face_count(), 1U);
}

TEST_F(PipelineModels, GeneratorsBeginAChain) {
  Pipeline chain = pipeline();
  chain.add_stage("make");
  chain.add_stage("move");
  const Value value = chain.compute();
  ASSERT_NE(value.mesh(), nullptr);
  EXPECT_EQ(value.mesh()->positions[0].z, 3);
}

TEST_F(PipelineModels, MeshesAndScenesStandForEachOther) {
  Pipeline chain = pipeline();
  chain.add_stage("make");
  chain.add_stage("render");
  EXPECT_EQ(chain.compute().frame()->layers[0].image.width(), 1);

  Pipeline two = pipeline();
  two.add_value(Value(pair()), "pair");
  two.add_stage("as:pair");
  two.add_stage("join:other=@pair");
  EXPECT_EQ(two.compute().mesh()->vertex_count(), 12U) << "flattened: two instances, twice";
}

TEST_F(PipelineModels, AnOperationOnAMeshIsDoneToTheMeshesOfAScene) {
  Pipeline chain = pipeline();
  chain.add_value(Value(pair()), "pair");
  chain.add_stage("move");
  chain.add_stage("move");
  const Value moved = chain.compute();
  ASSERT_NE(moved.scene(), nullptr);
  EXPECT_EQ(moved.scene()->nodes.size(), 2U);
  EXPECT_EQ(moved.scene()->meshes[0]->positions[0].z, 6);
  EXPECT_NE(chain.explain().find("2-move: at once, in memory, mesh by mesh"), std::string::npos) << chain.explain();

  chain.add_stage("count");
  std::string printed;
  EXPECT_TRUE(chain.execute([&](const std::string& text) { printed += text; }));
  const Json report = Json::parse(printed, "report");
  EXPECT_EQ(report["vertices"].number(), 3);
  EXPECT_EQ(report["meshes"][std::size_t{0}]["name"].text(), "triangle");
}

TEST_F(PipelineModels, AFrameGoesOnAsItsImage) {
  const Image image = rendered("render:depth", {"a.png"});
  EXPECT_EQ(image.width(), 2);
  EXPECT_EQ(image.view<std::uint8_t>()(1, 0, 0), 188);
  EXPECT_NE(warnings_.find("only layer \"color\" of 2 is written"), std::string::npos) << warnings_;

  Pipeline chain = pipeline();
  chain.add_value(Value(pair()), "pair");
  chain.add_stage("render:depth");
  chain.add_stage("as:shot");
  chain.add_stage("blend:other=@shot");
  ASSERT_NE(chain.compute().image(), nullptr);
  EXPECT_EQ(chain.compute().image()->view<std::uint8_t>()(0, 0, 1), 188);
}

TEST_F(PipelineModels, AllLayersGoIntoOneOpenExr) {
  rendered("render:depth", {"a.exr"});
  EXPECT_EQ(warnings_, "");
  ReadOptions depth;
  depth.layer = "depth";
  EXPECT_EQ(read_image(path("a.exr"), depth).channels(), 1);
}

TEST_F(PipelineModels, FilesOfFloatsAskForFloats) {
  EXPECT_EQ(rendered("render", {"a.exr"}).view<float>()(0, 0, 0), 0.5F);
  EXPECT_EQ(rendered("render", {"a.pfm"}).type(), PixelType::F32);
  // A choice of the user's is kept, and a picture that is also wanted for the eye.
  EXPECT_NEAR(rendered("render:output=display", {"a.exr"}).view<float>()(0, 0, 0), 0.5029F, 1e-4);
  EXPECT_NEAR(rendered("render", {"a.exr", "a.png"}).view<float>()(0, 0, 0), 0.5029F, 1e-4);
  EXPECT_EQ(read_image(path("a.png")).view<std::uint8_t>()(0, 0, 0), 188);
}

TEST_F(PipelineModels, ScenesAreFlattenedForFormatsOfMeshes) {
  Mesh painted = triangle();
  painted.material = {0};
  Scene scene = pair();
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(painted));
  scene.materials.resize(1);
  const Value value(std::move(scene));
  for (const std::string file : {"a.stl", "a.ply"}) {
    warnings_.clear();
    Pipeline chain = pipeline();
    chain.add_value(value, "pair");
    chain.add_output(path(file));
    EXPECT_TRUE(chain.execute({}));
    EXPECT_EQ(std::get<Mesh>(read_model(path(file))).face_count(), 2U);
    EXPECT_EQ(warnings_, path(file) + ": materials and textures are left out, the format has none\n");
  }
}

TEST_F(PipelineModels, RefusesWhatDoesNotFitBeforeAnythingRuns) {
  const auto with = [&](Value value, const std::string& stage) {
    return message_of([&] {
      Pipeline chain = pipeline();
      chain.add_value(std::move(value), "box.glb");
      chain.add_stage(stage);
    });
  };
  EXPECT_EQ(with(Value(pair()), "blend"), "blend: source: got scene from box.glb, expected image (render makes one)");
  EXPECT_EQ(with(Value(triangle()), "blend"),
            "blend: source: got mesh from box.glb, expected image (render makes one)");
  EXPECT_EQ(with(Value(Volume()), "blend"), "blend: source: got volume from box.glb, expected image");
  EXPECT_EQ(with(Value(Image(2, 2, 1)), "move"), "move: source: got image from box.glb, expected mesh");

  const auto to = [&](Value value, const std::string& file) {
    return message_of([&] {
      Pipeline chain = pipeline();
      chain.add_value(std::move(value), "box.glb");
      chain.add_output(file);
    });
  };
  EXPECT_EQ(to(Value(pair()), "a.png"), "a.png: got scene from box.glb, expected image (render makes one)");
  EXPECT_EQ(to(Value(Image(2, 2, 1)), "a.stl"), "a.stl: got image from box.glb, expected mesh or scene");
  EXPECT_EQ(to(Value(Volume()), "a.stl"), "a.stl: got volume from box.glb, volumes can't be written");
  EXPECT_TRUE(
      to(Value(pair()), "a.xyz").starts_with("a.xyz: can't tell the model format from the ending, expected one"));
  EXPECT_EQ(to(Value(triangle()), "a.stl"), "nothing was thrown");
}

/// The first output is a report: files of models get the mesh, those of images the drawing, drawn.
TEST_F(PipelineModels, AFileGetsTheFirstOutputThatItHolds) {
  Pipeline chain = pipeline();
  chain.add_stage("sketch");
  chain.add_stage("as:it");
  chain.add_output(path("a.ply"));
  chain.add_output("drawing=" + path("a.png"));
  chain.add_output(path("a.json"));
  chain.add_stage("@it.drawing");
  chain.add_output(path("b.jpg"));
  EXPECT_TRUE(chain.execute({}));
  EXPECT_EQ(std::get<Mesh>(read_model(path("a.ply"))).vertex_count(), 3U);
  EXPECT_EQ(read_image(path("a.png")).width(), 6);
  EXPECT_EQ(read_image(path("b.jpg")).height(), 4);
  EXPECT_TRUE(fs::exists(path("a.json")));
}

TEST_F(PipelineModels, AnOutputThatWasNotAskedForIsSaidSo) {
  Pipeline chain = pipeline();
  chain.add_value(Value(pair()), "pair");
  chain.add_stage("render");
  chain.add_stage("as:shot");
  chain.add_stage("@shot.depth_layer");
  EXPECT_EQ(message_of([&] { chain.compute(); }), "render gives no depth_layer with these options");
  chain.add_stage("blend:other=@shot");
  EXPECT_EQ(message_of([&] { chain.compute(); }), "render gives no depth_layer with these options");
}

TEST_F(PipelineModels, LabelsAreWrittenAsIds) {
  Labels labels(3, 2);
  labels.view()(2, 1) = 300;
  Pipeline chain = pipeline();
  chain.add_value(Value(std::move(labels)), "labels");
  chain.add_output(path("a.png"));
  EXPECT_TRUE(chain.execute({}));
  EXPECT_EQ(read_image(path("a.png")).view<std::uint16_t>()(2, 1), 300);
}

}  // namespace
}  // namespace azulejo
