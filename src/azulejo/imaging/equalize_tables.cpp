#include "azulejo/imaging/equalize_tables.h"

#include <algorithm>
#include <numeric>

namespace azulejo {

template <class T>
void EqualizeTables<T>::finish() {
  counts_.finish();
  constexpr std::size_t kBins = HistogramCounts<T>::kBins;
  tables_ = ValueTables<T>(counts_.size());
  for (std::size_t t = 0; t < counts_.size(); ++t) {
    const auto seen = counts_[t];
    const std::uint64_t all = std::accumulate(seen.begin(), seen.end(), std::uint64_t{0});
    const auto first = std::find_if(seen.begin(), seen.end(), [](std::uint64_t count) { return count != 0; });
    const std::uint64_t lowest = first == seen.end() ? 0 : *first;
    const std::uint64_t others = all - lowest;
    if (others == 0) tables_.keep(t);
    const std::span<T> result = tables_[t];
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

template class EqualizeTables<std::uint8_t>;
template class EqualizeTables<std::uint16_t>;
template class EqualizeTables<float>;

}  // namespace azulejo
