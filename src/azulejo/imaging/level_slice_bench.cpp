#include "azulejo/imaging/level_slice.h"

#include "azulejo/imaging/tone_bench.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, const ImageInfo& source) {
  bench.image_row(
      {.name = "level_slice",
       .source = source,
       .ours = [](const ConstAnyView& from, const AnyView& to, const Run& run) { level_slice(from, to, {}, run); },
       .peer = table_peer([](const Image& every) { return level_slice(every); })});
}

const Rows kRows([](Bench& bench) {
  add(bench, photo(PixelType::U8, 1, kFullHd));
  add(bench, photo(PixelType::U8, 1, k24Megapixels));
});

}  // namespace
}  // namespace azulejo::bench
