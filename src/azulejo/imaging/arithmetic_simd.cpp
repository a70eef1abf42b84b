#include "azulejo/imaging/arithmetic.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/arithmetic_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/memory_bound_inl.h"
#include "azulejo/imaging/stored_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

template <class T>
struct VectorAdd : AddValues<T> {
  template <class D, class V>
  HWY_INLINE V operator()(D, V a, V b) const {
    if constexpr (std::is_same_v<T, float>) {
      return hn::Add(a, b);
    } else {
      return hn::SaturatedAdd(a, b);
    }
  }
  using AddValues<T>::operator();
};

template <class T>
struct VectorDifference : DifferenceValues<T> {
  template <class D, class V>
  HWY_INLINE V operator()(D, V a, V b) const {
    if constexpr (std::is_same_v<T, float>) {
      return hn::Abs(hn::Sub(a, b));
    } else {
      return hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a));
    }
  }
  using DifferenceValues<T>::operator();
};

/// For t = a · b + half of the range, (t + (t >> bits)) >> bits is t ÷ full range, rounded down.
template <class T>
struct VectorMultiply : MultiplyValues<T> {
  template <class D, class V>
  HWY_INLINE V operator()(D d, V a, V b) const {
    if constexpr (std::is_same_v<T, float>) {
      return hn::Mul(a, b);
    } else if constexpr (sizeof(T) == 1) {
      // Even and odd bytes apart, in lanes twice as wide.
      const hn::RepartitionToWide<D> dw;
      const auto low = hn::Set(dw, 0x00FF);
      const auto half = hn::Set(dw, 128);
      const auto product = [&](auto x, auto y) HWY_ATTR {
        const auto t = hn::Add(hn::Mul(x, y), half);
        return hn::Add(t, hn::ShiftRight<8>(t));
      };
      const auto wide_a = hn::BitCast(dw, a);
      const auto wide_b = hn::BitCast(dw, b);
      const auto even = product(hn::And(wide_a, low), hn::And(wide_b, low));
      const auto odd = product(hn::ShiftRight<8>(wide_a), hn::ShiftRight<8>(wide_b));
      return hn::BitCast(d, hn::Or(hn::ShiftRight<8>(even), hn::AndNot(low, odd)));
    } else {
      // The product's upper and lower halves; carries from adding 2¹⁵, then the upper half, to the lower.
      const V lower = hn::Mul(a, b);
      const V upper = hn::Add(hn::MulHigh(a, b), hn::ShiftRight<15>(lower));
      const V moved = hn::Xor(lower, hn::Set(d, 0x8000));
      const auto carries = hn::Lt(hn::Add(moved, upper), moved);
      return hn::Sub(upper, hn::VecFromMask(d, carries));
    }
  }
  using MultiplyValues<T>::operator();
};

/// Calls with vectors of as many values as one vector of T holds.
template <class Values, class T>
void same_type(const Values& values, const T* a, const T* b, std::size_t count, T* result) {
  const MemoryBoundTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + 2 * lanes <= count; i += 2 * lanes) {
    const auto first = values(d, hn::LoadU(d, a + i), hn::LoadU(d, b + i));
    const auto second = values(d, hn::LoadU(d, a + i + lanes), hn::LoadU(d, b + i + lanes));
    hn::StoreU(first, d, result + i);
    hn::StoreU(second, d, result + i + lanes);
  }
  for (; i + lanes <= count; i += lanes) hn::StoreU(values(d, hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, result + i);
  if (i == count) return;
  HWY_ALIGN T rest[2][HWY_MAX_BYTES / sizeof(T)] = {};
  std::copy_n(a + i, count - i, rest[0]);
  std::copy_n(b + i, count - i, rest[1]);
  hn::Store(values(d, hn::Load(d, rest[0]), hn::Load(d, rest[1])), d, rest[0]);
  std::copy_n(rest[0], count - i, result + i);
}

template <class T>
void subtract_values(const T* a, const T* b, std::size_t count, float* result) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto top = hn::Set(d, full_range(kPixelTypeOf<T>));
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto difference = hn::Sub(LoadStored(a + i), LoadStored(b + i));
    hn::StoreU(std::is_same_v<T, float> ? difference : hn::Div(difference, top), d, result + i);
  }
  for (; i < count; ++i) result[i] = SubtractValues<T>()(a[i], b[i]);
}

template <class T>
void divide_values(const T* a, const T* b, std::size_t count, float by_zero, float* result) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto without = hn::Set(d, by_zero);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto divisor = LoadStored(b + i);
    const auto quotient = hn::Div(LoadStored(a + i), divisor);
    hn::StoreU(hn::IfThenElse(hn::Eq(divisor, hn::Zero(d)), without, quotient), d, result + i);
  }
  for (; i < count; ++i) result[i] = DivideValues<T>{by_zero}(a[i], b[i]);
}

void ArithmeticRow(Arithmetic operation, PixelType type, const std::byte* source, const std::byte* other,
                   std::size_t count, std::byte* result, float by_zero) {
  visit_type(type, [&](auto zero) HWY_ATTR {
    using T = decltype(zero);
    const auto* const a = reinterpret_cast<const T*>(source);
    const auto* const b = reinterpret_cast<const T*>(other);
    auto* const same = reinterpret_cast<T*>(result);
    auto* const real = reinterpret_cast<float*>(result);
    switch (operation) {
      case Arithmetic::Add: return same_type(VectorAdd<T>(), a, b, count, same);
      case Arithmetic::Subtract: return subtract_values(a, b, count, real);
      case Arithmetic::Difference: return same_type(VectorDifference<T>(), a, b, count, same);
      case Arithmetic::Multiply: return same_type(VectorMultiply<T>(), a, b, count, same);
      case Arithmetic::Divide: return divide_values(a, b, count, by_zero, real);
    }
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(ArithmeticRow);

void arithmetic_row(Arithmetic operation, PixelType type, const std::byte* source, const std::byte* other,
                    std::size_t count, std::byte* result, float by_zero) {
  HWY_DYNAMIC_DISPATCH(ArithmeticRow)(operation, type, source, other, count, result, by_zero);
}

}  // namespace azulejo::kernels
#endif
