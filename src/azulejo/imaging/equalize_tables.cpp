#include "azulejo/imaging/equalize_tables.h"

#include <algorithm>
#include <numeric>

namespace azulejo {

template <class T>
void EqualizeTables<T>::finish() {
  counts_.finish();
  tables_ = Buffer(size() * kBins * sizeof(T));
  for (std::size_t t = 0; t < size(); ++t) {
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
