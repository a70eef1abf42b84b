#include "azulejo/engine/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

/// A node that looks further than this is a barrier: its neighbours' tiles would be computed over and over.
constexpr int kFusedReach = 64;

bool in_memory(const Graph::Vertex& vertex) { return !vertex.node && vertex.pixels.data != nullptr; }
bool is_file(const Graph::Vertex& vertex) { return !vertex.node && vertex.pixels.data == nullptr; }

/// How far a node looks beyond a pixel; 0 where the source has another size (a resampling's window moves along).
int reach(const TileNode& node, int source) {
  if (node.results().empty()) return 0;
  const Rect whole = node.results()[0].rect();
  if (node.sources()[static_cast<std::size_t>(source)].rect() != whole) return 0;
  const Rect middle{whole.width / 2, whole.height / 2, 1, 1};
  const Rect need = node.needs(middle, source);
  return std::max(
      {middle.x - need.x, middle.y - need.y, need.right() - middle.right(), need.bottom() - middle.bottom()});
}

class Planner {
 public:
  Planner(const Graph& graph, std::span<const Target> targets, const Run& run)
      : graph_(graph), targets_(targets), run_(run) {
    plan_.first_value.reserve(graph.vertices().size() + 1);
    int count = 0;
    for (const auto& vertex : graph.vertices()) {
      plan_.first_value.push_back(count);
      count += vertex.node ? static_cast<int>(vertex.node->results().size()) : 1;
    }
    plan_.first_value.push_back(count);
    plan_.resident.assign(static_cast<std::size_t>(count), 0);
    level_.assign(static_cast<std::size_t>(count), -1);
  }

  Plan make() {
    find_needed();
    choose_resident();
    for (;;) {
      collect_groups();
      if (!make_bands()) break;  // a file turned out to be read out of order: it is resident now
    }
    return std::move(plan_);
  }

 private:
  const Graph::Vertex& vertex(int index) const { return graph_.vertices()[static_cast<std::size_t>(index)]; }
  bool resident(ValueRef value) const { return plan_.resident[plan_.index(value)] != 0; }
  bool analysed(int index, int source) const {
    const std::vector<char>& sources = analysed_[static_cast<std::size_t>(index)];
    return !sources.empty() && sources[static_cast<std::size_t>(source)] != 0;
  }

  void find_needed() {
    needed_.assign(graph_.vertices().size(), 0);
    analysed_.assign(graph_.vertices().size(), {});
    reported_.assign(graph_.vertices().size(), 0);
    for (const Target& target : targets_) {
      needed_[static_cast<std::size_t>(target.value.vertex)] = 1;
      if (target.analysed) reported_[static_cast<std::size_t>(target.value.vertex)] = 1;
    }
    for (int v = static_cast<int>(needed_.size()) - 1; v >= 0; --v) {
      if (!needed_[static_cast<std::size_t>(v)]) continue;
      const auto& sources = vertex(v).sources;
      analysed_[static_cast<std::size_t>(v)].assign(sources.size(), 0);
      for (std::size_t s = 0; s < sources.size(); ++s) {
        needed_[static_cast<std::size_t>(sources[s].vertex)] = 1;
        if (vertex(v).node->analysis(static_cast<int>(s))) analysed_[static_cast<std::size_t>(v)][s] = 1;
      }
    }
  }

  void choose_resident() {
    const bool keep_all = !run_.testing.fuse || run_.stages != nullptr;
    for (int v = 0; v < static_cast<int>(needed_.size()); ++v) {
      if (!needed_[static_cast<std::size_t>(v)] || !vertex(v).node) continue;
      const TileNode& node = *vertex(v).node;
      for (int s = 0; s < static_cast<int>(vertex(v).sources.size()); ++s) {
        const ValueRef source = vertex(v).sources[static_cast<std::size_t>(s)];
        if (in_memory(vertex(source.vertex))) continue;
        const int distance = reach(node, s);
        // What was computed for an analysis is kept where there is room, rather than computed again.
        const bool spill = analysed(v, s) && !node.results().empty() && vertex(source.vertex).node &&
                           image_bytes(graph_.info(source)) <= run_.limits.memory_bytes / 4;
        if (keep_all || spill || node.needs_everything(s) || distance > kFusedReach ||
            (node.border(s).mode == Border::Wrap && distance > 0)) {
          plan_.resident[plan_.index(source)] = 1;
        }
      }
      if (run_.stages != nullptr) {
        for (int o = 0; o < static_cast<int>(node.results().size()); ++o) plan_.resident[plan_.index({v, o})] = 1;
      }
    }
  }

  /// The group level at which a value can be computed: after everything it stands on that must be whole.
  int level_of(ValueRef value) {
    int& known = level_[plan_.index(value)];
    if (known >= 0) return known;
    int level = 0;
    const auto& at = vertex(value.vertex);
    for (int s = 0; s < static_cast<int>(at.sources.size()); ++s) {
      const ValueRef source = at.sources[static_cast<std::size_t>(s)];
      const int below = level_of(source);
      level = std::max(level, resident(source) || analysed(value.vertex, s) ? below + 1 : below);
    }
    return known = level;
  }

  Root& root(ValueRef value) {
    const ImageInfo& info = graph_.info(value);
    const int level = level_of(value);
    const auto same = std::find_if(plan_.groups.begin(), plan_.groups.end(), [&](const Group& group) {
      return group.level == level && group.width == info.width && group.height == info.height;
    });
    Group& group = same != plan_.groups.end() ? *same : plan_.groups.emplace_back();
    group.level = level;
    group.width = info.width;
    group.height = info.height;
    for (Root& each : group.roots) {
      if (each.value == value) return each;
    }
    Root added;
    added.value = value;
    added.resident = resident(value);
    return group.roots.emplace_back(std::move(added));
  }

  void collect_groups() {
    plan_.groups.clear();
    std::fill(level_.begin(), level_.end(), -1);
    for (int v = 0; v < static_cast<int>(needed_.size()); ++v) {
      if (!needed_[static_cast<std::size_t>(v)]) continue;
      const int outputs =
          plan_.first_value[static_cast<std::size_t>(v) + 1] - plan_.first_value[static_cast<std::size_t>(v)];
      for (int o = 0; o < outputs; ++o) {
        if (resident({v, o})) root({v, o});
      }
      for (int s = 0; s < static_cast<int>(vertex(v).sources.size()); ++s) {
        if (analysed(v, s)) root(vertex(v).sources[static_cast<std::size_t>(s)]).analyses.push_back({v, s});
      }
      if (reported_[static_cast<std::size_t>(v)]) analyse_results(v);
    }
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (!targets_[t].analysed) root(targets_[t].value).targets.push_back(static_cast<int>(t));
    }
    std::stable_sort(plan_.groups.begin(), plan_.groups.end(),
                     [](const Group& a, const Group& b) { return a.level < b.level; });
    for (Group& group : plan_.groups) {
      collect_nodes(group);
      choose_tiles(group);
    }
  }

  void analyse_results(int v) {
    const TileNode& node = *vertex(v).node;
    for (int o = 0; o < static_cast<int>(node.results().size()); ++o) {
      if (!node.result_analysis(o)) continue;
      root({v, o}).analyses.push_back({v, static_cast<int>(node.sources().size()) + o});
    }
  }

  void collect_nodes(Group& group) {
    std::vector<char> used(graph_.vertices().size(), 0);
    for (const Root& each : group.roots) used[static_cast<std::size_t>(each.value.vertex)] = 1;
    for (int v = static_cast<int>(used.size()) - 1; v >= 0; --v) {
      if (!used[static_cast<std::size_t>(v)]) continue;
      if (is_file(vertex(v))) group.files.push_back({v, 0});
      if (!vertex(v).node) continue;
      group.nodes.push_back(v);
      for (const ValueRef source : vertex(v).sources) {
        if (!resident(source)) used[static_cast<std::size_t>(source.vertex)] = 1;
      }
    }
    std::reverse(group.nodes.begin(), group.nodes.end());
  }

  /// Pixels computed and read for each pixel of the result, and bytes held, for tiles of one size.
  struct TileCost {
    double work = 0;
    double bytes = 0;
  };
  TileCost tile_cost(const Group& group, const Rect& tile) {
    propagate(graph_, plan_, group, tile, required_);
    TileCost cost;
    for (const int v : group.nodes) {
      const auto& at = vertex(v);
      Rect computed;
      for (int o = 0; o < static_cast<int>(at.node->results().size()); ++o) {
        const Rect& part = required_[plan_.index({v, o})];
        computed = united(computed, part);
        cost.bytes += static_cast<double>(part.area()) * static_cast<double>(graph_.info({v, o}).pixel_bytes());
      }
      cost.work += static_cast<double>(computed.area());
      for (int s = 0; s < static_cast<int>(at.sources.size()); ++s) {
        cost.work += 0.5 * static_cast<double>(at.node->needs(computed, s).area());
      }
    }
    if (group.nodes.empty()) cost.work = static_cast<double>(tile.area());  // an analysis or a copy
    cost.work /= static_cast<double>(tile.area());
    return cost;
  }

  /// The cheapest of a few sizes: small enough for the cache, large enough that borders of intermediates don't
  /// count, enough of them for all threads. 768 KB: three quarters of the smallest second-level cache in use.
  /// Each row of a tile begins at a new place in memory, which costs as much as some thousand pixels of a cheap node, while
  /// the next level of cache is hardly slower: wide tiles are better than square ones (24 megapixels: grayscale of RGB with
  /// 6000 columns 4.8 ms, 3000 9.8 ms; a chain of five 50 and 62 ms). The constants were fitted to single operations and
  /// chains of five on 2 and 24 megapixels.
  void choose_tiles(Group& group) {
    constexpr double kCacheBytes = 768 * 1024;
    constexpr double kPixelsPerTileCall = 2000;
    constexpr double kPixelsPerRow = 4000;
    constexpr double kPixelsPerNodeRow = 200;
    constexpr double kSlowerBeyondCache = 0.02;  // for each time that a tile fills the cache
    constexpr int kSmall = 128 * 128;
    const auto& [tile_width, tile_height, fuse, reference] = run_.testing;
    if (tile_width > 0 && tile_height > 0) {
      group.tile_width = std::min(tile_width, group.width);
      group.tile_height = std::min(tile_height, group.height);
      return;
    }
    if (std::int64_t{group.width} * group.height <= kSmall) {
      group.tile_width = group.width;
      group.tile_height = group.height;
      return;
    }
    const int threads = thread_count(run_);
    double best = std::numeric_limits<double>::infinity();
    int last_width = 0;
    for (const int across : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64, 128}) {
      const int w = std::min((std::max(group.width / across, 256) + 63) / 64 * 64, group.width);
      if (w == last_width) continue;
      last_width = w;
      int last_height = 0;
      for (const int height : {16, 32, 64, 128, 256, 512, 1024}) {
        const int h = std::min(height, group.height);
        if (h == last_height) continue;
        last_height = h;
        const TileCost cost = tile_cost(group, {(group.width - w) / 2, (group.height - h) / 2, w, h});
        const double tiles = std::ceil(1.0 * group.width / w) * std::ceil(1.0 * group.height / h);
        const double overflow = std::max(0.0, cost.bytes / kCacheBytes - 1);
        const double idle = threads > 1 ? 0.5 * threads / tiles : 0;
        const double calls = kPixelsPerTileCall / (1.0 * w * h) +
                             (kPixelsPerRow + kPixelsPerNodeRow * static_cast<double>(group.nodes.size())) / w;
        const double total = (cost.work * (1 + kSlowerBeyondCache * overflow) + calls) * (1 + idle);
        if (total < best * 0.999) {
          best = total;
          group.tile_width = w;
          group.tile_height = h;
        }
      }
    }
  }

  bool streamed(const Group& group) const {
    if (!group.files.empty()) return true;
    for (const Root& each : group.roots) {
      for (const int target : each.targets) {
        if (targets_[static_cast<std::size_t>(target)].sink != nullptr) return true;
      }
    }
    return false;
  }

  /// Bands of rows for groups that read or write files. True if a file must be made resident first, because a
  /// band needs rows above those of the band before.
  bool make_bands() {
    for (Group& group : plan_.groups) {
      group.band_height = group.height;
      if (!streamed(group)) continue;
      int step = group.tile_height;
      if (run_.testing.tile_height <= 0) {
        // Enough tiles in a band for all threads, and whole rows of the files' own tiles.
        const int across = (group.width + group.tile_width - 1) / group.tile_width;
        const int rows_of_tiles = std::max(1, (4 * thread_count(run_) + across - 1) / across);
        step = std::max(64, std::min(group.tile_height * rows_of_tiles, 512));
        int unit = 1;
        for (const ValueRef file : group.files) unit = std::max(unit, vertex(file.vertex).source->row_group());
        for (const Root& each : group.roots) {
          for (const int target : each.targets) {
            if (const ImageSink* sink = targets_[static_cast<std::size_t>(target)].sink)
              unit = std::max(unit, sink->row_group());
          }
        }
        if (unit <= 4096) step = (step + unit - 1) / unit * unit;
      }
      group.band_height = std::min(step, group.height);
      group.tile_height = std::min(group.tile_height, group.band_height);
      if (const int file = out_of_order(group); file >= 0) {
        plan_.resident[plan_.index({file, 0})] = 1;
        return true;
      }
    }
    return false;
  }

  int out_of_order(const Group& group) {
    std::vector<int> top(group.files.size(), 0);
    for (int y = 0; y < group.height; y += group.band_height) {
      const Rect band{0, y, group.width, std::min(group.band_height, group.height - y)};
      propagate(graph_, plan_, group, band, required_);
      for (std::size_t f = 0; f < group.files.size(); ++f) {
        const Rect& part = required_[plan_.index(group.files[f])];
        if (part.empty()) continue;
        if (part.y < top[f]) return group.files[f].vertex;
        top[f] = part.y;
      }
    }
    return -1;
  }

  const Graph& graph_;
  std::span<const Target> targets_;
  const Run& run_;
  Plan plan_;
  std::vector<char> needed_;
  std::vector<std::vector<char>> analysed_;  ///< by vertex and source: it is analysed first
  std::vector<char> reported_;               ///< by vertex: its report is wanted
  std::vector<int> level_;
  std::vector<Rect> required_;
};

/// Where a stretch of one period outside [0, size) lands; the whole where it is longer.
Span1 folded(std::int64_t low, std::int64_t high, int size, Border mode) {
  if (high - low >= size || low <= -std::int64_t{size} || high > 2 * std::int64_t{size} - 1) return {0, size};
  const int a = border_index(low, size, mode);
  const int b = border_index(high - 1, size, mode);
  return {std::min(a, b), std::max(a, b) + 1};
}

}  // namespace

Span1 covering(std::int64_t low, std::int64_t high, int size, Border mode) {
  if (high <= low) return {};
  const Span1 inside{static_cast<int>(std::clamp<std::int64_t>(low, 0, size)),
                     static_cast<int>(std::clamp<std::int64_t>(high, 0, size))};
  if (mode == Border::Constant) return inside.high > inside.low ? inside : Span1{};
  if (mode == Border::Clamp) {
    const int first = border_index(low, size, mode);
    const int last = border_index(high - 1, size, mode);
    return {first, last + 1};
  }
  Span1 all{size, 0};
  const auto take = [&](Span1 part) {
    all.low = std::min(all.low, part.low);
    all.high = std::max(all.high, part.high);
  };
  if (inside.high > inside.low) take(inside);
  if (low < 0) take(folded(low, std::min<std::int64_t>(high, 0), size, mode));
  if (high > size) take(folded(std::max<std::int64_t>(low, size), high, size, mode));
  return all;
}

Rect source_part(const TileNode& node, int source, const Rect& result) {
  const ImageInfo& info = node.sources()[static_cast<std::size_t>(source)];
  const Rect need = node.needs(result, source);
  if (info.rect().contains(need)) return need;
  const Border mode = node.border(source).mode;
  const Span1 x = covering(need.x, std::int64_t{need.x} + need.width, info.width, mode);
  const Span1 y = covering(need.y, std::int64_t{need.y} + need.height, info.height, mode);
  return rect_between(x.low, y.low, x.high, y.high);
}

void propagate(const Graph& graph, const Plan& plan, const Group& group, const Rect& tile,
               std::vector<Rect>& required) {
  required.assign(plan.resident.size(), Rect{});
  for (const Root& root : group.roots) required[plan.index(root.value)] = tile;
  for (std::size_t n = group.nodes.size(); n-- > 0;) {
    const int v = group.nodes[n];
    const Graph::Vertex& vertex = graph.vertices()[static_cast<std::size_t>(v)];
    Rect computed;
    const int outputs = static_cast<int>(vertex.node->results().size());
    for (int o = 0; o < outputs; ++o) computed = united(computed, required[plan.index({v, o})]);
    if (computed.empty()) continue;
    for (int s = 0; s < static_cast<int>(vertex.sources.size()); ++s) {
      Rect& part = required[plan.index(vertex.sources[static_cast<std::size_t>(s)])];
      part = united(part, source_part(*vertex.node, s, computed));
    }
  }
}

std::unique_ptr<Analysis> make_analysis(const TileNode& node, int index) {
  const auto sources = static_cast<int>(node.sources().size());
  return index < sources ? node.analysis(index) : node.result_analysis(index - sources);
}

Plan make_plan(const Graph& graph, std::span<const Target> targets, const Run& run) {
  return Planner(graph, targets, run).make();
}

}  // namespace azulejo
