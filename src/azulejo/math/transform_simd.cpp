#include "azulejo/math/transform_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/math/transform_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

/// Calls f(source, target) for vectors of points of kNumbers numbers; the last, incomplete one is done in scratch, so
/// that nothing is done twice in place.
template <std::size_t kNumbers, class F>
HWY_INLINE void for_points(const float* source, float* target, std::size_t count, F f) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) f(source + kNumbers * i, target + kNumbers * i);
  if (i == count) return;
  HWY_ALIGN float rest[kNumbers * HWY_MAX_BYTES / sizeof(float)] = {};
  for (std::size_t k = kNumbers * i; k < kNumbers * count; ++k) rest[k - kNumbers * i] = source[k];
  f(rest, rest);
  for (std::size_t k = kNumbers * i; k < kNumbers * count; ++k) target[k] = rest[k - kNumbers * i];
}

/// What is multiplied with x, y and 1, by turns for both results.
void TransformAffine2(const glm::mat3& m, const float* source, float* target, std::size_t count) {
  const D d;
  const auto turns = [&](float even, float odd) HWY_ATTR { return hn::OddEven(hn::Set(d, odd), hn::Set(d, even)); };
  const V own = turns(m[0].x, m[1].y);
  const V other = turns(m[1].x, m[0].y);
  const V shift = turns(m[2].x, m[2].y);
  const std::size_t lanes = hn::Lanes(d);
  for_points<2>(source, target, count, [&](const float* from, float* to) HWY_ATTR {
    const V a = hn::LoadU(d, from);
    const V b = hn::LoadU(d, from + lanes);
    const V at = hn::Add(hn::Add(hn::Mul(own, a), hn::Mul(other, hn::Shuffle2301(a))), shift);
    const V bt = hn::Add(hn::Add(hn::Mul(own, b), hn::Mul(other, hn::Shuffle2301(b))), shift);
    hn::StoreU(at, d, to);
    hn::StoreU(bt, d, to + lanes);
  });
}

void TransformProjective2(const glm::mat3& m, const float* source, float* target, std::size_t count) {
  const D d;
  for_points<2>(source, target, count, [&](const float* from, float* to) HWY_ATTR {
    V x;
    V y;
    hn::LoadInterleaved2(d, from, x, y);
    const auto row = [&](int r) HWY_ATTR {
      return hn::Add(hn::Add(hn::Mul(hn::Set(d, m[0][r]), x), hn::Mul(hn::Set(d, m[1][r]), y)), hn::Set(d, m[2][r]));
    };
    const V h = row(2);
    hn::StoreInterleaved2(hn::Div(row(0), h), hn::Div(row(1), h), d, to);
  });
}

/// Row r of a matrix with three coordinates.
HWY_INLINE V Row3(const glm::mat4& m, int r, V x, V y, V z) {
  const D d;
  const V xy = hn::Add(hn::Mul(hn::Set(d, m[0][r]), x), hn::Mul(hn::Set(d, m[1][r]), y));
  return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, m[2][r]), z)), hn::Set(d, m[3][r]));
}

void TransformAffine3(const glm::mat4& m, const float* source, float* target, std::size_t count) {
  const D d;
  for_points<3>(source, target, count, [&](const float* from, float* to) HWY_ATTR {
    V x;
    V y;
    V z;
    hn::LoadInterleaved3(d, from, x, y, z);
    hn::StoreInterleaved3(Row3(m, 0, x, y, z), Row3(m, 1, x, y, z), Row3(m, 2, x, y, z), d, to);
  });
}

void TransformProjective3(const glm::mat4& m, const float* source, float* target, std::size_t count) {
  const D d;
  for_points<3>(source, target, count, [&](const float* from, float* to) HWY_ATTR {
    V x;
    V y;
    V z;
    hn::LoadInterleaved3(d, from, x, y, z);
    const V h = Row3(m, 3, x, y, z);
    hn::StoreInterleaved3(hn::Div(Row3(m, 0, x, y, z), h), hn::Div(Row3(m, 1, x, y, z), h),
                          hn::Div(Row3(m, 2, x, y, z), h), d, to);
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(TransformAffine2);
HWY_EXPORT(TransformProjective2);
HWY_EXPORT(TransformAffine3);
HWY_EXPORT(TransformProjective3);

void transform_affine2(const glm::mat3& m, const float* source, float* target, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(TransformAffine2)(m, source, target, count);
}
void transform_projective2(const glm::mat3& m, const float* source, float* target, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(TransformProjective2)(m, source, target, count);
}
void transform_affine3(const glm::mat4& m, const float* source, float* target, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(TransformAffine3)(m, source, target, count);
}
void transform_projective3(const glm::mat4& m, const float* source, float* target, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(TransformProjective3)(m, source, target, count);
}

}  // namespace azulejo::kernels
#endif
