#include "azulejo/imaging/blend_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/blend_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/memory_bound_inl.h"

#include <cstring>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
struct VectorBlend : BlendPoint<T> {
  using BlendPoint<T>::BlendPoint;

  template <class D, class V>
  HWY_INLINE V operator()(D d, V source, V other) const {
    return sum(d, source, other);
  }

 private:
  template <class D, class V>
  HWY_INLINE V weighted(D d, V source, V other) const {
    return hn::Add(hn::Mul(hn::Set(d, this->source_share), source), hn::Mul(hn::Set(d, this->other_share), other));
  }
  template <class D>
  HWY_INLINE hn::Vec<D> sum(D d, hn::Vec<D> source, hn::Vec<D> other) const {
    if constexpr (std::is_same_v<T, float>) {
      return weighted(d, source, other);
    } else {
      // Even and odd values apart, in lanes twice as wide.
      const hn::RepartitionToWide<D> dw;
      const hn::RebindToSigned<decltype(dw)> di;
      const hn::RebindToFloat<decltype(dw)> df;
      const auto mixed = [&](auto s, auto o) HWY_ATTR {
        const auto mix = weighted(df, hn::ConvertTo(df, hn::BitCast(di, s)), hn::ConvertTo(df, hn::BitCast(di, o)));
        return hn::BitCast(dw, hn::ConvertTo(di, hn::Add(mix, hn::Set(df, 0.5F))));
      };
      const auto low = hn::Set(dw, 0xFFFF);
      const auto s = hn::BitCast(dw, source);
      const auto o = hn::BitCast(dw, other);
      const auto even = mixed(hn::And(s, low), hn::And(o, low));
      const auto odd = mixed(hn::ShiftRight<16>(s), hn::ShiftRight<16>(o));
      return hn::BitCast(d, hn::Or(even, hn::ShiftLeft<16>(odd)));
    }
  }
};

/// Bytes: source + (other − source) · share, in lanes of 16 bits; a share above a half is the other's part.
template <>
struct VectorBlend<std::uint8_t> : BlendPoint<std::uint8_t> {
  using BlendPoint<std::uint8_t>::BlendPoint;

  template <class D, class V>
  HWY_INLINE V operator()(D d, V source, V other) const {
    return other_share <= kWhole / 2 ? mixed(d, source, other, other_share)
                                     : mixed(d, other, source, kWhole - other_share);
  }

 private:
  template <class D, class V>
  HWY_INLINE static V mixed(D d, V base, V other, int share) {
    const hn::RepartitionToWide<D> dw;
    const hn::RebindToSigned<decltype(dw)> di;
    const auto part = hn::Set(di, static_cast<std::int16_t>(share));
    const auto mix = [&](auto b, auto o) HWY_ATTR {
      const auto from = hn::BitCast(di, b);
      return hn::BitCast(dw, hn::Add(from, hn::MulFixedPoint15(hn::Sub(hn::BitCast(di, o), from), part)));
    };
    const auto low = hn::Set(dw, 0x00FF);
    const auto b = hn::BitCast(dw, base);
    const auto o = hn::BitCast(dw, other);
    const auto even = mix(hn::And(b, low), hn::And(o, low));
    const auto odd = mix(hn::ShiftRight<8>(b), hn::ShiftRight<8>(o));
    return hn::BitCast(d, hn::Or(even, hn::ShiftLeft<8>(odd)));
  }
};

template <class T>
void blend_tile(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, float amount) {
  const MemoryBoundTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t count = result.info.row_bytes() / sizeof(T);
  const VectorBlend<T> mix(amount);
  const BlendPoint<T> mix_one(amount);
  for (int y = 0; y < result.info.height; ++y) {
    const T* const a = source.as<T>().row(y);
    const T* const b = other.as<T>().row(y);
    T* const to = result.as<T>().row(y);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) hn::StoreU(mix(d, hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, to + i);
    for (; i < count; ++i) to[i] = mix_one(a[i], b[i]);
  }
}

void Blend(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, float amount) {
  switch (result.info.type) {
    case PixelType::U8: return blend_tile<std::uint8_t>(source, other, result, amount);
    case PixelType::U16: return blend_tile<std::uint16_t>(source, other, result, amount);
    case PixelType::F32: return blend_tile<float>(source, other, result, amount);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Blend);

void blend(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, float amount) {
  HWY_DYNAMIC_DISPATCH(Blend)(source, other, result, amount);
}

}  // namespace azulejo::kernels
#endif
