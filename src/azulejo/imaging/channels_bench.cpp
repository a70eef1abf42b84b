#include "azulejo/imaging/channels.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, const std::string& name, PixelType type, Size size, int from, int to,
         const ChannelsOptions& take, const ImageCall& peer) {
  bench.image_row({.name = "channels " + name,
                   .source = photo(type, from, size),
                   .result = photo(type, to, size),
                   .ours = [take](const ConstAnyView& source, const AnyView& result,
                                  const Run& run) { channels(std::span(&source, 1), result, take, run); },
                   .peer = peer,
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  const ImageCall extract = [](const ConstAnyView& source, const AnyView& result) {
    cv::Mat green = mat(result);
    cv::extractChannel(mat(source), green, 1);
  };
  const ImageCall swap = [](const ConstAnyView& source, const AnyView& result) {
    cv::cvtColor(mat(source), mat(result), cv::COLOR_RGB2BGR);
  };
  const ImageCall add_alpha = [](const ConstAnyView& source, const AnyView& result) {
    cv::cvtColor(mat(source), mat(result), cv::COLOR_RGB2RGBA);
  };
  for (const PixelType type : {PixelType::U8, PixelType::F32}) {
    add(bench, "g", type, kFullHd, 3, 1, {.take = {"g"}}, extract);
    add(bench, "b,g,r", type, kFullHd, 3, 3, {.take = {"b", "g", "r"}}, swap);
    add(bench, "r,g,b,one", type, kFullHd, 3, 4, {.take = {"r", "g", "b", "one"}, .alpha = true}, add_alpha);
  }
  add(bench, "b,g,r", PixelType::U8, k24Megapixels, 3, 3, {.take = {"b", "g", "r"}}, swap);
});

}  // namespace
}  // namespace azulejo::bench
