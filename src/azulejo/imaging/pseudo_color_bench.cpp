#include "azulejo/imaging/pseudo_color.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, Size size) {
  ImageRow row{.name = "pseudo_color turbo",
               .source = photo(type, 1, size),
               .result = photo(type, 3, size),
               .ours = [](const ConstAnyView& source, const AnyView& result,
                          const Run& run) { pseudo_color(source, result, {.map = ColorMap::Turbo}, run); },
               .aim = 2.5};
  if (type == PixelType::U8) {
    // Ours as a table, so that the peer needn't turn its blue, green and red around.
    const auto table = std::make_shared<Image>(256, 1, 3);
    Image values(256, 1, 1);
    for (int v = 0; v < 256; ++v) values.view<std::uint8_t>()(v, 0) = static_cast<std::uint8_t>(v);
    pseudo_color(values.any(), table->any(), {.map = ColorMap::Turbo});
    row.peer = [table](const ConstAnyView& source, const AnyView& result) {
      const cv::Mat colors = mat(result);
      cv::applyColorMap(mat(source), colors, mat(table->any()).clone().reshape(3, 256));
    };
  }
  bench.image_row(row);
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, kFullHd);
  add(bench, PixelType::U8, k24Megapixels);
  add(bench, PixelType::F32, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
