// Every operation with any options on small images of any kind. The first bytes choose the image, the rest is the
// text of stages, separated by spaces: they give a result or an Error.
#include <cstddef>
#include <cstdint>
#include <string>

#include "azulejo/core/error.h"
#include "azulejo/pipeline.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace azulejo;
  if (size < 4) return 0;
  const int channels = 1 + data[0] % 4;
  const ImageInfo info{1 + data[1] % 40,
                       1 + data[2] % 40,
                       channels,
                       static_cast<PixelType>(data[3] % 3),
                       static_cast<ColorState>(data[3] / 3 % 3),
                       channels % 2 == 0 ? static_cast<AlphaState>(data[3] / 9 % 3) : AlphaState::None};
  Image image(info);
  for (int y = 0; y < info.height; ++y) {
    for (std::size_t i = 0; i < info.row_bytes(); ++i) {
      image.any().row(y)[i] = static_cast<std::byte>(data[(i + static_cast<std::size_t>(y) * 7) % size]);
    }
  }
  Run run;
  run.threads = 1;
  run.limits.pixels = 1 << 16;
  run.limits.memory_bytes = 1 << 24;
  try {
    Pipeline pipeline(run);
    pipeline.add_value(Value(std::move(image)), "fuzz");
    pipeline.add_stage("as:start");
    const std::string text(reinterpret_cast<const char*>(data) + 4, size - 4);
    std::size_t begin = 0;
    for (int stages = 0; stages < 4 && begin < text.size(); ++stages) {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      const std::string stage = text.substr(begin, end - begin);
      // Arguments may name files: only named values are wanted here.
      if (stage.find("=/") == std::string::npos && stage.find("=.") == std::string::npos) pipeline.add_stage(stage);
      begin = end + 1;
    }
    pipeline.explain();
    pipeline.compute();
  } catch (const Error&) {
    // What a caller gets who asks for the impossible.
  }
  return 0;
}
