#include "azulejo/imaging/invert_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/invert_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/point_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
struct VectorInvert {
  template <class D, class V>
  HWY_INLINE V operator()(D d, V v) const {
    return from(hn::Set(d, static_cast<T>(full_range(kPixelTypeOf<T>))), v);
  }
  template <class V>
  HWY_INLINE static V from(V whole, V v) {
    if constexpr (std::is_same_v<T, float>) {
      return hn::Sub(whole, v);
    } else {
      return hn::SaturatedSub(whole, v);
    }
  }
};

/// Premultiplied color, which has its alpha in the same sixteen bytes.
template <class T>
struct VectorInvertPremultiplied {
  explicit VectorInvertPremultiplied(int channels) {
    const std::size_t value = sizeof(T);
    const std::size_t pixel = value * static_cast<std::size_t>(channels);
    for (std::size_t b = 0; b < HWY_MAX_BYTES; ++b) {
      alpha_bytes[b] = static_cast<std::uint8_t>(b % 16 / pixel * pixel + pixel - value + b % value);
    }
  }
  template <class D, class V>
  HWY_INLINE V operator()(D d, V v) const {
    const hn::Repartition<std::uint8_t, D> db;
    const V alpha = hn::BitCast(d, hn::TableLookupBytes(hn::BitCast(db, v), hn::Load(db, alpha_bytes)));
    return VectorInvert<T>::from(alpha, v);
  }
  HWY_ALIGN std::uint8_t alpha_bytes[HWY_MAX_BYTES];
};

void Invert(const ConstAnyView& source, const AnyView& result) {
  const bool premultiplied = result.info.alpha == AlphaState::Premultiplied;
  for_rows(source, result, [&](const auto* from, auto* to, std::size_t count, int period) HWY_ATTR {
    using T = std::remove_pointer_t<decltype(to)>;
    if (premultiplied) {
      point_row<T>(from, to, count, period, VectorInvertPremultiplied<T>(period));
    } else {
      point_row<T>(from, to, count, period, VectorInvert<T>());
    }
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Invert);

void invert(const ConstAnyView& source, const AnyView& result) { HWY_DYNAMIC_DISPATCH(Invert)(source, result); }

}  // namespace azulejo::kernels
#endif
