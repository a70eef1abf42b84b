#include "azulejo/imaging/equalize_tables.h"

#include <algorithm>
#include <numeric>

namespace azulejo {
namespace {

/// Premultiplied color as straight color; alpha isn't 0.
template <class T>
T divided(T value, T alpha) {
  if constexpr (std::is_same_v<T, float>) {
    return value / alpha;
  } else {
    const auto top = static_cast<std::uint64_t>(full_range(kPixelTypeOf<T>));
    return static_cast<T>(std::min(top, (2 * top * value + alpha) / (2 * std::uint64_t{alpha})));
  }
}

template <class T>
T multiplied(T value, T alpha) {
  if constexpr (std::is_same_v<T, float>) {
    return value * alpha;
  } else {
    const auto top = static_cast<std::uint64_t>(full_range(kPixelTypeOf<T>));
    return static_cast<T>((2 * std::uint64_t{value} * alpha + top) / (2 * top));
  }
}

/// Counts bytes in several histograms, so that equal neighbors don't wait for each other; that of a byte is told by
/// its place, so that its channel is known.
template <std::size_t kHistograms>
void count_bytes(const ImageView<const std::uint8_t>& view, std::uint64_t* counts, std::size_t tables) {
  std::array<std::array<std::uint32_t, 256>, kHistograms> histograms{};
  const auto channels = static_cast<std::size_t>(view.channels);
  const std::size_t count = static_cast<std::size_t>(view.width) * channels;
  constexpr int kRowsAtOnce = 4096;  // rows of up to 2²⁰ values: 32 bits are enough
  for (int y = 0; y < view.height; ++y) {
    const std::uint8_t* const row = view.row(y);
    std::size_t i = 0;
    for (; i + kHistograms <= count; i += kHistograms) {
      for (std::size_t k = 0; k < kHistograms; ++k) ++histograms[k][row[i + k]];
    }
    for (; i < count; ++i) ++histograms[i % kHistograms][row[i]];
    if (y + 1 != view.height && (y + 1) % kRowsAtOnce != 0) continue;
    for (std::size_t k = 0; k < kHistograms; ++k) {
      std::uint64_t* const sum = counts + (tables == 1 ? 0 : k % channels) * 256;
      for (std::size_t v = 0; v < 256; ++v) sum[v] += histograms[k][v];
      histograms[k].fill(0);
    }
  }
}

}  // namespace

template <class T>
EqualizeTables<T>::EqualizeTables(const ImageInfo& info, bool per_channel)
    : info_(info),
      size_(per_channel ? static_cast<std::size_t>(info.color_channels()) : 1),
      counts_(size_ * kBins * sizeof(std::uint64_t)) {
  std::fill_n(counts_of(0), size_ * kBins, 0);
}

template <class T>
void EqualizeTables<T>::add(const ConstTile& tile, Scratch&) {
  const auto view = tile.pixels.template as<T>();
  if constexpr (sizeof(T) == 1) {
    if (info_.alpha == AlphaState::None && view.channels == 3) return count_bytes<12>(view, counts_of(0), size_);
    if (info_.alpha == AlphaState::None) return count_bytes<8>(view, counts_of(0), size_);
  }
  const int colors = info_.color_channels();
  for (int c = 0; c < colors; ++c) {
    std::uint64_t* const counts = counts_of(table_of(c));
    for (int y = 0; y < view.height; ++y) {
      const T* const row = view.row(y) + c;
      const T* const alphas = view.row(y) + colors;
      for (int i = 0; i < view.width * view.channels; i += view.channels) {
        if (info_.alpha != AlphaState::None && alphas[i] == T{0}) continue;
        const T value = info_.alpha == AlphaState::Premultiplied ? divided(row[i], alphas[i]) : row[i];
        if (value == value) ++counts[bin_of(value)];
      }
    }
  }
}

template <class T>
void EqualizeTables<T>::merge(const Analysis& other) {
  const std::uint64_t* const more = static_cast<const EqualizeTables&>(other).counts_of(0);
  std::uint64_t* const mine = counts_of(0);
  for (std::size_t i = 0; i < size_ * kBins; ++i) mine[i] += more[i];
}

template <class T>
void EqualizeTables<T>::finish() {
  tables_ = Buffer(size_ * kBins * sizeof(T));
  for (std::size_t t = 0; t < size_; ++t) {
    const auto seen = counts(t);
    const std::uint64_t all = std::accumulate(seen.begin(), seen.end(), std::uint64_t{0});
    const auto first = std::find_if(seen.begin(), seen.end(), [](std::uint64_t count) { return count != 0; });
    const std::uint64_t lowest = first == seen.end() ? 0 : *first;
    const std::uint64_t others = all - lowest;
    constant_[t] = others == 0;
    T* const result = reinterpret_cast<T*>(tables_.data()) + t * kBins;
    std::uint64_t up_to = 0;
    for (std::size_t v = 0; v < kBins; ++v) {
      if (seen[v] == 0 && v > 0 && others != 0) {
        result[v] = result[v - 1];
        continue;
      }
      up_to += seen[v];
      const std::uint64_t above = up_to - std::min(up_to, lowest);
      if constexpr (std::is_same_v<T, float>) {
        result[v] = others == 0 ? 0 : static_cast<float>(static_cast<double>(above) / static_cast<double>(others));
      } else {
        result[v] = static_cast<T>(others == 0 ? v : (2 * (kBins - 1) * above + others) / (2 * others));
      }
    }
  }
}

template <class T>
T EqualizeTables<T>::mapped(T value, std::size_t index) const {
  if (value != value || constant_[index]) return value;
  return table(index)[bin_of(value)];
}

template <class T>
T EqualizeTables<T>::mapped(T value, T alpha, std::size_t index) const {
  if (constant_[index]) return value;
  if (alpha == T{0}) return T{0};
  return multiplied(mapped(divided(value, alpha), index), alpha);
}

template class EqualizeTables<std::uint8_t>;
template class EqualizeTables<std::uint16_t>;
template class EqualizeTables<float>;

}  // namespace azulejo
