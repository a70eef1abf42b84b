#include "azulejo/imaging/blend.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// An amount that no peer has a short cut for.
constexpr float kAmount = 0.3F;

void add(Bench& bench, PixelType type, int channels, Size size, double tolerance) {
  const ImageInfo info = photo(type, channels, size);
  bench.row("blend amount=0.3, " + kind(info), [info, tolerance] {
    const auto source = make_photo(info);
    const auto other = make_photo(info);
    // The other way up.
    for (int y = 0; y < info.height; ++y) {
      std::copy_n(source->any().row(info.height - 1 - y), info.row_bytes(), other->any().row(y));
    }
    const auto ours = make_result(info);
    const auto peer = make_result(info);
    Row row;
    row.work = static_cast<double>(info.rect().area());
    row.ours = [=](int threads) {
      blend(source->any(), other->any(), ours->any(), {.amount = kAmount}, Run{.threads = threads});
    };
    row.peer = [=](int) {
      const auto share = static_cast<double>(kAmount);
      cv::addWeighted(mat(source->any()), 1 - share, mat(other->any()), share, 0, mat(peer->any()));
    };
    row.check = [=] { return compare(ours->any(), peer->any(), tolerance); };
    const std::size_t bytes = info.row_bytes() * static_cast<std::size_t>(info.height);
    row.limit = copy_limit(2 * bytes, bytes);
    row.aim = 1.5;
    return row;
  });
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd, 1);  // halves are rounded up here, to even there
  add(bench, PixelType::U8, 3, k24Megapixels, 1);
  add(bench, PixelType::U16, 1, kFullHd, 1);
  add(bench, PixelType::F32, 1, kFullHd, 1e-6);
});

}  // namespace
}  // namespace azulejo::bench
