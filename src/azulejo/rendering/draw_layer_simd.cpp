#include <algorithm>

#include "azulejo/rendering/draw_layer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/draw_layer_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kBlock>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;

template <class Each>
HWY_INLINE void for_lanes(Each&& each) {
  const F f;
  for (std::size_t x = 0; x < kBlock; x += hn::Lanes(f)) each(x);
}

HWY_INLINE float* block_of(const LayerRow& row, int block) {
  return row.pixels + static_cast<std::ptrdiff_t>(block) * kBlockFloats;
}

/// Makes pixels of a block that is one color.
HWY_INLINE void spread(const LayerRow& row, int block) {
  if (row.plain[block] == 0) return;
  row.plain[block] = 0;
  const F f;
  float* const pixels = block_of(row, block);
  for (int c = 0; c < 4; ++c) {
    const VF color = hn::Set(f, row.colors[block][c]);
    for_lanes([&](std::size_t x) { hn::Store(color, f, pixels + c * kBlock + x); });
  }
}

HWY_INLINE bool is_bare(const float* coverage) {
  const F f;
  VF any = hn::Zero(f);
  for_lanes([&](std::size_t x) { any = hn::Or(any, hn::Load(f, coverage + x)); });
  return hn::AllTrue(f, hn::Eq(any, hn::Zero(f)));
}

HWY_INLINE bool is_full(const float* coverage) {
  const F f;
  bool full = true;
  for_lanes([&](std::size_t x) { full = full && hn::AllTrue(f, hn::Eq(hn::Load(f, coverage + x), hn::Set(f, 1.0F))); });
  return full;
}

/// color  coverage · color
HWY_INLINE void cover_plain(const LayerRow& row, int block, const glm::vec4& color) {
  const float kept = 1.0F - color.w;
  if (kept == 0.0F) {
    row.plain[block] = 1;
    row.colors[block] = color;
    return;
  }
  if (row.plain[block] != 0) {
    glm::vec4& below = row.colors[block];
    for (int c = 0; c < 4; ++c) below[c] = below[c] * kept + color[c];
    return;
  }
  const F f;
  float* const pixels = block_of(row, block);
  const VF keep = hn::Set(f, kept);
  for (int c = 0; c < 4; ++c) {
    const VF added = hn::Set(f, color[c]);
    for_lanes([&](std::size_t x) {
      float* const at = pixels + c * kBlock + x;
      hn::Store(hn::Add(hn::Mul(hn::Load(f, at), keep), added), f, at);
    });
  }
}

HWY_INLINE void cover_mixed(const LayerRow& row, int block, const float* coverage, const glm::vec4& color) {
  if (is_bare(coverage)) return;
  if (is_full(coverage)) return cover_plain(row, block, color);
  spread(row, block);
  const F f;
  float* const pixels = block_of(row, block);
  for_lanes([&](std::size_t x) {
    const VF part = hn::Load(f, coverage + x);
    const VF alpha = hn::Mul(part, hn::Set(f, color.w));
    const VF kept = hn::Sub(hn::Set(f, 1.0F), alpha);
    for (int c = 0; c < 4; ++c) {
      float* const at = pixels + c * kBlock + x;
      const VF added = c == 3 ? alpha : hn::Mul(part, hn::Set(f, color[c]));
      hn::Store(hn::Add(hn::Mul(hn::Load(f, at), kept), added), f, at);
    }
  });
}

void CoverWithColor(const LayerRow& row, const RunCoverage& run, const glm::vec4& color) {
  if (run.values == nullptr) {
    glm::vec4 covering;
    for (int c = 0; c < 4; ++c) covering[c] = run.value * color[c];
    for (int block = run.first; block < run.last; ++block) cover_plain(row, block, covering);
    return;
  }
  for (int block = run.first; block < run.last; ++block) cover_mixed(row, block, run.values + block * kBlock, color);
}

/// part(x)  coverage of the pixels from x on
template <class Part>
HWY_INLINE void cover_block(float* pixels, const float* colors, Part&& part_at) {
  const F f;
  for_lanes([&](std::size_t x) {
    const VF part = part_at(x);
    const VF kept = hn::Sub(hn::Set(f, 1.0F), hn::Mul(part, hn::Load(f, colors + 3 * kBlock + x)));
    for (int c = 0; c < 4; ++c) {
      float* const at = pixels + c * kBlock + x;
      hn::Store(hn::Add(hn::Mul(hn::Load(f, at), kept), hn::Mul(part, hn::Load(f, colors + c * kBlock + x))), f, at);
    }
  });
}

void CoverWithColors(const LayerRow& row, const RunCoverage& run, const float* colors) {
  const F f;
  for (int block = run.first; block < run.last; ++block, colors += kBlockFloats) {
    const float* const coverage = run.values == nullptr ? nullptr : run.values + block * kBlock;
    if (coverage != nullptr && is_bare(coverage)) continue;
    spread(row, block);
    float* const pixels = block_of(row, block);
    if (coverage != nullptr) {
      cover_block(pixels, colors, [&](std::size_t x) { return hn::Load(f, coverage + x); });
    } else {
      cover_block(pixels, colors, [&](std::size_t) { return hn::Set(f, run.value); });
    }
  }
}

void CoverWithLayer(const LayerRow& row, const LayerRow& top, int first, int last, float opacity) {
  const F f;
  for (int block = first; block < last; ++block) {
    if (top.plain[block] != 0) {
      glm::vec4 color;
      for (int c = 0; c < 4; ++c) color[c] = opacity * top.colors[block][c];
      if (color.w != 0.0F) cover_plain(row, block, color);
      continue;
    }
    spread(row, block);
    cover_block(block_of(row, block), block_of(top, block), [&](std::size_t) { return hn::Set(f, opacity); });
  }
}

void KeepInside(const LayerRow& row, const LayerRow& mask, int first, int last) {
  const F f;
  for (int block = first; block < last; ++block) {
    if (mask.plain[block] != 0) {
      const float part = mask.colors[block].w;
      if (part == 1.0F) continue;
      if (row.plain[block] != 0 || part == 0.0F) {
        for (int c = 0; c < 4; ++c) row.colors[block][c] = part == 0.0F ? 0.0F : row.colors[block][c] * part;
        row.plain[block] = 1;
        continue;
      }
    }
    spread(row, block);
    float* const pixels = block_of(row, block);
    const float* const inside = block_of(mask, block) + 3 * kBlock;
    for_lanes([&](std::size_t x) {
      const VF part = mask.plain[block] != 0 ? hn::Set(f, mask.colors[block].w) : hn::Load(f, inside + x);
      for (int c = 0; c < 4; ++c) {
        float* const at = pixels + c * kBlock + x;
        hn::Store(hn::Mul(hn::Load(f, at), part), f, at);
      }
    });
  }
}

/// 0–255 from premultiplied colors with their alpha above 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE auto byte_of(D d, V color, V alpha, bool linear) {
  const hn::RebindToSigned<D> i;
  V straight = hn::Div(color, alpha);
  if (linear) straight = LinearToSrgb(d, straight);
  return hn::ConvertTo(i, hn::Add(hn::Mul(hn::Min(straight, hn::Set(d, 1.0F)), hn::Set(d, 255.0F)), hn::Set(d, 0.5F)));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE auto packed(D d, V red, V green, V blue, V alpha, bool linear) {
  const hn::RebindToSigned<D> i;
  const V safe = hn::Max(alpha, hn::Set(d, 1e-30F));
  const auto a =
      hn::ConvertTo(i, hn::Add(hn::Mul(hn::Min(alpha, hn::Set(d, 1.0F)), hn::Set(d, 255.0F)), hn::Set(d, 0.5F)));
  const auto rgb = hn::Or(byte_of(d, red, safe, linear), hn::Or(hn::ShiftLeft<8>(byte_of(d, green, safe, linear)),
                                                                hn::ShiftLeft<16>(byte_of(d, blue, safe, linear))));
  // What nothing was painted on is black without alpha.
  return hn::Or(hn::IfThenZeroElse(hn::Eq(a, hn::Zero(i)), rgb), hn::ShiftLeft<24>(a));
}

void StoreRow(const LayerRow& row, int width, bool linear, std::uint8_t* rgba) {
  const F f;
  const I i;
  HWY_ALIGN std::int32_t scratch[kBlock];
  glm::vec4 last_color(0);
  auto last = hn::Zero(i);  // what that is
  for (int block = 0; block * kBlock < width; ++block) {
    const int count = std::min(kBlock, width - block * kBlock);
    std::uint8_t* const bytes = rgba + static_cast<std::ptrdiff_t>(block) * kBlock * 4;
    std::int32_t* const pixels =
        count == kBlock ? reinterpret_cast<std::int32_t*>(bytes) : static_cast<std::int32_t*>(scratch);
    if (row.plain[block] != 0) {
      const glm::vec4& color = row.colors[block];
      if (color != last_color) {
        last_color = color;
        last = packed(f, hn::Set(f, color.x), hn::Set(f, color.y), hn::Set(f, color.z), hn::Set(f, color.w), linear);
      }
      for_lanes([&](std::size_t x) { hn::StoreU(last, i, pixels + x); });
    } else {
      const float* const from = block_of(row, block);
      for_lanes([&](std::size_t x) {
        const auto channel = [&](int c) { return hn::Load(f, from + c * kBlock + x); };
        hn::StoreU(packed(f, channel(0), channel(1), channel(2), channel(3), linear), i, pixels + x);
      });
    }
    if (count < kBlock) std::copy_n(reinterpret_cast<const std::uint8_t*>(scratch), count * 4, bytes);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(CoverWithColor);
HWY_EXPORT(CoverWithColors);
HWY_EXPORT(CoverWithLayer);
HWY_EXPORT(KeepInside);
HWY_EXPORT(StoreRow);

void cover_with_color(const LayerRow& row, const RunCoverage& run, const glm::vec4& color) {
  HWY_DYNAMIC_DISPATCH(CoverWithColor)(row, run, color);
}
void cover_with_colors(const LayerRow& row, const RunCoverage& run, const float* colors) {
  HWY_DYNAMIC_DISPATCH(CoverWithColors)(row, run, colors);
}
void cover_with_layer(const LayerRow& row, const LayerRow& top, int first, int last, float opacity) {
  HWY_DYNAMIC_DISPATCH(CoverWithLayer)(row, top, first, last, opacity);
}
void keep_inside(const LayerRow& row, const LayerRow& mask, int first, int last) {
  HWY_DYNAMIC_DISPATCH(KeepInside)(row, mask, first, last);
}
void store_row(const LayerRow& row, int width, bool linear, std::uint8_t* rgba) {
  HWY_DYNAMIC_DISPATCH(StoreRow)(row, width, linear, rgba);
}

}  // namespace azulejo::kernels
#endif
