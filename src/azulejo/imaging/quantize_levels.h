#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "azulejo/imaging/histogram_counts.h"
#include "azulejo/imaging/quantize.h"
#include "azulejo/imaging/quantize_kernels.h"
#include "azulejo/math/transfer.h"

namespace azulejo {

/// The levels of a quantization, and where values are among them.
template <class T>
class QuantizeLevels {
 public:
  QuantizeLevels(const QuantizeOptions& options, ColorState color)
      : last_(static_cast<float>(options.levels - 1)),
        curve_(options.light == Light::Linear && color == ColorState::Srgb) {
    for (int k = 0; k < options.levels; ++k) {
      values_.push_back(kernels::level_value<T>(static_cast<float>(k), last_));
      amounts_.push_back(curve_ ? light_of(values_.back()) : static_cast<float>(k));
      if (k > 0) middles_.push_back(0.5F * (amounts_[amounts_.size() - 2] + amounts_.back()));
    }
    if constexpr (!std::is_same_v<T, float>) {
      if (!curve_) return;
      const auto top = static_cast<std::size_t>(full_range(kPixelTypeOf<T>));
      for (std::size_t v = 0; v <= top; ++v) lights_.push_back(light_of(static_cast<T>(v)));
    }
  }

  float last() const { return last_; }
  bool curve() const { return curve_; }
  T value(std::size_t level) const { return values_[level]; }

  /// What is kept: light, 0–1, or the value in units of a level. NaN is not asked for.
  float amount(T value) const {
    if constexpr (std::is_same_v<T, float>) {
      const T inside = std::clamp(value, 0.0F, 1.0F);
      return curve_ ? srgb_to_linear(inside) : inside * last_;
    } else {
      return curve_ ? lights_[value] : kernels::place_of(value, last_);
    }
  }
  float amount_of(std::size_t level) const { return amounts_[level]; }
  /// The level whose amount is nearest.
  std::size_t nearest(float amount) const {
    if (!curve_) return static_cast<std::size_t>(kernels::level_at(amount, 0.5F, last_));
    return static_cast<std::size_t>(std::upper_bound(middles_.begin(), middles_.end(), amount) - middles_.begin());
  }

  /// Where a value is: the level below it, and its share of the way to the next.
  float place(T value) const {
    if (!curve_) return kernels::place_of(value, last_);
    const float light = amount(value);
    const auto above = std::upper_bound(amounts_.begin() + 1, amounts_.end() - 1, light);
    const float low = above[-1];
    return static_cast<float>(above - amounts_.begin() - 1) + (light - low) / (*above - low);
  }

 private:
  static float light_of(T value) { return srgb_to_linear(static_cast<float>(value) / full_range(kPixelTypeOf<T>)); }

  float last_;
  bool curve_;
  std::vector<T> values_;
  std::vector<float> amounts_;
  std::vector<float> middles_;  ///< between neighboring amounts
  std::vector<float> lights_;   ///< of each integer value
};

/// The same by ranks of bytes: the shares of the way to the next level that values have, in order.
class ByteLevels {
 public:
  explicit ByteLevels(const QuantizeLevels<std::uint8_t>& levels) {
    float shares[256];
    const auto highest = static_cast<std::size_t>(levels.last());
    for (std::size_t v = 0; v < 256; ++v) {
      const float place = levels.place(static_cast<std::uint8_t>(v));
      const std::size_t level = std::min(highest - 1, static_cast<std::size_t>(place));
      shares[v] = place - static_cast<float>(level);
      quantizer_.low[v] = levels.value(level);
      quantizer_.high[v] = levels.value(level + 1);
    }
    shares_.assign(shares, shares + 256);
    std::sort(shares_.begin(), shares_.end());
    shares_.erase(std::unique(shares_.begin(), shares_.end()), shares_.end());
    for (std::size_t v = 0; v < 256; ++v) quantizer_.rank[v] = static_cast<std::uint8_t>(below(shares[v]));
    quantizer_.binary = highest == 1 && shares_.size() == 256;
  }

  const kernels::ByteQuantizer& quantizer() const { return quantizer_; }
  /// Shares that reach the threshold have a higher rank. 0 is a share, and below each threshold.
  std::uint8_t rank(float threshold) const { return static_cast<std::uint8_t>(below(threshold) - 1); }

 private:
  std::ptrdiff_t below(float share) const {
    return std::lower_bound(shares_.begin(), shares_.end(), share) - shares_.begin();
  }

  kernels::ByteQuantizer quantizer_;
  std::vector<float> shares_;  ///< each once
};

/// Straight color of premultiplied color, or what is given; of alpha 0: 0.
template <class T>
T straight_color(const ImageInfo& info, T value, T alpha) {
  if (info.alpha != AlphaState::Premultiplied) return value;
  return alpha == T{0} ? T{0} : divided(value, alpha);
}
/// The way back.
template <class T>
T stored_color(const ImageInfo& info, T color, T alpha) {
  return info.alpha == AlphaState::Premultiplied ? multiplied(color, alpha) : color;
}

}  // namespace azulejo
