#include "azulejo/imaging/clahe_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "azulejo/imaging/grayscale_kernels.h"
#include "azulejo/imaging/histogram_counts.h"

namespace azulejo {

ClaheAxis::ClaheAxis(int size, int wanted) {
  const int count = std::min(size, wanted);
  for (int i = 0; i <= count; ++i) begins.push_back(static_cast<int>(std::int64_t{i} * size / count));
  // Twice the centers are whole numbers.
  const auto center = [&](int tile) {
    return begins[static_cast<std::size_t>(tile)] + begins[static_cast<std::size_t>(tile) + 1];
  };
  weights.assign(static_cast<std::size_t>(size), 0);
  int x = 0;
  for (int high = 0; high <= count; ++high) {
    // Pixels whose centers are before the center of `high`; those at it belong to the next stretch.
    const int end = high == count ? size : std::max(x, center(high) / 2);
    const int low = std::max(0, high - 1);
    const Stretch stretch{x, end, low, std::min(high, count - 1)};
    if (end > x) stretches.push_back(stretch);
    for (; x < end; ++x) {
      if (stretch.low == stretch.high) continue;
      const std::int64_t length = center(high) - center(low);
      const std::int64_t along = 2 * x + 1 - center(low);
      const std::int64_t weight = (2 * along * kernels::kClaheUnit + length) / (2 * length);
      weights[static_cast<std::size_t>(x)] = static_cast<std::int16_t>(std::min<std::int64_t>(weight, 32767));
    }
  }
}

ClaheLayout::ClaheLayout(const ImageInfo& source, const ClaheOptions& options)
    : info(source),
      luma(!options.per_channel && source.color_channels() == 3),
      direct(source.channels == 1),
      planes(luma ? 1 : source.color_channels()),
      clip(options.clip),
      across(source.width, options.columns),
      down(source.height, options.rows) {}

namespace {

/// One row of a plane, value by value.
template <class T>
void plane_row(const ClaheLayout& layout, const T* pixel, int pixels, int plane, T* result) {
  const int colors = layout.info.color_channels();
  const auto straight = [&](int c) {
    if (layout.info.alpha != AlphaState::Premultiplied) return pixel[c];
    return pixel[colors] == T{0} ? T{0} : divided(pixel[c], pixel[colors]);
  };
  for (int x = 0; x < pixels; ++x, pixel += layout.info.channels) {
    if (!layout.luma) {
      result[x] = straight(plane);
    } else if constexpr (std::is_same_v<T, float>) {
      result[x] = 0.299F * straight(0) + 0.587F * straight(1) + 0.114F * straight(2);
    } else {
      result[x] = static_cast<T>((299U * straight(0) + 587U * straight(1) + 114U * straight(2) + 500U) / 1000U);
    }
  }
}

/// Adds the values of part of a tile to its histogram.
template <class T>
void count_part(const ImageView<const T>& plane, const ConstAnyView& pixels, std::uint64_t* counts) {
  const bool has_alpha = pixels.info.alpha != AlphaState::None;
  if constexpr (sizeof(T) == 1) {
    if (!has_alpha) return count_bytes(plane, false, counts);
  }
  std::array<std::uint64_t, kernels::ClaheMapping<T>::kBins> odd{};
  const int channels = pixels.info.channels;
  for (int y = 0; y < plane.height; ++y) {
    const T* const row = plane.row(y);
    const T* const alphas = pixels.as<T>().row(y) + (channels - 1);
    const auto count = [&](int x, std::uint64_t* into) {
      if (has_alpha && alphas[x * channels] == T{0}) return;
      if (row[x] == row[x]) ++into[kernels::ClaheMapping<T>::bin(row[x])];
    };
    // Neighbors, which are often the same, don't wait for each other.
    int x = 0;
    for (; x + 2 <= plane.width; x += 2) {
      count(x, counts);
      count(x + 1, odd.data());
    }
    if (x < plane.width) count(x, counts);
  }
  for (std::size_t b = 0; b < odd.size(); ++b) counts[b] += odd[b];
}

}  // namespace

template <class T>
ImageView<const T> clahe_plane(const ClaheLayout& layout, const ConstAnyView& pixels, int plane, Scratch& scratch) {
  if (layout.direct) return pixels.as<T>();
  const int width = pixels.width();
  const int height = pixels.height();
  T* const values = scratch.take<T>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const ImageView<T> result{values, width, height, 1, width};
  if (layout.luma && layout.info.alpha == AlphaState::None) {
    kernels::grayscale(pixels, AnyView(result), kernels::GrayRule::Luma);
  } else {
    for (int y = 0; y < height; ++y) plane_row(layout, pixels.as<T>().row(y), width, plane, result.row(y));
  }
  return result;
}

void clahe_clip(std::span<const std::uint64_t> counts, double clip, std::span<double> clipped) {
  const std::size_t bins = counts.size();
  double all = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    clipped[b] = static_cast<double>(counts[b]);
    all += clipped[b];
  }
  const double limit = clip * all / static_cast<double>(bins);
  double excess = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    excess += std::max(0.0, clipped[b] - limit);
    clipped[b] = std::min(clipped[b], limit);
  }
  // Bins that have less room than their share fill up; the others share what is left, and more of them fill up.
  double more = 0;
  double rest = excess;
  std::size_t open = bins;
  for (std::size_t before = bins + 1; open > 0 && open < before;) {
    before = open;
    more = rest / static_cast<double>(open);
    rest = excess;
    open = 0;
    for (std::size_t b = 0; b < bins; ++b) {
      const double room = limit - clipped[b];
      const bool fills = room < more;
      rest -= fills ? room : 0;
      open += fills ? 0 : 1;
    }
  }
  for (std::size_t b = 0; b < bins; ++b) clipped[b] = std::min(limit, clipped[b] + more);
}

template <class T>
ClaheTables<T>::ClaheTables(const ClaheLayout& layout) : layout_(layout) {
  counts_ = Buffer(size() * Mapping::kBins * sizeof(std::uint64_t));
  std::fill_n(all(), size() * Mapping::kBins, 0);
}

template <class T>
void ClaheTables<T>::add(const ConstTile& tile, Scratch& scratch) {
  const auto mark = scratch.mark();
  for (int p = 0; p < layout_.planes; ++p) {
    const auto plane = clahe_plane<T>(layout_, tile.pixels, p, scratch);
    for (int r = 0; r < layout_.down.tiles(); ++r) {
      for (int c = 0; c < layout_.across.tiles(); ++c) {
        const auto begin = [](const ClaheAxis& axis, int i) { return axis.begins[static_cast<std::size_t>(i)]; };
        Rect part = intersection(tile.rect, rect_between(begin(layout_.across, c), begin(layout_.down, r),
                                                         begin(layout_.across, c + 1), begin(layout_.down, r + 1)));
        if (part.empty()) continue;
        part.x -= tile.rect.x;
        part.y -= tile.rect.y;
        count_part<T>(plane.crop(part), tile.pixels.crop(part), all() + index(p, r, c) * Mapping::kBins);
      }
    }
  }
  scratch.release(mark);
}

template <class T>
void ClaheTables<T>::merge(const Analysis& other) {
  const std::uint64_t* const more = static_cast<const ClaheTables&>(other).all();
  for (std::size_t i = 0; i < size() * Mapping::kBins; ++i) all()[i] += more[i];
}

template <class T>
void ClaheTables<T>::finish() {
  tables_ = Buffer(size() * Mapping::kEntries * sizeof(Entry));
  std::array<double, Mapping::kBins> clipped{};
  for (std::size_t t = 0; t < size(); ++t) {
    const std::span<const std::uint64_t> counts{all() + t * Mapping::kBins, Mapping::kBins};
    const auto seen = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
    Entry* const table = reinterpret_cast<Entry*>(tables_.data()) + t * Mapping::kEntries;
    clahe_clip(counts, layout_.clip, clipped);
    double below = 0;
    for (std::size_t b = 0; b < Mapping::kEntries; ++b) {
      const double in_bin = b < Mapping::kBins ? clipped[b] : 0;
      if constexpr (sizeof(T) == 1) {
        const double middle = seen == 0 ? static_cast<double>(b) : (below + in_bin / 2) / seen * 256 - 0.5;
        // Results are up to half a step outside; cut so that differences fit 16 bits.
        table[b] = static_cast<Entry>(std::clamp(std::floor(middle * 128 + 0.5), -63.0, 32703.0));
      } else {
        table[b] = static_cast<Entry>(seen == 0 ? static_cast<double>(b) / Mapping::kBins : below / seen);
      }
      below += in_bin;
    }
  }
}

template ImageView<const std::uint8_t> clahe_plane(const ClaheLayout&, const ConstAnyView&, int, Scratch&);
template ImageView<const std::uint16_t> clahe_plane(const ClaheLayout&, const ConstAnyView&, int, Scratch&);
template ImageView<const float> clahe_plane(const ClaheLayout&, const ConstAnyView&, int, Scratch&);
template class ClaheTables<std::uint8_t>;
template class ClaheTables<std::uint16_t>;
template class ClaheTables<float>;

}  // namespace azulejo
