#include "azulejo/charting/palette.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace azulejo {
namespace {

constexpr std::array<std::uint32_t, 8> kOkabeIto{0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7,
                                                 0xE69F00, 0x56B4E9, 0x000000, 0xF0E442};
constexpr std::array<std::uint32_t, 7> kTol{0x4477AA, 0xEE6677, 0x228833, 0xCCBB44, 0x66CCEE, 0xAA3377, 0xBBBBBB};
constexpr std::array<std::uint32_t, 5> kGray{0x202020, 0x808080, 0xB8B8B8, 0x505050, 0xD8D8D8};

std::span<const std::uint32_t> colors_of(ChartPalette palette) {
  switch (palette) {
    case ChartPalette::OkabeIto: return kOkabeIto;
    case ChartPalette::Tol: return kTol;
    case ChartPalette::Gray: return kGray;
  }
  return kOkabeIto;
}

}  // namespace

glm::vec4 series_color(ChartPalette palette, std::size_t series) {
  const std::span<const std::uint32_t> colors = colors_of(palette);
  const std::uint32_t color = colors[series % colors.size()];
  const auto channel = [&](int shift) { return static_cast<float>(color >> shift & 255) / 255.0F; };
  return {channel(16), channel(8), channel(0), 1};
}

std::vector<glm::vec4> map_colors(ColorMap map, int count) {
  Image ramp(count, 1, 1, PixelType::F32);
  for (int i = 0; i < count; ++i) {
    ramp.view<float>()(i, 0) = count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 0.0F;
  }
  const Image colors = pseudo_color(ramp, {.map = map}, {.threads = 1});
  std::vector<glm::vec4> list;
  for (int i = 0; i < count; ++i) {
    const float* const pixel = &colors.view<float>()(i, 0);
    list.emplace_back(std::clamp(pixel[0], 0.0F, 1.0F), std::clamp(pixel[1], 0.0F, 1.0F),
                      std::clamp(pixel[2], 0.0F, 1.0F), 1.0F);
  }
  return list;
}

std::size_t color_index(double value, double low, double high, std::size_t colors) {
  if (std::isnan(value)) return colors;
  const double share = high > low ? (value - low) / (high - low) : 0;
  return static_cast<std::size_t>(
      std::clamp(share * static_cast<double>(colors), 0.0, static_cast<double>(colors - 1)));
}

}  // namespace azulejo
