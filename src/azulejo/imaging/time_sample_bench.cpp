#include "azulejo/imaging/time_sample.h"

#include <array>
#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The mean of two frames; the second is the source itself.
void add(Bench& bench, PixelType type) {
  bench.image_row(
      {.name = "time_sample of two, light=encoded",
       .source = photo(type, 3, kFullHd),
       .ours =
           [](const ConstAnyView& source, const AnyView& result, const Run& run) {
             const std::array frames{source, source};
             time_sample(frames, result, {.light = Light::Encoded}, run);
           },
       .peer = [](const ConstAnyView& source,
                  const AnyView& result) { cv::addWeighted(mat(source), 0.5, mat(source), 0.5, 0, mat(result)); },
       .tolerance = type == PixelType::F32 ? 1e-6 : 1,
       .aim = 1});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8);
  add(bench, PixelType::F32);
});

}  // namespace
}  // namespace azulejo::bench
