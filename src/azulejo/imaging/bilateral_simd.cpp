// How it is fast. The weight between two pixels is the same seen from either: it is computed once, when the window's middle
// is the upper one, or the left one, and kept for the row where it is the other. Exponentials are powers of a polynomial,
// without a table.
#include "azulejo/imaging/bilateral_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/bilateral_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;

/// The weights of several exponents. Step by step for all: each step waits for the one before.
template <int kVectors>
HWY_INLINE void Weigh(Floats* HWY_RESTRICT values) {
  const FloatTag d;
  const auto one = hn::Set(d, 1.0F);
  Floats power[kVectors];
  for (int v = 0; v < kVectors; ++v) values[v] = hn::IfThenElse(hn::Lt(values[v], one), values[v], one);
  for (int v = 0; v < kVectors; ++v) power[v] = hn::Mul(values[v], hn::Set(d, -1.0F / 6));
  for (int v = 0; v < kVectors; ++v) power[v] = hn::Add(power[v], hn::Set(d, 0.5F));
  for (int v = 0; v < kVectors; ++v) power[v] = hn::Mul(power[v], values[v]);
  for (int v = 0; v < kVectors; ++v) power[v] = hn::Sub(power[v], one);
  for (int v = 0; v < kVectors; ++v) power[v] = hn::Mul(power[v], values[v]);
  for (int v = 0; v < kVectors; ++v) power[v] = hn::Add(power[v], one);
  for (int i = 1; i < kBilateralPower; i *= 2) {
    for (int v = 0; v < kVectors; ++v) power[v] = hn::Mul(power[v], power[v]);
  }
  for (int v = 0; v < kVectors; ++v) values[v] = power[v];
}

/// What a row of results needs of an offset.
struct Pair {
  std::ptrdiff_t step;  ///< to the other pixel
  float distance;
  const float* opposite;  ///< the weights of the pixels opposite, seen from them
  float* kept;            ///< where those of the other pixels are kept
  bool known;             ///< … are already
};

template <int kChannels>
class Filter {
 public:
  Filter(const BilateralPlanes& planes, const std::vector<BilateralOffset>& offsets, Scratch& scratch)
      : planes_(planes),
        offsets_(offsets),
        plane_((planes.height + 2 * planes.radius) * planes.stride),
        kept_(scratch.take<float*>(offsets.size())),
        pairs_(scratch.take<Pair>(offsets.size())) {
    for (std::size_t o = 0; o < offsets.size(); ++o) {
      kept_[o] = scratch.take<float>(static_cast<std::size_t>((offsets[o].dy + 1) * planes.stride));
    }
  }

  void Run(float* changes, std::ptrdiff_t stride) const {
    const int radius = planes_.radius;
    for (int y = -radius; y < planes_.height; ++y) {
      for (std::size_t o = 0; o < offsets_.size(); ++o) {
        // In its own row and above the first one, weights are needed before, or only, by others.
        if (offsets_[o].dy == 0 ? y >= 0 : (y < 0 && y >= -offsets_[o].dy)) WeighRow(o, y);
      }
      if (y >= 0) Row(y, changes + y * stride, planes_.height * stride);
    }
  }

 private:
  const float* At(int y, std::ptrdiff_t x) const {
    return planes_.values + (y + planes_.radius) * planes_.stride + bilateral_margin(planes_.radius) + x;
  }
  /// The weights of an offset are kept as many rows as there are to the pixel that asks for them last.
  float* KeptAt(std::size_t o, int y) const {
    const int row = (y + planes_.radius) % (offsets_[o].dy + 1);
    return kept_[o] + row * planes_.stride + bilateral_margin(planes_.radius);
  }
  std::ptrdiff_t Begin() const { return -((planes_.radius + 15) / 16 * 16); }
  std::ptrdiff_t End() const { return planes_.width + planes_.radius; }

  /// The weights of one offset, for all pixels of a row that are asked for.
  void WeighRow(std::size_t o, int y) const {
    const FloatTag d;
    const BilateralOffset& offset = offsets_[o];
    float* const kept = KeptAt(o, y);
    for (std::ptrdiff_t x = Begin(); x < End(); x += static_cast<std::ptrdiff_t>(hn::Lanes(d))) {
      const float* const from = At(y, x);
      auto t = hn::Set(d, offset.distance);
      for (int c = 0; c < kChannels; ++c) {
        const auto other = hn::LoadU(d, from + c * plane_ + offset.dy * planes_.stride + offset.dx);
        const auto difference = hn::Sub(other, hn::LoadU(d, from + c * plane_));
        t = hn::Add(t, hn::Mul(difference, difference));
      }
      Weigh<1>(&t);
      hn::StoreU(t, d, kept + x);
    }
  }

  /// A row of results. What lies beside it is computed for the weights only.
  void Row(int y, float* changes, std::ptrdiff_t changes_plane) const {
    const FloatTag d;
    for (std::size_t o = 0; o < offsets_.size(); ++o) {
      const BilateralOffset& offset = offsets_[o];
      pairs_[o] = {offset.dy * planes_.stride + offset.dx, offset.distance, KeptAt(o, y - offset.dy) - offset.dx,
                   KeptAt(o, y), offset.dy == 0};
    }
    const std::ptrdiff_t step = kTogether * static_cast<std::ptrdiff_t>(hn::Lanes(d));
    std::ptrdiff_t x = Begin();
    for (; x + step <= End(); x += step) Pixels<kTogether>(y, x, changes, changes_plane);
    for (; x < End(); x += static_cast<std::ptrdiff_t>(hn::Lanes(d))) Pixels<1>(y, x, changes, changes_plane);
  }

  /// Some vectors of results from x on.
  template <int kVectors>
  HWY_INLINE void Pixels(int y, std::ptrdiff_t x, float* changes, std::ptrdiff_t changes_plane) const {
    const FloatTag d;
    const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
    const float* const middle = At(y, x);
    Floats sum[kVectors];
    Floats change[kVectors][kChannels];
    for (int v = 0; v < kVectors; ++v) {
      sum[v] = hn::Set(d, 1.0F);
      for (auto& each : change[v]) each = hn::Zero(d);
    }
    for (std::size_t o = 0; o < offsets_.size(); ++o) {
      const Pair& pair = pairs_[o];
      const auto minus_own = [&](Floats other, int v, int c)
                                 HWY_ATTR { return hn::Sub(other, hn::LoadU(d, middle + c * plane_ + v * lanes)); };
      Floats weight[kVectors];
      Floats difference[kVectors][kChannels];
      for (int v = 0; v < kVectors; ++v) {
        weight[v] = hn::Set(d, pair.distance);
        for (int c = 0; c < kChannels; ++c) {
          difference[v][c] = minus_own(hn::LoadU(d, middle + c * plane_ + pair.step + v * lanes), v, c);
          weight[v] = hn::Add(weight[v], hn::Mul(difference[v][c], difference[v][c]));
        }
      }
      if (pair.known) {
        for (int v = 0; v < kVectors; ++v) weight[v] = hn::LoadU(d, pair.kept + x + v * lanes);
      } else {
        Weigh<kVectors>(weight);
        for (int v = 0; v < kVectors; ++v) hn::StoreU(weight[v], d, pair.kept + x + v * lanes);
      }
      for (int v = 0; v < kVectors; ++v) {
        const auto opposite = hn::LoadU(d, pair.opposite + x + v * lanes);
        sum[v] = hn::Add(hn::Add(sum[v], opposite), weight[v]);
        for (int c = 0; c < kChannels; ++c) {
          const auto before = minus_own(hn::LoadU(d, middle + c * plane_ - pair.step + v * lanes), v, c);
          change[v][c] = hn::Add(change[v][c], hn::Mul(opposite, before));
          change[v][c] = hn::Add(change[v][c], hn::Mul(weight[v], difference[v][c]));
        }
      }
    }
    for (int v = 0; v < kVectors; ++v) {
      const std::ptrdiff_t at = x + v * lanes;
      if (at < 0 || at >= planes_.width) continue;
      for (int c = 0; c < kChannels; ++c) {
        hn::StoreU(hn::Div(change[v][c], sum[v]), d, changes + c * changes_plane + at);
      }
    }
  }

  static constexpr int kTogether = kChannels == 1 ? 4 : 2;  ///< vectors: as many as there are registers for

  const BilateralPlanes planes_;
  const std::vector<BilateralOffset>& offsets_;
  const std::ptrdiff_t plane_;  ///< from a channel to the next
  float** const kept_;
  Pair* const pairs_;
};

void Planes(const BilateralPlanes& planes, const std::vector<BilateralOffset>& offsets, float* changes,
            std::ptrdiff_t stride, Scratch& scratch) {
  switch (planes.channels) {
    case 1: return Filter<1>(planes, offsets, scratch).Run(changes, stride);
    case 2: return Filter<2>(planes, offsets, scratch).Run(changes, stride);
    case 3: return Filter<3>(planes, offsets, scratch).Run(changes, stride);
    default: return Filter<4>(planes, offsets, scratch).Run(changes, stride);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Planes);

void bilateral_planes(const BilateralPlanes& planes, const std::vector<BilateralOffset>& offsets, float* changes,
                      std::ptrdiff_t changes_stride, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(Planes)(planes, offsets, changes, changes_stride, scratch);
}

}  // namespace azulejo::kernels
#endif
