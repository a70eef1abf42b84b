#include <algorithm>
#include <limits>

#include "azulejo/rendering/vertex_stage.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/vertex_stage_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void TransformVertices(const glm::vec3* positions, std::size_t count, const glm::mat4& m,
                       const ScreenTransform& transform, ScreenVertex* result) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t n = hn::Lanes(d);
  const auto row = [&](int r, V x, V y, V z) HWY_ATTR {
    const V xy = hn::Add(hn::Mul(hn::Set(d, m[0][r]), x), hn::Mul(hn::Set(d, m[1][r]), y));
    return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, m[2][r]), z)), hn::Set(d, m[3][r]));
  };
  const auto transformed = [&](const float* from, float* to) HWY_ATTR {
    V x, y, z;
    hn::LoadInterleaved3(d, from, x, y, z);
    const V cx = row(0, x, y, z);
    const V cy = row(1, x, y, z);
    const V cz = row(2, x, y, z);
    const V cw = row(3, x, y, z);
    const V inverse = hn::Div(hn::Set(d, 1.0F), cw);
    V sx = hn::Add(hn::Mul(hn::Mul(cx, inverse), hn::Set(d, transform.scale_x)), hn::Set(d, transform.offset_x));
    const V sy = hn::Add(hn::Mul(hn::Mul(cy, inverse), hn::Set(d, transform.scale_y)), hn::Set(d, transform.offset_y));
    const V zero = hn::Zero(d);
    const V guard = hn::Set(d, kGuardBand);
    const auto in_depth = hn::And(hn::And(hn::Ge(cz, zero), hn::Le(cz, cw)), hn::Gt(cw, zero));
    const auto inside = hn::And(in_depth, hn::And(hn::Le(hn::Abs(sx), guard), hn::Le(hn::Abs(sy), guard)));
    sx = hn::IfThenElse(inside, sx, hn::Set(d, std::numeric_limits<float>::quiet_NaN()));
    hn::StoreInterleaved4(sx, sy, hn::Mul(cz, inverse), inverse, d, to);
  };
  std::size_t i = 0;
  for (; i + n <= count; i += n) transformed(&positions[i].x, &result[i].x);
  if (i == count) return;
  HWY_ALIGN float from[3 * (HWY_MAX_BYTES / 4)] = {};
  HWY_ALIGN ScreenVertex to[HWY_MAX_BYTES / 4];
  std::copy(&positions[i].x, &positions[i].x + 3 * (count - i), from);
  transformed(from, &to[0].x);
  std::copy(to, to + (count - i), result + i);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(TransformVertices);

void transform_vertices(const glm::vec3* positions, std::size_t count, const glm::mat4& clip_from_object,
                        const ScreenTransform& transform, ScreenVertex* result) {
  HWY_DYNAMIC_DISPATCH(TransformVertices)(positions, count, clip_from_object, transform, result);
}

}  // namespace azulejo::kernels
#endif
