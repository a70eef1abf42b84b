#include <algorithm>
#include <cstring>

#include "azulejo/imaging/rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/rows_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/rows_inl.h"
#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

/// Linear light of stored values.
template <class T>
HWY_INLINE V Decoded(const ByteCurve& curve, V stored) {
  const D d;
  if constexpr (std::is_same_v<T, std::uint8_t>) {
    return hn::GatherIndex(d, curve.linear, hn::ConvertTo(DI(), stored));
  } else if constexpr (std::is_same_v<T, std::uint16_t>) {
    return SrgbToLinear(d, hn::Div(stored, hn::Set(d, 65535.0F)));
  } else {
    return SrgbToLinear(d, stored);
  }
}

template <class T, int kChannels>
void LoadAlpha(const RowFormat& format, const ByteCurve& curve, const T* source, std::size_t count, float* row) {
  const D d;
  const AlphaOf<kChannels> alpha_of;
  const bool unweigh = format.alpha == RowAlpha::Unweigh;
  const bool decode = format.curve;
  ForVectors(source, row, count, [&](const T* from, float* to) HWY_ATTR {
    const V stored = LoadStored(from);
    const V alpha = alpha_of(stored);
    V light = stored;
    if (unweigh) {
      light = SrgbToLinear(d, hn::IfThenZeroElse(hn::Eq(alpha, hn::Zero(d)), hn::Div(stored, alpha)));
    } else if (decode) {
      light = Decoded<T>(curve, stored);
    }
    hn::StoreU(hn::IfThenElse(alpha_of.is_alpha, stored, hn::Mul(light, alpha)), d, to);
  });
}

template <class T, int kChannels>
void StoreAlpha(const RowFormat& format, const ByteCurve& curve, const float* row, std::size_t count, T* result) {
  const D d;
  const AlphaOf<kChannels> alpha_of;
  const bool unweigh = format.alpha == RowAlpha::Unweigh;
  const bool encode = format.curve;
  ForVectors(row, result, count, [&](const float* from, T* to) HWY_ATTR {
    const V value = hn::LoadU(d, from);
    const V alpha = alpha_of(value);
    // NaN is visible; Ne would say no on some targets.
    const auto hidden = std::is_floating_point_v<T> ? hn::Eq(alpha, hn::Zero(d)) : hn::Lt(alpha, hn::Set(d, 0.5F));
    V light = hn::IfThenZeroElse(hidden, hn::Div(value, alpha));
    if (unweigh) {
      light = hn::Mul(LinearToSrgb(d, light), alpha);
    } else if (encode) {
      if constexpr (std::is_same_v<T, std::uint8_t>) {
        const auto is_alpha = hn::RebindMask(DI(), alpha_of.is_alpha);
        return StoreWhole(hn::IfThenElse(is_alpha, Rounded<T>(value), EncodeByte(curve, light)), to);
      }
      light = hn::Mul(LinearToSrgb(d, light), hn::Set(d, full_range(kPixelTypeOf<T>)));
    }
    StoreRounded(hn::IfThenElse(alpha_of.is_alpha, value, light), to);
  });
}

template <class T>
void LoadRow(const RowFormat& format, const ByteCurve& curve, const T* source, std::size_t count, float* row) {
  if (format.alpha != RowAlpha::Plain) {
    if (format.channels == 2) return LoadAlpha<T, 2>(format, curve, source, count, row);
    return LoadAlpha<T, 4>(format, curve, source, count, row);
  }
  if (format.curve) {
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      const DecodeBytes decode(curve);
      return ForVectors(source, row, count, [&](const T* from, float* to) HWY_ATTR {
        hn::StoreU(decode(hn::PromoteTo(DI(), hn::LoadU(hn::Rebind<T, D>(), from))), D(), to);
      });
    }
    ForVectors(source, row, count,
               [&](const T* from, float* to) HWY_ATTR { hn::StoreU(Decoded<T>(curve, LoadStored(from)), D(), to); });
  } else if constexpr (std::is_same_v<T, float>) {
    std::copy_n(source, count, row);
  } else {
    ForVectors(source, row, count, [](const T* from, float* to) HWY_ATTR { hn::StoreU(LoadStored(from), D(), to); });
  }
}

template <class T>
void StoreRow(const RowFormat& format, const ByteCurve& curve, const float* row, std::size_t count, T* result) {
  const D d;
  if (format.alpha != RowAlpha::Plain) {
    if (format.channels == 2) return StoreAlpha<T, 2>(format, curve, row, count, result);
    return StoreAlpha<T, 4>(format, curve, row, count, result);
  }
  if (format.curve) {
    ForVectors(row, result, count, [&](const float* from, T* to) HWY_ATTR {
      const V linear = hn::LoadU(d, from);
      if constexpr (std::is_same_v<T, std::uint8_t>) {
        StoreWhole(EncodeByte(curve, linear), to);
      } else {
        StoreRounded(hn::Mul(LinearToSrgb(d, linear), hn::Set(d, full_range(kPixelTypeOf<T>))), to);
      }
    });
  } else if constexpr (std::is_same_v<T, float>) {
    std::copy_n(row, count, result);
  } else {
    ForVectors(row, result, count, [](const float* from, T* to) HWY_ATTR { StoreRounded(hn::LoadU(D(), from), to); });
  }
}

void LoadAny(const RowFormat& format, const ByteCurve& curve, const std::byte* source, std::size_t count, float* row) {
  visit_type(format.type,
             [&](auto zero) { LoadRow(format, curve, reinterpret_cast<const decltype(zero)*>(source), count, row); });
}

void StoreAny(const RowFormat& format, const ByteCurve& curve, const float* row, std::size_t count, std::byte* result) {
  visit_type(format.type,
             [&](auto zero) { StoreRow(format, curve, row, count, reinterpret_cast<decltype(zero)*>(result)); });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo {
namespace kernels {

HWY_EXPORT(LoadAny);
HWY_EXPORT(StoreAny);

}  // namespace kernels

void load_row(const RowFormat& format, const std::byte* source, int pixels, float* row) {
  using namespace kernels;
  HWY_DYNAMIC_DISPATCH(LoadAny)(format, byte_curve(), source, format.values(pixels), row);
}

void store_row(const RowFormat& format, const float* row, int pixels, std::byte* result) {
  using namespace kernels;
  HWY_DYNAMIC_DISPATCH(StoreAny)(format, byte_curve(), row, format.values(pixels), result);
}

}  // namespace azulejo
#endif
