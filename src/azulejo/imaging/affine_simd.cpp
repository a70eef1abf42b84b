#include "azulejo/imaging/affine_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/affine_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstring>

#include "azulejo/math/truncate_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using Four = hn::FixedTag<float, 4>;  // the channels of a pixel, or four taps of one channel
using V4 = hn::Vec<Four>;

void AffinePlacesOf(const AffineSpan& span, AffinePlaces& places) {
  const D d;
  const DI di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto position = [&](V n, float start, float step, std::int32_t shift, std::int32_t* whole_of, float* rest_of)
                            HWY_ATTR {
                              const V at = hn::Add(hn::Set(d, start), hn::Mul(n, hn::Set(d, step)));
                              const V whole = hn::Floor(at);
                              hn::Store(hn::Add(Truncated(whole), hn::Set(di, shift)), di, whole_of);
                              hn::Store(hn::Sub(at, whole), d, rest_of);
                            };
  for (int i = 0; i < span.count; i += lanes) {
    const V n = hn::Iota(d, static_cast<float>(span.begin + i));
    position(n, span.x, span.step_x, span.column, places.column + i, places.x + i);
    position(n, span.y, span.step_y, span.row, places.row + i, places.y + i);
  }
}

template <class DF, class VF>
HWY_INLINE VF Between(DF, VF from, VF to, VF share) {
  return hn::Add(from, hn::Mul(hn::Sub(to, from), share));
}

void BilinearGray(const AffinePatch& patch, const AffinePlaces& places, int count, float* result) {
  const D d;
  const DI di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto stride = hn::Set(di, static_cast<std::int32_t>(patch.stride));
  HWY_ALIGN float rest[HWY_MAX_BYTES / sizeof(float)];
  for (int i = 0; i < count; i += lanes) {
    // Behind the last pixel there are no places: those of the first are taken.
    const auto real = hn::Lt(hn::Iota(di, i), hn::Set(di, count));
    const auto at =
        hn::IfThenElse(real, hn::Add(hn::Mul(hn::Load(di, places.row + i), stride), hn::Load(di, places.column + i)),
                       hn::Set(di, static_cast<std::int32_t>(patch.at(places, 0) - patch.values)));
    const V y = hn::Load(d, places.y + i);
    const float* const lower = patch.values + patch.stride;
    const V left = Between(d, hn::GatherIndex(d, patch.values, at), hn::GatherIndex(d, lower, at), y);
    const V right = Between(d, hn::GatherIndex(d, patch.values + 1, at), hn::GatherIndex(d, lower + 1, at), y);
    const V mixed = Between(d, left, right, hn::Load(d, places.x + i));
    if (i + lanes <= count) {
      hn::StoreU(mixed, d, result + i);
      continue;
    }
    hn::Store(mixed, d, rest);
    for (int k = i; k < count; ++k) result[k] = rest[k - i];
  }
}

/// Of three or four channels.
template <int kChannels>
void BilinearColor(const AffinePatch& patch, const AffinePlaces& places, int count, float* result) {
  const Four d;
  for (int i = 0; i < count; ++i) {
    const float* const upper = patch.values + places.row[i] * patch.stride + places.column[i] * kChannels;
    const float* const lower = upper + patch.stride;
    const V4 y = hn::Set(d, places.y[i]);
    const V4 left = Between(d, hn::LoadU(d, upper), hn::LoadU(d, lower), y);
    const V4 right = Between(d, hn::LoadU(d, upper + kChannels), hn::LoadU(d, lower + kChannels), y);
    hn::StoreU(Between(d, left, right, hn::Set(d, places.x[i])), d, result + kChannels * i);
  }
}

void AffineBilinear(const AffinePatch& patch, const AffinePlaces& places, int count, float* result) {
  switch (patch.channels) {
    case 1: return BilinearGray(patch, places, count, result);
    case 3: return BilinearColor<3>(patch, places, count, result);
    case 4: return BilinearColor<4>(patch, places, count, result);
    default: return affine_bilinear_reference(patch, places, count, result);
  }
}

/// Four neighboring bytes as they lie in memory.
HWY_INLINE std::int32_t FourBytes(const std::uint8_t* bytes) {
  std::int32_t four;
  std::memcpy(&four, bytes, sizeof four);
  return four;
}

void BilinearGrayBytes(const AffineBytes& source, const AffinePlaces& places, int count, std::uint8_t* result) {
  const D d;
  const DI di;
  const hn::Rebind<std::uint8_t, D> d8;
  const int lanes = static_cast<int>(hn::Lanes(d));
  HWY_ALIGN std::int32_t upper[kAffineBlock];
  HWY_ALIGN std::int32_t lower[kAffineBlock];
  for (int i = 0; i < count; ++i) {
    const std::uint8_t* const window = source.values + places.row[i] * source.stride + places.column[i];
    upper[i] = FourBytes(window);
    lower[i] = FourBytes(window + source.stride);
  }
  const auto byte = hn::Set(di, 255);
  HWY_ALIGN std::uint8_t rounded[kAffineBlock];
  for (int i = 0; i < count; i += lanes) {
    const V y = hn::Load(d, places.y + i);
    const auto above = hn::Load(di, upper + i);
    const auto below = hn::Load(di, lower + i);
    const auto value_of = [&](hn::Vec<DI> whole) HWY_ATTR { return hn::ConvertTo(d, hn::And(whole, byte)); };
    const V left = Between(d, value_of(above), value_of(below), y);
    const V right = Between(d, value_of(hn::ShiftRight<8>(above)), value_of(hn::ShiftRight<8>(below)), y);
    const V value = Between(d, left, right, hn::Load(d, places.x + i));
    hn::StoreU(hn::DemoteTo(d8, Truncated(hn::Add(value, hn::Set(d, 0.5F)))), d8, rounded + i);
  }
  std::memcpy(result, rounded, static_cast<std::size_t>(count));
}

/// The left and the right pixel of a window, between its rows.
struct Sides {
  V4 left;
  V4 right;
};

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
/// Both at once.
template <int kChannels>
HWY_INLINE Sides SidesOf(const std::uint8_t* upper, const std::uint8_t* lower, float y) {
  const hn::FixedTag<float, 8> d;
  const hn::FixedTag<std::int32_t, 8> di;
  const hn::FixedTag<std::uint8_t, 8> d8;
  HWY_ALIGN static constexpr std::uint8_t kSpread[8] = {0, 1, 2, 2, 3, 4, 5, 5};
  const auto load = [&](const std::uint8_t* bytes) HWY_ATTR {
    auto pair = hn::LoadU(d8, bytes);
    if constexpr (kChannels == 3) pair = hn::TableLookupBytes(pair, hn::Load(d8, kSpread));
    return hn::ConvertTo(d, hn::PromoteTo(di, pair));
  };
  const auto both = Between(d, load(upper), load(lower), hn::Set(d, y));
  return {hn::LowerHalf(Four(), both), hn::UpperHalf(Four(), both)};
}
#else
template <int kChannels>
HWY_INLINE Sides SidesOf(const std::uint8_t* upper, const std::uint8_t* lower, float y) {
  const Four d;
  const auto load = [&](const std::uint8_t* bytes) HWY_ATTR {
    return hn::ConvertTo(
        d, hn::PromoteTo(hn::FixedTag<std::int32_t, 4>(), hn::LoadU(hn::FixedTag<std::uint8_t, 4>(), bytes)));
  };
  const V4 share = hn::Set(d, y);
  return {Between(d, load(upper), load(lower), share),
          Between(d, load(upper + kChannels), load(lower + kChannels), share)};
}
#endif

template <int kChannels>
void BilinearColorBytes(const AffineBytes& source, const AffinePlaces& places, int count, std::uint8_t* result) {
  const Four d;
  const hn::FixedTag<std::uint8_t, 4> d8;
  HWY_ALIGN std::uint8_t rounded[4 * kAffineBlock];
  const V4 half = hn::Set(d, 0.5F);
  for (int i = 0; i < count; ++i) {
    const std::uint8_t* const upper = source.values + places.row[i] * source.stride + places.column[i] * kChannels;
    const Sides sides = SidesOf<kChannels>(upper, upper + source.stride, places.y[i]);
    const V4 value = Between(d, sides.left, sides.right, hn::Set(d, places.x[i]));
    hn::StoreU(hn::DemoteTo(d8, Truncated(hn::Add(value, half))), d8, rounded + kChannels * i);
  }
  std::memcpy(result, rounded, static_cast<std::size_t>(kChannels * count));
}

void AffineBilinearBytes(const AffineBytes& source, const AffinePlaces& places, int count, std::uint8_t* result) {
  switch (source.channels) {
    case 1: return BilinearGrayBytes(source, places, count, result);
    case 3: return BilinearColorBytes<3>(source, places, count, result);
    default: return BilinearColorBytes<4>(source, places, count, result);
  }
}

/// The weights for a rest, as affine_weight gives them.
HWY_INLINE void WeightsFor(const AffineWeights& weights, float rest, float* out) {
  const Four d;
  const float place = rest * static_cast<float>(weights.phases);
  const int whole = static_cast<int>(place);
  const int phase = whole < weights.phases ? whole : weights.phases - 1;
  const V4 share = hn::Set(d, place - static_cast<float>(phase));
  const float* const near = weights.values + static_cast<std::ptrdiff_t>(phase) * weights.taps;
  for (int tap = 0; tap < weights.taps; tap += 4)
    hn::StoreU(Between(d, hn::LoadU(d, near + tap), hn::LoadU(d, near + weights.taps + tap), share), d, out + tap);
}

HWY_INLINE V4 GraySum(const float* row, const float* weights, int taps) {
  const Four d;
  V4 sum = hn::Mul(hn::LoadU(d, weights), hn::LoadU(d, row));
  for (int j = 4; j < taps; j += 4) sum = hn::Add(sum, hn::Mul(hn::LoadU(d, weights + j), hn::LoadU(d, row + j)));
  return sum;
}

template <int kChannels>
HWY_INLINE V4 ColorSum(const float* row, const float* weights, int taps) {
  const Four d;
  V4 sum = hn::Mul(hn::Set(d, weights[0]), hn::LoadU(d, row));
  for (int j = 1; j < taps; ++j) sum = hn::Add(sum, hn::Mul(hn::Set(d, weights[j]), hn::LoadU(d, row + j * kChannels)));
  return sum;
}

template <int kChannels>
HWY_INLINE V4 RowSum(const float* row, const float* weights, int taps) {
  if constexpr (kChannels == 1) {
    return GraySum(row, weights, taps);
  } else {
    return ColorSum<kChannels>(row, weights, taps);
  }
}

/// kTaps: of both windows, where they are small; 0: any
template <int kChannels, int kTaps>
void WeightedSums(const AffinePatch& patch, const AffinePlaces& places, const AffineWeights& across,
                  const AffineWeights& down, int count, float* result) {
  const Four d;
  HWY_ALIGN float across_weights[kAffineMostTaps];
  HWY_ALIGN float down_weights[kAffineMostTaps];
  const int columns = kTaps > 0 ? kTaps : across.taps;
  const int rows = kTaps > 0 ? kTaps : down.taps;
  for (int i = 0; i < count; ++i) {
    WeightsFor(across, places.x[i], across_weights);
    WeightsFor(down, places.y[i], down_weights);
    const float* row = patch.values + places.row[i] * patch.stride + places.column[i] * kChannels;
    V4 sum = hn::Mul(hn::Set(d, down_weights[0]), RowSum<kChannels>(row, across_weights, columns));
    for (int k = 1; k < rows; ++k) {
      row += patch.stride;
      sum = hn::Add(sum, hn::Mul(hn::Set(d, down_weights[k]), RowSum<kChannels>(row, across_weights, columns)));
    }
    if constexpr (kChannels == 1) {
      HWY_ALIGN float sums[4];
      hn::Store(sum, d, sums);
      result[i] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    } else {
      hn::StoreU(sum, d, result + kChannels * i);
    }
  }
}

template <int kChannels>
void WeightedOf(const AffinePatch& patch, const AffinePlaces& places, const AffineWeights& across,
                const AffineWeights& down, int count, float* result) {
  if (across.taps == 4 && down.taps == 4) return WeightedSums<kChannels, 4>(patch, places, across, down, count, result);
  return WeightedSums<kChannels, 0>(patch, places, across, down, count, result);
}

void AffineWeighted(const AffinePatch& patch, const AffinePlaces& places, const AffineWeights& across,
                    const AffineWeights& down, int count, float* result) {
  switch (patch.channels) {
    case 1: return WeightedOf<1>(patch, places, across, down, count, result);
    case 3: return WeightedOf<3>(patch, places, across, down, count, result);
    case 4: return WeightedOf<4>(patch, places, across, down, count, result);
    default: return affine_weighted_reference(patch, places, across, down, count, result);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(AffinePlacesOf);
HWY_EXPORT(AffineBilinear);
HWY_EXPORT(AffineBilinearBytes);
HWY_EXPORT(AffineWeighted);

void affine_places(const AffineSpan& span, AffinePlaces& places) { HWY_DYNAMIC_DISPATCH(AffinePlacesOf)(span, places); }
void affine_bilinear(const AffinePatch& patch, const AffinePlaces& places, int count, float* result) {
  HWY_DYNAMIC_DISPATCH(AffineBilinear)(patch, places, count, result);
}
void affine_bilinear_bytes(const AffineBytes& source, const AffinePlaces& places, int count, std::uint8_t* result) {
  HWY_DYNAMIC_DISPATCH(AffineBilinearBytes)(source, places, count, result);
}
void affine_weighted(const AffinePatch& patch, const AffinePlaces& places, const AffineWeights& across,
                     const AffineWeights& down, int count, float* result) {
  HWY_DYNAMIC_DISPATCH(AffineWeighted)(patch, places, across, down, count, result);
}

}  // namespace azulejo::kernels
#endif
