#include "azulejo/engine/tile_worker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

namespace azulejo {
namespace {

const Graph::Vertex& vertex_of(const GroupJob& job, int index) {
  return job.graph.vertices()[static_cast<std::size_t>(index)];
}

/// The bytes of a pixel whose channels all have the intensity `value`.
std::array<std::byte, 16> pixel_of(const ImageInfo& info, float value) {
  std::array<std::byte, 16> pixel{};
  visit_type(info.type, [&](auto zero) {
    using T = decltype(zero);
    T channel{};
    if constexpr (std::is_floating_point_v<T>) {
      channel = value;
    } else {
      const float top = full_range(kPixelTypeOf<T>);
      channel = static_cast<T>(std::clamp(value * top, 0.0F, top) + 0.5F);
    }
    for (int c = 0; c < info.channels; ++c)
      std::memcpy(pixel.data() + static_cast<std::size_t>(c) * sizeof(T), &channel, sizeof(T));
  });
  return pixel;
}

}  // namespace

TileWorker::TileWorker(const GroupJob& job) : job_(job) {
  computed_.resize(job.plan.resident.size());
  find_readers();
  for (const Root& root : job.group.roots) {
    for (const Root::Analysis& wanted : root.analyses) {
      partials_.push_back(make_analysis(*vertex_of(job, wanted.vertex).node, wanted.index));
    }
  }
}

void TileWorker::find_readers() {
  readers_.resize(job_.plan.resident.size());
  std::vector<int> reads(readers_.size(), 0);
  for (const int v : job_.group.nodes) {
    const auto& sources = vertex_of(job_, v).sources;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      readers_[job_.plan.index(sources[s])] = {v, static_cast<int>(s)};
      ++reads[job_.plan.index(sources[s])];
    }
  }
  for (const Root& root : job_.group.roots) reads[job_.plan.index(root.value)] = 0;
  for (std::size_t i = 0; i < reads.size(); ++i) {
    if (reads[i] != 1) readers_[i] = {};
  }
}

/// The part of a value that is computed, with what its only reader needs beside it: filled in place, so that
/// the reader's source is no copy.
Rect TileWorker::with_margin(ValueRef value, const Rect& computed) const {
  const Reader& reader = readers_[job_.plan.index(value)];
  if (reader.vertex < 0) return computed;
  const TileNode& node = *vertex_of(job_, reader.vertex).node;
  Rect wanted;
  for (int o = 0; o < static_cast<int>(node.results().size()); ++o) {
    wanted = united(wanted, required_[job_.plan.index({reader.vertex, o})]);
  }
  return united(computed, node.needs(wanted, reader.source));
}

void TileWorker::fill_margin(ValueRef value, const Rect& computed) {
  const std::size_t index = job_.plan.index(value);
  const Tile& tile = computed_[index];
  if (tile.rect == computed) return;
  const Reader& reader = readers_[index];
  const ImageInfo& whole = job_.graph.info(value);
  const BorderRule rule = vertex_of(job_, reader.vertex).node->border(reader.source);
  const std::array<std::byte, 16> outside = pixel_of(whole, rule.value);
  const std::size_t bytes = whole.pixel_bytes();
  const auto at = [&](int x) {
    return static_cast<std::ptrdiff_t>(x - tile.rect.x) * static_cast<std::ptrdiff_t>(bytes);
  };
  const auto fill = [&](int from, int to, std::byte* row) {
    for (int x = from; x < to; ++x) {
      const int source = border_index(x, whole.width, rule.mode);
      std::memcpy(row + at(x), source < 0 ? outside.data() : row + at(source), bytes);
    }
  };
  for (int y = computed.y; y < computed.bottom(); ++y) {
    std::byte* const row = tile.pixels.row(y - tile.rect.y);
    fill(tile.rect.x, computed.x, row);
    fill(computed.right(), tile.rect.right(), row);
  }
  for (int y = tile.rect.y; y < tile.rect.bottom(); ++y) {
    if (y >= computed.y && y < computed.bottom()) continue;
    std::byte* const row = tile.pixels.row(y - tile.rect.y);
    const int source = border_index(y, whole.height, rule.mode);
    if (source >= 0) {
      std::memcpy(row, tile.pixels.row(source - tile.rect.y), tile.pixels.info.row_bytes());
    } else {
      for (int x = tile.rect.x; x < tile.rect.right(); ++x) std::memcpy(row + at(x), outside.data(), bytes);
    }
  }
}

AnyView TileWorker::new_tile(const ImageInfo& info, const Rect& rect) {
  ImageInfo part = info;
  part.width = rect.width;
  part.height = rect.height;
  const auto stride = static_cast<std::ptrdiff_t>((part.row_bytes() + 63) / 64 * 64);
  return {tiles_.take<std::byte>(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rect.height)), stride,
          part};
}

void TileWorker::compute(const Rect& tile) {
  const Scratch::Mark start = tiles_.mark();
  propagate(job_.graph, job_.plan, job_.group, tile, required_);
  for (const int v : job_.group.nodes) run_node(v, tile);
  deliver(tile);
  tiles_.release(start);
}

void TileWorker::run_node(int v, const Rect& tile) {
  const Graph::Vertex& vertex = vertex_of(job_, v);
  const int outputs = static_cast<int>(vertex.node->results().size());
  Rect all;
  for (int o = 0; o < outputs; ++o) all = united(all, required_[job_.plan.index({v, o})]);
  if (all.empty()) return;

  node_results_.clear();
  for (int o = 0; o < outputs; ++o) {
    const ValueRef value{v, o};
    Tile result{{}, all};
    Tile kept = result;
    if (!required_[job_.plan.index(value)].empty()) {
      // Straight into the first destination where the tile is just that part of it.
      const auto place = std::find_if(job_.destinations.begin(), job_.destinations.end(), [&](const Destination& each) {
        return job_.group.roots[each.root].value == value;
      });
      if (all == tile && place != job_.destinations.end()) {
        result.pixels = place->pixels.crop({tile.x - place->rect.x, tile.y - place->rect.y, tile.width, tile.height});
        result.pixels.info = job_.graph.info(value);
        result.pixels.info.width = tile.width;
        result.pixels.info.height = tile.height;
        kept = result;
      } else {
        kept.rect = with_margin(value, all);
        kept.pixels = new_tile(job_.graph.info(value), kept.rect);
        result.pixels = kept.pixels.crop({all.x - kept.rect.x, all.y - kept.rect.y, all.width, all.height});
      }
    }
    computed_[job_.plan.index(value)] = kept;
    node_results_.push_back(result);
  }

  node_sources_.clear();
  for (int s = 0; s < static_cast<int>(vertex.sources.size()); ++s) node_sources_.push_back(source_tile(v, s, all));

  const Scratch::Mark start = scratch_.mark();
  const TileContext context{scratch_, job_.finished_analyses[static_cast<std::size_t>(v)]};
  if (job_.reference) {
    vertex.node->run_reference(node_sources_, node_results_, context);
  } else {
    vertex.node->run(node_sources_, node_results_, context);
  }
  scratch_.release(start);
  for (int o = 0; o < outputs; ++o) {
    if (node_results_[static_cast<std::size_t>(o)].wanted()) fill_margin({v, o}, all);
  }
}

ConstTile TileWorker::source_tile(int v, int source, const Rect& computed) {
  const Graph::Vertex& vertex = vertex_of(job_, v);
  const ValueRef value = vertex.sources[static_cast<std::size_t>(source)];
  const std::size_t index = job_.plan.index(value);
  Available from = job_.available[index];
  if (from.pixels.data == nullptr) from = {computed_[index].pixels, computed_[index].rect};

  const Rect need = vertex.node->needs(computed, source);
  const ImageInfo& whole = vertex.node->sources()[static_cast<std::size_t>(source)];
  if (whole.rect().contains(need) || from.rect.contains(need)) {
    ConstAnyView part = from.pixels.crop({need.x - from.rect.x, need.y - from.rect.y, need.width, need.height});
    return {part, need};
  }
  return bordered(from.pixels, from.rect, need, whole, vertex.node->border(source));
}

/// A copy of `need`, what lies outside the image filled in by the rule.
ConstTile TileWorker::bordered(const ConstAnyView& pixels, const Rect& rect, const Rect& need, const ImageInfo& whole,
                               const BorderRule& rule) {
  const AnyView copy = new_tile(whole, need);
  const std::size_t bytes = whole.pixel_bytes();
  const std::array<std::byte, 16> outside = pixel_of(whole, rule.value);
  const int inside_left = std::clamp(need.x, 0, whole.width);
  const int inside_right = std::clamp(need.right(), inside_left, whole.width);
  const auto offset = [bytes](int count) { return count * static_cast<std::ptrdiff_t>(bytes); };
  // The columns beside the image, as places in a row, and the places that they are filled from; < 0: none.
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> beside;
  for (int x = need.x; x < need.right(); ++x) {
    if (x == inside_left && inside_left < inside_right) x = inside_right;
    if (x == need.right()) break;
    const int source_x = border_index(x, whole.width, rule.mode);
    beside.emplace_back(offset(x - need.x), source_x < 0 ? -1 : offset(source_x - rect.x));
  }
  for (int y = 0; y < need.height; ++y) {
    std::byte* const row = copy.row(y);
    const int source_y = border_index(std::int64_t{need.y} + y, whole.height, rule.mode);
    if (source_y < 0) {
      for (int x = 0; x < need.width; ++x) std::memcpy(row + offset(x), outside.data(), bytes);
      continue;
    }
    const std::byte* const source = pixels.row(source_y - rect.y);
    for (const auto& [to, from] : beside) {
      const std::byte* const pixel = from < 0 ? outside.data() : source + from;
      if (bytes == 1) {
        row[to] = *pixel;
      } else {
        std::memcpy(row + to, pixel, bytes);
      }
    }
    if (inside_left < inside_right) {
      std::memcpy(row + offset(inside_left - need.x), source + offset(inside_left - rect.x),
                  static_cast<std::size_t>(offset(inside_right - inside_left)));
    }
  }
  return {copy, need};
}

/// Hands the finished root tiles to their destinations and analyses.
void TileWorker::deliver(const Rect& tile) {
  std::size_t partial = 0;
  for (std::size_t r = 0; r < job_.group.roots.size(); ++r) {
    const Root& root = job_.group.roots[r];
    const std::size_t index = job_.plan.index(root.value);
    const bool is_node = vertex_of(job_, root.value.vertex).node != nullptr;
    const Rect from_rect = is_node ? computed_[index].rect : job_.available[index].rect;
    ConstAnyView from = is_node ? ConstAnyView(computed_[index].pixels) : job_.available[index].pixels;
    from = from.crop({tile.x - from_rect.x, tile.y - from_rect.y, tile.width, tile.height});
    for (const Destination& each : job_.destinations) {
      if (each.root != r) continue;
      const AnyView place = each.pixels.crop({tile.x - each.rect.x, tile.y - each.rect.y, tile.width, tile.height});
      if (place.data != from.data) copy_pixels(from, place);
    }
    for (std::size_t a = 0; a < root.analyses.size(); ++a) partials_[partial++]->add({from, tile}, scratch_);
  }
}

}  // namespace azulejo
