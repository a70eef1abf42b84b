#include "azulejo/imaging/histogram_counts.h"

#include <array>
#include <cstring>

namespace azulejo {
namespace {

constexpr std::size_t kPairs = 65536;
/// From here on, counting pairs pays for clearing and adding up their counters; measured on 1 to 24 megapixels.
constexpr std::int64_t kPixelsForPairs = 1 << 19;

/// Counts bytes in several histograms, so that equal neighbors don't wait for each other; that of a byte is told by
/// its place, so that its channel is known.
template <std::size_t kHistograms>
void count_in_turn(const ImageView<const std::uint8_t>& view, bool per_channel, std::uint64_t* counts) {
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
      std::uint64_t* const sum = counts + (per_channel ? k % channels : 0) * 256;
      for (std::size_t v = 0; v < 256; ++v) sum[v] += histograms[k][v];
      histograms[k].fill(0);
    }
  }
}

/// Adds both bytes of every pair.
void add_up(const std::uint32_t* pairs, std::uint64_t* counts) {
  for (std::size_t high = 0; high < 256; ++high) {
    const std::uint32_t* const row = pairs + high * 256;
    std::uint64_t sum = 0;
    for (std::size_t low = 0; low < 256; ++low) {
      sum += row[low];
      counts[low] += row[low];
    }
    counts[high] += sum;
  }
}

}  // namespace

void count_bytes(const ImageView<const std::uint8_t>& view, bool per_channel, std::uint64_t* counts) {
  if (view.channels == 3) return count_in_turn<12>(view, per_channel, counts);
  count_in_turn<8>(view, per_channel, counts);
}

template <class T>
HistogramCounts<T>::HistogramCounts(const ImageInfo& info, bool per_channel)
    : info_(info),
      size_(per_channel ? static_cast<std::size_t>(info.color_channels()) : 1),
      counts_(size_ * kBins * sizeof(std::uint64_t)) {
  std::fill_n(all(), size_ * kBins, 0);
  if (sizeof(T) == 1 && size_ == 1 && info.alpha == AlphaState::None && info.rect().area() >= kPixelsForPairs) {
    pairs_ = Buffer(kPairs * sizeof(std::uint32_t));
    std::fill_n(pairs(), kPairs, 0);
  }
}

/// Two bytes take one count: of neighbors, of which photographs have few kinds.
template <class T>
void HistogramCounts<T>::add_pairs(const ImageView<const std::uint8_t>& view) {
  const std::size_t count = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.channels);
  const std::uint64_t more = (count / 2) * static_cast<std::uint64_t>(view.height);
  if (pair_count_ + more > ~std::uint32_t{0}) finish();
  pair_count_ += more;
  std::uint32_t* const seen = pairs();
  for (int y = 0; y < view.height; ++y) {
    const std::uint8_t* const row = view.row(y);
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, row + i, 8);
      ++seen[eight & 0xFFFF];
      ++seen[eight >> 16 & 0xFFFF];
      ++seen[eight >> 32 & 0xFFFF];
      ++seen[eight >> 48];
    }
    for (; i + 2 <= count; i += 2) ++seen[row[i] * std::size_t{256} + row[i + 1]];
    if (i < count) ++all()[row[i]];
  }
}

template <class T>
void HistogramCounts<T>::add(const ConstAnyView& pixels) {
  const auto view = pixels.as<T>();
  if constexpr (sizeof(T) == 1) {
    if (pairs_.data() != nullptr && pixels.info.rect().area() < std::int64_t{1} << 30) return add_pairs(view);
    if (info_.alpha == AlphaState::None) return count_bytes(view, size_ > 1, all());
  }
  const int colors = info_.color_channels();
  for (int c = 0; c < colors; ++c) {
    std::uint64_t* const counts = all() + table_of(c) * kBins;
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
void HistogramCounts<T>::merge(const HistogramCounts& other) {
  for (std::size_t i = 0; i < size_ * kBins; ++i) all()[i] += other.all()[i];
  if (other.pair_count_ > 0) add_up(other.pairs(), all());
}

template <class T>
void HistogramCounts<T>::finish() {
  if (pair_count_ == 0) return;
  add_up(pairs(), all());
  std::fill_n(pairs(), kPairs, 0);
  pair_count_ = 0;
}

template class HistogramCounts<std::uint8_t>;
template class HistogramCounts<std::uint16_t>;
template class HistogramCounts<float>;

}  // namespace azulejo
