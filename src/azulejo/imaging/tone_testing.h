#pragma once

// For tests only: what every function of one intensity must do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "azulejo/data/image.h"

namespace azulejo {

using PointOperation = std::function<Image(const Image& source)>;
using ExactFunction = std::function<double(double intensity)>;

/// Every value there is, of an integer type, or 65536 of f32 in [−0.5, 1.5].
inline Image every_value(PixelType type) {
  Image image(type == PixelType::U8 ? 256 : 65536, 1, 1, type);
  visit(image.any(), [&](auto view) {
    using T = std::remove_pointer_t<decltype(view.data)>;
    for (int x = 0; x < view.width; ++x) {
      view(x, 0) = std::is_same_v<T, float> ? static_cast<T>(static_cast<double>(x) / 32768 - 0.5) : static_cast<T>(x);
    }
  });
  return image;
}

/// Integers are the function's value, rounded half up and saturated. Where it comes within `slack` levels of a half,
/// either neighbor will do.
inline void expect_rounded(const PointOperation& operation, const ExactFunction& exact, PixelType type, double slack) {
  const Image source = every_value(type);
  const Image result = operation(source);
  visit(result.any(), [&](auto view) {
    const auto top = static_cast<double>(full_range(type));
    for (int x = 0; x < view.width; ++x) {
      const double level = std::clamp(exact(x / top), 0.0, 1.0) * top;
      EXPECT_GE(view(x, 0), std::floor(level + 0.5 - slack)) << to_string(type) << " " << x << ": " << level;
      EXPECT_LE(view(x, 0), std::floor(level + 0.5 + slack)) << to_string(type) << " " << x << ": " << level;
    }
  });
}

/// f32 is within `absolute` + `relative` · |value| of the function, which also tells of values beyond 0–1.
inline void expect_real(const PointOperation& operation, const ExactFunction& exact, double absolute, double relative) {
  const Image source = every_value(PixelType::F32);
  const Image result = operation(source);
  for (int x = 0; x < source.width(); ++x) {
    const double wanted = exact(static_cast<double>(source.view<float>()(x, 0)));
    EXPECT_NEAR(result.view<float>()(x, 0), wanted, absolute + relative * std::abs(wanted)) << x;
  }
}

/// Alpha is copied, straight color is what it would be without alpha, premultiplied color is that times alpha.
inline void expect_alpha_is_left_alone(const PointOperation& operation) {
  constexpr int kPixels = 40;
  Image plain(kPixels, 1, 3, PixelType::F32);
  Image straight(kPixels, 1, 4, PixelType::F32);
  Image premultiplied(kPixels, 1, 4, PixelType::F32);
  premultiplied.set_states(ColorState::Srgb, AlphaState::Premultiplied);
  for (int x = 0; x < kPixels; ++x) {
    // Alphas that are powers of two: divided and multiplied without rounding.
    const float alpha = x % 5 == 4 ? 0.0F : 1.0F / static_cast<float>(1 << x % 5);
    for (int c = 0; c < 3; ++c) {
      const float color = static_cast<float>((x * 3 + c) * 37 % 128) / 128;
      plain.view<float>()(x, 0, c) = straight.view<float>()(x, 0, c) = color;
      premultiplied.view<float>()(x, 0, c) = color * alpha;
    }
    straight.view<float>()(x, 0, 3) = premultiplied.view<float>()(x, 0, 3) = alpha;
  }
  const Image plain_result = operation(plain);
  const Image straight_result = operation(straight);
  const Image premultiplied_result = operation(premultiplied);
  for (int x = 0; x < kPixels; ++x) {
    const float alpha = straight.view<float>()(x, 0, 3);
    EXPECT_EQ(straight_result.view<float>()(x, 0, 3), alpha);
    EXPECT_EQ(premultiplied_result.view<float>()(x, 0, 3), alpha);
    for (int c = 0; c < 3; ++c) {
      const float color = plain_result.view<float>()(x, 0, c);
      EXPECT_EQ(straight_result.view<float>()(x, 0, c), color) << x << " " << c;
      EXPECT_EQ(premultiplied_result.view<float>()(x, 0, c), color * alpha) << x << " " << c;
    }
  }
}

inline float of_one(const PointOperation& operation, float value) {
  Image source(1, 1, 1, PixelType::F32);
  source.view<float>()(0, 0) = value;
  return operation(source).view<float>()(0, 0);
}

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace azulejo
