#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>

#include "azulejo/data/pool.h"
#include "azulejo/data/view.h"

namespace azulejo {

/// The bin of a value that is not NaN: integers are their own, floats are cut to 0–1 and have 65536.
template <class T>
std::size_t bin_of(T value) {
  if constexpr (std::is_same_v<T, float>) {
    const float inside = value > 0 ? (value < 1 ? value : 1.0F) : 0.0F;
    return static_cast<std::size_t>(inside * 65535.0F + 0.5F);
  } else {
    return value;
  }
}

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

/// Straight color as premultiplied color.
template <class T>
T multiplied(T value, T alpha) {
  if constexpr (std::is_same_v<T, float>) {
    return value * alpha;
  } else {
    const auto top = static_cast<std::uint64_t>(full_range(kPixelTypeOf<T>));
    return static_cast<T>((2 * std::uint64_t{value} * alpha + top) / (2 * top));
  }
}

/// Adds the bytes of all channels to `counts`: 256 of them, or with `per_channel` 256 a channel.
void count_bytes(const ImageView<const std::uint8_t>& view, bool per_channel, std::uint64_t* counts);

/// Histograms of an image's color channels: one for all, or one each. Neither NaN nor pixels of alpha 0 are counted;
/// premultiplied color is divided by alpha.
template <class T>
class HistogramCounts {
 public:
  static constexpr std::size_t kBins = sizeof(T) == 1 ? 256 : 65536;

  /// info  of the whole image
  HistogramCounts(const ImageInfo& info, bool per_channel);

  void add(const ConstAnyView& pixels);
  void merge(const HistogramCounts& other);
  /// To be called after everything was added and merged, before anything is read.
  void finish();

  /// Histograms: 1, or one a color channel.
  std::size_t size() const { return size_; }
  std::size_t table_of(int channel) const { return size_ == 1 ? 0 : static_cast<std::size_t>(channel); }
  std::span<const std::uint64_t> operator[](std::size_t table) const { return {all() + table * kBins, kBins}; }

 private:
  std::uint64_t* all() const { return reinterpret_cast<std::uint64_t*>(counts_.data()); }
  std::uint32_t* pairs() const { return reinterpret_cast<std::uint32_t*>(pairs_.data()); }
  void add_pairs(const ImageView<const std::uint8_t>& view);

  ImageInfo info_;
  std::size_t size_;
  Buffer counts_;                 ///< of std::uint64_t
  Buffer pairs_;                  ///< of std::uint32_t: how often a byte follows another, where that is counted
  std::uint64_t pair_count_ = 0;  ///< sum of pairs_
};

extern template class HistogramCounts<std::uint8_t>;
extern template class HistogramCounts<std::uint16_t>;
extern template class HistogramCounts<float>;

}  // namespace azulejo
