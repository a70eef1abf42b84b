#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "azulejo/imaging/tone.h"
#include "azulejo/math/transfer.h"

// Functions of one intensity, each as its definition and as a kernel that gives the same bytes with vectors.
namespace azulejo {

/// v^exponent, odd around 0.
struct PowerFunction {
  float operator()(float v) const { return std::copysign(power_deterministic(std::fabs(v), exponent), v); }
  float exponent = 1;
};

/// What is in [low, high] becomes `level`; the rest 0, or what it was.
struct SliceFunction {
  float operator()(float v) const { return v >= low && v <= high ? level : keep ? v : 0.0F; }
  float low = 0;
  float high = 1;
  float level = 1;
  bool keep = false;
};

/// The nearest of steps + 1 levels that divide 0–1 evenly.
struct StepFunction {
  float operator()(float v) const { return std::floor(cut(v, 0, 1) * steps + 0.5F) / steps; }
  float steps = 1;
};

/// Lines between points whose x grow; constant beyond the first and the last. NaN stays NaN.
struct CurveFunction {
  struct Point {
    float x, y;
    float slope;  ///< of the line to the next; 0: the last
  };
  float operator()(float v) const {
    float result = v != v ? v : points.front().y;
    for (const Point& each : points) {
      if (v >= each.x) result = each.y + (v - each.x) * each.slope;
    }
    return result;
  }
  std::vector<Point> points;
};

/// Lines between values at even distances, the first at `first`, the last at `first` + 1 / scale; constant beyond.
/// NaN stays NaN.
struct TableFunction {
  float operator()(float v) const {
    const auto intervals = static_cast<float>(values.size() - 1);
    const float place = (v - first) * scale * intervals;
    if (place != place) return v;
    const float inside = cut(place, 0, intervals);
    const float below = std::floor(inside < intervals ? inside : intervals - 1);
    const float* const value = values.data() + static_cast<int>(below);
    return value[0] + (value[1] - value[0]) * (inside - below);
  }
  float first = 0;
  float scale = 1;
  std::vector<float> values;  ///< at least 2
};

/// Light times a gain, of sRGB-encoded intensities.
struct GainFunction {
  float operator()(float v) const { return linear_to_srgb(srgb_to_linear(v) * gain); }
  float gain = 1;
};

namespace kernels {
void linear(const LinearFunction& function, const float* source, float* result, std::size_t count);
void power(const PowerFunction& function, const float* source, float* result, std::size_t count);
void slice(const SliceFunction& function, const float* source, float* result, std::size_t count);
void steps(const StepFunction& function, const float* source, float* result, std::size_t count);
void curve(const CurveFunction& function, const float* source, float* result, std::size_t count);
void table(const TableFunction& function, const float* source, float* result, std::size_t count);
void gain(const GainFunction& function, const float* source, float* result, std::size_t count);
}  // namespace kernels

using LinearTone = KernelTone<LinearFunction, kernels::linear>;
using PowerTone = KernelTone<PowerFunction, kernels::power>;
using SliceTone = KernelTone<SliceFunction, kernels::slice>;
using StepTone = KernelTone<StepFunction, kernels::steps>;
using CurveTone = KernelTone<CurveFunction, kernels::curve>;
using TableTone = KernelTone<TableFunction, kernels::table>;
using GainTone = KernelTone<GainFunction, kernels::gain>;

}  // namespace azulejo
