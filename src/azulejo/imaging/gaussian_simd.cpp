// How it is fast. A vector holds the same place of neighbouring columns in the first pass, of neighbouring rows in
// the second: both passes then read whole aligned vectors, one a tap, and differ in nothing but the strides. What
// lies between is turned over, N × N values at a time. Everything stays in the first-level cache: a panel of
// columns as f32, what the first pass made of the last 2 · radius columns, and little else.
#include "azulejo/imaging/gaussian_kernels.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/gaussian_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;

constexpr int kPanel = 64;           ///< values of a row that the first pass takes at once
constexpr int kRows = 32;            ///< rows that go through both passes together
constexpr std::size_t kOutputs = 4;  ///< results computed at once: they share weights and hide latency

HWY_INLINE int VectorLanes() { return static_cast<int>(hn::Lanes(FloatTag())); }

/// Stored values to weighted ones and back; whole pixels of 2 and 4 channels at a time.
template <class T>
class Pixels {
 public:
  explicit Pixels(const GaussianPixels& what)
      : what_(what), as_stored_(!what.decode && (!what.alpha || what.premultiplied)) {
    for (int i = 0; i < VectorLanes(); ++i) {
      alpha_lanes_[i] = what.alpha && i % what.channels == what.channels - 1 ? 1.0F : 0.0F;
    }
  }

  bool as_stored() const { return as_stored_; }

  HWY_INLINE static Floats Converted(const T* from) {
    const FloatTag d;
    if constexpr (std::is_same_v<T, float>) {
      return hn::LoadU(d, from);
    } else {
      const hn::RebindToSigned<FloatTag> di;
      return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<T, FloatTag>(), from)));
    }
  }
  HWY_INLINE Floats Load(const T* from) const { return as_stored_ ? Converted(from) : Weighted(Converted(from)); }

  HWY_INLINE static void Round(Floats value, T* to) {
    const FloatTag d;
    if constexpr (std::is_same_v<T, float>) {
      hn::StoreU(value, d, to);
    } else {
      const hn::RebindToSigned<FloatTag> di;
      const hn::Rebind<T, FloatTag> dt;
      hn::StoreU(hn::DemoteTo(dt, hn::ConvertTo(di, hn::Add(value, hn::Set(d, 0.5F)))), dt, to);
    }
  }
  HWY_INLINE void Store(Floats value, T* to) const { Round(as_stored_ ? value : Stored(value), to); }

 private:
  HWY_INLINE Floats AlphaOf(Floats value) const {
    return what_.channels == 4 ? hn::Broadcast<3>(value) : hn::DupOdd(value);
  }
  HWY_INLINE auto IsAlpha() const { return hn::Gt(hn::Load(FloatTag(), alpha_lanes_), hn::Zero(FloatTag())); }
  /// color ÷ alpha, 0 where alpha is (rounded to) 0.
  HWY_INLINE static Floats Divided(Floats color, Floats alpha, float least) {
    const FloatTag d;
    const auto nothing = least > 0 ? hn::Lt(alpha, hn::Set(d, least)) : hn::Eq(alpha, hn::Zero(d));
    return hn::IfThenElse(nothing, hn::Zero(d), hn::Div(color, alpha));
  }

  HWY_NOINLINE Floats Weighted(Floats value) const {
    const FloatTag d;
    const Floats alpha = AlphaOf(value);
    Floats color = value;
    if (what_.decode) {
      color = what_.premultiplied ? Divided(color, alpha, 0) : hn::Div(color, hn::Set(d, what_.full));
      color = SrgbToLinear(d, color);
    }
    if (!what_.alpha) return color;
    return hn::IfThenElse(IsAlpha(), value, hn::Mul(color, alpha));
  }

  HWY_NOINLINE Floats Stored(Floats value) const {
    const FloatTag d;
    const Floats alpha = AlphaOf(value);
    Floats color = what_.alpha ? Divided(value, alpha, std::is_same_v<T, float> ? 0.0F : 0.5F) : value;
    if (what_.decode) {
      color = hn::Mul(LinearToSrgb(d, color), what_.premultiplied ? alpha : hn::Set(d, what_.full));
    }
    return what_.alpha ? hn::IfThenElse(IsAlpha(), value, color) : color;
  }

  GaussianPixels what_;
  bool as_stored_;
  HWY_ALIGN float alpha_lanes_[HWY_MAX_BYTES / sizeof(float)];
};

/// kOutputs results of one pass: result j from in[j · step] and what lies 1 … radius taps before and behind.
/// Where step = tap, neighbouring results share what they load: the compiler sees that in kTogether taps at once.
template <bool kAnchored>
HWY_INLINE void Smooth(const float* HWY_RESTRICT in, std::ptrdiff_t step, std::ptrdiff_t tap,
                       const float* HWY_RESTRICT weights, int radius, float* HWY_RESTRICT out) {
  constexpr int kTogether = 4;
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  Floats sum[kOutputs];
  Floats twice[kOutputs];
  for (std::size_t j = 0; j < kOutputs; ++j) {
    sum[j] = hn::Zero(d);
    const auto center = hn::Load(d, in + static_cast<std::ptrdiff_t>(j) * step);
    twice[j] = hn::Add(center, center);
  }
  const float* before = in - radius * tap;
  const float* behind = in + radius * tap;
  const auto add = [&](std::ptrdiff_t offset, float weight) HWY_ATTR {
    const auto factor = hn::Set(d, weight);
    for (std::size_t j = 0; j < kOutputs; ++j) {
      const auto at = static_cast<std::ptrdiff_t>(j) * step;
      auto pair = hn::Add(hn::Load(d, before + at + offset), hn::Load(d, behind + at - offset));
      if constexpr (kAnchored) pair = hn::Sub(pair, twice[j]);
      sum[j] = hn::Add(sum[j], hn::Mul(factor, pair));
    }
  };
  int k = radius;
  for (; k % kTogether != 0; --k, before += tap, behind -= tap) add(0, weights[k]);
  for (; k > 0; k -= kTogether, before += kTogether * tap, behind -= kTogether * tap) {
    add(0, weights[k]);
    add(tap, weights[k - 1]);
    add(2 * tap, weights[k - 2]);
    add(3 * tap, weights[k - 3]);
  }
  for (std::size_t j = 0; j < kOutputs; ++j) {
    const auto center = hn::Load(d, in + static_cast<std::ptrdiff_t>(j) * step);
    const auto part = kAnchored ? center : hn::Mul(hn::Set(d, weights[0]), center);
    hn::Store(hn::Add(sum[j], part), d, out + j * lanes);
  }
}

/// A vector's worth of results one step after the other.
template <bool kAnchored>
HWY_INLINE void SmoothBlock(const float* HWY_RESTRICT in, std::ptrdiff_t step, std::ptrdiff_t tap,
                            const float* HWY_RESTRICT weights, int radius, float* HWY_RESTRICT block) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  for (std::size_t j = 0; j < lanes; j += kOutputs) {
    Smooth<kAnchored>(in + static_cast<std::ptrdiff_t>(j) * step, step, tap, weights, radius, block + j * lanes);
  }
}

/// Four columns of four rows, as many times as a vector has room.
struct Quad {
  Floats column[4];
};

HWY_INLINE Quad TransposedRows(const float* rows) {
  const FloatTag d;
  const hn::RepartitionToWide<FloatTag> dw;
  const std::size_t lanes = hn::Lanes(d);
  const auto row0 = hn::Load(d, rows);
  const auto row1 = hn::Load(d, rows + lanes);
  const auto row2 = hn::Load(d, rows + 2 * lanes);
  const auto row3 = hn::Load(d, rows + 3 * lanes);
  const auto low01 = hn::BitCast(dw, hn::InterleaveLower(d, row0, row1));
  const auto low23 = hn::BitCast(dw, hn::InterleaveLower(d, row2, row3));
  const auto high01 = hn::BitCast(dw, hn::InterleaveUpper(d, row0, row1));
  const auto high23 = hn::BitCast(dw, hn::InterleaveUpper(d, row2, row3));
  return {{hn::BitCast(d, hn::InterleaveLower(dw, low01, low23)), hn::BitCast(d, hn::InterleaveUpper(dw, low01, low23)),
           hn::BitCast(d, hn::InterleaveLower(dw, high01, high23)),
           hn::BitCast(d, hn::InterleaveUpper(dw, high01, high23))}};
}

/// Turns over N × N values, N being the lanes of a vector: store(column, its index).
template <class Store>
HWY_INLINE void Transpose(const float* HWY_RESTRICT rows, const Store& store) {
  [[maybe_unused]] const FloatTag d;
  const Quad quad0 = TransposedRows(rows);
#if HWY_MAX_BYTES == 16
  const auto columns = [&](std::size_t j, Floats v0) HWY_ATTR { store(v0, j); };
  columns(0, quad0.column[0]);
  columns(1, quad0.column[1]);
  columns(2, quad0.column[2]);
  columns(3, quad0.column[3]);
#elif HWY_MAX_BYTES == 32
  const Quad quad1 = TransposedRows(rows + 4 * hn::Lanes(d));
  const auto columns = [&](std::size_t j, Floats v0, Floats v1) HWY_ATTR {
    store(hn::ConcatLowerLower(d, v1, v0), j);
    store(hn::ConcatUpperUpper(d, v1, v0), 4 + j);
  };
  columns(0, quad0.column[0], quad1.column[0]);
  columns(1, quad0.column[1], quad1.column[1]);
  columns(2, quad0.column[2], quad1.column[2]);
  columns(3, quad0.column[3], quad1.column[3]);
#else
  const Quad quad1 = TransposedRows(rows + 4 * hn::Lanes(d));
  const Quad quad2 = TransposedRows(rows + 8 * hn::Lanes(d));
  const Quad quad3 = TransposedRows(rows + 12 * hn::Lanes(d));
  const auto columns = [&](std::size_t j, Floats v0, Floats v1, Floats v2, Floats v3) HWY_ATTR {
    const auto low02 = hn::ConcatLowerLower(d, v2, v0);
    const auto low13 = hn::ConcatLowerLower(d, v3, v1);
    const auto high02 = hn::ConcatUpperUpper(d, v2, v0);
    const auto high13 = hn::ConcatUpperUpper(d, v3, v1);
    store(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(low13), low02), j);
    store(hn::OddEvenBlocks(low13, hn::SwapAdjacentBlocks(low02)), 4 + j);
    store(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(high13), high02), 8 + j);
    store(hn::OddEvenBlocks(high13, hn::SwapAdjacentBlocks(high02)), 12 + j);
  };
  columns(0, quad0.column[0], quad1.column[0], quad2.column[0], quad3.column[0]);
  columns(1, quad0.column[1], quad1.column[1], quad2.column[1], quad3.column[1]);
  columns(2, quad0.column[2], quad1.column[2], quad2.column[2], quad3.column[2]);
  columns(3, quad0.column[3], quad1.column[3], quad2.column[3], quad3.column[3]);
#endif
}

/// The same for values that are bytes when rounded: four columns become the four bytes of a lane, so that few lanes
/// are left to turn over.
HWY_INLINE void TransposeToBytes(const float* HWY_RESTRICT columns, std::uint8_t* HWY_RESTRICT rows) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  const auto byte = [&](std::size_t column) HWY_ATTR {
    const auto value = hn::Load(d, columns + column * hn::Lanes(d));
    return hn::BitCast(du, hn::ConvertTo(hn::RebindToSigned<FloatTag>(), hn::Add(value, hn::Set(d, 0.5F))));
  };
  const auto quad = [&](std::size_t column) HWY_ATTR {
    const auto low = hn::Or(byte(column), hn::ShiftLeft<8>(byte(column + 1)));
    const auto high = hn::Or(byte(column + 2), hn::ShiftLeft<8>(byte(column + 3)));
    return hn::Or(low, hn::ShiftLeft<16>(high));
  };
  auto* const words = reinterpret_cast<std::uint32_t*>(rows);
#if HWY_MAX_BYTES == 16
  hn::StoreU(quad(0), du, words);
#elif HWY_MAX_BYTES == 32
  hn::StoreInterleaved2(quad(0), quad(4), du, words);
#else
  hn::StoreInterleaved4(quad(0), quad(4), quad(8), quad(12), du, words);
#endif
}

/// Both passes over bands of kRows rows, panel by panel from left to right.
template <class T>
class Passes {
 public:
  static constexpr bool kAnchored = !std::is_same_v<T, std::uint8_t>;

  Passes(const GaussianTile<T>& tile, const GaussianPixels& pixels, const float* weights, int radius, Scratch& scratch)
      : tile_(tile),
        pixels_(pixels),
        weights_(weights),
        radius_(radius),
        lanes_(VectorLanes()),
        reach_(2 * radius * pixels.channels),
        tap_(pixels.channels),
        values_(tile.width * pixels.channels),
        window_columns_(2 * (reach_ + lanes_ + kPanel)) {
    panel_ = scratch.take<float>(static_cast<std::size_t>(kRows + 2 * radius) * kPanel);
    window_ = scratch.take<float>(static_cast<std::size_t>(window_columns_) * kRows);
    block_ = scratch.take<float>(static_cast<std::size_t>(lanes_ * lanes_));
    turned_ = scratch.take<float>(static_cast<std::size_t>(lanes_ * lanes_));
  }

  void Run() {
    for (int y = 0; y < tile_.height; y += kRows) Band(y, std::min(kRows, tile_.height - y));
  }

 private:
  void Band(int y, int rows) {
    const int vector_rows = (rows + lanes_ - 1) / lanes_ * lanes_;
    int begin = 0;  // the source column (in values) that the window begins with
    int done = 0;   // results written
    for (int x = 0; x < values_ + reach_; x += kPanel) {
      const int count = std::min(kPanel, values_ + reach_ - x);
      if (x + kPanel - begin > window_columns_) {
        std::memmove(window_, window_ + std::ptrdiff_t{done - begin} * kRows,
                     static_cast<std::size_t>(x - done) * kRows * sizeof(float));
        begin = done;
      }
      FillPanel(y, rows, vector_rows, x, count);
      FirstPass(vector_rows, count, x - begin);
      const bool last = x + count == values_ + reach_;
      for (; done + lanes_ <= x + count - reach_ || (last && done < values_); done += lanes_) {
        SecondPass(y, rows, done, done - begin);
      }
    }
  }

  void FillPanel(int y, int rows, int vector_rows, int x, int count) {
    const FloatTag d;
    for (int i = 0; i < rows + 2 * radius_; ++i) {
      const T* const from = tile_.source + (y + i) * tile_.source_stride + x;
      float* const to = panel_ + std::ptrdiff_t{i} * kPanel;
      int at = 0;
      if (pixels_.as_stored()) {
        for (; at + lanes_ <= count; at += lanes_) hn::Store(Pixels<T>::Converted(from + at), d, to + at);
      } else {
        for (; at + lanes_ <= count; at += lanes_) hn::Store(pixels_.Load(from + at), d, to + at);
      }
      if (at < count) {
        T rest[HWY_MAX_BYTES / sizeof(float)] = {};
        std::memcpy(rest, from + at, static_cast<std::size_t>(count - at) * sizeof(T));
        hn::Store(pixels_.Load(rest), d, to + at);
      }
    }
    // Rows that make the last vector of the second pass full: computed with, never written.
    std::fill_n(panel_ + std::ptrdiff_t{rows + 2 * radius_} * kPanel,
                static_cast<std::size_t>(vector_rows - rows) * kPanel, 0.0F);
  }

  void FirstPass(int vector_rows, int count, int column) {
    // Members as locals: the compiler can't know that no store changes them.
    const int lanes = lanes_;
    const int radius = radius_;
    const float* const weights = weights_;
    float* const block = block_;
    for (int x = 0; x < count; x += lanes) {
      const float* in = panel_ + std::ptrdiff_t{radius} * kPanel + x;
      float* turned = window_ + std::ptrdiff_t{column + x} * kRows;
      for (int y = 0; y < vector_rows; y += lanes) {
        SmoothBlock<kAnchored>(in, kPanel, kPanel, weights, radius, block);
        Transpose(block, [turned](Floats values, std::size_t i)
                             HWY_ATTR { hn::Store(values, FloatTag(), turned + i * kRows); });
        in += lanes * kPanel;
        turned += lanes;
      }
    }
  }

  void SecondPass(int y, int rows, int x, int column) {
    const int lanes = lanes_;
    const int radius = radius_;
    const float* const weights = weights_;
    float* const block = block_;
    const float* in = window_ + std::ptrdiff_t{column + reach_ / 2} * kRows;
    for (int top = 0; top < rows; top += lanes, in += lanes) {
      if (tap_ == 1) {
        SmoothBlock<kAnchored>(in, kRows, kRows, weights, radius, block);
      } else {
        SmoothBlock<kAnchored>(in, kRows, tap_ * kRows, weights, radius, block);
      }
      WriteRows(y + top, std::min(lanes, rows - top), x);
    }
  }

  /// Writes what stands by columns in block_.
  void WriteRows(int y, int rows, int x) {
    const FloatTag d;
    const int count = std::min(lanes_, values_ - x);
    T* const result = tile_.result + y * tile_.result_stride + x;
    const std::ptrdiff_t stride = tile_.result_stride;
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      if (pixels_.as_stored()) {
        constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(float);
        HWY_ALIGN std::uint8_t bytes[kLanes * kLanes];
        TransposeToBytes(block_, bytes);
        const hn::Rebind<std::uint8_t, FloatTag> dt;
        if (count == lanes_) {
          for (int i = 0; i < rows; ++i) hn::StoreU(hn::Load(dt, bytes + i * lanes_), dt, result + i * stride);
        } else {
          for (int i = 0; i < rows; ++i) {
            std::memcpy(result + i * stride, bytes + i * lanes_, static_cast<std::size_t>(count));
          }
        }
        return;
      }
    }
    if (rows == lanes_ && count == lanes_ && pixels_.as_stored()) {
      Transpose(block_, [result, stride](Floats values, std::size_t i)
                            HWY_ATTR { Pixels<T>::Round(values, result + static_cast<std::ptrdiff_t>(i) * stride); });
      return;
    }
    float* const turned = turned_;
    Transpose(block_, [turned](Floats values, std::size_t i)
                          HWY_ATTR { hn::Store(values, FloatTag(), turned + i * hn::Lanes(FloatTag())); });
    for (int i = 0; i < rows; ++i) {
      T rest[HWY_MAX_BYTES / sizeof(float)];
      pixels_.Store(hn::Load(d, turned + std::ptrdiff_t{i} * lanes_), rest);
      std::memcpy(result + i * stride, rest, static_cast<std::size_t>(count) * sizeof(T));
    }
  }

  const GaussianTile<T> tile_;
  const Pixels<T> pixels_;
  const float* const weights_;
  const int radius_;
  const int lanes_;
  const int reach_;   ///< values that a row of the source is longer
  const int tap_;     ///< values from a tap of the second pass to the next
  const int values_;  ///< of a row of the result
  const int window_columns_;
  float* panel_;   ///< rows of kPanel values: the source as f32
  float* window_;  ///< columns of kRows values: the first pass's results
  float* block_;
  float* turned_;
};

void GaussianU8(const GaussianTile<std::uint8_t>& tile, const GaussianPixels& pixels, const float* weights, int radius,
                Scratch& scratch) {
  Passes<std::uint8_t>(tile, pixels, weights, radius, scratch).Run();
}
void GaussianU16(const GaussianTile<std::uint16_t>& tile, const GaussianPixels& pixels, const float* weights,
                 int radius, Scratch& scratch) {
  Passes<std::uint16_t>(tile, pixels, weights, radius, scratch).Run();
}
void GaussianF32(const GaussianTile<float>& tile, const GaussianPixels& pixels, const float* weights, int radius,
                 Scratch& scratch) {
  Passes<float>(tile, pixels, weights, radius, scratch).Run();
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(GaussianU8);
HWY_EXPORT(GaussianU16);
HWY_EXPORT(GaussianF32);

void gaussian_tile(const GaussianTile<std::uint8_t>& tile, const GaussianPixels& pixels, const float* weights,
                   int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(GaussianU8)(tile, pixels, weights, radius, scratch);
}
void gaussian_tile(const GaussianTile<std::uint16_t>& tile, const GaussianPixels& pixels, const float* weights,
                   int radius, Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(GaussianU16)(tile, pixels, weights, radius, scratch);
}
void gaussian_tile(const GaussianTile<float>& tile, const GaussianPixels& pixels, const float* weights, int radius,
                   Scratch& scratch) {
  HWY_DYNAMIC_DISPATCH(GaussianF32)(tile, pixels, weights, radius, scratch);
}

}  // namespace azulejo::kernels
#endif
