#include "azulejo/imaging/clahe_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/clahe_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "azulejo/imaging/stored_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Below this, mixing whole tables for the row costs more than mixing for each pixel; tuned on 1920×1080.
constexpr std::size_t kShort = 48;
constexpr std::size_t kBlock = 256;  ///< pixels at a time

/// scratch[2 i] and [2 i + 1]: entry i of the left and the right tables, mixed from above and below.
template <class D, class Mix>
HWY_INLINE void MixTables(D d, const hn::TFromD<D>* const tables[4], std::size_t count, hn::TFromD<D>* scratch,
                          const Mix& mix) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto left = mix(hn::LoadU(d, tables[0] + i), hn::LoadU(d, tables[2] + i));
    const auto right = mix(hn::LoadU(d, tables[1] + i), hn::LoadU(d, tables[3] + i));
    hn::StoreInterleaved2(left, right, d, scratch + 2 * i);
  }
}

/// result[i] = pairs[source[i]], two 16-bit entries each. Single loads are faster than gathers on most machines; eight
/// bytes are read at once, lest the compiler makes vectors of the indices and takes them apart again.
HWY_INLINE void LookUpPairs(const std::uint8_t* source, std::size_t count, const std::int16_t* pairs,
                            std::int16_t* result) {
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, source + i, 8);
    for (int k = 0; k < 8; k += 2, eight >>= 16) {
      std::uint32_t two[2];
      std::memcpy(&two[0], pairs + 2 * (eight & 0xFF), 4);
      std::memcpy(&two[1], pairs + 2 * (eight >> 8 & 0xFF), 4);
      const std::uint64_t both = two[0] | static_cast<std::uint64_t>(two[1]) << 32;
      std::memcpy(result + 2 * (i + static_cast<std::size_t>(k)), &both, 8);
    }
  }
  for (; i < count; ++i) std::memcpy(result + 2 * i, pairs + 2 * source[i], 4);
}

void MapBytes(const ClaheStretch<std::uint8_t>& stretch) {
  if (stretch.count < kShort) return clahe_map_reference(stretch);
  const hn::ScalableTag<std::int16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const auto mix = [](auto a, auto b, auto weight)
                       HWY_ATTR { return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), weight)); };
  const auto down = hn::Set(d, static_cast<std::int16_t>(stretch.down));
  MixTables(d, stretch.tables, 256, stretch.scratch, [&](auto a, auto b) HWY_ATTR { return mix(a, b, down); });
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::int16_t pairs[2 * kBlock];
  for (std::size_t begin = 0; begin < stretch.count; begin += kBlock) {
    const std::size_t count = std::min(kBlock, stretch.count - begin);
    LookUpPairs(stretch.source + begin, count, stretch.scratch, pairs);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
      auto left = hn::Zero(d);
      auto right = hn::Zero(d);
      hn::LoadInterleaved2(d, pairs + 2 * i, left, right);
      const auto mixed = mix(left, right, hn::LoadU(d, stretch.across + begin + i));
      const auto rounded = hn::ShiftRight<7>(hn::Add(mixed, hn::Set(d, 64)));
      hn::StoreU(hn::DemoteTo(d8, rounded), d8, stretch.result + begin + i);
    }
    for (; i < count; ++i) {
      stretch.result[begin + i] = clahe_mapped(pairs[2 * i], pairs[2 * i + 1], stretch.across[begin + i]);
    }
  }
}

template <class D>
HWY_INLINE void StoreValues(D d, hn::Vec<D> mapped, hn::Vec<D> value, float* result) {
  hn::StoreU(hn::IfThenElse(hn::Eq(value, value), mapped, value), d, result);
}
template <class D>
HWY_INLINE void StoreValues(D d, hn::Vec<D> mapped, hn::Vec<D>, std::uint16_t* result) {
  const hn::Rebind<std::uint16_t, D> d16;
  const hn::RebindToSigned<D> di;
  const auto stored = hn::Min(hn::Mul(mapped, hn::Set(d, 65536.0F)), hn::Set(d, 65535.0F));
  hn::StoreU(hn::DemoteTo(d16, hn::ConvertTo(di, stored)), d16, result);
}

/// Places of values on the scale of bins. NaN becomes 0, whatever minima do with it, and is put back on storing.
template <class T, class D>
HWY_INLINE hn::Vec<D> Places(D d, hn::Vec<D> value) {
  if constexpr (std::is_same_v<T, float>) {
    const auto positive = hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), value);
    return hn::Mul(hn::Min(positive, hn::Set(d, 1.0F)), hn::Set(d, 1024.0F));
  } else {
    return hn::Mul(hn::Add(value, hn::Set(d, 0.5F)), hn::Set(d, 1024.0F / 65536.0F));
  }
}

template <class T>
void MapValues(const ClaheStretch<T>& stretch) {
  if (stretch.count < kShort) return clahe_map_reference(stretch);
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const auto unit = hn::Set(d, 1.0F / kClaheUnit);
  const auto mix = [](auto a, auto b, auto weight) HWY_ATTR { return hn::Add(a, hn::Mul(hn::Sub(b, a), weight)); };
  const auto down = hn::Mul(hn::Set(d, static_cast<float>(stretch.down)), unit);
  MixTables(d, stretch.tables, 1024, stretch.scratch, [&](auto a, auto b) HWY_ATTR { return mix(a, b, down); });
  stretch.scratch[2048] = clahe_mix(stretch.tables[0][1024], stretch.tables[2][1024], stretch.down);
  stretch.scratch[2049] = clahe_mix(stretch.tables[1][1024], stretch.tables[3][1024], stretch.down);
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::int32_t bins[kBlock];
  HWY_ALIGN float ends[4 * kBlock];  // of each pixel: left and right at its bin, left and right behind it
  const std::size_t whole = stretch.count / lanes * lanes;
  for (std::size_t begin = 0; begin < whole; begin += kBlock) {
    const std::size_t count = std::min(kBlock, whole - begin);
    for (std::size_t i = 0; i < count; i += lanes) {
      const auto place = Places<T>(d, LoadStored(stretch.source + begin + i));
      hn::Store(hn::Min(hn::ConvertTo(di, place), hn::Set(di, 1023)), di, bins + i);
    }
    for (std::size_t i = 0; i < count; ++i) std::memcpy(ends + 4 * i, stretch.scratch + 2 * bins[i], 16);
    for (std::size_t i = 0; i < count; i += lanes) {
      const auto value = LoadStored(stretch.source + begin + i);
      const auto part = hn::Sub(Places<T>(d, value), hn::ConvertTo(d, hn::Load(di, bins + i)));
      const auto across = hn::PromoteTo(di, hn::LoadU(d16, stretch.across + begin + i));
      const auto weight = hn::Mul(hn::ConvertTo(d, across), unit);
      auto left = hn::Zero(d);
      auto right = hn::Zero(d);
      auto next_left = hn::Zero(d);
      auto next_right = hn::Zero(d);
      hn::LoadInterleaved4(d, ends + 4 * i, left, right, next_left, next_right);
      const auto low = mix(left, right, weight);
      StoreValues(d, mix(low, mix(next_left, next_right, weight), part), value, stretch.result + begin + i);
    }
  }
  ClaheStretch<T> rest = stretch;
  rest.source += whole;
  rest.result += whole;
  rest.across += whole;
  rest.count -= whole;
  clahe_map_reference(rest);
}

void MapWords(const ClaheStretch<std::uint16_t>& stretch) { MapValues(stretch); }
void MapFloats(const ClaheStretch<float>& stretch) { MapValues(stretch); }

template <class T>
void Shift(const ClaheShift<T>& shift) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= shift.pixels; i += lanes) {
    const auto before = hn::LoadU(d, shift.before + i);
    const auto after = hn::LoadU(d, shift.after + i);
    const auto shifted = [&](auto color) HWY_ATTR {
      if constexpr (std::is_same_v<T, float>) {
        return hn::Add(color, hn::Sub(after, before));
      } else {
        // One of the two steps is none.
        return hn::SaturatedSub(hn::SaturatedAdd(color, hn::SaturatedSub(after, before)),
                                hn::SaturatedSub(before, after));
      }
    };
    auto r = hn::Undefined(d);
    auto g = hn::Undefined(d);
    auto b = hn::Undefined(d);
    if (shift.channels == 3) {
      hn::LoadInterleaved3(d, shift.source + 3 * i, r, g, b);
      hn::StoreInterleaved3(shifted(r), shifted(g), shifted(b), d, shift.result + 3 * i);
    } else {
      auto a = hn::Undefined(d);
      hn::LoadInterleaved4(d, shift.source + 4 * i, r, g, b, a);
      hn::StoreInterleaved4(shifted(r), shifted(g), shifted(b), a, d, shift.result + 4 * i);
    }
  }
  clahe_shift_reference(shift, i);
}

void ShiftBytes(const ClaheShift<std::uint8_t>& shift) { Shift(shift); }
void ShiftWords(const ClaheShift<std::uint16_t>& shift) { Shift(shift); }
void ShiftFloats(const ClaheShift<float>& shift) { Shift(shift); }

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(MapBytes);
HWY_EXPORT(MapWords);
HWY_EXPORT(MapFloats);
HWY_EXPORT(ShiftBytes);
HWY_EXPORT(ShiftWords);
HWY_EXPORT(ShiftFloats);

void clahe_map(const ClaheStretch<std::uint8_t>& stretch) { HWY_DYNAMIC_DISPATCH(MapBytes)(stretch); }
void clahe_map(const ClaheStretch<std::uint16_t>& stretch) { HWY_DYNAMIC_DISPATCH(MapWords)(stretch); }
void clahe_map(const ClaheStretch<float>& stretch) { HWY_DYNAMIC_DISPATCH(MapFloats)(stretch); }
void clahe_shift(const ClaheShift<std::uint8_t>& shift) { HWY_DYNAMIC_DISPATCH(ShiftBytes)(shift); }
void clahe_shift(const ClaheShift<std::uint16_t>& shift) { HWY_DYNAMIC_DISPATCH(ShiftWords)(shift); }
void clahe_shift(const ClaheShift<float>& shift) { HWY_DYNAMIC_DISPATCH(ShiftFloats)(shift); }

}  // namespace azulejo::kernels
#endif
