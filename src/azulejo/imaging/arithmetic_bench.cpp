#include <opencv2/core.hpp>

#include "azulejo/imaging/add.h"
#include "azulejo/imaging/difference.h"
#include "azulejo/imaging/divide.h"
#include "azulejo/imaging/multiply.h"
#include "azulejo/imaging/subtract.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

using Ours = std::function<void(const ConstAnyView& a, const ConstAnyView& b, const AnyView& result, const Run& run)>;
using Peer = std::function<void(const cv::Mat& a, const cv::Mat& b, cv::Mat result)>;

struct Contest {
  std::string name;
  bool real = false;  ///< gives f32
  Ours ours;
  Peer peer;
  double tolerance = 0;
};

void row(Bench& bench, const ImageInfo& info, const Contest& contest) {
  bench.row(contest.name + ", " + kind(info), [info, contest] {
    const auto source = make_photo(info);
    const auto other = make_photo(info);
    // The other way up, and nowhere 0: peers differ in what they make of quotients by 0.
    visit(other->any(), [&](auto view) {
      using T = std::remove_pointer_t<decltype(view.data)>;
      const T least = std::is_same_v<T, float> ? static_cast<T>(0.01F) : T{1};
      for (int y = 0; y < info.height; ++y) {
        const T* const from = source->view<T>().row(info.height - 1 - y);
        std::transform(from, from + info.width * info.channels, view.row(y), [&](T v) { return std::max(v, least); });
      }
    });
    ImageInfo result = info;
    if (contest.real) result.type = PixelType::F32;
    if (contest.real) result.color = ColorState::Data;
    const auto ours = make_result(result);
    const auto peer = make_result(result);
    Row each;
    each.work = static_cast<double>(info.rect().area());
    each.ours = [=](int threads) { contest.ours(source->any(), other->any(), ours->any(), Run{.threads = threads}); };
    each.peer = [=](int) { contest.peer(mat(source->any()), mat(other->any()), mat(peer->any())); };
    each.check = [=] { return compare(ours->any(), peer->any(), contest.tolerance); };
    const auto rows = static_cast<std::size_t>(info.height);
    each.limit = copy_limit(2 * info.row_bytes() * rows, result.row_bytes() * rows);
    each.aim = 0.9;
    return each;
  });
}

void rows(Bench& bench, const ImageInfo& info) {
  const double top = static_cast<double>(full_range(info.type));
  const bool whole = info.type != PixelType::F32;
  row(bench, info,
      {.name = "add",
       .ours = [](const auto& a, const auto& b, const auto& to, const Run& run) { add(a, b, to, {}, run); },
       .peer = [](const cv::Mat& a, const cv::Mat& b, cv::Mat to) { cv::add(a, b, to); }});
  row(bench, info,
      {.name = "subtract",
       .real = true,
       .ours = [](const auto& a, const auto& b, const auto& to, const Run& run) { subtract(a, b, to, {}, run); },
       .peer =
           [top, whole](const cv::Mat& a, const cv::Mat& b, cv::Mat to) {
             if (whole) return cv::addWeighted(a, 1 / top, b, -1 / top, 0, to, CV_32F);
             cv::subtract(a, b, to);
           },
       .tolerance = 1e-6});
  row(bench, info,
      {.name = "difference",
       .ours = [](const auto& a, const auto& b, const auto& to, const Run& run) { difference(a, b, to, {}, run); },
       .peer = [](const cv::Mat& a, const cv::Mat& b, cv::Mat to) { cv::absdiff(a, b, to); }});
  row(bench, info,
      {.name = "multiply",
       .ours = [](const auto& a, const auto& b, const auto& to, const Run& run) { multiply(a, b, to, {}, run); },
       .peer = [top](const cv::Mat& a, const cv::Mat& b, cv::Mat to) { cv::multiply(a, b, to, 1 / top); },
       .tolerance = whole ? 1 : 1e-6});
  row(bench, info,
      {.name = "divide",
       .real = true,
       .ours = [](const auto& a, const auto& b, const auto& to, const Run& run) { divide(a, b, to, {}, run); },
       .peer = [](const cv::Mat& a, const cv::Mat& b, cv::Mat to) { cv::divide(a, b, to, 1, CV_32F); },
       .tolerance = 1e-4});
}

const Rows kRows([](Bench& bench) {
  rows(bench, photo(PixelType::U8, 1, kFullHd));
  rows(bench, photo(PixelType::U8, 1, k24Megapixels));
  rows(bench, photo(PixelType::U16, 1, kFullHd));
  rows(bench, photo(PixelType::F32, 1, kFullHd));
});

}  // namespace
}  // namespace azulejo::bench
