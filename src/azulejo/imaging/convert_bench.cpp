#include "azulejo/imaging/convert.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType from, PixelType to, int channels, Size size) {
  const double scale = static_cast<double>(full_range(to)) / static_cast<double>(full_range(from));
  bench.image_row({.name = std::string("convert ") + to_string(to),
                   .source = photo(from, channels, size),
                   .result = photo(to, channels, size),
                   .ours = [to](const ConstAnyView& source, const AnyView& result,
                                const Run& run) { convert(source, result, {.type = to}, run); },
                   .peer =
                       [scale](const ConstAnyView& source, const AnyView& result) {
                         const cv::Mat converted = mat(result);
                         mat(source).convertTo(converted, converted.type(), scale);
                       },
                   .tolerance = to == PixelType::F32 ? 1e-6 : 1,
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  constexpr PixelType kTypes[] = {PixelType::U8, PixelType::U16, PixelType::F32};
  for (const PixelType from : kTypes) {
    for (const PixelType to : kTypes) {
      if (from != to) add(bench, from, to, 1, kFullHd);
    }
  }
  add(bench, PixelType::U16, PixelType::U8, 1, k24Megapixels);
  add(bench, PixelType::U8, PixelType::F32, 3, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
