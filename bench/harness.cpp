#include "harness.h"

#include <fmt/format.h>
#include <vips/vips.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"

namespace azulejo::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Seconds by the clock, or of this process's threads.
double now(bool processor_time) {
  if (!processor_time) return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<void (*)(Bench&)>& registered() {
  static std::vector<void (*)(Bench&)> list;
  return list;
}

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The peers' threads. Their pools are woken at once, so that no timed call pays for it.
void set_peer_threads(int threads) {
  vips_concurrency_set(threads);
  if (cv::getNumThreads() == threads) return;
  cv::setNumThreads(threads);
  for (int i = 0; i < 3; ++i) cv::parallel_for_(cv::Range(0, 16), [](const cv::Range&) {});
}

/// A function under the clock. Short calls are timed several at once.
class Timed {
 public:
  Timed(const Call& call, int threads, bool processor_time)
      : call_(call), threads_(threads), processor_time_(processor_time) {
    if (!call_) return;
    call_(threads_);
    const auto start = Clock::now();
    call_(threads_);
    constexpr double kShortest = 300e-6;  // a hundred times what reading the clock and a switch of the cache cost
    repeats_ = std::clamp(static_cast<int>(std::ceil(kShortest / std::max(since(start), 1e-9))), 1, 10000);
  }

  void sample() {
    if (!call_) return;
    const double start = now(processor_time_);
    for (int i = 0; i < repeats_; ++i) call_(threads_);
    seconds_.push_back((now(processor_time_) - start) / repeats_);
  }

  const std::vector<double>& seconds() const { return seconds_; }

 private:
  const Call& call_;
  int threads_;
  bool processor_time_;
  int repeats_ = 1;
  std::vector<double> seconds_;
};

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<double> ratios(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> result(std::min(above.size(), below.size()));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = above[i] / below[i];
  return result;
}

/// Ours, the peer and the limit with one number of threads.
struct Contest {
  int threads;
  Timed ours, peer, limit;

  Contest(const Row& row, int thread_count, bool processor_time)
      : threads(thread_count),
        ours((set_peer_threads(thread_count), row.ours), thread_count, processor_time),
        peer(row.peer, thread_count, processor_time),
        limit(row.limit, thread_count, processor_time) {}

  void round(bool backwards) {
    set_peer_threads(threads);
    if (backwards)
      limit.sample(), peer.sample(), ours.sample();
    else
      ours.sample(), peer.sample(), limit.sample();
  }

  Timing result(const Row& row) const {
    Timing timing;
    timing.threads = threads;
    timing.seconds = quantile(ours.seconds(), 0.5);
    timing.rate = row.work / timing.seconds * 1e-6;
    const std::vector<double> to_peer = ratios(peer.seconds(), ours.seconds());
    timing.ratio = quantile(to_peer, 0.5);
    timing.ratio_low = quantile(to_peer, 0.25);
    timing.ratio_high = quantile(to_peer, 0.75);
    if (row.peer) timing.ratio_best = quantile(peer.seconds(), 0) / quantile(ours.seconds(), 0);
    timing.of_limit = quantile(ratios(limit.seconds(), ours.seconds()), 0.5);
    timing.parity = row.limit_name == "copy" && timing.of_limit >= 1 / 1.5;
    const double asked = timing.parity ? std::min(row.aim, 0.9) : row.aim;
    const bool timely = row.aim_seconds <= 0 || threads != row.threads.back() || timing.seconds <= row.aim_seconds;
    timing.reached = timely && (!row.peer || timing.ratio >= asked);
    return timing;
  }
};

template <class T>
double largest_difference(const ImageView<const T>& a, const ImageView<const T>& b) {
  double largest = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int i = 0; i < a.width * a.channels; ++i) {
      const double difference = std::abs(static_cast<double>(a.row(y)[i]) - static_cast<double>(b.row(y)[i]));
      if (!(difference <= largest)) largest = std::isnan(difference) ? HUGE_VAL : difference;
    }
  }
  return largest;
}

template <class T>
void fill_photo_rows(const ImageView<T>& view) {
  // Waves of several lengths, as products of a table a column and a table a row; a pattern of edges; noise of ±2 %.
  std::vector<float> across(static_cast<std::size_t>(view.width) * 2);
  for (int x = 0; x < view.width; ++x) {
    across[static_cast<std::size_t>(x) * 2] = std::sin(static_cast<float>(x) * 0.013F);
    across[static_cast<std::size_t>(x) * 2 + 1] = std::cos(static_cast<float>(x) * 0.171F);
  }
  const auto top = static_cast<double>(full_range(kPixelTypeOf<T>));
  const double half = std::is_same_v<T, float> ? 0 : 0.5;
  parallel_for(static_cast<std::size_t>(view.height), 16, Run{}, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      const float slow = std::cos(static_cast<float>(y) * 0.017F);
      const float fast = std::sin(static_cast<float>(y) * 0.131F);
      std::uint32_t noise = static_cast<std::uint32_t>(y) * 2654435761U + 1U;
      for (int i = 0; i < view.width * view.channels; ++i) {
        const int x = i / view.channels;
        noise = noise * 1664525U + 1013904223U;
        const auto column = static_cast<std::size_t>(x) * 2;
        const float edge = (((x + y / 3) / 61 + y / 47) & 1) != 0 ? 0.15F : -0.15F;
        const float value = 0.5F + 0.22F * across[column] * slow + 0.09F * across[column + 1] * fast + edge +
                            0.02F * static_cast<float>(i % view.channels) +
                            0.02F * (static_cast<float>(noise >> 8) * 0x1p-23F - 1.0F);
        view.row(y)[i] = static_cast<T>(std::clamp(static_cast<double>(value), 0.0, 1.0) * top + half);
      }
    }
  });
}

/// The same memory with no space between the rows.
AnyView packed(const AnyView& view) {
  return {view.data, static_cast<std::ptrdiff_t>(view.info.row_bytes()), view.info};
}

/// A line of /proc/self/status, in bytes.
std::int64_t status_bytes(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(name + ":")) return std::stoll(line.substr(name.size() + 1)) * 1024;
  }
  return 0;
}

/// `peak_memory` in a process of its own.
std::int64_t child_memory(const std::string& name, const char* who) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  const std::string command = fmt::format("'{}' --memory-of '{}' --who {}", self, name, who);
  FILE* const pipe = popen(command.c_str(), "r");
  long long bytes = -1;
  const bool read = pipe != nullptr && std::fscanf(pipe, "%lld", &bytes) == 1;
  if (pipe == nullptr || pclose(pipe) != 0 || !read) throw Error(Error::Resource, command + ": failed");
  return bytes;
}

/// Images that live as long as the row's calls.
struct Pictures {
  std::shared_ptr<Image> source, ours, peer;
};

}  // namespace

Rows::Rows(void (*add)(Bench&)) { registered().push_back(add); }

Bench all_rows() {
  Bench bench;
  for (const auto add : registered()) add(bench);
  return bench;
}

void Bench::row(std::string name, std::function<Row()> make) { entries_.push_back({std::move(name), std::move(make)}); }

void Bench::image_row(ImageRow what) {
  std::string name = what.name + ", " + kind(what.source);
  row(std::move(name), [what = std::move(what)] {
    const ImageInfo info = what.result.width > 0 ? what.result : what.source;
    const Pictures pictures{std::make_shared<Image>(what.source), make_result(info), make_result(info)};
    const auto view = [&](Image& image) { return what.packed ? packed(image.any()) : image.any(); };
    const AnyView source = view(*pictures.source);
    const AnyView ours = view(*pictures.ours);
    const AnyView peer = view(*pictures.peer);
    what.fill ? what.fill(source) : fill_photo(source);

    Row result;
    const ImageInfo& larger = info.rect().area() > what.source.rect().area() ? info : what.source;
    result.work = static_cast<double>(larger.rect().area());
    result.ours = [pictures, source, ours, call = what.ours](int threads) {
      call(source, ours, Run{.threads = threads});
    };
    result.peer_name = what.peer_name;
    if (what.peer) {
      result.peer = [pictures, source, peer, call = what.peer](int) { call(source, peer); };
      result.check = [pictures, ours, peer, what] { return compare(ours, peer, what.tolerance, what.margin); };
    }
    const auto bytes = [](const ImageInfo& each) { return each.row_bytes() * static_cast<std::size_t>(each.height); };
    result.limit = copy_limit(bytes(what.source), bytes(info));
    result.aim = what.aim;
    result.aim_seconds = what.aim_seconds;
    return result;
  });
}

ImageInfo photo(PixelType type, int channels, Size size) {
  return {size.width, size.height,      channels,
          type,       ColorState::Srgb, channels % 2 == 0 ? AlphaState::Straight : AlphaState::None};
}

std::string kind(const ImageInfo& info) {
  static constexpr const char* kChannels[] = {"gray", "gray+alpha", "RGB", "RGBA"};
  return fmt::format("{} {} {}×{}", to_string(info.type), kChannels[info.channels - 1], info.width, info.height);
}

void fill_photo(const AnyView& pixels) {
  visit(pixels, [](const auto& view) { fill_photo_rows(view); });
}

std::shared_ptr<Image> make_photo(const ImageInfo& info) {
  auto image = std::make_shared<Image>(info);
  fill_photo(image->any());
  return image;
}

std::shared_ptr<Image> make_result(const ImageInfo& info) {
  auto image = std::make_shared<Image>(info);
  std::memset(image->any().data, 0, static_cast<std::size_t>(image->bytes()));
  return image;
}

cv::Mat mat(const ConstAnyView& view) {
  const int depth = view.info.type == PixelType::U8 ? CV_8U : view.info.type == PixelType::U16 ? CV_16U : CV_32F;
  return {view.height(), view.width(), CV_MAKETYPE(depth, view.info.channels), const_cast<std::byte*>(view.data),
          static_cast<std::size_t>(view.stride)};
}

Check compare(const ConstAnyView& ours, const ConstAnyView& peer, double tolerance, int margin) {
  if (!(ours.info.rect() == peer.info.rect()) || ours.info.channels != peer.info.channels ||
      ours.info.type != peer.info.type) {
    return {false, "ours is " + describe(ours.info) + ", the peer's " + describe(peer.info)};
  }
  const Rect part{margin, margin, ours.width() - 2 * margin, ours.height() - 2 * margin};
  const double difference = visit(ours.crop(part), [&](const auto& view) {
    using T = std::remove_cv_t<std::remove_pointer_t<decltype(view.data)>>;
    return largest_difference<T>(view, peer.crop(part).as<T>());
  });
  return {difference <= tolerance, fmt::format("{:.3g}", difference)};
}

Call copy_limit(std::size_t read, std::size_t written) {
  const std::size_t bytes = (read + written) / 2;
  const auto from = make_result({static_cast<int>((bytes + 4095) / 4096), 1024, 4});
  const auto to = make_result(from->info());
  return [from, to, bytes](int threads) {
    constexpr std::size_t kChunk = std::size_t{1} << 18;
    const std::byte* source = from->any().data;
    std::byte* result = to->any().data;
    parallel_for(bytes, kChunk, Run{.threads = threads},
                 [&](std::size_t begin, std::size_t end) { std::memcpy(result + begin, source + begin, end - begin); });
  };
}

std::int64_t peak_memory(const Row& row, bool of_peer) {
  const int threads = row.threads.back();
  set_peer_threads(threads);
  if (!(std::ofstream("/proc/self/clear_refs") << "5")) throw Error(Error::Io, "/proc/self/clear_refs: not writable");
  const std::int64_t before = status_bytes("VmRSS");
  (of_peer ? row.peer : row.ours)(threads);
  return std::max<std::int64_t>(status_bytes("VmHWM") - before, 0);
}

Measured measure(const std::string& name, const Row& row, const Measuring& measuring) {
  Measured result{name, row.unit,      row.peer ? row.peer_name : "", row.aim, row.aim_seconds, {}, {}, 0, 0,
                  0,    row.aim_memory};
  std::vector<Contest> contests;
  contests.reserve(row.threads.size());
  for (const int threads : row.threads) {
    contests.emplace_back(row, threads, measuring.processor_time);
    if (row.check && result.check.right) result.check = row.check();
  }

  if (row.memory) {
    result.memory_ours = child_memory(name, "ours");
    result.memory_peer = child_memory(name, "peer");
  }

  const std::size_t enough_rounds = measuring.quick ? 5 : 15;
  const double enough_seconds = measuring.quick ? 0.05 : 0.3;
  const double all_seconds = measuring.quick ? 0.5 : 6;
  const auto start = Clock::now();
  for (std::size_t round = 0; round < 3 || since(start) < all_seconds; ++round) {
    const std::vector<double>& last = contests.back().ours.seconds();
    const double spent = std::accumulate(last.begin(), last.end(), 0.0);
    if (round >= enough_rounds && (spent >= enough_seconds || round >= 20 * enough_rounds)) break;
    for (Contest& contest : contests) contest.round(round % 2 == 1);
  }
  for (const Contest& contest : contests) result.timings.push_back(contest.result(row));
  if (contests.size() > 1) {
    result.gain = quantile(ratios(contests.front().ours.seconds(), contests.back().ours.seconds()), 0.5);
  }
  return result;
}

}  // namespace azulejo::bench
