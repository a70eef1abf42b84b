#include <cstring>
#include <memory>
#include <vector>

#include "azulejo/vision/height_field.h"
#include "harness.h"

namespace azulejo::bench {
namespace {

/// As many bytes as the mesh has, written.
const Rows kRows([](Bench& bench) {
  for (const bool based : {false, true}) {
    bench.row(based ? "height_field with a base, 4 Mpix" : "height_field, 4 Mpix", [based] {
      const std::shared_ptr<Image> source = make_photo(photo(PixelType::U8, 1, {2048, 2048}));
      HeightFieldOptions options;
      if (based) options.base = -1.0F;
      const double pixels = 2048.0 * 2048;
      const auto bytes = static_cast<std::size_t>(pixels * (based ? 2 : 1) * (32 + 24));
      auto memory = std::make_shared<std::vector<char>>(bytes);
      Row row;
      row.work = pixels;
      row.ours = [source, options](int threads) { height_field(source->any(), options, {.threads = threads}); };
      row.limit_name = "write";
      row.limit = [memory](int) { std::memset(memory->data(), 1, memory->size()); };
      return row;
    });
  }
});

}  // namespace
}  // namespace azulejo::bench
