#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/graph.h"
#include "azulejo/engine/plan.h"
#include "azulejo/engine/stages.h"
#include "azulejo/engine/tile_worker.h"

namespace azulejo {
namespace {

/// Calls run.progress now and then, from one thread at a time.
class Progress {
 public:
  Progress(const Plan& plan, const Run& run) : run_(run) {
    for (const Group& group : plan.groups) total_ += 1.0 * group.width * group.height;
  }
  void add(std::int64_t pixels) {
    if (!run_.progress) return;
    const std::lock_guard lock(mutex_);
    done_ += static_cast<double>(pixels);
    run_.progress(std::min(1.0, done_ / total_));
  }

 private:
  const Run& run_;
  std::mutex mutex_;
  double total_ = 0;
  double done_ = 0;
};

/// A source file read by bands: the rows that the current band needs, and those of the next while they are read.
class FileWindow {
 public:
  FileWindow(ValueRef value, ImageSource& source, const Run& run)
      : value_(value), info_(source.info()), reader_(source.rows(run)) {}

  ValueRef value() const { return value_; }
  /// Reads what is missing of the rows [low, high) for the next band; rows of the current band stay readable.
  void read_next(Span1 rows, const Run& run) {
    Window& next = windows_[1 - current_];
    const Window& now = windows_[current_];
    const int height = rows.high - rows.low;
    if (height <= 0) {
      next.rows = rows;
      return;
    }
    if (next.image.empty() || next.image.height() < height) {
      ImageInfo info = info_;
      info.height = height;
      next.image = Image();
      next.image = Image(info, run.limits);
    }
    const int kept_from = std::clamp(rows.low, now.rows.low, now.rows.high);
    const int kept_to = std::clamp(rows.high, kept_from, now.rows.high);
    if (kept_to > kept_from) {
      copy_pixels(now.image.any().crop({0, kept_from - now.rows.low, info_.width, kept_to - kept_from}),
                  next.image.any().crop({0, kept_from - rows.low, info_.width, kept_to - kept_from}));
    }
    const int fresh_from = kept_to > kept_from ? kept_to : rows.low;
    if (rows.high > fresh_from) {
      reader_->read(fresh_from, next.image.any().crop({0, fresh_from - rows.low, info_.width, rows.high - fresh_from}));
    }
    next.rows = rows;
  }
  void advance() { current_ = 1 - current_; }
  Available available() const {
    const Window& now = windows_[current_];
    if (now.rows.high <= now.rows.low) return {};
    const Rect rect{0, now.rows.low, info_.width, now.rows.high - now.rows.low};
    return {now.image.any().crop({0, 0, rect.width, rect.height}), rect};
  }

 private:
  struct Window {
    Image image;
    Span1 rows;
  };
  ValueRef value_;
  ImageInfo info_;
  std::unique_ptr<RowReader> reader_;
  std::array<Window, 2> windows_;
  std::size_t current_ = 0;
};

/// A target that is written by bands: the band being computed, and the one before while it is written.
struct SinkBands {
  std::size_t root;
  ImageSink* sink;
  std::array<Image, 2> bands;
};

class Executor {
 public:
  Executor(const Graph& graph, std::span<const Target> targets, const Run& run)
      : graph_(graph), targets_(targets), run_(run), plan_(make_plan(graph, targets, run)), progress_(plan_, run) {
    whole_.resize(plan_.resident.size());
    available_.resize(plan_.resident.size());
    analyses_.resize(graph.vertices().size());
    finished_.resize(graph.vertices().size());
    for (std::size_t v = 0; v < graph.vertices().size(); ++v) {
      const Graph::Vertex& vertex = graph.vertices()[v];
      const std::size_t count = vertex.node ? vertex.node->sources().size() + vertex.node->results().size() : 0;
      analyses_[v].resize(count);
      finished_[v].assign(count, nullptr);
      if (!vertex.node && vertex.pixels.data != nullptr) {
        available_[plan_.index({static_cast<int>(v), 0})] = {vertex.pixels, vertex.source_info.rect()};
      }
    }
  }

  void execute() {
    for (std::size_t g = 0; g < plan_.groups.size(); ++g) {
      run_group(plan_.groups[g]);
      if (run_.stages != nullptr) report_stages(plan_.groups[g]);
      release_after(g);
    }
    for (const Target& target : targets_) {
      if (target.sink != nullptr) target.sink->finish();
      if (target.analysed) target.analysed(finished_[static_cast<std::size_t>(target.value.vertex)]);
    }
  }

 private:
  const Graph::Vertex& vertex(int index) const { return graph_.vertices()[static_cast<std::size_t>(index)]; }

  /// A whole image for a resident value: in memory while there is room, else in a temporary file.
  Image whole_image(const ImageInfo& info) {
    const std::int64_t bytes = image_bytes(info);
    if (memory_used_ + bytes <= run_.limits.memory_bytes) {
      memory_used_ += bytes;
      return Image(info, run_.limits);
    }
    if (temporary_used_ + bytes > run_.limits.temporary_bytes) {
      throw Error(Error::Resource, fmt::format("{} more bytes of temporary file needed, the limit is {}", bytes,
                                               run_.limits.temporary_bytes));
    }
    temporary_used_ += bytes;
    return Image::in_temporary_file(info, run_.limits);
  }

  void run_group(const Group& group) {
    GroupJob job{graph_, plan_, group, run_.testing.reference, available_, {}, finished_};
    std::vector<SinkBands> sinks;
    for (std::size_t r = 0; r < group.roots.size(); ++r) {
      const Root& root = group.roots[r];
      const ImageInfo& info = graph_.info(root.value);
      for (const int t : root.targets) {
        const Target& target = targets_[static_cast<std::size_t>(t)];
        if (target.pixels.data != nullptr) job.destinations.push_back({r, target.pixels, info.rect()});
        if (target.sink != nullptr) sinks.push_back({r, target.sink, {}});
      }
      if (root.resident) {
        Image& image = whole_[plan_.index(root.value)] = whole_image(info);
        job.destinations.push_back({r, image.any(), info.rect()});
      }
    }
    std::vector<std::optional<TileWorker>> workers(static_cast<std::size_t>(thread_count(run_)));
    if (group.files.empty() && sinks.empty()) {
      run_band(job, workers, {0, 0, group.width, group.height}, 0, [](std::size_t) {});
    } else {
      run_bands(job, workers, sinks);
    }
    merge_analyses(group, workers);
    for (const Root& root : group.roots) {
      if (root.resident) {
        const std::size_t index = plan_.index(root.value);
        available_[index] = {whole_[index].any(), whole_[index].info().rect()};
      }
    }
  }

  /// Computes the tiles of a band on all threads, after `extra` other tasks.
  void run_band(const GroupJob& job, std::vector<std::optional<TileWorker>>& workers, const Rect& band,
                std::size_t extra, const std::function<void(std::size_t)>& other) {
    const Group& group = job.group;
    const int across = (band.width + group.tile_width - 1) / group.tile_width;
    const int down = (band.height + group.tile_height - 1) / group.tile_height;
    const std::size_t tiles = band.empty() ? 0 : static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
    parallel_tasks(extra + tiles, run_, [&](std::size_t task, int worker) {
      if (task < extra) return other(task);
      const auto index = static_cast<int>(task - extra);
      const int x = band.x + index % across * group.tile_width;
      const int y = band.y + index / across * group.tile_height;
      const Rect tile{x, y, std::min(group.tile_width, band.right() - x),
                      std::min(group.tile_height, band.bottom() - y)};
      auto& mine = workers[static_cast<std::size_t>(worker)];
      if (!mine) mine.emplace(job);
      mine->compute(tile);
      progress_.add(tile.area());
    });
  }

  /// Band by band: while one is computed, the rows of the next are read and those of the last are written.
  void run_bands(GroupJob& job, std::vector<std::optional<TileWorker>>& workers, std::vector<SinkBands>& sinks) {
    const Group& group = job.group;
    std::vector<FileWindow> files;
    for (const ValueRef file : group.files) files.emplace_back(file, *vertex(file.vertex).source, run_);
    for (SinkBands& each : sinks) {
      for (Image& band : each.bands) {
        ImageInfo info = graph_.info(group.roots[each.root].value);
        info.height = group.band_height;
        band = Image(info, run_.limits);
      }
    }
    const std::size_t fixed_destinations = job.destinations.size();
    const int bands = (group.height + group.band_height - 1) / group.band_height;
    const auto band_rect = [&](int index) {
      const int y = index * group.band_height;
      return Rect{0, y, group.width, std::min(group.band_height, group.height - y)};
    };

    std::vector<Rect> required;
    for (int step = -1; step <= bands; ++step) {
      // Step: read band step + 1, compute band step, write band step − 1.
      const auto current = static_cast<std::size_t>(step & 1);
      const bool reads = step + 1 < bands && !files.empty();
      const bool writes = step - 1 >= 0 && !sinks.empty();
      if (reads) propagate(graph_, plan_, group, band_rect(step + 1), required);
      job.destinations.resize(fixed_destinations);
      const Rect band = step >= 0 && step < bands ? band_rect(step) : Rect{};
      if (!band.empty()) {
        for (const FileWindow& file : files) job.available[plan_.index(file.value())] = file.available();
        for (SinkBands& each : sinks) {
          AnyView view = each.bands[current].any();
          job.destinations.push_back({each.root, view.crop({0, 0, band.width, band.height}), band});
        }
      }
      const std::size_t reading = reads ? files.size() : 0;
      run_band(job, workers, band, reading + (writes ? sinks.size() : 0), [&](std::size_t task) {
        if (task < reading) {
          const Rect& part = required[plan_.index(files[task].value())];
          files[task].read_next({part.y, part.bottom()}, run_);
        } else {
          SinkBands& each = sinks[task - reading];
          const Rect written = band_rect(step - 1);
          each.sink->write(std::as_const(each.bands[1 - current]).any().crop({0, 0, written.width, written.height}));
        }
      });
      if (reads) {
        for (FileWindow& file : files) file.advance();
      }
    }
    for (const FileWindow& file : files) job.available[plan_.index(file.value())] = {};
  }

  void merge_analyses(const Group& group, const std::vector<std::optional<TileWorker>>& workers) {
    std::size_t index = 0;
    for (const Root& root : group.roots) {
      for (const Root::Analysis& wanted : root.analyses) {
        auto& all = analyses_[static_cast<std::size_t>(wanted.vertex)][static_cast<std::size_t>(wanted.index)];
        all = make_analysis(*vertex(wanted.vertex).node, wanted.index);
        for (const auto& worker : workers) {
          if (worker) all->merge(*worker->partials()[index]);
        }
        all->finish();
        finished_[static_cast<std::size_t>(wanted.vertex)][static_cast<std::size_t>(wanted.index)] = all.get();
        ++index;
      }
    }
  }

  void report_stages(const Group& group) {
    for (const int v : group.nodes) {
      const Graph::Vertex& at = vertex(v);
      const StageReporter reporter(*run_.stages, at.label);
      at.node->report_stages(finished_[static_cast<std::size_t>(v)], reporter);
      for (std::size_t o = 0; o < at.result_names.size(); ++o) {
        const Image& image = whole_[plan_.index({v, static_cast<int>(o)})];
        if (!image.empty()) reporter.image(at.result_names[o], image);
      }
    }
  }

  /// Frees resident values that no later group reads.
  void release_after(std::size_t done) {
    for (std::size_t v = 0; v < graph_.vertices().size(); ++v) {
      for (int value = plan_.first_value[v]; value < plan_.first_value[v + 1]; ++value) {
        const auto index = static_cast<std::size_t>(value);
        if (whole_[index].empty() || read_later(static_cast<int>(v), done)) continue;
        whole_[index] = Image();
        available_[index] = {};
      }
    }
  }

  bool read_later(int source, std::size_t done) const {
    for (std::size_t g = done + 1; g < plan_.groups.size(); ++g) {
      for (const int v : plan_.groups[g].nodes) {
        for (const ValueRef read : vertex(v).sources) {
          if (read.vertex == source) return true;
        }
      }
      for (const Root& root : plan_.groups[g].roots) {
        if (root.value.vertex == source) return true;
      }
    }
    return false;
  }

  const Graph& graph_;
  std::span<const Target> targets_;
  const Run& run_;
  Plan plan_;
  Progress progress_;
  std::vector<Image> whole_;                                      ///< by value index
  std::vector<Available> available_;                              ///< by value index
  std::vector<std::vector<std::unique_ptr<Analysis>>> analyses_;  ///< by vertex, and Root::Analysis::index
  std::vector<std::vector<const Analysis*>> finished_;            ///< the same, once merged
  std::int64_t memory_used_ = 0;
  std::int64_t temporary_used_ = 0;
};

}  // namespace

void execute(const Graph& graph, std::span<const Target> targets, const Run& run) {
  check_cancelled(run);
  Executor(graph, targets, run).execute();
}

}  // namespace azulejo
