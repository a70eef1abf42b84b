#include "azulejo/imaging/histogram_chart.h"

#include <algorithm>
#include <string_view>

namespace azulejo {

Image bar_chart(const std::vector<double>& heights) {
  Image chart(ImageInfo{kChartWidth, kChartHeight});
  const auto view = chart.view<std::uint8_t>();
  const double highest = std::max(1e-300, *std::max_element(heights.begin(), heights.end()));
  for (int x = 0; x < kChartWidth; ++x) {
    const double share = heights[static_cast<std::size_t>(x)] / highest;
    const int bar = share > 0 ? std::max(1, static_cast<int>(share * kChartHeight + 0.5)) : 0;
    for (int y = 0; y < kChartHeight; ++y) view(x, y) = kChartHeight - y <= bar ? 40 : 255;
  }
  return chart;
}

void report_chart(const StageReporter& reporter, const std::string& name, const char* what,
                  const std::vector<double>& heights) {
  const bool is_count = std::string_view(what) == "counts";
  Json values = Json::array();
  for (const double height : heights) {
    values.push(is_count ? Json(static_cast<std::int64_t>(height)) : Json(height));
  }
  reporter.report(name, Json::object().set(what, values));
  reporter.image(name, bar_chart(heights));
}

}  // namespace azulejo
