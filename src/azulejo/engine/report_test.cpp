// Nodes that report, and nodes without sources.
#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/engine_testing.h"
#include "azulejo/engine/graph.h"
#include "azulejo/engine/operation.h"

namespace azulejo {
namespace {

int ramp(int x, int y) { return (3 * x + 5 * y) % 251; }

struct Sum final : Analysis {
  void add(const ConstTile& tile, Scratch&) override {
    const auto view = tile.pixels.as<std::uint8_t>();
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) sum += view(x, y);
    }
    pixels += tile.rect.area();
  }
  void merge(const Analysis& other) override {
    sum += static_cast<const Sum&>(other).sum;
    pixels += static_cast<const Sum&>(other).pixels;
  }
  void finish() override { finished = true; }
  std::int64_t sum = 0;
  std::int64_t pixels = 0;
  bool finished = false;
};

Json json_of(const Analysis* analysis) {
  if (analysis == nullptr) return Json("none");
  const auto& sum = static_cast<const Sum&>(*analysis);
  return Json::object().set("sum", sum.sum).set("pixels", sum.pixels).set("finished", sum.finished);
}

/// Both ways to compute are the same.
class Node : public TileNode {
 public:
  using TileNode::TileNode;
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const final {
    run(sources, results, context);
  }
};

/// A picture of its own.
class Ramp final : public Node {
 public:
  Ramp(int width, int height) : Node(std::span<const ImageInfo>()) { set_results({ImageInfo{width, height}}); }
  void run(std::span<const ConstTile>, std::span<const Tile> results, const TileContext&) const override {
    const auto view = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        view(x, y) = static_cast<std::uint8_t>(ramp(x + results[0].rect.x, y + results[0].rect.y));
      }
    }
  }
};

/// Halves its source, and says the sums of source and result.
class Half final : public Node {
 public:
  explicit Half(const ImageInfo& info) : Node(std::span(&info, 1)) { set_results({info}); }
  std::unique_ptr<Analysis> analysis(int) const override { return std::make_unique<Sum>(); }
  std::unique_ptr<Analysis> result_analysis(int) const override { return std::make_unique<Sum>(); }
  Report report(std::span<const Analysis* const> analyses) const override {
    return {Json::object().set("source", json_of(analyses[0])).set("result", json_of(analyses[1])), false};
  }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    const auto from = sources[0].pixels.as<std::uint8_t>();
    const auto to = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) to(x, y) = from(x, y) / 2;
    }
  }
};

/// The largest of three in a row.
class Widen final : public Node {
 public:
  explicit Widen(const ImageInfo& info) : Node(std::span(&info, 1)) { set_results({info}); }
  Rect needs(const Rect& result, int) const override { return grown(result, 1, 0); }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    const auto from = sources[0].pixels.as<std::uint8_t>();
    const auto to = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) to(x, y) = std::max({from(x, y), from(x + 1, y), from(x + 2, y)});
    }
  }
};

/// Measures, and makes nothing.
class Only final : public Node {
 public:
  explicit Only(const ImageInfo& info) : Node(std::span(&info, 1)) {}
  std::unique_ptr<Analysis> analysis(int) const override { return std::make_unique<Sum>(); }
  Report report(std::span<const Analysis* const> analyses) const override {
    return {Json::object().set("source", json_of(analyses[0]))};
  }
  void run(std::span<const ConstTile>, std::span<const Tile>, const TileContext&) const override { FAIL(); }
};

struct Sums {
  std::int64_t ramp = 0;
  std::int64_t half = 0;
  std::int64_t wide = 0;
};

Sums sums(int width, int height) {
  Sums all;
  const auto half = [&](int x, int y) { return ramp(x < 0 ? 1 : x == width ? width - 2 : x, y) / 2; };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      all.ramp += ramp(x, y);
      all.half += half(x, y);
      all.wide += std::max({half(x - 1, y), half(x, y), half(x + 1, y)});
    }
  }
  return all;
}

TEST(Report, CountsEveryPixelOnceInsideAChain) {
  constexpr int kWidth = 61;
  constexpr int kHeight = 47;
  const Sums expected = sums(kWidth, kHeight);
  for (const bool streamed : {false, true}) {
    for (const int threads : {1, 3}) {
      Graph graph;
      const ValueRef source = graph.add_node(std::make_unique<Ramp>(kWidth, kHeight), {}, "ramp");
      const ImageInfo info = graph.info(source);
      const ValueRef half = graph.add_node(std::make_unique<Half>(info), {source}, "half");
      const ValueRef wide = graph.add_node(std::make_unique<Widen>(info), {half}, "widen");
      const ValueRef only = graph.add_node(std::make_unique<Only>(info), {wide}, "only", {});
      Report of_half;
      Report of_wide;
      Image image(info);
      RowsInto rows(info);
      const auto report = [&](ValueRef value, Report& to) {
        const TileNode& node = *graph.vertices()[static_cast<std::size_t>(value.vertex)].node;
        return Target{.value = value, .analysed = [&](auto analyses) { to = node.report(analyses); }};
      };
      std::vector<Target> targets{report(half, of_half), report(only, of_wide)};
      if (streamed) {
        targets.push_back({wide, {}, &rows});
      } else {
        targets.push_back({wide, image.any(), nullptr});
      }
      azulejo::Run run;
      run.threads = threads;
      run.testing = {.tile_width = 9, .tile_height = 5};
      execute(graph, targets, run);
      const auto json = [](std::int64_t sum) {
        return Json::object().set("sum", sum).set("pixels", std::int64_t{kWidth} * kHeight).set("finished", true);
      };
      EXPECT_EQ(of_half.json.dump(),
                Json::object().set("source", json(expected.ramp)).set("result", json(expected.half)).dump());
      EXPECT_FALSE(of_half.verdict);
      EXPECT_EQ(of_wide.json.dump(), Json::object().set("source", json(expected.wide)).dump());
      const Image& written = streamed ? rows.image : image;
      EXPECT_EQ(written.view<std::uint8_t>()(20, 30), std::max(ramp(19, 30), std::max(ramp(20, 30), ramp(21, 30))) / 2);
    }
  }
}

TEST(Report, OfAResultIsNotGatheredUnlessItIsWanted) {
  Graph graph;
  const ValueRef source = graph.add_node(std::make_unique<Ramp>(10, 10), {}, "ramp");
  const ValueRef half = graph.add_node(std::make_unique<Half>(graph.info(source)), {source}, "half");
  Image image(graph.info(half));
  const Target targets[] = {{half, image.any(), nullptr}};
  EXPECT_EQ(explain(graph, targets, {}).find("half is analysed"), std::string::npos);
  const Target with_report[] = {{half, image.any(), nullptr}, {.value = half, .analysed = [](auto) {}}};
  EXPECT_NE(explain(graph, with_report, {}).find("half is analysed for half"), std::string::npos);
}

/// Adds the mean of its last source to the first.
class AddLastMean final : public Node {
 public:
  explicit AddLastMean(std::span<const ImageInfo> infos) : Node(infos) { set_results({infos[0]}); }
  std::unique_ptr<Analysis> analysis(int source) const override {
    return source + 1 == static_cast<int>(sources().size()) ? std::make_unique<Sum>() : nullptr;
  }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    ASSERT_EQ(context.analyses[0], nullptr);
    const auto& last = static_cast<const Sum&>(*context.analyses[sources.size() - 1]);
    const auto from = sources[0].pixels.as<std::uint8_t>();
    const auto to = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) to(x, y) = static_cast<std::uint8_t>(from(x, y) + last.sum / last.pixels);
    }
  }
};

TEST(Report, ANodeMayHaveMoreSourcesThanAWordHasBits) {
  std::vector<Image> images;
  Graph graph;
  std::vector<ValueRef> sources;
  std::vector<ImageInfo> infos;
  for (int i = 0; i < 70; ++i) {
    Image& image = images.emplace_back(12, 9, 1);
    for (int y = 0; y < 9; ++y) std::fill_n(image.view<std::uint8_t>().row(y), 12, static_cast<std::uint8_t>(i));
    sources.push_back(graph.add_source(image.any(), "image"));
    infos.push_back(image.info());
  }
  const ValueRef sum = graph.add_node(std::make_unique<AddLastMean>(infos), sources, "add");
  Image result(graph.info(sum));
  const Target targets[] = {{sum, result.any(), nullptr}};
  execute(graph, targets, {});
  EXPECT_EQ(result.view<std::uint8_t>()(5, 5), 69);
}

struct Nothing {};

struct MeasuringStep final : Node {
  MeasuringStep(const Nothing&, std::span<const ImageInfo> sources) : Node(sources) {
    if (sources.size() == 2) set_results({sources[1]});
  }
  std::unique_ptr<Analysis> analysis(int) const override { return std::make_unique<Sum>(); }
  Report report(std::span<const Analysis* const> analyses) const override {
    return {
        Json::object().set("sources", static_cast<std::int64_t>(analyses.size())).set("first", json_of(analyses[0]))};
  }
  void run(std::span<const ConstTile>, std::span<const Tile>, const TileContext&) const override {}
};

TEST(Report, MeasuresImagesInMemory) {
  const Operation operation = image_operation<Nothing, MeasuringStep>(
      "sum", "Sums.", {{.name = "source"}, {.name = "more", .optional = true, .repeated = true}},
      {{"report", "the sum", ValueKind::Report}}, {});
  Image image(5, 3, 1);
  for (int y = 0; y < 3; ++y) std::fill_n(image.view<std::uint8_t>().row(y), 5, std::uint8_t{2});
  const Nothing options;
  EXPECT_EQ(measure(operation, &options, {image.any()}, {}).json["first"]["sum"].dump(), "30");
  EXPECT_EQ(measure(operation, &options, {image.any(), image.any(), image.any()}, {}).json["sources"].dump(), "3");
  EXPECT_THROW(measure(operation, &options, {}, {}), Error);
}

}  // namespace
}  // namespace azulejo
