#include "azulejo/pipeline.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

/// A folder of a test's own.
class PipelineTest : public testing::Test {
 protected:
  PipelineTest()
      : folder_(fs::path(testing::TempDir()) /
                ("pipeline-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    Image image(20, 10, 1);
    const auto view = image.view<std::uint8_t>();
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 20; ++x) view(x, y) = static_cast<std::uint8_t>(12 * x);
    }
    write_image(image, path("ramp.png"));
  }
  ~PipelineTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_;
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

TEST_F(PipelineTest, RunsAChainFromFileToFile) {
  Pipeline pipeline({});
  pipeline.add_file(path("ramp.png"));
  pipeline.add_stage("threshold:level=0.5");
  pipeline.add_output(path("mask.png"));
  EXPECT_TRUE(pipeline.execute({}));
  const Image mask = read_image(path("mask.png"));
  const auto view = mask.view<std::uint8_t>();
  for (int x = 0; x < 20; ++x) EXPECT_EQ(view(x, 5), 12 * x > 127 ? 255 : 0);
}

TEST_F(PipelineTest, NamesResultsAndUsesThem) {
  Pipeline pipeline({});
  pipeline.add_file(path("ramp.png"));
  pipeline.add_stage("as:ramp");
  pipeline.add_stage("threshold:level=0.5");
  pipeline.add_stage("as:mask");
  pipeline.add_stage("@ramp");
  pipeline.add_stage("blend:other=@mask,amount=1");
  pipeline.add_output(path("blended.png"));
  pipeline.add_output("mask=" + path("mask.png"));
  pipeline.add_output("ramp=" + path("again.png"));
  EXPECT_TRUE(pipeline.execute({}));
  const Image mask = read_image(path("mask.png"));
  const Image blended = read_image(path("blended.png"));
  const Image again = read_image(path("again.png"));
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(blended.view<std::uint8_t>()(x, 0), mask.view<std::uint8_t>()(x, 0));
    EXPECT_EQ(again.view<std::uint8_t>()(x, 9), 12 * x);
  }
}

TEST_F(PipelineTest, ComputesInMemory) {
  Pipeline pipeline({});
  EXPECT_THROW(pipeline.compute(), Error);
  Image gray(4, 2, 1);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) gray.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(80 * x);
  }
  pipeline.add_value(Value(std::move(gray)), "gray");
  pipeline.add_stage("threshold");
  const Value mask = pipeline.compute();
  ASSERT_NE(mask.image(), nullptr);
  EXPECT_EQ(mask.image()->view<std::uint8_t>()(1, 1), 0);
  EXPECT_EQ(mask.image()->view<std::uint8_t>()(2, 1), 255);
}

TEST_F(PipelineTest, RefusesWrongChainsBeforeAnythingRuns) {
  const auto with = [&](const std::string& stage) {
    return message_of([&] {
      Pipeline pipeline({});
      pipeline.add_file(path("ramp.png"));
      pipeline.add_stage(stage);
    });
  };
  EXPECT_EQ(with("treshold"), "treshold: no such operation (did you mean threshold?); azulejo ops lists them");
  EXPECT_EQ(with("threshold:levle=1"),
            "threshold: no option \"levle\" (did you mean level?); expected level, invert, source");
  EXPECT_EQ(with("threshold:level=2"), "threshold: level: 2, expected a number from 0 to 1");
  EXPECT_EQ(with("blend"), "blend: other: missing, expected image");
  EXPECT_EQ(with("@nothing"), "@nothing: nothing was named so; expected as:nothing before");
  EXPECT_EQ(with("as:1x"), "as: \"1x\", expected a name of letters, digits and _");
  Pipeline pipeline({});
  pipeline.add_file(path("ramp.png"));
  EXPECT_NE(message_of([&] { pipeline.add_output(path("a.xyz")); }).find("can't tell the image format"),
            std::string::npos);
  EXPECT_NE(message_of([&] { pipeline.add_output("nobody=" + path("a.png")); }).find("nothing was named so"),
            std::string::npos);
  pipeline.add_output(path("a.png"));
  EXPECT_NE(message_of([&] { pipeline.add_output(path("a.png")); }).find("given twice"), std::string::npos);
  EXPECT_NE(message_of([&] { pipeline.add_file(path("missing.png")); }).find("missing.png"), std::string::npos);
}

TEST_F(PipelineTest, LeavesNothingBehindWhenItFails) {
  std::ofstream(path("broken.png"), std::ios::binary) << std::ifstream(path("ramp.png"), std::ios::binary).rdbuf();
  fs::resize_file(path("broken.png"), fs::file_size(path("broken.png")) - 20);
  std::ofstream(path("result.png")) << "what was there before";
  Pipeline pipeline({});
  pipeline.add_file(path("broken.png"));
  pipeline.add_stage("threshold");
  pipeline.add_output(path("result.png"));
  EXPECT_THROW(pipeline.execute({}), Error);
  std::string kept;
  std::getline(std::ifstream(path("result.png")), kept);
  EXPECT_EQ(kept, "what was there before");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(fs::path(path("x")).parent_path())) ++files;
  EXPECT_EQ(files, 3);
}

// Operations that aren't computed by tiles: the mean as a report, and an image made from a report's options.

struct NoOptions {};

Operation mean_operation() {
  Operation mean;
  mean.name = "mean";
  mean.summary = "Measures the mean.";
  mean.inputs = {{"source", "the image"}};
  mean.outputs = {{"report", "the mean", ValueKind::Report}};
  mean.make_options = []() -> std::shared_ptr<void> { return std::make_shared<NoOptions>(); };
  mean.invoke = [](std::span<const Value> inputs, const void*, const azulejo::Run&) {
    const auto view = inputs[0].image()->view<std::uint8_t>();
    double sum = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) sum += view(x, y);
    }
    Report report;
    report.json.set("mean", sum / (view.width * view.height));
    report.verdict = sum > 0;
    return std::vector<Value>{Value(std::move(report))};
  };
  return mean;
}

Operation twice_operation() {
  Operation twice = mean_operation();
  twice.name = "twice";
  twice.outputs = {{"wide", "the image, twice as wide"}, {"same", "the image"}};
  twice.invoke = [](std::span<const Value> inputs, const void*, const azulejo::Run&) {
    const Image& source = *inputs[0].image();
    Image wide(2 * source.width(), source.height(), 1);
    copy_pixels(source.any(), wide.any().crop({0, 0, source.width(), source.height()}));
    copy_pixels(source.any(), wide.any().crop({source.width(), 0, source.width(), source.height()}));
    return std::vector<Value>{Value(std::move(wide)), Value(source.clone())};
  };
  return twice;
}

TEST_F(PipelineTest, TakesOperationsThatAreNotTiled) {
  const Operation mean = mean_operation();
  const Operation twice = twice_operation();
  const Operation* list[] = {find_operation("threshold"), &mean, &twice};
  Pipeline pipeline({}, {}, list);
  pipeline.add_file(path("ramp.png"));
  pipeline.add_stage("twice");
  pipeline.add_stage("threshold:level=0");
  pipeline.add_output(path("mask.png"));
  pipeline.add_stage("mean");
  std::string printed;
  EXPECT_TRUE(pipeline.has_output());
  EXPECT_TRUE(pipeline.execute([&](const std::string& text) { printed += text; }));
  const Json report = Json::parse(printed, "report");
  EXPECT_EQ(report["operation"].text(), "mean");
  EXPECT_EQ(report.keys()[0], "azulejo");
  EXPECT_DOUBLE_EQ(report["mean"].number(), 255.0 * 19 / 20);
  EXPECT_EQ(read_image(path("mask.png")).width(), 40);
}

TEST_F(PipelineTest, ChecksKindsAndVerdicts) {
  const Operation mean = mean_operation();
  const Operation* list[] = {find_operation("threshold"), &mean};
  Pipeline pipeline({}, {}, list);
  pipeline.add_file(path("ramp.png"));
  pipeline.add_stage("threshold:level=1");
  pipeline.add_stage("mean");
  EXPECT_EQ(message_of([&] { pipeline.add_stage("threshold"); }),
            "threshold: source: got report from mean, expected image");
  EXPECT_FALSE(pipeline.execute([](const std::string&) {}));
}

}  // namespace
}  // namespace azulejo
