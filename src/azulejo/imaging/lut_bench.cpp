#include "azulejo/imaging/lut.h"

#include "azulejo/imaging/tone_bench.h"

namespace azulejo::bench {
namespace {

const LutOptions kOptions{.curve = {4, 2, {0, 0, 0.3F, 0.15F, 0.7F, 0.85F, 1, 1}}};

void add(Bench& bench, const ImageInfo& source) {
  bench.image_row(
      {.name = "lut",
       .source = source,
       .ours = [](const ConstAnyView& from, const AnyView& to, const Run& run) { lut(from, to, kOptions, run); },
       .peer = table_peer([](const Image& every) { return lut(every, kOptions); })});
}

const Rows kRows([](Bench& bench) {
  add(bench, photo(PixelType::U8, 1, kFullHd));
  add(bench, photo(PixelType::U8, 1, k24Megapixels));
  add(bench, photo(PixelType::U8, 3, kFullHd));
});

}  // namespace
}  // namespace azulejo::bench
