#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "azulejo/data/pool.h"
#include "azulejo/engine/tile_node.h"

namespace azulejo {

/// Histograms of an image's color channels, and the tables that equalize them.
template <class T>
class EqualizeTables final : public Analysis {
 public:
  static constexpr std::size_t kBins = sizeof(T) == 1 ? 256 : 65536;

  EqualizeTables(const ImageInfo& info, bool per_channel);

  void add(const ConstTile& tile, Scratch& scratch) override;
  void merge(const Analysis& other) override;
  void finish() override;

  /// Tables: 1, or one a color channel.
  std::size_t size() const { return size_; }
  std::size_t table_of(int channel) const { return size_ == 1 ? 0 : static_cast<std::size_t>(channel); }
  std::span<const std::uint64_t> counts(std::size_t table) const {
    return {reinterpret_cast<const std::uint64_t*>(counts_.data()) + table * kBins, kBins};
  }
  /// What becomes of a bin's values.
  std::span<const T> table(std::size_t table) const {
    return {reinterpret_cast<const T*>(tables_.data()) + table * kBins, kBins};
  }
  /// True if there was but one value: then values stay as they are.
  bool constant(std::size_t table) const { return constant_[table]; }

  /// What becomes of a value.
  T mapped(T value, std::size_t index) const;
  /// The same for premultiplied color.
  T mapped(T value, T alpha, std::size_t index) const;

 private:
  std::uint64_t* counts_of(std::size_t table) const {
    return reinterpret_cast<std::uint64_t*>(counts_.data()) + table * kBins;
  }

  ImageInfo info_;
  std::size_t size_;
  std::array<bool, 4> constant_{};
  Buffer counts_;  ///< of std::uint64_t
  Buffer tables_;  ///< of T
};

/// The bin of a value that is not NaN: integers are their own, floats are cut to 0–1.
template <class T>
std::size_t bin_of(T value) {
  if constexpr (std::is_same_v<T, float>) {
    const float inside = value > 0 ? (value < 1 ? value : 1.0F) : 0.0F;
    return static_cast<std::size_t>(inside * 65535.0F + 0.5F);
  } else {
    return value;
  }
}

extern template class EqualizeTables<std::uint8_t>;
extern template class EqualizeTables<std::uint16_t>;
extern template class EqualizeTables<float>;

}  // namespace azulejo
