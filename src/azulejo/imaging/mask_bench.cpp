#include "azulejo/imaging/mask.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, int channels, Size size) {
  const ImageInfo info = photo(PixelType::U8, channels, size);
  const ImageInfo gray = photo(PixelType::U8, 1, size);
  bench.row("mask, " + kind(info), [info, gray] {
    const auto source = make_photo(info);
    const auto marks = make_photo(gray);
    for (int y = 0; y < gray.height; ++y) {
      std::uint8_t* const row = marks->view<std::uint8_t>().row(y);
      std::transform(row, row + gray.width, row, [](std::uint8_t v) { return v > 127 ? 255 : 0; });
    }
    const auto ours = make_result(info);
    const auto peer = make_result(info);
    Row row;
    row.work = static_cast<double>(info.rect().area());
    row.ours = [=](int threads) {
      mask(source->any(), std::as_const(*marks).any(), ours->any(), {}, Run{.threads = threads});
    };
    row.peer = [=](int) {
      cv::Mat to = mat(peer->any());
      to.setTo(0);
      mat(source->any()).copyTo(to, mat(marks->any()));
    };
    row.check = [=] { return compare(ours->any(), peer->any(), 0); };
    const auto rows = static_cast<std::size_t>(info.height);
    row.limit = copy_limit((info.row_bytes() + gray.row_bytes()) * rows, info.row_bytes() * rows);
    row.aim = 0.9;
    return row;
  });
}

const Rows kRows([](Bench& bench) {
  add(bench, 1, kFullHd);
  add(bench, 3, kFullHd);
  add(bench, 1, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
