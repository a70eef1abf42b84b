#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "azulejo/engine/tile_node.h"

// What add, subtract, difference, multiply and divide share.
namespace azulejo {

enum class Arithmetic : std::uint8_t { Add, Subtract, Difference, Multiply, Divide };

/// The definitions of one stored value of each image without alpha. T is the source's type, Result what comes out.
template <class T>
struct AddValues {
  using Result = T;
  T operator()(T a, T b) const {
    if constexpr (std::is_same_v<T, float>) {
      return a + b;
    } else {
      constexpr int kTop = static_cast<T>(-1);
      return static_cast<T>(std::min(static_cast<int>(a) + static_cast<int>(b), kTop));
    }
  }
};

template <class T>
struct SubtractValues {
  using Result = float;
  float operator()(T a, T b) const {
    return (static_cast<float>(a) - static_cast<float>(b)) / full_range(kPixelTypeOf<T>);
  }
};

template <class T>
struct DifferenceValues {
  using Result = T;
  T operator()(T a, T b) const {
    if constexpr (std::is_same_v<T, float>) {
      return std::fabs(a - b);
    } else {
      return static_cast<T>(a > b ? a - b : b - a);
    }
  }
};

/// Of integers a · b ÷ full range, to the nearest: there is never a half.
template <class T>
struct MultiplyValues {
  using Result = T;
  T operator()(T a, T b) const {
    if constexpr (std::is_same_v<T, float>) {
      return a * b;
    } else {
      constexpr std::uint32_t kTop = static_cast<T>(-1);
      return static_cast<T>((std::uint32_t{a} * b + kTop / 2) / kTop);
    }
  }
};

template <class T>
struct DivideValues {
  using Result = float;
  float operator()(T a, T b) const { return b == T{0} ? by_zero : static_cast<float>(a) / static_cast<float>(b); }
  float by_zero = 0;
};

/// A step that makes each value from those of two images at its place; by_zero is the quotient by 0.
///
/// Sources fit as those of common_image do; one may be data beside colors. With alpha, color counts as far as it is seen:
/// sums take both on black and add their alphas, to 1 at most; differences take both on black and have no alpha; factors
/// and divisors are taken on white, and the first source keeps its alpha.
class ArithmeticNode : public TileNode {
 public:
  ArithmeticNode(Arithmetic operation, std::span<const ImageInfo> sources, float by_zero = 0);

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override;
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override;

 private:
  bool has_alpha() const { return sources()[0].alpha != AlphaState::None || sources()[1].alpha != AlphaState::None; }
  void run_plain(std::span<const ConstTile> sources, const Tile& result, Scratch& scratch) const;
  void run_seen(std::span<const ConstTile> sources, const Tile& result, Scratch& scratch) const;
  void combine(const float* source, const float* other, float* result) const;

  Arithmetic operation_;
  float by_zero_;
  int colors_;  ///< channels of the richer source, and of the result
};

/// The step of an operation; options.by_zero counts if there is one.
template <class Options, Arithmetic operation>
class ArithmeticStep final : public ArithmeticNode {
 public:
  ArithmeticStep(const Options& options, std::span<const ImageInfo> sources)
      : ArithmeticNode(operation, sources, by_zero(options)) {}

 private:
  static float by_zero(const Options& options) {
    if constexpr (operation == Arithmetic::Divide) {
      return options.by_zero;
    } else {
      return 0;
    }
  }
};

namespace kernels {
/// The definitions for rows of `count` values of the type, with vectors. The result may be one of them.
void arithmetic_row(Arithmetic operation, PixelType type, const std::byte* source, const std::byte* other,
                    std::size_t count, std::byte* result, float by_zero);
}  // namespace kernels

}  // namespace azulejo
