#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "azulejo/data/pool.h"
#include "azulejo/data/view.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/histogram_counts.h"

namespace azulejo {

/// What becomes of the values of each bin of HistogramCounts<T>: one table for all color channels, or one each.
/// NaN stays as it is; premultiplied color is divided by alpha before and multiplied after.
template <class T>
class ValueTables {
 public:
  static constexpr std::size_t kBins = HistogramCounts<T>::kBins;

  /// size  tables: 1, or one a color channel. Their contents are undefined at first
  explicit ValueTables(std::size_t size = 0) : size_(size), tables_(size * kBins * sizeof(T)) {}

  std::size_t size() const { return size_; }
  std::size_t table_of(int channel) const { return size_ == 1 ? 0 : static_cast<std::size_t>(channel); }
  std::span<T> operator[](std::size_t table) { return {all() + table * kBins, kBins}; }
  std::span<const T> operator[](std::size_t table) const { return {all() + table * kBins, kBins}; }

  /// Values stay as they are, whatever the table says.
  void keep(std::size_t table) { kept_[table] = true; }
  bool keeps(std::size_t table) const { return kept_[table]; }

  T mapped(T value, std::size_t table) const {
    return value != value || kept_[table] ? value : (*this)[table][bin_of(value)];
  }
  /// The same for premultiplied color.
  T mapped(T value, T alpha, std::size_t table) const {
    if (kept_[table]) return value;
    return alpha == T{0} ? T{0} : multiplied(mapped(divided(value, alpha), table), alpha);
  }

 private:
  T* all() const { return reinterpret_cast<T*>(tables_.data()); }

  std::size_t size_;
  std::array<bool, 4> kept_{};
  Buffer tables_;  ///< of T
};

/// Maps the colors of a tile and copies its alpha. In place is allowed.
template <class T>
void map_values(const ValueTables<T>& tables, const ConstAnyView& source, const AnyView& result);
/// The same, value by value.
template <class T>
void map_values_reference(const ValueTables<T>& tables, const ConstAnyView& source, const AnyView& result);

/// Reports charts for each table: histogram_before, mapping, histogram_after.
template <class T>
void report_tables(const ValueTables<T>& tables, const HistogramCounts<T>& counts, const StageReporter& reporter);

}  // namespace azulejo
