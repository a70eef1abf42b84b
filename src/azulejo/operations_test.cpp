// Tests that run on every operation there is: agreement of all ways to compute it, edges, bad options.
#include "azulejo/operations.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/engine_testing.h"
#include "azulejo/engine/graph.h"
#include "azulejo/operations_testing.h"

namespace azulejo {
namespace {

struct Case {
  const Operation* operation;
  std::shared_ptr<void> options;
  std::string name;  ///< for messages: operation, options, image
  std::vector<Image> sources;
};

Image test_image(const ImageInfo& info, unsigned seed, bool with_nan) {
  Image image(info);
  std::mt19937 random(seed);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        T& value = view.row(y)[i];
        if constexpr (std::is_same_v<T, float>) {
          value = std::uniform_real_distribution<float>(-0.2F, 1.3F)(random);
          if (random() % 16 == 0) value = static_cast<float>(random() % 3) * 0.5F;
          if (with_nan && random() % 31 == 0) value = std::numeric_limits<float>::quiet_NaN();
        } else {
          value = static_cast<T>(random());
          if (random() % 4 == 0) value = random() % 2 == 0 ? T{0} : std::numeric_limits<T>::max();
        }
      }
    }
  });
  return image;
}

std::vector<ImageInfo> infos() {
  std::vector<ImageInfo> list;
  const std::pair<int, int> sizes[] = {{1, 1}, {1, 19}, {23, 1}, {37, 29}, {131, 67}};
  for (const auto& [width, height] : sizes) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) {
      for (const int channels : {1, 2, 3, 4}) {
        const bool small = width * height < 100;
        ImageInfo info{width, height, channels, type, ColorState::Srgb, AlphaState::None};
        if (channels % 2 == 1) list.push_back(info);
        if (channels % 2 == 0) {
          info.alpha = AlphaState::Straight;
          list.push_back(info);
          if (channels == 4 && !small) {
            info.alpha = AlphaState::Premultiplied;
            list.push_back(info);
          }
        }
        if (channels == 2 && !small) {
          info.alpha = AlphaState::None;
          info.color = ColorState::Data;
          list.push_back(info);
        }
        if (channels == 3 && width == 37) {
          info.color = ColorState::Linear;
          list.push_back(info);
        }
      }
    }
  }
  return list;
}

/// Calls f for every operation, its option sets and the kinds of images that it takes.
template <class F>
void for_each_case(F f) {
  for (const Operation* operation : every_variant()) {
    if (operation->make_node == nullptr) continue;
    int taken = 0;
    for (const auto& [label, options] : option_sets(*operation)) {
      for (const ImageInfo& info : infos()) {
        // Options other than the defaults are tried on fewer kinds of images.
        const bool telling = info.width == 37 ? info.channels % 3 == 1 || info.color == ColorState::Linear
                                              : info.width == 23 && info.channels == 1;
        if (label != "defaults" && !telling) continue;
        Case each{operation, options, operation->name + " " + label + " on " + describe(info), {}};
        std::vector<ImageInfo> source_infos(operation->inputs.size(), info);
        if (!operation->inputs.empty() && operation->inputs.back().repeated) source_infos.push_back(info);
        try {
          const auto node = make_node(*operation, options.get(), source_infos);
          // An image enlarged to this shows nothing that a smaller one doesn't, and takes minutes by rows.
          if (!node->results().empty() && node->results()[0].rect().area() > 20'000) continue;
        } catch (const Error& error) {
          EXPECT_TRUE(error.kind() == Error::Argument || error.kind() == Error::Unsupported)
              << each.name << ": " << error.what();
          continue;
        }
        ++taken;
        for (std::size_t s = 0; s < source_infos.size(); ++s) {
          each.sources.push_back(test_image(info, static_cast<unsigned>(taken * 7 + static_cast<int>(s)),
                                            info.type == PixelType::F32 && info.width == 37));
        }
        f(each);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
    EXPECT_GT(taken, 0) << title_of(*operation) << " takes no image";
  }
}

/// Two views hold the same pixels; NaNs of any kind are the same.
testing::AssertionResult same_pixels(const ConstAnyView& a, const ConstAnyView& b) {
  if (a.info.width != b.info.width || a.info.height != b.info.height || a.info.channels != b.info.channels ||
      a.info.type != b.info.type) {
    return testing::AssertionFailure() << describe(a.info) << " and " << describe(b.info);
  }
  return visit(a, [&](auto view) -> testing::AssertionResult {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
    const auto other = b.as<T>();
    for (int y = 0; y < view.height; ++y) {
      for (int i = 0; i < view.width * view.channels; ++i) {
        const T x = view.row(y)[i];
        const T z = other.row(y)[i];
        if (std::memcmp(&x, &z, sizeof(T)) == 0 || (x != x && z != z)) continue;
        return testing::AssertionFailure() << "column " << i / view.channels << ", row " << y << ", channel "
                                           << i % view.channels << ": " << +x << " and " << +z;
      }
    }
    return testing::AssertionSuccess();
  });
}

/// What comes out of an operation.
struct Results {
  std::vector<Image> images;
  std::string report;  ///< as text; empty: none
};

/// Adds the report of a node to what is wanted, if its operation has one.
void add_report(const Case& each, const Graph& graph, int vertex, std::vector<Target>& targets, std::string& text) {
  if (image_names(*each.operation).size() == each.operation->outputs.size()) return;
  const TileNode& node = *graph.vertices()[static_cast<std::size_t>(vertex)].node;
  targets.push_back({.value = {vertex, 0}, .analysed = [&](std::span<const Analysis* const> analyses) {
                       text = node.report(analyses).json.dump();
                     }});
}

Results compute(const Case& each, const Run& run) {
  Graph graph;
  std::vector<ValueRef> sources;
  std::vector<ImageInfo> source_infos;
  for (const Image& source : each.sources) {
    sources.push_back(graph.add_source(source.any(), "source"));
    source_infos.push_back(source.info());
  }
  auto node = make_node(*each.operation, each.options.get(), source_infos);
  Results results;
  std::vector<Target> targets;
  for (const ImageInfo& info : node->results()) results.images.emplace_back(info);
  const ValueRef first = graph.add_node(std::move(node), sources, each.operation->name, image_names(*each.operation));
  for (std::size_t r = 0; r < results.images.size(); ++r)
    targets.push_back({{first.vertex, static_cast<int>(r)}, results.images[r].any(), nullptr});
  add_report(each, graph, first.vertex, targets, results.report);
  execute(graph, targets, run);
  return results;
}

void expect_same(const Results& expected, const Results& got, const std::string& name, const std::string& how) {
  ASSERT_EQ(expected.images.size(), got.images.size());
  for (std::size_t r = 0; r < expected.images.size(); ++r) {
    ASSERT_TRUE(same_pixels(expected.images[r].any(), got.images[r].any())) << name << ", result " << r << ", " << how;
  }
  ASSERT_EQ(expected.report, got.report) << name << ", " << how;
}

azulejo::Run with(int threads, const Testing& testing) {
  azulejo::Run run;
  run.threads = threads;
  run.testing = testing;
  return run;
}

/// Every computation of the registry's operations must give these bytes.
Results reference(const Case& each) { return compute(each, with(1, {.reference = true})); }

TEST(EveryOperation, VectorTargetsAgreeWithTheScalarDefinition) {
  for_each_case([](const Case& each) {
    const auto expected = reference(each);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(target);
      expect_same(expected, compute(each, with(1, {})), each.name, hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  });
}

TEST(EveryOperation, OddTilesAndThreadsGiveTheSameBytes) {
  for_each_case([](const Case& each) {
    const auto expected = reference(each);
    for (const auto& [width, height, threads] : {std::tuple{7, 5, 1}, {13, 64, 2}, {64, 3, 7}}) {
      expect_same(expected, compute(each, with(threads, {.tile_width = width, .tile_height = height})), each.name,
                  "tiles " + std::to_string(width) + "×" + std::to_string(height));
    }
  });
}

TEST(EveryOperation, StripsFromAndToFilesGiveTheSameBytes) {
  for_each_case([](const Case& each) {
    const auto expected = reference(each);
    for (const auto& [height, threads] : {std::pair{1, 1}, {7, 2}}) {
      Graph graph;
      std::vector<ValueRef> sources;
      std::vector<ImageInfo> source_infos;
      for (const Image& source : each.sources) {
        sources.push_back(graph.add_source(std::make_shared<RowsOf>(source), "source"));
        source_infos.push_back(source.info());
      }
      auto node = make_node(*each.operation, each.options.get(), source_infos);
      std::vector<std::unique_ptr<RowsInto>> sinks;
      for (const ImageInfo& info : node->results()) sinks.push_back(std::make_unique<RowsInto>(info));
      std::vector<Target> targets;
      const ValueRef first =
          graph.add_node(std::move(node), sources, each.operation->name, image_names(*each.operation));
      for (int r = 0; r < static_cast<int>(sinks.size()); ++r) {
        targets.push_back({{first.vertex, r}, {}, sinks[static_cast<std::size_t>(r)].get()});
      }
      Results results;
      add_report(each, graph, first.vertex, targets, results.report);
      execute(graph, targets, with(threads, {.tile_width = 40, .tile_height = height}));
      for (auto& sink : sinks) {
        EXPECT_TRUE(sink->finished) << each.name;
        results.images.push_back(std::move(sink->image));
      }
      expect_same(expected, results, each.name, "strips of " + std::to_string(height));
    }
  });
}

/// A step that gives back what it got, with a reach that makes its tiles overlap.
class Identity final : public TileNode {
 public:
  explicit Identity(std::span<const ImageInfo> sources) : TileNode(sources) { set_results({sources[0]}); }
  Rect needs(const Rect& result, int) const override { return grown(result, 2, 1); }
  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    const Rect& rect = results[0].rect;
    const Rect part{rect.x - sources[0].rect.x, rect.y - sources[0].rect.y, rect.width, rect.height};
    copy_pixels(sources[0].pixels.crop(part), results[0].pixels);
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }
};

TEST(EveryOperation, InsideAChainGivesTheSameBytes) {
  for_each_case([](const Case& each) {
    const auto expected = reference(each);
    for (const bool fuse : {true, false}) {
      Graph graph;
      std::vector<ValueRef> sources;
      std::vector<ImageInfo> source_infos;
      for (const Image& source : each.sources) {
        const ImageInfo infos[] = {source.info()};
        sources.push_back(
            graph.add_node(std::make_unique<Identity>(infos), {graph.add_source(source.any(), "source")}, "before"));
        source_infos.push_back(source.info());
      }
      auto node = make_node(*each.operation, each.options.get(), source_infos);
      const std::vector<ImageInfo> infos(node->results().begin(), node->results().end());
      const ValueRef first =
          graph.add_node(std::move(node), sources, each.operation->name, image_names(*each.operation));
      Results results;
      std::vector<Target> targets;
      for (const ImageInfo& info : infos) results.images.emplace_back(info);
      for (std::size_t r = 0; r < results.images.size(); ++r) {
        const ValueRef after = graph.add_node(std::make_unique<Identity>(std::span(&infos[r], 1)),
                                              {{first.vertex, static_cast<int>(r)}}, "after");
        targets.push_back({after, results.images[r].any(), nullptr});
      }
      add_report(each, graph, first.vertex, targets, results.report);
      execute(graph, targets, with(fuse ? 2 : 1, {.tile_width = 17, .tile_height = 11, .fuse = fuse}));
      expect_same(expected, results, each.name, fuse ? "fused" : "not fused");
    }
  });
}

TEST(EveryOperation, PaddedStridesAreReadAndLeftAlone) {
  constexpr std::byte kCanary{0xA5};
  for_each_case([&](const Case& each) {
    const auto expected = reference(each);
    const auto padded = [&](const ImageInfo& info, std::vector<std::byte>& memory) {
      // Rows begin at odd multiples of the value's size and end before a canary.
      const std::size_t value = size_of(info.type);
      const std::size_t stride = info.row_bytes() + 3 * value;
      memory.assign(stride * static_cast<std::size_t>(info.height) + 2 * 64, kCanary);
      return AnyView(memory.data() + 64 + value, static_cast<std::ptrdiff_t>(stride), info);
    };
    std::vector<std::vector<std::byte>> source_memory(each.sources.size());
    std::vector<std::vector<std::byte>> result_memory(expected.images.size());
    Graph graph;
    std::vector<ValueRef> sources;
    std::vector<ImageInfo> source_infos;
    for (std::size_t s = 0; s < each.sources.size(); ++s) {
      const AnyView view = padded(each.sources[s].info(), source_memory[s]);
      copy_pixels(each.sources[s].any(), view);
      sources.push_back(graph.add_source(view, "source"));
      source_infos.push_back(each.sources[s].info());
    }
    auto node = make_node(*each.operation, each.options.get(), source_infos);
    const ValueRef first = graph.add_node(std::move(node), sources, each.operation->name, image_names(*each.operation));
    std::vector<Target> targets;
    for (std::size_t r = 0; r < expected.images.size(); ++r) {
      targets.push_back(
          {{first.vertex, static_cast<int>(r)}, padded(expected.images[r].info(), result_memory[r]), nullptr});
    }
    execute(graph, targets, with(1, {}));
    for (std::size_t r = 0; r < expected.images.size(); ++r) {
      const AnyView& view = targets[r].pixels;
      ASSERT_TRUE(same_pixels(expected.images[r].any(), view)) << each.name;
      for (int y = 0; y < view.height(); ++y) {  // what was written is made canary again: then all must be
        std::fill_n(view.row(y), view.info.row_bytes(), kCanary);
      }
      for (const std::byte each_byte : result_memory[r])
        ASSERT_EQ(each_byte, kCanary) << each.name << ": wrote outside its rows";
    }
  });
}

TEST(EveryOperation, RefusesOptionsOutOfRange) {
  for (const Operation* operation : every_variant()) {
    for (const Field& field : operation->fields) {
      std::vector<std::string> bad;
      if (field.type != FieldType::Text) bad = {"", "maybe", "nan", "1;2", ",", "#12345"};
      if (field.type == FieldType::Int || field.type == FieldType::Float || field.type == FieldType::Point ||
          field.type == FieldType::Grid) {
        bad.emplace_back("1x");
        const auto [low, high] = field.range;  // a step of 1 is none beside 1e30
        if (std::isfinite(low)) bad.push_back(repeated(field, low - std::max(1.0, std::fabs(low))));
        if (std::isfinite(high)) bad.push_back(repeated(field, high + std::max(1.0, std::fabs(high))));
      }
      for (const std::string& text : bad) {
        const auto options = operation->make_options();
        try {
          field.parse(options.get(), text);
          ADD_FAILURE() << operation->name << ": " << field.name << " takes \"" << text << "\"";
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), Error::Argument);
          EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos) << error.what();
        }
      }
    }
  }
}

TEST(EveryOperation, IsToldWell) {
  std::set<std::string> names;
  std::string last;
  for (const Operation* operation : operations()) {
    SCOPED_TRACE(operation->name);
    EXPECT_TRUE(names.insert(operation->name).second) << "told twice";
    EXPECT_LT(last, operation->name) << "the list is not in the order of names";
    last = operation->name;
  }
  for (const Operation* operation : every_variant()) {
    SCOPED_TRACE(title_of(*operation));
    EXPECT_TRUE(operation->summary.ends_with('.'));
    EXPECT_FALSE(operation->outputs.empty());
    const auto defaults = operation->make_options();
    EXPECT_NO_THROW(operation->check(defaults.get()));
    EXPECT_NE(operation->make_node != nullptr, operation->invoke != nullptr);
    if (!operation->float_output.empty()) {
      const std::string name = operation->float_output.substr(0, operation->float_output.find('='));
      ASSERT_NE(operation->find_field(name), nullptr) << operation->float_output;
      EXPECT_TRUE(operation->find_field(name)->optional);
      EXPECT_NO_THROW(operation->find_field(name)->parse(operation->make_options().get(),
                                                         operation->float_output.substr(name.size() + 1)));
    }
    EXPECT_EQ(operation->find_field("within"), nullptr) << "every image operation has that";
    for (const Field& field : operation->fields) {
      EXPECT_TRUE(field.name != "feather" || operation->name == "within") << "every image operation has that";
      EXPECT_FALSE(field.help.empty()) << field.name;
      EXPECT_FALSE(field.help.ends_with('.')) << field.name;
      const auto copy = operation->make_options();
      field.parse(copy.get(), field.print(defaults.get()));
      EXPECT_EQ(field.print(copy.get()), field.print(defaults.get())) << field.name << " prints what it can't read";
    }
  }
}

TEST(EveryOperation, HasVariantsThatFitTogether) {
  const auto same_names = [](const std::vector<Port>& a, const std::vector<Port>& b) {
    return std::ranges::equal(a, b, {}, &Port::name, &Port::name);
  };
  for (const Operation* operation : operations()) {
    if (operation->variants.empty()) continue;
    SCOPED_TRACE(operation->name);
    std::set<ValueKind> kinds;
    std::map<std::string, bool> switches;
    for (const Operation* each : variants_of(*operation)) {
      ASSERT_FALSE(each->inputs.empty());
      EXPECT_TRUE(kinds.insert(each->inputs[0].kind).second) << "two variants for " << to_string(each->inputs[0].kind);
      EXPECT_EQ(each->name, operation->name);
      EXPECT_TRUE(each == operation || each->variants.empty());
      EXPECT_TRUE(same_names(each->inputs, operation->inputs));
      EXPECT_TRUE(same_names(each->outputs, operation->outputs));
      for (const Field& field : each->fields) {
        const bool is_switch = field.type == FieldType::Bool;
        EXPECT_EQ(switches.emplace(field.name, is_switch).first->second, is_switch) << field.name;
      }
    }
  }
}

}  // namespace
}  // namespace azulejo
