#include "azulejo/charting/chart.h"

#include <memory>
#include <random>

#include <fmt/format.h>

#include "azulejo/charting/iso_lines.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

Row scatter(std::size_t points) {
  const auto table = std::make_shared<CsvTable>();
  table->rows = points;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const char* name : {"x", "y"}) {
    CsvColumn& column = table->columns.emplace_back();
    column.name = name;
    for (std::size_t i = 0; i < points; ++i) column.numbers.push_back(normal(random));
  }
  const auto drawn = std::make_shared<std::size_t>(0);
  Row row;
  row.work = static_cast<double>(points);
  row.unit = "Mpoints/s";
  row.threads = {1};
  row.ours = [table, drawn](int) { *drawn = chart(*table, {.kind = ChartKind::Scatter, .x = "x"}).points.size(); };
  row.limit = copy_limit(16 * points, 8 * points);
  row.check = [drawn, points]() -> Check { return {*drawn >= points, fmt::format("{} points", *drawn)}; };
  row.aim_seconds = 0.1;
  return row;
}

Row contours(Size size) {
  const auto image = make_photo({size.width, size.height, 1, PixelType::F32});
  const auto found = std::make_shared<std::size_t>(0);
  Row row;
  row.work = static_cast<double>(size.width) * size.height;
  row.threads = {1};
  row.ours = [image, found](int) { *found = iso_lines(image->view<float>(), 0.5F).points.size(); };
  row.limit = copy_limit(4 * static_cast<std::size_t>(row.work), static_cast<std::size_t>(row.work));
  row.check = [found]() -> Check { return {*found > 0, fmt::format("{} points", *found)}; };
  row.aim_seconds = 0.2;
  return row;
}

const Rows kRows([](Bench& bench) {
  bench.row("chart kind=scatter, 1000000 points", [] { return scatter(1000000); });
  bench.row("iso_lines, f32 gray 2400×1700", [] { return contours({2400, 1700}); });
});

}  // namespace
}  // namespace azulejo::bench
