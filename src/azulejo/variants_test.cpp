// Operations with variants for several kinds of inputs. Those here are the test's own.
#include <gtest/gtest.h>

#include "azulejo/conversion.h"
#include "azulejo/core/error.h"
#include "azulejo/pipeline.h"

namespace azulejo {
namespace {

struct MeshOptions {
  float depth = 1;
};
struct ImageOptions {
  int width = 2;
  float depth = 1;
};

Report told(const std::string& variant) { return {Json::object().set("variant", variant)}; }

const Operation kOfImage = value_operation<ImageOptions>(
    "tell", "Tells what it is.", {{"source", "anything"}}, {{"report", "its kind", ValueKind::Report}},
    {field("width", &ImageOptions::width, {1, 9}, "px", "of it"), field("depth", &ImageOptions::depth, "of all")},
    [](std::span<const Value>, const ImageOptions& options, const Run&) {
      return std::vector<Value>{Value(told("image " + std::to_string(options.width)))};
    });
const Operation kTell = with_variants(
    value_operation<MeshOptions>(
        "tell", "Tells what it is.", {{"source", "anything", ValueKind::Mesh}},
        {{"report", "its kind", ValueKind::Report}}, {field("depth", &MeshOptions::depth, "of all")},
        [](std::span<const Value>, const MeshOptions&, const Run&) { return std::vector<Value>{Value(told("mesh"))}; }),
    {&kOfImage});

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  return mesh;
}

/// What the stage says of a value, or the error's message.
std::string said(Value value, const std::string& stage) {
  try {
    const std::array<const Operation*, 1> list{&kTell};
    Pipeline pipeline({}, {}, list);
    pipeline.add_value(std::move(value), "value");
    pipeline.add_stage("as:it");
    pipeline.add_stage(stage);
    return pipeline.compute().report()->json["variant"].text();
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Variants, TheKindOfTheFirstInputChooses) {
  EXPECT_EQ(said(Value(Image(3, 2, 1)), "tell:width=5"), "image 5");
  EXPECT_EQ(said(Value(triangle()), "tell:depth=5"), "mesh");
  EXPECT_EQ(said(Value(Image(3, 2, 1)), "tell:source=@it"), "image 2");
}

TEST(Variants, AreChosenByWhatTheInputConvertsTo) {
  EXPECT_EQ(said(Value(Labels(3, 2)), "tell"), "image 2");
  EXPECT_EQ(&variant_for(kTell, ValueKind::Scene), &kTell);
  EXPECT_EQ(&variant_for(kTell, ValueKind::Frame), &kOfImage);
  EXPECT_EQ(said(Value(Volume()), "tell"), "tell: source: got volume from value, expected mesh");
}

TEST(Variants, HaveOptionsOfTheirOwn) {
  EXPECT_EQ(said(Value(triangle()), "tell:width=5"), "tell: no option \"width\"; expected depth, source");
  const std::vector<VariantField> fields = fields_of(kTell);
  ASSERT_EQ(fields.size(), 2U);
  EXPECT_EQ(fields[0].field->name, "depth");
  EXPECT_EQ(fields[0].kinds, "");
  EXPECT_EQ(fields[1].field->name, "width");
  EXPECT_EQ(fields[1].kinds, "image");
  EXPECT_EQ(fields[1].operation, &kOfImage);
}

}  // namespace
}  // namespace azulejo
