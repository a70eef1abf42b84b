#include "azulejo/imaging/sobel_kernels.h"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/sobel_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/math/arctangent_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;

/// The results of a vector's worth of derivatives, written from index i on.
HWY_INLINE void Write(Floats dx, Floats dy, Floats scale, const SobelRows& rows, std::size_t i) {
  const FloatTag d;
  if (rows.magnitude != nullptr) {
    const auto length = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
    hn::StoreU(hn::Mul(length, scale), d, rows.magnitude + i);
  }
  if (rows.x != nullptr) hn::StoreU(hn::Mul(dx, scale), d, rows.x + i);
  if (rows.y != nullptr) hn::StoreU(hn::Mul(dy, scale), d, rows.y + i);
  if (rows.orientation != nullptr) {
    hn::StoreU(atan2_deterministic(d, hn::Sub(hn::Zero(d), dy), dx), d, rows.orientation + i);
  }
}

/// The derivatives of a vector of values that `load` gives by address.
template <class D, class T, class Load, class V = hn::Vec<D>>
HWY_INLINE void Differentiate(D, const T* above, const T* at, const T* below, std::ptrdiff_t tap, const Load& load,
                              V& dx, V& dy) {
  const auto weighted = [](V outer0, V outer1, V inner)
                            HWY_ATTR { return hn::Add(hn::Add(outer0, outer1), hn::Add(inner, inner)); };
  const V above_left = load(above - tap);
  const V above_right = load(above + tap);
  const V below_left = load(below - tap);
  const V below_right = load(below + tap);
  dx = hn::Sub(weighted(above_right, below_right, load(at + tap)), weighted(above_left, below_left, load(at - tap)));
  dy = hn::Sub(weighted(below_left, below_right, load(below)), weighted(above_left, above_right, load(above)));
}

/// Values that Gradient handles at once.
template <class T>
HWY_INLINE std::size_t Step() {
  return hn::Lanes(FloatTag()) * (std::is_same_v<T, std::uint8_t> ? 2 : 1);
}

/// Step<T>() results from index i on: bytes in 16-bit integers, all others in f32.
template <class T>
HWY_INLINE void Gradient(const SobelSource<T>& source, Floats scale, const SobelRows& rows, std::size_t i) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const T* const above = source.above + i;
  const T* const at = source.at + i;
  const T* const below = source.below + i;
  if constexpr (std::is_same_v<T, std::uint8_t>) {
    const hn::ScalableTag<std::int16_t> dw;
    const hn::Half<decltype(dw)> half;
    const auto load = [&](const T* from) HWY_ATTR {
      return hn::PromoteTo(dw, hn::LoadU(hn::Rebind<std::uint8_t, decltype(dw)>(), from));
    };
    hn::Vec<decltype(dw)> dx;
    hn::Vec<decltype(dw)> dy;
    Differentiate(dw, above, at, below, source.tap, load, dx, dy);
    Write(hn::ConvertTo(d, hn::PromoteTo(di, hn::LowerHalf(half, dx))),
          hn::ConvertTo(d, hn::PromoteTo(di, hn::LowerHalf(half, dy))), scale, rows, i);
    Write(hn::ConvertTo(d, hn::PromoteTo(di, hn::UpperHalf(half, dx))),
          hn::ConvertTo(d, hn::PromoteTo(di, hn::UpperHalf(half, dy))), scale, rows, i + hn::Lanes(d));
  } else {
    const auto load = [&](const T* from) HWY_ATTR {
      if constexpr (std::is_same_v<T, float>) {
        return hn::LoadU(d, from);
      } else {
        return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<T, FloatTag>(), from)));
      }
    };
    Floats dx;
    Floats dy;
    Differentiate(d, above, at, below, source.tap, load, dx, dy);
    Write(dx, dy, scale, rows, i);
  }
}

/// A row shorter than a step, by way of padded memory.
template <class T>
HWY_NOINLINE void ShortRow(const SobelSource<T>& source, Floats scale, const SobelRows& rows) {
  constexpr std::size_t kStep = HWY_MAX_BYTES / 2;
  constexpr std::size_t kReach = 4;  // the largest tap
  T padded[3][kStep + 2 * kReach] = {};
  const T* const from[3] = {source.above, source.at, source.below};
  const auto tap = static_cast<std::size_t>(source.tap);
  for (std::size_t r = 0; r < 3; ++r) std::copy_n(from[r] - tap, source.count + 2 * tap, padded[r]);
  float results[4][kStep];
  float* const wanted[4] = {rows.magnitude, rows.x, rows.y, rows.orientation};
  const auto place = [&](std::size_t r) { return wanted[r] != nullptr ? results[r] : nullptr; };
  Gradient<T>({padded[0] + tap, padded[1] + tap, padded[2] + tap, source.count, source.tap}, scale,
              {place(0), place(1), place(2), place(3)}, 0);
  for (std::size_t r = 0; r < 4; ++r) {
    if (wanted[r] != nullptr) std::copy_n(results[r], source.count, wanted[r]);
  }
}

template <class T>
HWY_INLINE void Row(const SobelSource<T>& source, float scale, const SobelRows& rows) {
  const std::size_t step = Step<T>();
  const auto factor = hn::Set(FloatTag(), scale);
  if (source.count < step) return ShortRow(source, factor, rows);
  std::size_t i = 0;
  for (; i + step <= source.count; i += step) Gradient(source, factor, rows, i);
  if (i < source.count) Gradient(source, factor, rows, source.count - step);
}

void SobelU8(const SobelSource<std::uint8_t>& source, float scale, const SobelRows& rows) { Row(source, scale, rows); }
void SobelU16(const SobelSource<std::uint16_t>& source, float scale, const SobelRows& rows) {
  Row(source, scale, rows);
}
void SobelF32(const SobelSource<float>& source, float scale, const SobelRows& rows) { Row(source, scale, rows); }

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(SobelU8);
HWY_EXPORT(SobelU16);
HWY_EXPORT(SobelF32);

void sobel_row(const SobelSource<std::uint8_t>& source, float scale, const SobelRows& rows) {
  HWY_DYNAMIC_DISPATCH(SobelU8)(source, scale, rows);
}
void sobel_row(const SobelSource<std::uint16_t>& source, float scale, const SobelRows& rows) {
  HWY_DYNAMIC_DISPATCH(SobelU16)(source, scale, rows);
}
void sobel_row(const SobelSource<float>& source, float scale, const SobelRows& rows) {
  HWY_DYNAMIC_DISPATCH(SobelF32)(source, scale, rows);
}

}  // namespace azulejo::kernels
#endif
