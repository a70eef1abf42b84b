#include "azulejo/imaging/threshold_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/threshold_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/point_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
struct VectorThreshold : ThresholdPoint<T> {
  using ThresholdPoint<T>::ThresholdPoint;
  template <class D, class V>
  HWY_INLINE V operator()(D d, V v) const {
    return hn::IfThenElse(hn::Gt(v, hn::Set(d, this->level)), hn::Set(d, this->above), hn::Set(d, this->below));
  }
};

void Threshold(const ConstAnyView& source, const AnyView& result, const ThresholdOptions& options) {
  point_tile<VectorThreshold>(source, result, options);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Threshold);

void threshold(const ConstAnyView& source, const AnyView& result, const ThresholdOptions& options) {
  HWY_DYNAMIC_DISPATCH(Threshold)(source, result, options);
}

}  // namespace azulejo::kernels
#endif
