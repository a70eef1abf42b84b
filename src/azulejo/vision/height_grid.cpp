#include "azulejo/vision/height_grid.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/csv.h"

namespace azulejo {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

/// Weights of up to three channels from the first one on.
struct Weights {
  int first = 0;
  int count = 1;
  float weight[3] = {1, 0, 0};
};

Weights weights_of(const ImageInfo& info, HeightChannel channel) {
  const int colors = info.color_channels();
  if (channel == HeightChannel::Alpha) {
    if (info.alpha == AlphaState::None) {
      throw Error(Error::Argument, fmt::format("channel: alpha, expected one of the image's {}", info.channels));
    }
    return {info.channels - 1, 1, {1, 0, 0}};
  }
  if (colors < 3) return {};
  if (channel == HeightChannel::Luma) return {0, 3, {0.299F, 0.587F, 0.114F}};
  return {static_cast<int>(channel) - static_cast<int>(HeightChannel::Red), 1, {1, 0, 0}};
}

template <class T>
void take_row(const T* pixels, int channels, const Weights& weights, float scale, float* heights, int width) {
  for (int x = 0; x < width; ++x) {
    const T* const pixel = pixels + static_cast<std::ptrdiff_t>(x) * channels + weights.first;
    float sum = weights.weight[0] * static_cast<float>(pixel[0]);
    for (int k = 1; k < weights.count; ++k) sum += weights.weight[k] * static_cast<float>(pixel[k]);
    heights[x] = scale * sum;
  }
}

void check_memory(double samples, const HeightFieldOptions& options, const Run& run) {
  const double bytes = samples * (options.base ? 116 : 60);
  if (bytes > static_cast<double>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("height_field: {:.0f} samples need about {:.0f} bytes, the limit is {}",
                                             samples, bytes, run.limits.memory_bytes));
  }
}

}  // namespace

HeightGrid height_grid(const ConstAnyView& image, const HeightFieldOptions& options, const Run& run) {
  const Weights weights = weights_of(image.info, options.channel);
  HeightGrid grid;
  grid.columns = static_cast<std::size_t>(image.width());
  grid.rows = static_cast<std::size_t>(image.height());
  check_memory(static_cast<double>(grid.columns) * static_cast<double>(grid.rows), options, run);
  grid.heights.resize(grid.columns * grid.rows);
  const float scale = options.height / full_range(image.info.type);
  visit(image, [&](auto view) {
    parallel_for(grid.rows, kRowsAtOnce, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        take_row(view.row(static_cast<int>(y)), view.channels, weights, scale, grid.heights.data() + y * grid.columns,
                 view.width);
      }
    });
  });
  return grid;
}

HeightGrid height_grid(const std::string& csv_file, const HeightFieldOptions& options, const Run& run) {
  const CsvTable table = read_csv(csv_file, {}, run);
  HeightGrid grid;
  grid.columns = table.columns.size();
  grid.rows = table.rows;
  check_memory(static_cast<double>(grid.columns) * static_cast<double>(grid.rows), options, run);
  grid.heights.resize(grid.columns * grid.rows);
  for (std::size_t x = 0; x < grid.columns; ++x) {
    const CsvColumn& column = table.columns[x];
    if (column.is_text()) {
      throw Error(Error::Data, fmt::format("{}: column {} holds texts, expected numbers", csv_file, x + 1));
    }
    for (std::size_t y = 0; y < grid.rows; ++y) {
      grid.heights[y * grid.columns + x] = static_cast<float>(options.height * column.numbers[y]);
    }
  }
  return grid;
}

}  // namespace azulejo
