#include "azulejo/rendering/draw_outlines.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/modelling/flatten_path.h"
#include "azulejo/rendering/crisp_path.h"
#include "azulejo/rendering/point_marks.h"
#include "azulejo/rendering/stroke_path.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunkCommands = 4096;  ///< of paths that one task does
constexpr std::size_t kPartPoints = 16384;    ///< of an outline so large that it is cut into parts
constexpr std::size_t kBinned = 48;           ///< edges from which on each band has a list of its own

/// A part, while the arrays grow that it is in.
struct PartRange {
  std::size_t step;
  std::size_t first_edge, edge_count;
  std::size_t first_start, start_count;
  std::size_t first_chosen, chosen_count;
  int first_band;
  Rect pixels;
};

struct LargeOutline {
  std::size_t step;
  FlatPath path;
};

void drop_not_finite(FlatPath& path) {
  const auto finite = [](const glm::vec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  if (std::all_of(path.points.begin(), path.points.end(), finite)) return;
  FlatPath kept;
  for (std::size_t i = 0; i < path.contour_count(); ++i) {
    kept.begin();
    for (const glm::vec2& point : path.contour(i)) {
      if (finite(point)) kept.points.push_back(point);
    }
  }
  path = std::move(kept);
}

}  // namespace

/// What a task made.
struct DrawOutlines::Chunk {
  Array<OutlineEdge> edges;
  Array<std::uint32_t> starts;
  Array<std::uint32_t> chosen;
  std::vector<PartRange> parts;
  std::vector<LargeOutline> large;

  /// Finishes a part that consists of the edges from `first` on.
  void end_part(std::size_t step, std::size_t first, bool reaches_right, const DrawFrame& frame, int band_rows) {
    if (first == edges.size()) return;
    const std::span<const OutlineEdge> added(edges.data() + first, edges.size() - first);
    Rect pixels = pixels_of(added);
    if (reaches_right) pixels.width = frame.width - pixels.x;
    pixels = intersection({pixels.x, pixels.y, std::max(pixels.width, 1), std::max(pixels.height, 1)},
                          {0, 0, frame.width, frame.height});
    if (pixels.empty()) return edges.resize(first);
    PartRange part{step, first, added.size(), starts.size(), 0, chosen.size(), 0, pixels.y / band_rows, pixels};
    const int bands = (pixels.bottom() - 1) / band_rows - part.first_band + 1;
    if (added.size() > kBinned && bands > 1) choose(added, part, bands, band_rows);
    parts.push_back(part);
  }

 private:
  /// Lists the edges of each band.
  void choose(std::span<const OutlineEdge> added, PartRange& part, int bands, int band_rows) {
    part.start_count = static_cast<std::size_t>(bands) + 1;
    starts.resize(part.first_start + part.start_count);
    std::uint32_t* const start = starts.data() + part.first_start;
    std::fill_n(start, part.start_count, 0U);
    const auto for_bands = [&](const OutlineEdge& edge, auto&& each) {
      const auto band_of = [&](std::int32_t y) {
        return std::clamp((y >> kEdgeBits) / band_rows - part.first_band, 0, bands - 1);
      };
      const int top = band_of(std::min(edge.y0, edge.y1));
      const int bottom = band_of(std::max(edge.y0, edge.y1));
      for (int band = top; band <= bottom; ++band) each(band);
    };
    for (const OutlineEdge& edge : added) {
      for_bands(edge, [&](int band) { ++start[band + 1]; });
    }
    for (int band = 0; band < bands; ++band) start[band + 1] += start[band];
    part.chosen_count = start[bands];
    chosen.resize(part.first_chosen + part.chosen_count);
    std::uint32_t* const list = chosen.data() + part.first_chosen;
    for (std::size_t i = 0; i < added.size(); ++i) {
      for_bands(added[i], [&](int band) { list[start[band]++] = static_cast<std::uint32_t>(i); });
    }
    // Each start moved on to the next one.
    for (int band = bands; band > 0; --band) start[band] = start[band - 1];
    start[0] = 0;
  }
};

namespace {

/// Makes the outlines of one thread.
class OutlineMaker {
 public:
  OutlineMaker(const Drawing& drawing, const DrawSteps& steps, const DrawFrame& frame, const DrawOptions& options)
      : drawing_(drawing), steps_(steps) {
    const Box2 window{{0, 0}, {static_cast<float>(frame.width), static_cast<float>(frame.height)}};
    flatten_ = {.tolerance = options.tolerance, .window = window};
    stroke_ = {.tolerance = options.tolerance, .window = window};
    window_ = {0, 0, frame.width, frame.height};
    crisp_ = options.strokes == DrawStrokes::Crisp;
  }

  FlatPath& make(std::size_t index) {
    flat_.clear();
    const DrawStep& step = steps_.steps[index];
    const DrawingPath& path = drawing_.paths[step.path];
    const glm::mat3x2& place = steps_.places[step.place];
    const DrawingStyle& style = drawing_.styles[path.style];
    switch (step.shape) {
      case DrawShape::Inside: flatten_path(drawing_.view(path), place, flatten_, flat_); break;
      case DrawShape::Stroke: stroke_path(drawing_.view(path), style, place, stroke_, scratch_, flat_); break;
      case DrawShape::Points:
        point_marks(drawing_.view(path), style, place, flatten_.tolerance, flatten_.window, flat_);
        break;
    }
    return flat_;
  }

  bool is_crisp(std::size_t index) const { return crisp_ && steps_.steps[index].shape == DrawShape::Stroke; }
  /// Whole pixels: each run of a row is a rectangle.
  void make_crisp(std::size_t index, Array<OutlineEdge>& edges) {
    const DrawStep& step = steps_.steps[index];
    const DrawingPath& path = drawing_.paths[step.path];
    flat_.clear();
    lines_.clear();
    crisp_path(drawing_.view(path), drawing_.styles[path.style], steps_.places[step.place],
               {.tolerance = flatten_.tolerance, .window = window_}, flat_, lines_);
    for (const CrispLine& line : lines_) {
      for_runs(line, 0, window_.height - 1, [&](int row, int begin, int end) {
        const std::int32_t left = std::clamp(begin, 0, window_.width) << kEdgeBits;
        const std::int32_t right = std::clamp(end, 0, window_.width) << kEdgeBits;
        const std::int32_t top = row << kEdgeBits;
        edges.push_back({left, top, left, top + kEdgeOne, 1});
        edges.push_back({right, top + kEdgeOne, right, top, 1});
      });
    }
  }

 private:
  const Drawing& drawing_;
  const DrawSteps& steps_;
  FlattenOptions flatten_;
  StrokeOptions stroke_;
  Rect window_;
  bool crisp_ = false;
  StrokeScratch scratch_;
  FlatPath flat_;
  Array<CrispLine> lines_;
};

/// Convex outlines have one chain: no pixel of theirs is looked at twice, and level edges say nothing.
void simplify_convex(Array<OutlineEdge>& edges, std::size_t first) {
  constexpr std::size_t kMost = 256;
  if (edges.size() - first > kMost || !is_convex({edges.data() + first, edges.size() - first})) return;
  const auto from = edges.begin() + static_cast<std::ptrdiff_t>(first);
  edges.erase(std::remove_if(from, edges.end(), [](const OutlineEdge& edge) { return edge.y0 == edge.y1; }),
              edges.end());
  for (std::size_t i = first; i < edges.size(); ++i) edges[i].chain = 1;
}

/// The lines that begin at points [begin, end) of all contours.
void gather_part(const FlatPath& path, std::size_t begin, std::size_t end, EdgeGatherer& gatherer) {
  const auto after = std::upper_bound(path.starts.begin(), path.starts.end(), static_cast<std::uint32_t>(begin));
  auto contour = static_cast<std::size_t>(after - path.starts.begin()) - 1;
  for (std::size_t at = begin; at < end; ++contour) {
    const std::span<const glm::vec2> points = path.contour(contour);
    const std::size_t from = at - path.starts[contour];
    const std::size_t to = std::min(points.size(), end - path.starts[contour]);
    gatherer.set_summed(path.summed[contour] != 0);
    gatherer.add_lines(points.subspan(from, std::min(to + 1, points.size()) - from));
    if (to == points.size() && !points.empty()) {
      gatherer.add_lines(std::array{points.back(), points.front()});
      gatherer.begin_chain();
    }
    at = path.starts[contour] + to;
  }
}

/// Ranges of steps that are about as much work.
std::vector<std::size_t> task_starts(const Drawing& drawing, const DrawSteps& steps) {
  std::vector<std::size_t> starts;
  std::size_t commands = kChunkCommands;
  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    if (commands >= kChunkCommands) {
      starts.push_back(i);
      commands = 0;
    }
    const DrawStep& step = steps.steps[i];
    commands += 1 + (step.kind == DrawStep::Shape ? drawing.paths[step.path].command_count : 0);
  }
  starts.push_back(steps.steps.size());
  return starts;
}

/// Counts memory of all tasks.
class MemoryLimit {
 public:
  explicit MemoryLimit(const Run& run) : most_(run.limits.memory_bytes) {}
  void add(std::size_t edges) {
    const auto bytes = static_cast<std::int64_t>(edges * (sizeof(OutlineEdge) + sizeof(std::uint32_t)));
    if (bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes > most_) {
      throw Error(Error::Resource, fmt::format("draw: its lines need more memory than the limit of {} bytes", most_));
    }
  }

 private:
  std::int64_t most_;
  std::atomic<std::int64_t> bytes_{0};
};

}  // namespace

DrawOutlines::DrawOutlines(const Drawing& drawing, const DrawSteps& steps, const DrawFrame& frame,
                           const DrawOptions& options, int band_rows, const Run& run)
    : outlines_(steps.steps.size()) {
  const std::vector<std::size_t> starts = task_starts(drawing, steps);
  std::vector<std::shared_ptr<Chunk>> made(starts.size() - 1);
  MemoryLimit limit(run);
  parallel_tasks(made.size(), run, [&](std::size_t task, int) {
    made[task] = std::make_shared<Chunk>();
    Chunk& chunk = *made[task];
    OutlineMaker maker(drawing, steps, frame, options);
    for (std::size_t i = starts[task]; i < starts[task + 1]; ++i) {
      if (steps.steps[i].kind != DrawStep::Shape) continue;
      const std::size_t first = chunk.edges.size();
      if (maker.is_crisp(i)) {
        maker.make_crisp(i, chunk.edges);
        limit.add(chunk.edges.size() - first);
        chunk.end_part(i, first, false, frame, band_rows);
        continue;
      }
      FlatPath& path = maker.make(i);
      limit.add(path.points.size());
      if (path.points.size() > kPartPoints) {
        chunk.large.push_back({i, std::move(path)});
        drop_not_finite(chunk.large.back().path);
        continue;
      }
      EdgeGatherer gatherer(frame.width, frame.height, chunk.edges);
      for (std::size_t c = 0; c < path.contour_count(); ++c) {
        gatherer.set_summed(path.summed[c] != 0);
        gatherer.add_contour(path.contour(c));
      }
      if (path.contour_count() == 1) simplify_convex(chunk.edges, first);
      chunk.end_part(i, first, gatherer.reaches_right(), frame, band_rows);
    }
  });

  struct Piece {
    const LargeOutline* outline;
    std::size_t begin;
  };
  std::vector<Piece> pieces;
  for (const std::shared_ptr<Chunk>& chunk : made) {
    for (const LargeOutline& outline : chunk->large) {
      for (std::size_t at = 0; at < outline.path.points.size(); at += kPartPoints) pieces.push_back({&outline, at});
    }
  }
  std::vector<std::shared_ptr<Chunk>> pieces_made(pieces.size());
  parallel_tasks(pieces.size(), run, [&](std::size_t task, int) {
    const auto& [outline, begin] = pieces[task];
    pieces_made[task] = std::make_shared<Chunk>();
    Chunk& chunk = *pieces_made[task];
    const std::size_t end = std::min(begin + kPartPoints, outline->path.points.size());
    chunk.edges.reserve(end - begin);
    const auto chain = static_cast<std::uint32_t>(begin / kPartPoints * (4 * kPartPoints) % (1U << 31));
    EdgeGatherer gatherer(frame.width, frame.height, chunk.edges, chain + 1);
    gather_part(outline->path, begin, end, gatherer);
    chunk.end_part(outline->step, 0, gatherer.reaches_right(), frame, band_rows);
  });

  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    const DrawStep& step = steps.steps[i];
    if (step.kind != DrawStep::Shape) continue;
    const DrawingStyle& style = drawing.styles[drawing.paths[step.path].style];
    outlines_[i].rule = step.shape == DrawShape::Inside ? style.fill_rule : FillRule::NonZero;
  }
  chunks_ = std::move(made);
  chunks_.insert(chunks_.end(), pieces_made.begin(), pieces_made.end());
  for (const std::shared_ptr<Chunk>& chunk : chunks_) add_parts(*chunk);
}

void DrawOutlines::add_parts(Chunk& chunk) {
  chunk.large.clear();
  for (const PartRange& part : chunk.parts) {
    DrawOutline& outline = outlines_[part.step];
    if (outline.part_count++ == 0) {
      outline.first_part = static_cast<std::uint32_t>(parts_.size());
      outline.pixels = part.pixels;
    } else {
      const Rect& known = outline.pixels;
      outline.pixels =
          rect_between(std::min(known.x, part.pixels.x), std::min(known.y, part.pixels.y),
                       std::max(known.right(), part.pixels.right()), std::max(known.bottom(), part.pixels.bottom()));
    }
    parts_.push_back({{chunk.edges.data() + part.first_edge, part.edge_count},
                      part.first_band,
                      {chunk.starts.data() + part.first_start, part.start_count},
                      {chunk.chosen.data() + part.first_chosen, part.chosen_count}});
  }
}

}  // namespace azulejo
