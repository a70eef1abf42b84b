#pragma once

#include <cstdint>
#include <type_traits>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

/// (1 − amount) · source + amount · other of one stored value each.
template <class T>
struct BlendPoint {
  explicit BlendPoint(float amount) : other_share(amount), source_share(1 - amount) {}
  T operator()(T source, T other) const {
    const float sum = source_share * static_cast<float>(source) + other_share * static_cast<float>(other);
    if constexpr (std::is_same_v<T, float>) return sum;
    return static_cast<T>(sum + 0.5F);
  }

  float other_share;
  float source_share;
};

template <>
struct BlendPoint<std::uint8_t> {
  static constexpr int kWhole = 32768;
  explicit BlendPoint(float amount) : other_share(static_cast<int>(amount * kWhole + 0.5F)) {}
  std::uint8_t operator()(std::uint8_t source, std::uint8_t other) const {
    return static_cast<std::uint8_t>((source * (kWhole - other_share) + other * other_share + kWhole / 2) / kWhole);
  }

  int other_share;
};

/// The same for tiles of equal shape; the result may be one of them.
void blend(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, float amount);
void blend_reference(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, float amount);

}  // namespace azulejo::kernels
