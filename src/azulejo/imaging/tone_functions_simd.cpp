#include "azulejo/imaging/tone_functions.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/tone_functions_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/rows_inl.h"
#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

HWY_INLINE V Cut(V v, V low, V high) {
  return hn::IfThenElse(hn::Lt(v, low), low, hn::IfThenElse(hn::Gt(v, high), high, v));
}

/// result[i] = f(source[i]) for vectors.
template <class F>
HWY_INLINE void ForIntensities(const float* source, float* result, std::size_t count, F f) {
  ForVectors(source, result, count,
             [&](const float* from, float* to) HWY_ATTR { hn::StoreU(f(hn::LoadU(D(), from)), D(), to); });
}

void Linear(const LinearFunction& function, const float* source, float* result, std::size_t count) {
  const V scale = hn::Set(D(), function.scale);
  const V offset = hn::Set(D(), function.offset);
  const V low = hn::Set(D(), function.low);
  const V high = hn::Set(D(), function.high);
  ForIntensities(source, result, count,
                 [&](V v) HWY_ATTR { return Cut(hn::Add(hn::Mul(v, scale), offset), low, high); });
}

void WordLines(const WordLine& line, const std::uint16_t* source, std::uint16_t* result, std::size_t count) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::RepartitionToWide<decltype(d)> dw;
  const V scale = hn::Set(D(), line.scale);
  const V offset = hn::Set(D(), line.offset);
  const V low = hn::Set(D(), line.low);
  const V high = hn::Set(D(), line.high);
  // Even and odd values apart, in lanes twice as wide.
  const auto mapped = [&](auto words) HWY_ATTR {
    const V v = hn::ConvertTo(D(), hn::BitCast(DI(), words));
    return hn::BitCast(dw, hn::Min(hn::Max(hn::Add(hn::Mul(v, scale), offset), low), high));
  };
  constexpr int kEven = WordLine::kBehindPoint;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto words = hn::BitCast(dw, hn::LoadU(d, source + i));
    const auto even = hn::ShiftRight<kEven>(mapped(hn::And(words, hn::Set(dw, 0xFFFF))));
    const auto odd = hn::ShiftLeft<16 - kEven>(mapped(hn::ShiftRight<16>(words)));
    hn::StoreU(hn::OddEven(hn::BitCast(d, odd), hn::BitCast(d, even)), d, result + i);
  }
  for (; i < count; ++i) result[i] = line(source[i]);
}

void PowerOf(const PowerFunction& function, const float* source, float* result, std::size_t count) {
  ForIntensities(source, result, count,
                 [&](V v) HWY_ATTR { return hn::CopySign(Power(D(), hn::Abs(v), function.exponent), v); });
}

void Slice(const SliceFunction& function, const float* source, float* result, std::size_t count) {
  const V low = hn::Set(D(), function.low);
  const V high = hn::Set(D(), function.high);
  const V level = hn::Set(D(), function.level);
  ForIntensities(source, result, count, [&](V v) HWY_ATTR {
    const V rest = function.keep ? v : hn::Zero(D());
    return hn::IfThenElse(hn::And(hn::Ge(v, low), hn::Le(v, high)), level, rest);
  });
}

void Steps(const StepFunction& function, const float* source, float* result, std::size_t count) {
  const V steps = hn::Set(D(), function.steps);
  ForIntensities(source, result, count, [&](V v) HWY_ATTR {
    const V inside = Cut(v, hn::Zero(D()), hn::Set(D(), 1.0F));
    return hn::Div(hn::Floor(hn::Add(hn::Mul(inside, steps), hn::Set(D(), 0.5F))), steps);
  });
}

void Curve(const CurveFunction& function, const float* source, float* result, std::size_t count) {
  ForIntensities(source, result, count, [&](V v) HWY_ATTR {
    V value = hn::IfThenElse(hn::Eq(v, v), hn::Set(D(), function.points.front().y), v);
    for (const CurveFunction::Point& each : function.points) {
      const V x = hn::Set(D(), each.x);
      const V line = hn::Add(hn::Set(D(), each.y), hn::Mul(hn::Sub(v, x), hn::Set(D(), each.slope)));
      value = hn::IfThenElse(hn::Ge(v, x), line, value);
    }
    return value;
  });
}

void Table(const TableFunction& function, const float* source, float* result, std::size_t count) {
  const float intervals = static_cast<float>(function.values.size() - 1);
  const V first = hn::Set(D(), function.first);
  const V scale = hn::Set(D(), function.scale);
  const V last = hn::Set(D(), intervals);
  ForIntensities(source, result, count, [&](V v) HWY_ATTR {
    const V place = hn::Mul(hn::Mul(hn::Sub(v, first), scale), last);
    // NaN looks up the first value, and is put back.
    const V inside = hn::IfThenElseZero(hn::Gt(place, hn::Zero(D())), hn::Min(place, last));
    const V below = hn::Floor(hn::IfThenElse(hn::Lt(inside, last), inside, hn::Set(D(), intervals - 1)));
    const auto index = hn::ConvertTo(DI(), below);
    const V value = hn::GatherIndex(D(), function.values.data(), index);
    const V next = hn::GatherIndex(D(), function.values.data() + 1, index);
    const V between = hn::Add(value, hn::Mul(hn::Sub(next, value), hn::Sub(inside, below)));
    return hn::IfThenElse(hn::Eq(place, place), between, v);
  });
}

void Gain(const GainFunction& function, const float* source, float* result, std::size_t count) {
  const V gain = hn::Set(D(), function.gain);
  ForIntensities(source, result, count,
                 [&](V v) HWY_ATTR { return LinearToSrgb(D(), hn::Mul(SrgbToLinear(D(), v), gain)); });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Linear);
HWY_EXPORT(WordLines);
HWY_EXPORT(PowerOf);
HWY_EXPORT(Slice);
HWY_EXPORT(Steps);
HWY_EXPORT(Curve);
HWY_EXPORT(Table);
HWY_EXPORT(Gain);

void linear(const LinearFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(Linear)(function, source, result, count);
}
void word_line(const WordLine& line, const std::uint16_t* source, std::uint16_t* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(WordLines)(line, source, result, count);
}
void power(const PowerFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(PowerOf)(function, source, result, count);
}
void slice(const SliceFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(Slice)(function, source, result, count);
}
void steps(const StepFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(Steps)(function, source, result, count);
}
void curve(const CurveFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(Curve)(function, source, result, count);
}
void table(const TableFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(Table)(function, source, result, count);
}
void gain(const GainFunction& function, const float* source, float* result, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(Gain)(function, source, result, count);
}

}  // namespace azulejo::kernels
#endif
