// The steps of color_space_steps.cpp for vectors: the same bytes. Compiled once for every vector target: included by
// *_simd.cpp.
#if defined(AZULEJO_IMAGING_COLOR_SPACE_STEPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_COLOR_SPACE_STEPS_INL_H
#undef AZULEJO_IMAGING_COLOR_SPACE_STEPS_INL_H
#else
#define AZULEJO_IMAGING_COLOR_SPACE_STEPS_INL_H
#endif

#include <hwy/highway.h>

#include "azulejo/imaging/color_space_steps.h"
#include "azulejo/math/arctangent_inl.h"
#include "azulejo/math/cube_root_inl.h"
#include "azulejo/math/sine_inl.h"
#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Each step is called with vectors of the three values of pixels, and changes them.
using StepTag = hn::ScalableTag<float>;
using StepVec = hn::Vec<StepTag>;

HWY_INLINE StepVec Number(float value) { return hn::Set(StepTag(), value); }
HWY_INLINE StepVec Larger(StepVec a, StepVec b) { return hn::IfThenElse(hn::Gt(a, b), a, b); }
HWY_INLINE StepVec Smaller(StepVec a, StepVec b) { return hn::IfThenElse(hn::Lt(a, b), a, b); }

struct ExtremesOfRgb {
  HWY_INLINE ExtremesOfRgb(StepVec r, StepVec g, StepVec b)
      : largest(Larger(Larger(r, g), b)), smallest(Smaller(Smaller(r, g), b)), range(hn::Sub(largest, smallest)) {}
  StepVec largest;
  StepVec smallest;
  StepVec range;
};

HWY_INLINE StepVec HueOfRgb(StepVec r, StepVec g, StepVec b, const ExtremesOfRgb& of, StepVec full) {
  const StepVec zero = hn::Zero(StepTag());
  const auto is_red = hn::Eq(r, of.largest);
  const auto is_green = hn::Eq(g, of.largest);
  const StepVec from = hn::IfThenElse(is_red, g, hn::IfThenElse(is_green, b, r));
  const StepVec minus = hn::IfThenElse(is_red, b, hn::IfThenElse(is_green, r, g));
  const StepVec difference = hn::Sub(from, minus);
  const StepVec red_corner = hn::IfThenElseZero(hn::Lt(difference, zero), Number(6.0F));
  const StepVec corner = hn::IfThenElse(is_red, red_corner, hn::IfThenElse(is_green, Number(2.0F), Number(4.0F)));
  const StepVec above = hn::Mul(full, hn::Add(difference, hn::Mul(corner, of.range)));
  return hn::IfThenZeroElse(hn::Eq(of.range, zero), hn::Div(above, hn::Mul(Number(6.0F), of.range)));
}

struct HsvOfRgb {
  float full;
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const ExtremesOfRgb of(c0, c1, c2);
    const StepVec top = Number(full);
    c0 = HueOfRgb(c0, c1, c2, of, top);
    const auto black = hn::Eq(of.largest, hn::Zero(StepTag()));
    c1 = hn::IfThenZeroElse(black, hn::Div(hn::Mul(top, of.range), of.largest));
    c2 = of.largest;
  }
};

struct HslOfRgb {
  float full;
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const ExtremesOfRgb of(c0, c1, c2);
    const StepVec top = Number(full);
    const StepVec sum = hn::Add(of.largest, of.smallest);
    const StepVec width = hn::Sub(top, hn::Abs(hn::Sub(sum, top)));
    c0 = HueOfRgb(c0, c1, c2, of, top);
    c1 = hn::IfThenZeroElse(hn::Eq(width, hn::Zero(StepTag())), hn::Div(hn::Mul(top, of.range), width));
    c2 = hn::Mul(Number(0.5F), sum);
  }
};

HWY_INLINE StepVec Sixths(StepVec hue, float full) {
  const StepVec turns = hn::Div(hue, Number(full));
  return hn::Mul(Number(6.0F), hn::Sub(turns, hn::Floor(turns)));
}

HWY_INLINE StepVec Trapezoid(StepVec hue, float ahead) {
  const StepVec sum = hn::Add(hue, Number(ahead));
  const StepVec k = hn::IfThenElse(hn::Ge(sum, Number(6.0F)), hn::Sub(sum, Number(6.0F)), sum);
  const StepVec edge = Smaller(k, hn::Sub(Number(4.0F), k));
  return hn::IfThenElseZero(hn::Gt(edge, hn::Zero(StepTag())), Smaller(edge, Number(1.0F)));
}

HWY_INLINE void RgbBelow(StepVec high, StepVec range, StepVec hue, StepVec& r, StepVec& g, StepVec& b) {
  r = hn::Sub(high, hn::Mul(range, Trapezoid(hue, 5.0F)));
  g = hn::Sub(high, hn::Mul(range, Trapezoid(hue, 3.0F)));
  b = hn::Sub(high, hn::Mul(range, Trapezoid(hue, 1.0F)));
}

struct RgbOfHsv {
  float full;
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec range = hn::Div(hn::Mul(c2, c1), Number(full));
    RgbBelow(c2, range, Sixths(c0, full), c0, c1, c2);
  }
};

struct RgbOfHsl {
  float full;
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec nearer = Smaller(c2, hn::Sub(Number(full), c2));
    const StepVec half = hn::Div(hn::Mul(c1, nearer), Number(full));
    RgbBelow(hn::Add(c2, half), hn::Mul(Number(2.0F), half), Sixths(c0, full), c0, c1, c2);
  }
};

struct YcbcrOfRgb {
  float center;
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec red = hn::Mul(Number(299.0F), c0);
    const StepVec green = hn::Mul(Number(587.0F), c1);
    const StepVec blue = hn::Mul(Number(114.0F), c2);
    const StepVec cb = hn::Add(Number(1772.0F * center), hn::Mul(Number(886.0F), c2));
    const StepVec cr = hn::Add(Number(1402.0F * center), hn::Mul(Number(701.0F), c0));
    c0 = hn::Mul(hn::Add(hn::Add(red, green), blue), Number(color::kPer1000));
    c1 = hn::Mul(hn::Sub(hn::Sub(cb, red), green), Number(color::kPer1772));
    c2 = hn::Mul(hn::Sub(hn::Sub(cr, green), blue), Number(color::kPer1402));
  }
};

struct RgbOfYcbcr {
  float center;
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec luma = c0;
    const StepVec cb = hn::Sub(c1, Number(center));
    const StepVec cr = hn::Sub(c2, Number(center));
    c0 = hn::Add(luma, hn::Mul(Number(1.402F), cr));
    c1 = hn::Sub(hn::Sub(luma, hn::Mul(Number(0.344136286F), cb)), hn::Mul(Number(0.714136286F), cr));
    c2 = hn::Add(luma, hn::Mul(Number(1.772F), cb));
  }
};

struct Product {
  const float (&matrix)[3][3];
  HWY_INLINE StepVec Row(int k, StepVec c0, StepVec c1, StepVec c2) const {
    const auto& row = matrix[k];
    return hn::Add(hn::Add(hn::Mul(Number(row[0]), c0), hn::Mul(Number(row[1]), c1)), hn::Mul(Number(row[2]), c2));
  }
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec x = Row(0, c0, c1, c2);
    const StepVec y = Row(1, c0, c1, c2);
    c2 = Row(2, c0, c1, c2);
    c0 = x;
    c1 = y;
  }
};

HWY_INLINE StepVec LabCurve(StepVec x) {
  const StepVec line = hn::Add(hn::Mul(Number(color::kLabSlope), x), Number(color::kLabOffset));
  return hn::IfThenElse(hn::Gt(x, Number(color::kLabKnee)), cbrt_deterministic(StepTag(), x), line);
}

HWY_INLINE StepVec LabCurveBack(StepVec f) {
  const StepVec line = hn::Mul(hn::Sub(f, Number(color::kLabOffset)), Number(1.0F / color::kLabSlope));
  return hn::IfThenElse(hn::Gt(f, Number(color::kLabKneeRoot)), hn::Mul(hn::Mul(f, f), f), line);
}

struct LabOfXyz {
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec x = LabCurve(c0);
    const StepVec y = LabCurve(c1);
    const StepVec z = LabCurve(c2);
    c0 = hn::Sub(hn::Mul(Number(1.16F), y), Number(0.16F));
    c1 = hn::Add(hn::Mul(Number(color::kAbScale), hn::Sub(x, y)), Number(color::kCenter));
    c2 = hn::Add(hn::Mul(Number(color::kBScale), hn::Sub(y, z)), Number(color::kCenter));
  }
};

struct XyzOfLab {
  HWY_INLINE void operator()(StepVec& c0, StepVec& c1, StepVec& c2) const {
    const StepVec y = hn::Mul(hn::Add(c0, Number(0.16F)), Number(1.0F / 1.16F));
    const StepVec a = hn::Mul(hn::Sub(c1, Number(color::kCenter)), Number(1.0F / color::kAbScale));
    const StepVec b = hn::Mul(hn::Sub(c2, Number(color::kCenter)), Number(1.0F / color::kBScale));
    c0 = LabCurveBack(hn::Add(y, a));
    c1 = LabCurveBack(y);
    c2 = LabCurveBack(hn::Sub(y, b));
  }
};

struct LchOfLab {
  HWY_INLINE void operator()(StepVec&, StepVec& c1, StepVec& c2) const {
    const StepVec a = hn::Sub(c1, Number(color::kCenter));
    const StepVec b = hn::Sub(c2, Number(color::kCenter));
    const StepVec turns = hn::Mul(Number(color::kTurnOfRadian), atan2_deterministic(StepTag(), b, a));
    c1 = hn::Mul(Number(color::kChromaOfAb), hn::Sqrt(hn::Add(hn::Mul(a, a), hn::Mul(b, b))));
    c2 = hn::IfThenElse(hn::Lt(turns, hn::Zero(StepTag())), hn::Add(turns, Number(1.0F)), turns);
  }
};

struct LabOfLch {
  HWY_INLINE void operator()(StepVec&, StepVec& c1, StepVec& c2) const {
    StepVec sine, cosine;
    sine_cosine_of_turns(StepTag(), hn::Sub(c2, hn::Floor(c2)), sine, cosine);
    const StepVec chroma = hn::Mul(c1, Number(1.0F / color::kChromaOfAb));
    c1 = hn::Add(Number(color::kCenter), hn::Mul(chroma, cosine));
    c2 = hn::Add(Number(color::kCenter), hn::Mul(chroma, sine));
  }
};

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
