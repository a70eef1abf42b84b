#pragma once

#include <string>
#include <vector>

#include "azulejo/data/image.h"
#include "azulejo/engine/stages.h"

namespace azulejo {

inline constexpr int kChartWidth = 256;
inline constexpr int kChartHeight = 100;

/// Dark bars on white, the largest as high as the chart; a bar of something is a pixel high at least.
///
/// heights  kChartWidth of them, not negative
Image bar_chart(const std::vector<double>& heights);

/// Reports heights as a chart and as numbers, which are whole where they are `what` "counts".
void report_chart(const StageReporter& reporter, const std::string& name, const char* what,
                  const std::vector<double>& heights);

}  // namespace azulejo
