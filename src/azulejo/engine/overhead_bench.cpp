// What a call costs before and after the pixels: an operation that does next to nothing on a small image.
#include "azulejo/imaging/threshold.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  bench.image_row({.name = "overhead of a call (threshold)",
                   .source = photo(PixelType::U8, 1, {64, 64}),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { threshold(source, result, {}, run); },
                   .aim = 0,
                   .aim_seconds = 5e-6});
});

}  // namespace
}  // namespace azulejo::bench
