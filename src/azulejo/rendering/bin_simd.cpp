#include <algorithm>

#include "azulejo/rendering/bin.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/bin_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;

/// One corner of a vector of triangles, in subpixels.
struct Corner {
  hn::Vec<I> x;
  hn::Vec<I> y;
  hn::Mask<F> valid;
};

HWY_INLINE Corner load_corner(const ScreenVertex* vertices, hn::Vec<U> index) {
  const F d;
  const I di;
  const auto at = hn::BitCast(di, hn::ShiftLeft<2>(index));
  const auto x = hn::GatherIndex(d, &vertices->x, at);
  const auto y = hn::GatherIndex(d, &vertices->x + 1, at);
  const auto scale = hn::Set(d, static_cast<float>(kSubpixels));
  return {hn::NearestInt(hn::Mul(x, scale)), hn::NearestInt(hn::Mul(y, scale)), hn::Eq(x, x)};
}

HWY_INLINE hn::Vec<I> smallest(hn::Vec<I> a, hn::Vec<I> b, hn::Vec<I> c) { return hn::Min(hn::Min(a, b), c); }
HWY_INLINE hn::Vec<I> largest(hn::Vec<I> a, hn::Vec<I> b, hn::Vec<I> c) { return hn::Max(hn::Max(a, b), c); }

void CullBlock(const ScreenVertex* vertices, const std::uint32_t* triangles, std::size_t count, bool mirrored,
               bool cull, const TileGrid& grid, CulledBlock& result) {
  const F d;
  const I di;
  const U du;
  const std::size_t n = hn::Lanes(d);
  const auto extent = hn::Set(di, kSmallExtent);
  const auto before = hn::Set(di, 255 - grid.sample_high);
  const auto low = hn::Set(di, grid.sample_low);
  const auto left = hn::Set(di, grid.area.x);
  const auto top = hn::Set(di, grid.area.y);
  const auto right = hn::Set(di, grid.area.right() - 1);
  const auto bottom = hn::Set(di, grid.area.bottom() - 1);
  const auto zero = hn::Zero(di);
  HWY_ALIGN std::uint32_t padded[3 * (HWY_MAX_BYTES / 4)] = {};
  result.count = result.culled = result.empty = result.outside = 0;

  for (std::size_t t = 0; t < count; t += n) {
    const std::uint32_t* from = triangles + 3 * t;
    const std::size_t here = std::min(n, count - t);
    if (here < n) {
      std::copy(from, from + 3 * here, padded);
      std::fill(padded + 3 * here, padded + 3 * n, from[0]);
      from = padded;
    }
    hn::Vec<U> i0, i1, i2;
    hn::LoadInterleaved3(du, from, i0, i1, i2);
    const Corner a = load_corner(vertices, i0);
    const Corner b = load_corner(vertices, i1);
    const Corner c = load_corner(vertices, i2);
    const auto wanted = hn::FirstN(di, here);
    const auto x_low = smallest(a.x, b.x, c.x);
    const auto x_high = largest(a.x, b.x, c.x);
    const auto y_low = smallest(a.y, b.y, c.y);
    const auto y_high = largest(a.y, b.y, c.y);
    const auto valid = hn::RebindMask(di, hn::And(hn::And(a.valid, b.valid), c.valid));
    const auto small = hn::And(hn::And(hn::Lt(hn::Sub(x_high, x_low), extent), hn::Lt(hn::Sub(y_high, y_low), extent)),
                               hn::And(valid, wanted));
    const auto by_hand = hn::AndNot(small, wanted);

    // Positive where the corners run counter-clockwise as seen (y points down here).
    const auto area =
        hn::Sub(hn::Mul(hn::Sub(c.x, a.x), hn::Sub(b.y, a.y)), hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)));
    auto x0 = hn::ShiftRight<kSubpixelBits>(hn::Add(x_low, before));
    auto y0 = hn::ShiftRight<kSubpixelBits>(hn::Add(y_low, before));
    auto x1 = hn::ShiftRight<kSubpixelBits>(hn::Sub(x_high, low));
    auto y1 = hn::ShiftRight<kSubpixelBits>(hn::Sub(y_high, low));
    const auto nothing = hn::Or(hn::Or(hn::Gt(x0, x1), hn::Gt(y0, y1)), hn::Eq(area, zero));
    const auto front = mirrored ? hn::Lt(area, zero) : hn::Gt(area, zero);
    x0 = hn::Max(x0, left);
    y0 = hn::Max(y0, top);
    x1 = hn::Min(x1, right);
    y1 = hn::Min(y1, bottom);
    const auto away = hn::Or(hn::Gt(x0, x1), hn::Gt(y0, y1));

    const auto empty = hn::And(small, nothing);
    auto kept = hn::AndNot(nothing, small);
    const auto culled = cull ? hn::AndNot(front, kept) : hn::FirstN(di, 0);
    kept = hn::AndNot(culled, kept);
    const auto outside = hn::And(kept, away);
    kept = hn::AndNot(outside, kept);
    result.empty += static_cast<std::uint32_t>(hn::CountTrue(di, empty));
    result.culled += static_cast<std::uint32_t>(hn::CountTrue(di, culled));
    result.outside += static_cast<std::uint32_t>(hn::CountTrue(di, outside));
    const auto left_over = hn::Or(kept, by_hand);
    if (hn::AllFalse(di, left_over)) continue;

    const auto tile = [&](hn::Vec<I> x, hn::Vec<I> y) HWY_ATTR {
      const auto column = hn::ShiftRightSame(x, grid.tile_log2);
      const auto row = hn::ShiftRightSame(y, grid.tile_log2);
      return hn::Or(column, hn::ShiftLeft<12>(row));
    };
    const auto back = hn::IfThenElse(front, zero, hn::BitCast(di, hn::Set(du, CulledBlock::kBackFacing)));
    const auto first_tile =
        hn::IfThenElse(by_hand, hn::BitCast(di, hn::Set(du, CulledBlock::kByHand)), hn::Or(tile(x0, y0), back));
    const auto number = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(t)));
    const auto store = [&](hn::Vec<I> v, std::uint32_t* to)
                           HWY_ATTR { hn::StoreU(hn::BitCast(du, hn::Compress(v, left_over)), du, to + result.count); };
    store(number, result.triangle.data());
    store(first_tile, result.first_tile.data());
    store(tile(x1, y1), result.last_tile.data());
    result.count += hn::CountTrue(di, left_over);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(CullBlock);

void cull_block(const ScreenVertex* vertices, const std::uint32_t* triangles, std::size_t count, bool mirrored,
                bool cull, const TileGrid& grid, CulledBlock& result) {
  HWY_DYNAMIC_DISPATCH(CullBlock)(vertices, triangles, count, mirrored, cull, grid, result);
}

}  // namespace azulejo::kernels
#endif
