#include "azulejo/engine/graph.h"

#include <atomic>
#include <cstring>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/data/image_testing.h"
#include "azulejo/engine/engine_testing.h"
#include "azulejo/engine/stages.h"

namespace azulejo {
namespace {

// Nodes whose results show every mistake: sums modulo 251 of all pixels that they read.

class Neighbours final : public TileNode {
 public:
  Neighbours(const ImageInfo& info, int columns, int rows, BorderRule border)
      : TileNode(std::span(&info, 1)), columns_(columns), rows_(rows), border_(border) {
    set_results({info});
  }
  Rect needs(const Rect& result, int) const override { return grown(result, columns_, rows_); }
  BorderRule border(int) const override { return border_; }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    const auto from = sources[0].pixels.as<std::uint8_t>();
    const auto to = results[0].pixels.as<std::uint8_t>();
    ASSERT_EQ(sources[0].rect, needs(results[0].rect, 0));
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) {
        for (int c = 0; c < to.channels; ++c) {
          int sum = 0;
          for (int dy = 0; dy <= 2 * rows_; ++dy) {
            for (int dx = 0; dx <= 2 * columns_; ++dx) sum += (3 * dx + 5 * dy + 7) * from(x + dx, y + dy, c);
          }
          to(x, y, c) = static_cast<std::uint8_t>(sum % 251);
        }
      }
    }
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }

 private:
  int columns_;
  int rows_;
  BorderRule border_;
};

/// Turns the image upside down: its first rows need the source's last.
class Upside final : public TileNode {
 public:
  explicit Upside(const ImageInfo& info) : TileNode(std::span(&info, 1)) { set_results({info}); }
  Rect needs(const Rect& result, int) const override {
    return {result.x, results()[0].height - result.bottom(), result.width, result.height};
  }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    const auto& from = sources[0].pixels;
    for (int y = 0; y < from.height(); ++y) {
      std::memcpy(results[0].pixels.row(y), from.row(from.height() - 1 - y), from.info.row_bytes());
    }
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }
};

/// Half the size: sums of 2×2 pixels, the source's last column and row mirrored where the size is odd.
class Half final : public TileNode {
 public:
  explicit Half(const ImageInfo& info) : TileNode(std::span(&info, 1)) {
    ImageInfo half = info;
    half.width = (info.width + 1) / 2;
    half.height = (info.height + 1) / 2;
    set_results({half});
  }
  Rect needs(const Rect& result, int) const override {
    return {2 * result.x, 2 * result.y, 2 * result.width, 2 * result.height};
  }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    const auto from = sources[0].pixels.as<std::uint8_t>();
    const auto to = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) {
        for (int c = 0; c < to.channels; ++c) {
          to(x, y, c) = static_cast<std::uint8_t>((from(2 * x, 2 * y, c) + 3 * from(2 * x + 1, 2 * y, c) +
                                                   5 * from(2 * x, 2 * y + 1, c) + 7 * from(2 * x + 1, 2 * y + 1, c)) %
                                                  251);
        }
      }
    }
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }
};

/// Two sources, two results: sum and difference.
class SumAndDifference final : public TileNode {
 public:
  explicit SumAndDifference(const ImageInfo& info) : TileNode(std::vector{info, info}) { set_results({info, info}); }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    for (int r = 0; r < 2; ++r) {
      const Tile& result = results[static_cast<std::size_t>(r)];
      if (!result.wanted()) continue;
      const auto to = result.pixels.as<std::uint8_t>();
      for (int y = 0; y < to.height; ++y) {
        const std::uint8_t* a = sources[0].pixels.as<std::uint8_t>().row(y);
        const std::uint8_t* b = sources[1].pixels.as<std::uint8_t>().row(y);
        for (int i = 0; i < to.width * to.channels; ++i)
          to.row(y)[i] = static_cast<std::uint8_t>(r == 0 ? a[i] + b[i] : a[i] - b[i]);
      }
    }
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }
};

/// Adds the sum of all pixels to each.
class AddTotal final : public TileNode {
 public:
  explicit AddTotal(const ImageInfo& info) : TileNode(std::span(&info, 1)) { set_results({info}); }
  struct Total final : Analysis {
    void add(const ConstTile& tile, Scratch&) override {
      const auto view = tile.pixels.as<std::uint8_t>();
      for (int y = 0; y < view.height; ++y) {
        for (int i = 0; i < view.width * view.channels; ++i) sum += view.row(y)[i];
      }
      pixels += tile.rect.area();
    }
    void merge(const Analysis& other) override {
      sum += static_cast<const Total&>(other).sum;
      pixels += static_cast<const Total&>(other).pixels;
    }
    void finish() override { finished = true; }
    std::uint64_t sum = 0;
    std::int64_t pixels = 0;
    bool finished = false;
  };
  std::unique_ptr<Analysis> analysis(int) const override { return std::make_unique<Total>(); }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    const auto& total = static_cast<const Total&>(*context.analyses[0]);
    ASSERT_TRUE(total.finished);
    ASSERT_EQ(total.pixels, this->sources()[0].rect().area());
    const auto to = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < to.height; ++y) {
      const std::uint8_t* from = sources[0].pixels.as<std::uint8_t>().row(y);
      for (int i = 0; i < to.width * to.channels; ++i) to.row(y)[i] = static_cast<std::uint8_t>(from[i] + total.sum);
    }
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }
};

class Failing final : public TileNode {
 public:
  explicit Failing(const ImageInfo& info) : TileNode(std::span(&info, 1)) { set_results({info}); }
  void run(std::span<const ConstTile>, std::span<const Tile> results, const TileContext&) const override {
    if (results[0].rect.bottom() > 20) throw Error(Error::Data, "row 20 is bad");
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }
};

/// What a node gives, computed on whole images, borders looked up pixel by pixel.
std::vector<Image> by_definition(const TileNode& node, const std::vector<const Image*>& sources) {
  std::vector<Image> padded;
  std::vector<ConstTile> tiles;
  std::vector<std::unique_ptr<Analysis>> analyses;
  std::vector<const Analysis*> finished;
  Scratch scratch;
  const Rect whole = node.results()[0].rect();
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const int index = static_cast<int>(s);
    const Rect need = node.needs(whole, index);
    ImageInfo info = sources[s]->info();
    const ImageView<const std::uint8_t> from = sources[s]->view<std::uint8_t>();
    const BorderRule rule = node.border(index);
    info.width = need.width;
    info.height = need.height;
    Image& to = padded.emplace_back(info);
    for (int y = 0; y < need.height; ++y) {
      for (int x = 0; x < need.width; ++x) {
        const int sx = border_index(need.x + x, from.width, rule.mode);
        const int sy = border_index(need.y + y, from.height, rule.mode);
        for (int c = 0; c < info.channels; ++c) {
          to.view<std::uint8_t>()(x, y, c) =
              sx < 0 || sy < 0 ? static_cast<std::uint8_t>(rule.value * 255 + 0.5F) : from(sx, sy, c);
        }
      }
    }
    analyses.push_back(node.analysis(index));
    if (analyses.back()) {
      analyses.back()->add({sources[s]->any(), sources[s]->info().rect()}, scratch);
      analyses.back()->finish();
    }
    finished.push_back(analyses.back().get());
  }
  for (std::size_t s = 0; s < sources.size(); ++s)
    tiles.push_back({std::as_const(padded[s]).any(), node.needs(whole, static_cast<int>(s))});
  std::vector<Image> results;
  std::vector<Tile> result_tiles;
  for (const ImageInfo& info : node.results()) results.emplace_back(info);
  for (Image& result : results) result_tiles.push_back({result.any(), whole});
  node.run(tiles, result_tiles, {scratch, finished});
  return results;
}

bool same(const ConstAnyView& a, const ConstAnyView& b) {
  if (!(a.info == b.info)) return false;
  for (int y = 0; y < a.height(); ++y) {
    if (std::memcmp(a.row(y), b.row(y), a.info.row_bytes()) != 0) return false;
  }
  return true;
}

std::unique_ptr<TileNode> random_node(std::mt19937& random, const ImageInfo& info) {
  const auto upto = [&](unsigned n) { return static_cast<int>(random() % n); };
  switch (upto(6)) {
    case 0:
    case 1: {
      const BorderRule rule{static_cast<Border>(upto(5)), 0.3F};
      return std::make_unique<Neighbours>(info, upto(4), upto(4), rule);
    }
    case 2: return std::make_unique<Upside>(info);
    case 3: return std::make_unique<Half>(info);
    case 4: return std::make_unique<AddTotal>(info);
    default: return std::make_unique<SumAndDifference>(info);
  }
}

/// A random graph, its values by definition, and the same through the executor in a random way.
void try_random_graph(unsigned seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto upto = [&](unsigned n) { return static_cast<int>(random() % n); };
  Graph graph;
  std::vector<std::vector<Image>> values;
  const ImageInfo info{1 + upto(60), 1 + upto(60), 1 + upto(3), PixelType::U8, ColorState::Data, AlphaState::None};
  const int sources = 1 + upto(2);
  for (int s = 0; s < sources; ++s) {
    values.emplace_back();
    values.back().push_back(random_image(info, seed * 31 + static_cast<unsigned>(s)));
  }
  for (int s = 0; s < sources; ++s) {
    const Image& image = values[static_cast<std::size_t>(s)][0];
    if (upto(2) == 0) {
      graph.add_source(image.any(), "memory");
    } else {
      graph.add_source(std::make_shared<RowsOf>(image), "file");
    }
  }
  std::vector<ValueRef> candidates;
  for (int s = 0; s < sources; ++s) candidates.push_back({s, 0});
  const auto value_of = [&](ValueRef ref) -> const Image& {
    return values[static_cast<std::size_t>(ref.vertex)][static_cast<std::size_t>(ref.output)];
  };
  for (int n = 1 + upto(6); n > 0; --n) {
    const ValueRef first = candidates[static_cast<std::size_t>(upto(static_cast<unsigned>(candidates.size())))];
    auto node = random_node(random, value_of(first).info());
    std::vector<ValueRef> refs{first};
    if (node->sources().size() == 2) {
      std::vector<ValueRef> fitting;
      for (const ValueRef ref : candidates) {
        if (value_of(ref).info() == value_of(first).info()) fitting.push_back(ref);
      }
      refs.push_back(fitting[static_cast<std::size_t>(upto(static_cast<unsigned>(fitting.size())))]);
    }
    std::vector<const Image*> images;
    for (const ValueRef ref : refs) images.push_back(&value_of(ref));
    values.push_back(by_definition(*node, images));
    const std::vector<std::string> names(node->results().size(), "result");
    const ValueRef added = graph.add_node(std::move(node), refs, "node", names);
    for (int o = 0; o < static_cast<int>(names.size()); ++o) candidates.push_back({added.vertex, o});
  }

  std::vector<Target> targets;
  std::vector<std::unique_ptr<RowsInto>> sinks;
  std::vector<Image> results;
  results.reserve(8);
  for (int t = 1 + upto(3); t > 0; --t) {
    const ValueRef ref =
        candidates[candidates.size() - 1 - static_cast<std::size_t>(upto(static_cast<unsigned>(candidates.size())))];
    if (upto(2) == 0) {
      sinks.push_back(std::make_unique<RowsInto>(graph.info(ref)));
      targets.push_back({ref, {}, sinks.back().get()});
    } else {
      results.emplace_back(graph.info(ref));
      targets.push_back({ref, results.back().any(), nullptr});
    }
  }
  azulejo::Run run;
  run.threads = 1 + upto(4);
  run.testing = {.tile_width = upto(3) == 0 ? 0 : 1 + upto(40), .tile_height = 1 + upto(40), .fuse = upto(4) != 0};
  if (upto(4) == 0) run.testing.tile_width = run.testing.tile_height = 0;
  if (upto(3) == 0) run.limits.memory_bytes = 4000;  // resident values go to temporary files, analyses run twice
  execute(graph, targets, run);
  for (const Target& target : targets) {
    const Image& expected = value_of(target.value);
    if (target.sink != nullptr) {
      const auto& sink = static_cast<const RowsInto&>(*target.sink);
      EXPECT_TRUE(sink.finished);
      EXPECT_TRUE(same(expected.any(), sink.image.any())) << explain(graph, targets, run);
    } else {
      EXPECT_TRUE(same(expected.any(), target.pixels)) << explain(graph, targets, run);
    }
  }
}

TEST(Executor, RandomGraphsGiveWhatTheDefinitionGives) {
  for (unsigned seed = 0; seed < 600 && !HasFailure(); ++seed) try_random_graph(seed);
}

struct Chain {
  Graph graph;
  Image result;
  std::vector<Target> targets;
};

/// Neighbours of `reach` pixels, twice.
void build_chain(Chain& chain, const Image& source, int reach) {
  const ValueRef from = chain.graph.add_source(source.any(), "source");
  const ValueRef first =
      chain.graph.add_node(std::make_unique<Neighbours>(source.info(), reach, 0, BorderRule{}), {from}, "first");
  const ValueRef second =
      chain.graph.add_node(std::make_unique<Neighbours>(source.info(), reach, 0, BorderRule{}), {first}, "second");
  chain.result = Image(source.info());
  chain.targets = {{second, chain.result.any(), nullptr}};
}

TEST(Executor, FusesShortReachesAndMaterializesLongOnes) {
  const Image source = random_image({300, 300, 1, PixelType::U8}, 1);
  Chain near;
  build_chain(near, source, 64);
  EXPECT_NE(explain(near.graph, near.targets, {}).find("pass 1: first + second"), std::string::npos)
      << explain(near.graph, near.targets, {});
  Chain far;
  build_chain(far, source, 65);
  const std::string text = explain(far.graph, far.targets, {});
  EXPECT_NE(text.find("first is kept whole"), std::string::npos) << text;
  EXPECT_NE(text.find("pass 2: second"), std::string::npos) << text;
}

TEST(Executor, RethrowsWhatANodeThrows) {
  const Image source = random_image({64, 400, 1, PixelType::U8}, 2);
  for (const int threads : {1, 2, 7}) {
    Graph graph;
    const ValueRef bad =
        graph.add_node(std::make_unique<Failing>(source.info()), {graph.add_source(source.any(), "source")}, "bad");
    RowsInto sink(source.info());
    const Target targets[] = {{bad, {}, &sink}};
    azulejo::Run run;
    run.threads = threads;
    run.testing = {.tile_width = 16, .tile_height = 8};
    try {
      execute(graph, targets, run);
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Data);
      EXPECT_STREQ(error.what(), "row 20 is bad");
    }
    EXPECT_FALSE(sink.finished);
  }
}

TEST(Executor, TellsProgressAndStopsWhenCancelled) {
  const Image source = random_image({500, 500, 1, PixelType::U8}, 3);
  Chain chain;
  build_chain(chain, source, 2);
  double last = 0;
  const CancelToken token;
  azulejo::Run run;
  run.testing = {.tile_width = 50, .tile_height = 50};
  run.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  execute(chain.graph, chain.targets, run);
  EXPECT_EQ(last, 1.0);
  run.cancel = &token;
  run.progress = [&](double fraction) {
    last = fraction;
    if (fraction > 0.3) token.cancel();
  };
  EXPECT_THROW(execute(chain.graph, chain.targets, run), Error);
  EXPECT_LT(last, 0.6);
}

TEST(Executor, HoldsToItsLimits) {
  const Image source = random_image({200, 200, 1, PixelType::U8}, 4);
  Chain chain;
  build_chain(chain, source, 70);
  azulejo::Run run;
  run.limits.memory_bytes = 1000;
  run.limits.temporary_bytes = 1000;
  try {
    execute(chain.graph, chain.targets, run);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Resource);
  }
  run.limits.temporary_bytes = 1 << 20;
  run.limits.temporary_folder = testing::TempDir();
  EXPECT_NO_THROW(execute(chain.graph, chain.targets, run));
  run.limits.temporary_folder = "/does/not/exist";
  EXPECT_THROW(execute(chain.graph, chain.targets, run), Error);
}

TEST(Executor, ReportsStagesInOrder) {
  class Collect final : public Stages {
   public:
    void image(const std::string& step, const std::string& name, const Image& image) override {
      names.push_back(step + "/" + name + " " + std::to_string(image.width()));
    }
    void report(const std::string& step, const std::string& name, const Json&) override {
      names.push_back(step + "/" + name);
    }
    std::vector<std::string> names;
  } collect;
  const Image source = random_image({40, 30, 1, PixelType::U8}, 5);
  Graph graph;
  const ValueRef half =
      graph.add_node(std::make_unique<Half>(source.info()), {graph.add_source(source.any(), "source")}, "1-half");
  const ValueRef both = graph.add_node(std::make_unique<SumAndDifference>(graph.info(half)), {half, half}, "2-both",
                                       {"sum", "difference"});
  Image result(graph.info(both));
  const Target targets[] = {{both, result.any(), nullptr}};
  azulejo::Run run;
  run.stages = &collect;
  execute(graph, targets, run);
  EXPECT_EQ(collect.names, (std::vector<std::string>{"1-half/result 20", "2-both/sum 20", "2-both/difference 20"}));
}

}  // namespace
}  // namespace azulejo
