#include "azulejo/imaging/exposure.h"

#include "azulejo/imaging/tone_bench.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, const ImageInfo& source) {
  bench.image_row({.name = "exposure stops=1",
                   .source = source,
                   .ours = [](const ConstAnyView& from, const AnyView& to,
                              const Run& run) { exposure(from, to, {.stops = 1.0F}, run); },
                   .peer = table_peer([](const Image& every) { return exposure(every, {.stops = 1.0F}); })});
}

const Rows kRows([](Bench& bench) {
  add(bench, photo(PixelType::U8, 1, kFullHd));
  add(bench, photo(PixelType::U8, 3, k24Megapixels));
});

}  // namespace
}  // namespace azulejo::bench
