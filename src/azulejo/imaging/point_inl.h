// Compiled once for every vector target: included by *_simd.cpp after <hwy/highway.h>.
#if defined(AZULEJO_IMAGING_POINT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_POINT_INL_H
#undef AZULEJO_IMAGING_POINT_INL_H
#else
#define AZULEJO_IMAGING_POINT_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstring>

#include "azulejo/imaging/memory_bound_inl.h"
#include "azulejo/imaging/point.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

/// result[i] = point(d, source[i]) for whole vectors; the last value of each period is copied. In place is allowed.
template <class T, class Point>
void point_row(const T* source, T* result, std::size_t count, int period, const Point& point) {
  namespace hn = hwy::HWY_NAMESPACE;
  const MemoryBoundTag<T> d;
  const std::size_t lanes = hn::Lanes(d);  // a multiple of every period
  std::size_t i = 0;
  if (period == 0) {
    for (; i + 2 * lanes <= count; i += 2 * lanes) {
      const auto first = hn::LoadU(d, source + i);
      const auto second = hn::LoadU(d, source + i + lanes);
      hn::StoreU(point(d, first), d, result + i);
      hn::StoreU(point(d, second), d, result + i + lanes);
    }
  }
  HWY_ALIGN T rest[HWY_MAX_BYTES / sizeof(T)] = {};
  if (period > 0) {
    const auto each = static_cast<std::size_t>(period);
    for (std::size_t k = each - 1; k < lanes; k += each) rest[k] = T{1};
  }
  const auto is_alpha = hn::Ne(hn::Load(d, rest), hn::Zero(d));
  for (; i + lanes <= count; i += lanes) {
    const auto v = hn::LoadU(d, source + i);
    hn::StoreU(hn::IfThenElse(is_alpha, v, point(d, v)), d, result + i);
  }
  if (i < count) {
    std::memcpy(rest, source + i, (count - i) * sizeof(T));
    const auto v = hn::Load(d, rest);
    hn::Store(hn::IfThenElse(is_alpha, v, point(d, v)), d, rest);
    std::memcpy(result + i, rest, (count - i) * sizeof(T));
  }
}

/// The rows of a tile by VectorPoint<T>(options), which has V operator()(D d, V values) const.
template <template <class> class VectorPoint, class Options>
void point_tile(const ConstAnyView& source, const AnyView& result, const Options& options) {
  for_rows(source, result, [&](const auto* from, auto* to, std::size_t count, int period) HWY_ATTR {
    using T = std::remove_pointer_t<decltype(to)>;
    point_row<T>(from, to, count, period, VectorPoint<T>(options));
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
