#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "azulejo/rendering/raster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/raster_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 16>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;

/// A triangle in subpixels from the tile's origin, its corners turned so that its area is positive.
struct Prepared {
  std::int32_t x[3];
  std::int32_t y[3];
  float z[3];
  std::int64_t area;
};

HWY_INLINE std::int32_t snap(float coordinate) {
  return static_cast<std::int32_t>(std::nearbyint(coordinate * static_cast<float>(kSubpixels)));
}

/// False: no area.
HWY_INLINE bool prepare(const VisibilityBuffer& target, const ScreenVertex& a, const ScreenVertex& b,
                        const ScreenVertex& c, Prepared& t) {
  const std::int32_t ox = target.origin_x * kSubpixels;
  const std::int32_t oy = target.origin_y * kSubpixels;
  const ScreenVertex* v[3] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    t.x[i] = snap(v[i]->x) - ox;
    t.y[i] = snap(v[i]->y) - oy;
    t.z[i] = v[i]->z;
  }
  t.area = std::int64_t{t.x[2] - t.x[0]} * (t.y[1] - t.y[0]) - std::int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]);
  if (t.area < 0) {
    std::swap(t.x[1], t.x[2]);
    std::swap(t.y[1], t.y[2]);
    std::swap(t.z[1], t.z[2]);
    t.area = -t.area;
  }
  return t.area != 0;
}

/// An edge's function e(x, y) = dx (x − x0) + dy (y − y0), positive inside; a sample is inside where e ≥ least: 0 on a
/// top or left edge, 1 on others.
struct Edge {
  std::int32_t dx;
  std::int32_t dy;
  std::int32_t x0;
  std::int32_t y0;
  std::int32_t least;
};

HWY_INLINE Edge edge_of(const Prepared& t, int from, int to) {
  const std::int32_t dx = t.y[to] - t.y[from];
  const std::int32_t dy = t.x[from] - t.x[to];
  return {dx, dy, t.x[from], t.y[from], dx > 0 || (dx == 0 && dy > 0) ? 0 : 1};
}

/// Pixels whose samples may be inside: columns x0–x1, rows y0–y1, in the tile.
struct Extent {
  int x0, y0, x1, y1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

HWY_INLINE Extent extent_of(const VisibilityBuffer& target, const Prepared& t, const SamplePoint& sample) {
  const auto low = [](const std::int32_t* v) { return std::min(std::min(v[0], v[1]), v[2]); };
  const auto high = [](const std::int32_t* v) { return std::max(std::max(v[0], v[1]), v[2]); };
  return {std::max((low(t.x) + 255 - sample.x) >> kSubpixelBits, target.left),
          std::max((low(t.y) + 255 - sample.y) >> kSubpixelBits, target.top),
          std::min((high(t.x) - sample.x) >> kSubpixelBits, target.right - 1),
          std::min((high(t.y) - sample.y) >> kSubpixelBits, target.bottom - 1)};
}

/// Where passed samples go.
struct Draw {
  float* depth;
  std::uint32_t* triangle;
  std::uint32_t number;
  RasterCounts* counts;

  HWY_INLINE void operator()(std::size_t at, hn::Mask<F> covered, hn::Vec<F> z) const {
    const F d;
    const U du;
    const auto passed = hn::And(covered, hn::Gt(z, hn::LoadU(d, depth + at)));
    hn::BlendedStore(z, passed, d, depth + at);
    hn::BlendedStore(hn::Set(du, number), hn::RebindMask(du, passed), du, triangle + at);
    if (HWY_UNLIKELY(counts != nullptr)) {
      counts->tested += hn::CountTrue(d, covered);
      counts->passed += hn::CountTrue(d, passed);
    }
  }
};

struct Cover {
  const float* depth;
  std::vector<CoveredSample>* covered_samples;

  HWY_INLINE void operator()(std::size_t at, hn::Mask<F> covered, hn::Vec<F> z) const {
    const F d;
    const auto passed = hn::And(covered, hn::Gt(z, hn::LoadU(d, depth + at)));
    if (hn::AllFalse(d, passed)) return;
    HWY_ALIGN float depths[16];
    std::uint8_t bits[8] = {};
    hn::Store(z, d, depths);
    hn::StoreMaskBits(d, passed, bits);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      if ((bits[lane / 8] >> (lane % 8) & 1) != 0) {
        covered_samples->push_back({static_cast<std::uint32_t>(at + lane), depths[lane]});
      }
    }
  }
};

/// In 32-bit integers: no product exceeds 2^14 · 2^15.
template <class Sink>
HWY_INLINE void raster_small(const VisibilityBuffer& target, const Prepared& t, const Sink& sink) {
  const F d;
  const I di;
  const int n = static_cast<int>(hn::Lanes(d));
  const Edge edges[3] = {edge_of(t, 1, 2), edge_of(t, 2, 0), edge_of(t, 0, 1)};
  const auto lanes = hn::Iota(di, 0);
  hn::Vec<I> across[3];
  hn::Vec<I> below[3];
  for (int e = 0; e < 3; ++e) {
    across[e] = hn::Mul(lanes, hn::Set(di, edges[e].dx * kSubpixels));
    below[e] = hn::Set(di, edges[e].least - 1);
  }
  // Depth from the distances to two edges: neither is negative inside, so nothing cancels.
  const float inverse = 1.0F / static_cast<float>(t.area);
  const auto z0 = hn::Set(d, t.z[0]);
  const auto toward1 = hn::Set(d, (t.z[1] - t.z[0]) * inverse);
  const auto toward2 = hn::Set(d, (t.z[2] - t.z[0]) * inverse);

  for (std::size_t s = 0; s < target.samples.size(); ++s) {
    const SamplePoint sample = target.samples[s];
    const Extent extent = extent_of(target, t, sample);
    if (extent.empty()) continue;
    for (int x = extent.x0; x <= extent.x1; x += n) {
      const auto inside_columns = hn::FirstN(di, static_cast<std::size_t>(extent.x1 - x + 1));
      hn::Vec<I> e[3];
      for (int i = 0; i < 3; ++i) {
        const std::int32_t start = edges[i].dx * (x * kSubpixels + sample.x - edges[i].x0) +
                                   edges[i].dy * (extent.y0 * kSubpixels + sample.y - edges[i].y0);
        e[i] = hn::Add(across[i], hn::Set(di, start));
      }
      std::size_t at =
          s * target.pixels() + (static_cast<std::size_t>(extent.y0) << target.log2) + static_cast<std::size_t>(x);
      for (int y = extent.y0; y <= extent.y1; ++y, at += static_cast<std::size_t>(target.size())) {
        const auto inside = hn::And(hn::And(hn::Gt(e[0], below[0]), hn::Gt(e[1], below[1])),
                                    hn::And(hn::Gt(e[2], below[2]), inside_columns));
        const auto z =
            hn::Add(z0, hn::Add(hn::Mul(hn::ConvertTo(d, e[1]), toward1), hn::Mul(hn::ConvertTo(d, e[2]), toward2)));
        sink(at, hn::RebindMask(d, inside), z);
        for (int i = 0; i < 3; ++i) e[i] = hn::Add(e[i], hn::Set(di, edges[i].dy * kSubpixels));
      }
    }
  }
}

/// floor(a ÷ b), b > 0
HWY_INLINE std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// The columns of a row where all edges are inside: exact, in 64-bit integers.
HWY_INLINE void narrow(const Edge& edge, std::int64_t x, std::int64_t y, int& first, int& last) {
  const std::int64_t start = edge.dx * (x - edge.x0) + edge.dy * (y - edge.y0) - edge.least;
  const std::int64_t step = std::int64_t{edge.dx} * kSubpixels;
  constexpr std::int64_t kFar = 1 << 20;
  if (step == 0) {
    if (start < 0) last = -1;
  } else if (step > 0) {
    first = std::max(first, static_cast<int>(std::clamp(-floor_div(start, step), -kFar, kFar)));
  } else {
    last = std::min(last, static_cast<int>(std::clamp(floor_div(start, -step), -kFar, kFar)));
  }
}

/// Row by row: the span that lies inside, then its depths.
template <class Sink>
HWY_NOINLINE void raster_large(const VisibilityBuffer& target, const Prepared& t, const Sink& sink) {
  const F d;
  const int n = static_cast<int>(hn::Lanes(d));
  const Edge edges[3] = {edge_of(t, 1, 2), edge_of(t, 2, 0), edge_of(t, 0, 1)};
  const double inverse = 1.0 / static_cast<double>(t.area);
  const double z10 = (static_cast<double>(t.z[1]) - t.z[0]) * inverse;
  const double z20 = (static_cast<double>(t.z[2]) - t.z[0]) * inverse;
  const double dzdx = z10 * edges[1].dx + z20 * edges[2].dx;  // per subpixel
  const double dzdy = z10 * edges[1].dy + z20 * edges[2].dy;
  const auto slope = hn::Set(d, static_cast<float>(dzdx * kSubpixels));
  const auto lanes = hn::ConvertTo(d, hn::Iota(I(), 0));

  for (std::size_t s = 0; s < target.samples.size(); ++s) {
    const SamplePoint sample = target.samples[s];
    const Extent extent = extent_of(target, t, sample);
    if (extent.empty()) continue;
    // An edge that every pixel of the extent is inside of needs no looking at.
    bool needed[3];
    for (int i = 0; i < 3; ++i) {
      const std::int64_t x = (edges[i].dx > 0 ? extent.x0 : extent.x1) * kSubpixels + sample.x;
      const std::int64_t y = (edges[i].dy > 0 ? extent.y0 : extent.y1) * kSubpixels + sample.y;
      needed[i] = edges[i].dx * (x - edges[i].x0) + edges[i].dy * (y - edges[i].y0) < edges[i].least;
    }
    for (int y = extent.y0; y <= extent.y1; ++y) {
      const std::int64_t row = std::int64_t{y} * kSubpixels + sample.y;
      int first = extent.x0;
      int last = extent.x1;
      for (int i = 0; i < 3; ++i) {
        if (needed[i]) narrow(edges[i], sample.x, row, first, last);
      }
      if (first > last) continue;
      const double start =
          t.z[0] + dzdx * (static_cast<double>(sample.x) - t.x[0]) + dzdy * (static_cast<double>(row) - t.y[0]);
      const auto z_start = hn::Set(d, static_cast<float>(start));
      const std::size_t line = s * target.pixels() + (static_cast<std::size_t>(y) << target.log2);
      for (int x = first; x <= last; x += n) {
        const auto column = hn::Add(lanes, hn::Set(d, static_cast<float>(x)));
        const auto z = hn::Add(z_start, hn::Mul(column, slope));
        sink(line + static_cast<std::size_t>(x), hn::FirstN(d, static_cast<std::size_t>(last - x + 1)), z);
      }
    }
  }
}

template <class Sink>
HWY_INLINE void raster(const VisibilityBuffer& target, const ScreenVertex& a, const ScreenVertex& b,
                       const ScreenVertex& c, const Sink& sink) {
  Prepared t;
  if (!prepare(target, a, b, c, t)) return;
  const auto wide = [](const std::int32_t* v) {
    return std::max(std::max(v[0], v[1]), v[2]) - std::min(std::min(v[0], v[1]), v[2]) >= kSmallExtent;
  };
  if (HWY_UNLIKELY(wide(t.x) || wide(t.y))) {
    raster_large(target, t, sink);
  } else {
    raster_small(target, t, sink);
  }
}

/// What the rows of a block of small triangles need, for one sample: a value for each triangle.
struct SmallBlock {
  static constexpr std::size_t kMost = 16;
  template <class T>
  using Column = T[kMost];
  alignas(64) ScreenVertex corners[3][kMost];
  alignas(64) Column<std::int32_t> dx[3];  ///< of the edges, per pixel
  alignas(64) Column<std::int32_t> dy[3];
  alignas(64) Column<std::int32_t> below[3];
  alignas(64) Column<std::int32_t> start[3];  ///< at the first pixel of the extent
  alignas(64) Column<float> z0;
  alignas(64) Column<float> toward1;
  alignas(64) Column<float> toward2;
  alignas(64) Column<std::int32_t> x0, y0, x1, y1;
};

/// The corners of a vector of triangles in subpixels from the tile's origin, the second and third exchanged where that
/// makes the area positive.
struct Corners {
  hn::Vec<I> x[3];
  hn::Vec<I> y[3];
  hn::Vec<F> z[3];
  hn::Vec<I> area;
  bool small;  ///< all of them
};

HWY_INLINE hn::Vec<I> smallest(const hn::Vec<I>* v) { return hn::Min(hn::Min(v[0], v[1]), v[2]); }
HWY_INLINE hn::Vec<I> largest(const hn::Vec<I>* v) { return hn::Max(hn::Max(v[0], v[1]), v[2]); }

HWY_INLINE Corners corners_of(const VisibilityBuffer& target, const SmallBlock& block) {
  const F d;
  const I di;
  Corners c;
  const auto scale = hn::Set(d, static_cast<float>(kSubpixels));
  const auto ox = hn::Set(di, target.origin_x * kSubpixels);
  const auto oy = hn::Set(di, target.origin_y * kSubpixels);
  for (int k = 0; k < 3; ++k) {
    hn::Vec<F> x, y, unused;
    hn::LoadInterleaved4(d, &block.corners[k][0].x, x, y, c.z[k], unused);
    c.x[k] = hn::Sub(hn::NearestInt(hn::Mul(x, scale)), ox);
    c.y[k] = hn::Sub(hn::NearestInt(hn::Mul(y, scale)), oy);
  }
  const auto extent = hn::Set(di, kSmallExtent);
  c.small = hn::AllTrue(di, hn::And(hn::Lt(hn::Sub(largest(c.x), smallest(c.x)), extent),
                                    hn::Lt(hn::Sub(largest(c.y), smallest(c.y)), extent)));
  c.area = hn::Sub(hn::Mul(hn::Sub(c.x[2], c.x[0]), hn::Sub(c.y[1], c.y[0])),
                   hn::Mul(hn::Sub(c.x[1], c.x[0]), hn::Sub(c.y[2], c.y[0])));
  const auto flipped = hn::Lt(c.area, hn::Zero(di));
  const auto exchange = [&](hn::Vec<I>* v) HWY_ATTR {
    const auto second = v[1];
    v[1] = hn::IfThenElse(flipped, v[2], second);
    v[2] = hn::IfThenElse(flipped, second, v[2]);
  };
  exchange(c.x);
  exchange(c.y);
  const auto turned = hn::RebindMask(d, flipped);
  const auto second = c.z[1];
  c.z[1] = hn::IfThenElse(turned, c.z[2], second);
  c.z[2] = hn::IfThenElse(turned, second, c.z[2]);
  c.area = hn::Abs(c.area);
  return c;
}

/// All but what depends on the sample.
HWY_INLINE void prepare_block(const Corners& c, SmallBlock& block, hn::Vec<I>* dx, hn::Vec<I>* dy) {
  const F d;
  const I di;
  const auto zero = hn::Zero(di);
  for (int e = 0; e < 3; ++e) {
    const int from = (e + 1) % 3;
    const int to = (e + 2) % 3;
    dx[e] = hn::Sub(c.y[to], c.y[from]);
    dy[e] = hn::Sub(c.x[from], c.x[to]);
    const auto top_left = hn::Or(hn::Gt(dx[e], zero), hn::And(hn::Eq(dx[e], zero), hn::Gt(dy[e], zero)));
    hn::Store(hn::IfThenElse(top_left, hn::Set(di, -1), zero), di, block.below[e]);
    hn::Store(hn::ShiftLeft<kSubpixelBits>(dx[e]), di, block.dx[e]);
    hn::Store(hn::ShiftLeft<kSubpixelBits>(dy[e]), di, block.dy[e]);
  }
  const auto inverse = hn::Div(hn::Set(d, 1.0F), hn::ConvertTo(d, c.area));
  hn::Store(c.z[0], d, block.z0);
  hn::Store(hn::Mul(hn::Sub(c.z[1], c.z[0]), inverse), d, block.toward1);
  hn::Store(hn::Mul(hn::Sub(c.z[2], c.z[0]), inverse), d, block.toward2);
}

/// The extents for a sample, and the edges' values where they begin. Triangles without area have no extent.
HWY_INLINE void prepare_sample(const VisibilityBuffer& target, const Corners& c, const hn::Vec<I>* dx,
                               const hn::Vec<I>* dy, const SamplePoint& sample, SmallBlock& block) {
  const I di;
  const auto sx = hn::Set(di, sample.x);
  const auto sy = hn::Set(di, sample.y);
  const auto up = hn::Set(di, kSubpixels - 1);
  const auto first = [&](const hn::Vec<I>* v, hn::Vec<I> s, int bound) HWY_ATTR {
    return hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(hn::Sub(smallest(v), s), up)), hn::Set(di, bound));
  };
  const auto last = [&](const hn::Vec<I>* v, hn::Vec<I> s, int bound) HWY_ATTR {
    return hn::Min(hn::ShiftRight<kSubpixelBits>(hn::Sub(largest(v), s)), hn::Set(di, bound));
  };
  const auto x0 = first(c.x, sx, target.left);
  const auto y0 = first(c.y, sy, target.top);
  const auto none = hn::Eq(c.area, hn::Zero(di));
  hn::Store(x0, di, block.x0);
  hn::Store(y0, di, block.y0);
  hn::Store(hn::IfThenElse(none, hn::Set(di, -1), last(c.x, sx, target.right - 1)), di, block.x1);
  hn::Store(last(c.y, sy, target.bottom - 1), di, block.y1);
  const auto px = hn::Add(hn::ShiftLeft<kSubpixelBits>(x0), sx);
  const auto py = hn::Add(hn::ShiftLeft<kSubpixelBits>(y0), sy);
  for (int e = 0; e < 3; ++e) {
    const int from = (e + 1) % 3;
    hn::Store(hn::Add(hn::Mul(dx[e], hn::Sub(px, c.x[from])), hn::Mul(dy[e], hn::Sub(py, c.y[from]))), di,
              block.start[e]);
  }
}

/// The rows of one triangle of a block.
HWY_INLINE void draw_rows(const VisibilityBuffer& target, const SmallBlock& block, std::size_t i, std::size_t plane,
                          const Draw& draw) {
  const F d;
  const I di;
  const int n = static_cast<int>(hn::Lanes(d));
  const auto lanes = hn::Iota(di, 0);
  hn::Vec<I> at_start[3];
  hn::Vec<I> below[3];
  hn::Vec<I> down[3];
  for (int e = 0; e < 3; ++e) {
    at_start[e] = hn::Add(hn::Mul(lanes, hn::Set(di, block.dx[e][i])), hn::Set(di, block.start[e][i]));
    below[e] = hn::Set(di, block.below[e][i]);
    down[e] = hn::Set(di, block.dy[e][i]);
  }
  const auto z0 = hn::Set(d, block.z0[i]);
  const auto toward1 = hn::Set(d, block.toward1[i]);
  const auto toward2 = hn::Set(d, block.toward2[i]);
  for (int x = block.x0[i]; x <= block.x1[i]; x += n) {
    const auto inside_columns = hn::FirstN(di, static_cast<std::size_t>(block.x1[i] - x + 1));
    hn::Vec<I> e0 = at_start[0];
    hn::Vec<I> e1 = at_start[1];
    hn::Vec<I> e2 = at_start[2];
    std::size_t at = plane + (static_cast<std::size_t>(block.y0[i]) << target.log2) + static_cast<std::size_t>(x);
    for (int y = block.y0[i]; y <= block.y1[i]; ++y, at += static_cast<std::size_t>(target.size())) {
      const auto inside =
          hn::And(hn::And(hn::Gt(e0, below[0]), hn::Gt(e1, below[1])), hn::And(hn::Gt(e2, below[2]), inside_columns));
      const auto z =
          hn::Add(z0, hn::Add(hn::Mul(hn::ConvertTo(d, e1), toward1), hn::Mul(hn::ConvertTo(d, e2), toward2)));
      draw(at, hn::RebindMask(d, inside), z);
      e0 = hn::Add(e0, down[0]);
      e1 = hn::Add(e1, down[1]);
      e2 = hn::Add(e2, down[2]);
    }
    for (int e = 0; e < 3; ++e) at_start[e] = hn::Add(at_start[e], hn::Set(di, block.dx[e][i] * n));
  }
}

void RasterTriangles(VisibilityBuffer& target, const ScreenVertex* vertices, const std::uint32_t* triangles,
                     std::uint32_t first, std::span<const std::uint32_t> numbers, RasterCounts* counts) {
  const std::size_t n = hn::Lanes(F());
  Draw draw{target.depth.data(), target.triangle.data(), 0, counts};
  // The triangles of a tile lie all over memory: their corners are asked for two blocks ahead, the vertices of these
  // one block ahead.
  const auto corner_numbers = [&](std::size_t i) { return triangles + std::size_t{3} * (numbers[i] - first); };
  SmallBlock block;
  for (std::size_t begin = 0; begin < numbers.size(); begin += n) {
    const std::size_t here = std::min(n, numbers.size() - begin);
    for (std::size_t i = begin + 2 * n; i < std::min(begin + 3 * n, numbers.size()); ++i)
      __builtin_prefetch(corner_numbers(i));
    for (std::size_t i = begin + n; i < std::min(begin + 2 * n, numbers.size()); ++i) {
      const std::uint32_t* const ahead = corner_numbers(i);
      for (int k = 0; k < 3; ++k) __builtin_prefetch(vertices + ahead[k]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t* const corners = corner_numbers(begin + std::min(i, here - 1));
      for (int k = 0; k < 3; ++k) block.corners[k][i] = vertices[corners[k]];
    }
    const Corners c = corners_of(target, block);
    if (HWY_UNLIKELY(!c.small)) {
      for (std::size_t i = 0; i < here; ++i) {
        draw.number = numbers[begin + i];
        raster(target, block.corners[0][i], block.corners[1][i], block.corners[2][i], draw);
      }
      continue;
    }
    hn::Vec<I> dx[3];
    hn::Vec<I> dy[3];
    prepare_block(c, block, dx, dy);
    for (std::size_t s = 0; s < target.samples.size(); ++s) {
      prepare_sample(target, c, dx, dy, target.samples[s], block);
      for (std::size_t i = 0; i < here; ++i) {
        draw.number = numbers[begin + i];
        draw_rows(target, block, i, s * target.pixels(), draw);
      }
    }
  }
}

void RasterTriangle(VisibilityBuffer& target, const std::array<ScreenVertex, 3>& v, std::uint32_t number,
                    RasterCounts* counts) {
  raster(target, v[0], v[1], v[2], Draw{target.depth.data(), target.triangle.data(), number, counts});
}

void CoverTriangle(const VisibilityBuffer& target, const std::array<ScreenVertex, 3>& v,
                   std::vector<CoveredSample>& covered) {
  raster(target, v[0], v[1], v[2], Cover{target.depth.data(), &covered});
}

VisibleCounts VisiblePixels(const VisibilityBuffer& buffer, std::uint32_t* pixels, std::uint32_t* triangles,
                            std::uint32_t* mixed) {
  const U du;
  const std::size_t n = hn::Lanes(du);
  const auto none = hn::Set(du, kNoTriangle);
  const auto lanes = hn::Iota(du, 0);
  VisibleCounts counts;
  for (std::size_t at = 0; at < buffer.pixels(); at += n) {
    const auto triangle = hn::LoadU(du, buffer.triangle.data() + at);
    auto any = hn::Ne(triangle, none);
    auto same = any;
    for (std::size_t s = 1; s < buffer.samples.size(); ++s) {
      const auto other = hn::LoadU(du, buffer.triangle.data() + s * buffer.pixels() + at);
      any = hn::Or(any, hn::Ne(other, none));
      same = hn::And(same, hn::Eq(other, triangle));
    }
    if (hn::AllFalse(du, any)) continue;
    const auto place = hn::Add(lanes, hn::Set(du, static_cast<std::uint32_t>(at)));
    hn::StoreU(hn::Compress(place, same), du, pixels + counts.whole);
    hn::StoreU(hn::Compress(triangle, same), du, triangles + counts.whole);
    counts.whole += hn::CountTrue(du, same);
    const auto different = hn::AndNot(same, any);
    if (hn::AllFalse(du, different)) continue;
    hn::StoreU(hn::Compress(place, different), du, mixed + counts.mixed);
    counts.mixed += hn::CountTrue(du, different);
  }
  return counts;
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(RasterTriangles);
HWY_EXPORT(RasterTriangle);
HWY_EXPORT(CoverTriangle);
HWY_EXPORT(VisiblePixels);

void raster_triangles(VisibilityBuffer& target, const ScreenVertex* vertices, const std::uint32_t* triangles,
                      std::uint32_t first, std::span<const std::uint32_t> numbers, RasterCounts* counts) {
  HWY_DYNAMIC_DISPATCH(RasterTriangles)(target, vertices, triangles, first, numbers, counts);
}

void raster_triangle(VisibilityBuffer& target, const std::array<ScreenVertex, 3>& vertices, std::uint32_t number,
                     RasterCounts* counts) {
  HWY_DYNAMIC_DISPATCH(RasterTriangle)(target, vertices, number, counts);
}

void cover_triangle(const VisibilityBuffer& target, const std::array<ScreenVertex, 3>& vertices,
                    std::vector<CoveredSample>& covered) {
  HWY_DYNAMIC_DISPATCH(CoverTriangle)(target, vertices, covered);
}

VisibleCounts visible_pixels(const VisibilityBuffer& buffer, std::uint32_t* pixels, std::uint32_t* triangles,
                             std::uint32_t* mixed) {
  return HWY_DYNAMIC_DISPATCH(VisiblePixels)(buffer, pixels, triangles, mixed);
}

}  // namespace azulejo::kernels
#endif
