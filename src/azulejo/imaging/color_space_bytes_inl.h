// Steps of color_space_steps.cpp from sRGB for bytes, in integers as far as they go: the same bytes, since both give the
// exact quotients, rounded. Compiled once for every vector target: included by *_simd.cpp.
#if defined(AZULEJO_IMAGING_COLOR_SPACE_BYTES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_COLOR_SPACE_BYTES_INL_H
#undef AZULEJO_IMAGING_COLOR_SPACE_BYTES_INL_H
#else
#define AZULEJO_IMAGING_COLOR_SPACE_BYTES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "azulejo/math/truncate_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using ByteTag = hn::ScalableTag<std::uint8_t>;
using Bytes = hn::Vec<ByteTag>;
using WordTag = hn::ScalableTag<std::int16_t>;
using Words = hn::Vec<WordTag>;

/// The bytes at even and at odd places, each in 16 bits.
HWY_INLINE Words EvenBytes(Bytes v) { return hn::And(hn::BitCast(WordTag(), v), hn::Set(WordTag(), 255)); }
HWY_INLINE Words OddBytes(Bytes v) {
  return hn::BitCast(WordTag(), hn::ShiftRight<8>(hn::BitCast(hn::ScalableTag<std::uint16_t>(), v)));
}
HWY_INLINE Bytes FromEvenAndOdd(Words even, Words odd) {
  return hn::BitCast(ByteTag(), hn::Or(even, hn::ShiftLeft<8>(odd)));
}

/// Words at even and at odd places, 0–65535, as floats.
HWY_INLINE auto EvenWords(Words v) {
  const hn::ScalableTag<std::int32_t> di;
  return hn::ConvertTo(hn::ScalableTag<float>(), hn::And(hn::BitCast(di, v), hn::Set(di, 65535)));
}
HWY_INLINE auto OddWords(Words v) {
  const hn::ScalableTag<std::uint32_t> du;
  const hn::ScalableTag<std::int32_t> di;
  return hn::ConvertTo(hn::ScalableTag<float>(), hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, v))));
}

/// 255 · above ÷ below, rounded half up; above is not larger than below. The product is exact, and a quotient that is
/// not a half is too far from it to be rounded to it.
template <int kBelowTimes>
HWY_INLINE Words ScaledQuotient(Words above, Words below) {
  const hn::ScalableTag<float> d;
  const auto quotient = [&](auto numerator, auto denominator) HWY_ATTR {
    if constexpr (kBelowTimes != 1) {
      denominator = hn::Mul(denominator, hn::Set(d, static_cast<float>(kBelowTimes)));
    }
    const auto ratio = hn::Div(hn::Mul(numerator, hn::Set(d, 255.0F)), denominator);
    return Truncated(hn::Add(ratio, hn::Set(d, 0.5F)));
  };
  const auto even = quotient(EvenWords(above), EvenWords(below));
  const auto odd = quotient(OddWords(above), OddWords(below));
  return hn::BitCast(WordTag(), hn::Or(even, hn::ShiftLeft<16>(odd)));
}

struct ByteExtremes {
  HWY_INLINE ByteExtremes(Bytes r, Bytes g, Bytes b)
      : largest(hn::Max(hn::Max(r, g), b)), smallest(hn::Min(hn::Min(r, g), b)), range(hn::Sub(largest, smallest)) {}
  Bytes largest;
  Bytes smallest;
  Bytes range;
};

HWY_INLINE Bytes HueOfBytes(Bytes r, Bytes g, Bytes b, const ByteExtremes& of) {
  const ByteTag d;
  const auto is_red = hn::Eq(r, of.largest);
  const auto is_green = hn::Eq(g, of.largest);
  const Bytes from = hn::IfThenElse(is_red, g, hn::IfThenElse(is_green, b, r));
  const Bytes minus = hn::IfThenElse(is_red, b, hn::IfThenElse(is_green, r, g));
  const Bytes red_corner = hn::IfThenZeroElse(hn::Eq(hn::Max(from, minus), from), hn::Set(d, 6));
  const Bytes corner = hn::IfThenElse(is_red, red_corner, hn::IfThenElse(is_green, hn::Set(d, 2), hn::Set(d, 4)));
  const auto hue = [](Words plus, Words less, Words corners, Words range) HWY_ATTR {
    const Words above = hn::Add(hn::Sub(plus, less), hn::Mul(corners, range));
    return ScaledQuotient<6>(above, hn::Max(range, hn::Set(WordTag(), 1)));
  };
  return FromEvenAndOdd(hue(EvenBytes(from), EvenBytes(minus), EvenBytes(corner), EvenBytes(of.range)),
                        hue(OddBytes(from), OddBytes(minus), OddBytes(corner), OddBytes(of.range)));
}

/// 255 · above ÷ below of bytes; 0 where below is 0, as above is then.
HWY_INLINE Bytes ByteQuotient(Bytes above, Bytes below) {
  const Bytes positive = hn::Max(below, hn::Set(ByteTag(), 1));
  return FromEvenAndOdd(ScaledQuotient<1>(EvenBytes(above), EvenBytes(positive)),
                        ScaledQuotient<1>(OddBytes(above), OddBytes(positive)));
}

struct HsvOfBytes {
  HWY_INLINE void operator()(Bytes& c0, Bytes& c1, Bytes& c2) const {
    const ByteExtremes of(c0, c1, c2);
    c0 = HueOfBytes(c0, c1, c2, of);
    c1 = ByteQuotient(of.range, of.largest);
    c2 = of.largest;
  }
};

struct HslOfBytes {
  HWY_INLINE void operator()(Bytes& c0, Bytes& c1, Bytes& c2) const {
    const ByteExtremes of(c0, c1, c2);
    c0 = HueOfBytes(c0, c1, c2, of);
    // 255 − |largest + smallest − 255|
    const Bytes rest = hn::Not(of.smallest);
    const Bytes width = hn::Not(hn::Sub(hn::Max(of.largest, rest), hn::Min(of.largest, rest)));
    c1 = ByteQuotient(of.range, width);
    c2 = hn::AverageRound(of.largest, of.smallest);
  }
};

struct YcbcrOfBytes {
  /// With v = R − G and u = B − G, of 16 bits each:
  /// Y   G + ⌊(299 v + 114 u + 500) / 1000⌋, the quotient of ⌊… / 8⌋ and 125, made positive by 106 · 125
  /// Cb  128 + ⌊(886 u − 299 v + 886) / 1772⌋ = 128 + ⌊(u + 1 + ⌊−299 v / 886⌋) / 2⌋
  /// Cr  128 + ⌊(701 v − 114 u + 701) / 1402⌋ = 128 + ⌊(v + 1 + ⌊−114 u / 701⌋) / 2⌋
  /// The inner quotients are ⌊factor · w / 65536⌋ for all |w| ≤ 255.
  static HWY_INLINE void Convert(Words r, Words g, Words b, Words& y, Words& cb, Words& cr) {
    const WordTag d;
    const hn::ScalableTag<std::uint16_t> du;
    const Words v = hn::Sub(r, g);
    const Words u = hn::Sub(b, g);
    const Words sum = hn::Add(v, u);
    const Words low = hn::Add(hn::Add(sum, sum), hn::Add(v, hn::Set(d, 500)));
    const Words eighths = hn::Add(hn::Add(hn::Mul(v, hn::Set(d, 37)), hn::Mul(u, hn::Set(d, 14))),
                                  hn::Add(hn::ShiftRight<3>(low), hn::Set(d, 106 * 125)));
    const auto quotient = hn::ShiftRight<6>(hn::MulHigh(hn::BitCast(du, eighths), hn::Set(du, 33555)));
    y = hn::Add(hn::BitCast(d, quotient), hn::Sub(g, hn::Set(d, 106)));
    cb = Difference(u, hn::Neg(v), 22116);
    cr = Difference(v, hn::Neg(u), 10657);
  }

  static HWY_INLINE Words Difference(Words plus, Words other, std::int16_t factor) {
    const WordTag d;
    const Words sum = hn::Add(plus, hn::MulHigh(other, hn::Set(d, factor)));
    return hn::Min(hn::ShiftRight<1>(hn::Add(sum, hn::Set(d, 257))), hn::Set(d, 255));
  }

  HWY_INLINE void operator()(Bytes& c0, Bytes& c1, Bytes& c2) const {
    Words even0, even1, even2, odd0, odd1, odd2;
    Convert(EvenBytes(c0), EvenBytes(c1), EvenBytes(c2), even0, even1, even2);
    Convert(OddBytes(c0), OddBytes(c1), OddBytes(c2), odd0, odd1, odd2);
    c0 = FromEvenAndOdd(even0, odd0);
    c1 = FromEvenAndOdd(even1, odd1);
    c2 = FromEvenAndOdd(even2, odd2);
  }
};

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
