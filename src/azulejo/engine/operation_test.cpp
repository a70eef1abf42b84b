#include "azulejo/engine/operation.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/stages.h"

namespace azulejo {
namespace {

struct CopiesOptions {
  int copies = 2;
};

/// Gives the mesh's vertices several times over.
std::vector<Value> copies(std::span<const Value> inputs, const CopiesOptions& options, const Run& run) {
  const Mesh& source = *inputs[0].mesh();
  if (source.positions.empty()) throw Error(Error::Argument, "source: a mesh without vertices");
  Mesh result;
  for (int i = 0; i < options.copies; ++i) {
    result.positions.insert(result.positions.end(), source.positions.begin(), source.positions.end());
  }
  if (run.stages != nullptr) run.stages->report("copies", "count", Json(options.copies));
  return {Value(std::move(result))};
}

Operation copies_operation() {
  return value_operation<CopiesOptions>("copies", "Repeats vertices.", {{"source", "the mesh", ValueKind::Mesh}},
                                        {{"mesh", "more of it", ValueKind::Mesh}},
                                        {field("copies", &CopiesOptions::copies, {1, 5}, "", "how often")}, copies);
}

Mesh points(std::size_t count) {
  Mesh mesh;
  mesh.positions.assign(count, glm::vec3(1, 2, 3));
  return mesh;
}

std::string refusal(const Operation& operation, const void* options, std::vector<Value> inputs) {
  try {
    invoke(operation, options, inputs, {});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Argument);
    return error.what();
  }
  return "taken";
}

TEST(ValueOperation, IsInvoked) {
  const Operation operation = copies_operation();
  EXPECT_EQ(operation.make_node, nullptr);
  CopiesOptions options{3};
  const Value inputs[] = {Value(points(4))};
  const auto results = invoke(operation, &options, inputs, {});
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].kind(), ValueKind::Mesh);
  EXPECT_EQ(results[0].mesh()->positions.size(), 12U);
}

TEST(ValueOperation, ChecksOptionsAndInputsFirst) {
  const Operation operation = copies_operation();
  CopiesOptions options{6};
  EXPECT_EQ(refusal(operation, &options, {}), "copies: copies: 6, expected a whole number from 1 to 5");
  options.copies = 1;
  EXPECT_EQ(refusal(operation, &options, {}), "copies: source: got nothing, expected mesh");
  EXPECT_EQ(refusal(operation, &options, {Value(Volume())}), "copies: source: got volume, expected mesh");
  EXPECT_EQ(refusal(operation, &options, {Value(points(1)), Value(points(1))}), "copies: 2 inputs, expected 1");
  EXPECT_EQ(refusal(operation, &options, {Value(points(0))}), "copies: source: a mesh without vertices");
}

TEST(ValueOperation, ReportsStagesUnderItsStep) {
  struct Collect final : Stages {
    void image(const std::string&, const std::string&, const Image&) override {}
    void report(const std::string& step, const std::string& name, const Json& report) override {
      seen += step + "/" + name + "=" + report.dump(-1) + " ";
    }
    std::string seen;
  } collect;
  azulejo::Run run;
  run.stages = &collect;
  const Operation operation = copies_operation();
  const CopiesOptions options;
  const Value inputs[] = {Value(points(1))};
  invoke(operation, &options, inputs, run);
  invoke(operation, &options, inputs, run, "2-copies");
  EXPECT_EQ(collect.seen, "copies/count=2 2-copies/count=2 ");
}

TEST(ValueOperation, GeneratesWithoutInputs) {
  const Operation operation = value_operation<CopiesOptions>(
      "dots", "Makes dots.", {}, {{"mesh", "the dots", ValueKind::Mesh}}, {},
      [](std::span<const Value>, const CopiesOptions& options, const azulejo::Run&) {
        return std::vector<Value>{Value(points(static_cast<std::size_t>(options.copies)))};
      });
  const CopiesOptions options{7};
  EXPECT_EQ(invoke(operation, &options, {}, {})[0].mesh()->positions.size(), 7U);
}

TEST(Value, KnowsItsKind) {
  EXPECT_EQ(Value(Frame()).kind(), ValueKind::Frame);
  EXPECT_EQ(Value(Scene()).kind(), ValueKind::Scene);
  EXPECT_EQ(Value(Volume()).kind(), ValueKind::Volume);
  EXPECT_EQ(Value(Report()).kind(), ValueKind::Report);
  EXPECT_EQ(Value(Labels(1, 1)).kind(), ValueKind::Labels);
  EXPECT_EQ(Value(Image(1, 1, 1)).kind(), ValueKind::Image);
  EXPECT_THROW(Value().kind(), Error);
  const auto mesh = std::make_shared<const Mesh>(points(2));
  const Value value(mesh);
  EXPECT_EQ(value.shared<Mesh>(), mesh);
  EXPECT_EQ(value.mesh(), mesh.get());
  EXPECT_EQ(value.scene(), nullptr);
}

}  // namespace
}  // namespace azulejo
