#include "azulejo/imaging/laplacian_kernels.h"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/laplacian_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;

/// Values that Laplacian handles at once.
template <class T>
HWY_INLINE std::size_t Step() {
  return hn::Lanes(FloatTag()) * (sizeof(T) == 1 ? 2 : 1);
}

/// The sum of differences, for vectors that `load` gives by address.
template <bool kEight, class T, class Load>
HWY_INLINE auto Differences(const SobelSource<T>& source, std::size_t i, const Load& load) {
  const T* const above = source.above + i;
  const T* const at = source.at + i;
  const T* const below = source.below + i;
  const std::ptrdiff_t tap = source.tap;
  const auto center = load(at);
  const auto less = [&](const T* from) HWY_ATTR { return hn::Sub(load(from), center); };
  auto sum = hn::Add(hn::Add(less(above), less(below)), hn::Add(less(at - tap), less(at + tap)));
  if constexpr (kEight) {
    sum = hn::Add(
        sum, hn::Add(hn::Add(less(above - tap), less(above + tap)), hn::Add(less(below - tap), less(below + tap))));
  }
  return sum;
}

/// Step<T>() results from index i on: bytes in 16-bit integers, all others in f32.
template <bool kEight, class T>
HWY_INLINE void Laplacian(const SobelSource<T>& source, Floats scale, std::size_t i, float* result) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  if constexpr (sizeof(T) == 1) {
    const hn::ScalableTag<std::int16_t> dw;
    const hn::Half<decltype(dw)> half;
    const auto sum = Differences<kEight>(source, i, [&](const T* from) HWY_ATTR {
      return hn::PromoteTo(dw, hn::LoadU(hn::Rebind<std::uint8_t, decltype(dw)>(), from));
    });
    hn::StoreU(hn::Mul(hn::ConvertTo(d, hn::PromoteTo(di, hn::LowerHalf(half, sum))), scale), d, result + i);
    hn::StoreU(hn::Mul(hn::ConvertTo(d, hn::PromoteTo(di, hn::UpperHalf(half, sum))), scale), d,
               result + i + hn::Lanes(d));
  } else {
    const auto sum = Differences<kEight>(source, i, [&](const T* from) HWY_ATTR {
      if constexpr (std::is_same_v<T, float>) {
        return hn::LoadU(d, from);
      } else {
        return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<T, FloatTag>(), from)));
      }
    });
    hn::StoreU(hn::Mul(sum, scale), d, result + i);
  }
}

/// A row shorter than a step, by way of padded memory.
template <bool kEight, class T>
HWY_NOINLINE void ShortRow(const SobelSource<T>& source, Floats scale, float* result) {
  constexpr std::size_t kStep = HWY_MAX_BYTES / 2;
  constexpr std::size_t kReach = 4;  // the largest tap
  T padded[3][kStep + 2 * kReach] = {};
  const T* const from[3] = {source.above, source.at, source.below};
  const auto tap = static_cast<std::size_t>(source.tap);
  for (std::size_t r = 0; r < 3; ++r) std::copy_n(from[r] - tap, source.count + 2 * tap, padded[r]);
  float results[kStep];
  Laplacian<kEight, T>({padded[0] + tap, padded[1] + tap, padded[2] + tap, source.count, source.tap}, scale, 0,
                       results);
  std::copy_n(results, source.count, result);
}

template <bool kEight, class T>
HWY_INLINE void Row(const SobelSource<T>& source, float scale, float* result) {
  const std::size_t step = Step<T>();
  const auto factor = hn::Set(FloatTag(), scale);
  if (source.count < step) return ShortRow<kEight>(source, factor, result);
  std::size_t i = 0;
  for (; i + step <= source.count; i += step) Laplacian<kEight>(source, factor, i, result);
  if (i < source.count) Laplacian<kEight>(source, factor, source.count - step, result);
}

template <class T>
HWY_INLINE void AnyRow(const SobelSource<T>& source, bool eight, float scale, float* result) {
  eight ? Row<true>(source, scale, result) : Row<false>(source, scale, result);
}

void LaplacianU8(const SobelSource<std::uint8_t>& source, bool eight, float scale, float* result) {
  AnyRow(source, eight, scale, result);
}
void LaplacianU16(const SobelSource<std::uint16_t>& source, bool eight, float scale, float* result) {
  AnyRow(source, eight, scale, result);
}
void LaplacianF32(const SobelSource<float>& source, bool eight, float scale, float* result) {
  AnyRow(source, eight, scale, result);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(LaplacianU8);
HWY_EXPORT(LaplacianU16);
HWY_EXPORT(LaplacianF32);

void laplacian_row(const SobelSource<std::uint8_t>& source, bool eight, float scale, float* result) {
  HWY_DYNAMIC_DISPATCH(LaplacianU8)(source, eight, scale, result);
}
void laplacian_row(const SobelSource<std::uint16_t>& source, bool eight, float scale, float* result) {
  HWY_DYNAMIC_DISPATCH(LaplacianU16)(source, eight, scale, result);
}
void laplacian_row(const SobelSource<float>& source, bool eight, float scale, float* result) {
  HWY_DYNAMIC_DISPATCH(LaplacianF32)(source, eight, scale, result);
}

}  // namespace azulejo::kernels
#endif
