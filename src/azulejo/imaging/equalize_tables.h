#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "azulejo/data/pool.h"
#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/histogram_counts.h"

namespace azulejo {

/// Histograms of an image's color channels, and the tables that equalize them.
template <class T>
class EqualizeTables final : public Analysis {
 public:
  static constexpr std::size_t kBins = HistogramCounts<T>::kBins;

  EqualizeTables(const ImageInfo& info, bool per_channel) : counts_(info, per_channel) {}

  void add(const ConstTile& tile, Scratch&) override { counts_.add(tile.pixels); }
  void merge(const Analysis& other) override { counts_.merge(static_cast<const EqualizeTables&>(other).counts_); }
  void finish() override;

  /// Tables: 1, or one a color channel.
  std::size_t size() const { return counts_.size(); }
  std::size_t table_of(int channel) const { return counts_.table_of(channel); }
  std::span<const std::uint64_t> counts(std::size_t table) const { return counts_[table]; }
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
  HistogramCounts<T> counts_;
  std::array<bool, 4> constant_{};
  Buffer tables_;  ///< of T
};

extern template class EqualizeTables<std::uint8_t>;
extern template class EqualizeTables<std::uint16_t>;
extern template class EqualizeTables<float>;

}  // namespace azulejo
