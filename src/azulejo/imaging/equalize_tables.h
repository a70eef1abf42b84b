#pragma once

#include <cstdint>

#include "azulejo/engine/tile_node.h"
#include "azulejo/imaging/histogram_counts.h"
#include "azulejo/imaging/value_tables.h"

namespace azulejo {

/// Histograms of an image's color channels, and the tables that equalize them.
template <class T>
class EqualizeTables final : public Analysis {
 public:
  EqualizeTables(const ImageInfo& info, bool per_channel) : counts_(info, per_channel) {}

  void add(const ConstTile& tile, Scratch&) override { counts_.add(tile.pixels); }
  void merge(const Analysis& other) override { counts_.merge(static_cast<const EqualizeTables&>(other).counts_); }
  void finish() override;

  const HistogramCounts<T>& counts() const { return counts_; }
  const ValueTables<T>& tables() const { return tables_; }

 private:
  HistogramCounts<T> counts_;
  ValueTables<T> tables_;
};

extern template class EqualizeTables<std::uint8_t>;
extern template class EqualizeTables<std::uint16_t>;
extern template class EqualizeTables<float>;

}  // namespace azulejo
