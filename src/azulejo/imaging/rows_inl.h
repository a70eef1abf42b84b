// Rows of f32 with alpha. Compiled once for every vector target: included by *_simd.cpp after <hwy/highway.h>.
#if defined(AZULEJO_IMAGING_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_ROWS_INL_H
#undef AZULEJO_IMAGING_ROWS_INL_H
#else
#define AZULEJO_IMAGING_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "azulejo/imaging/stored_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = FloatTag;
using DI = WholeTag;
using V = hn::Vec<D>;

/// The alpha of each value's pixel, and which values are alpha.
template <int kChannels>
struct AlphaOf {
  AlphaOf() {
    const D d;
    HWY_ALIGN float pattern[HWY_MAX_BYTES / 4];
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) pattern[i] = i % kChannels == kChannels - 1 ? 1.0F : 0.0F;
    is_alpha = hn::Gt(hn::Load(d, pattern), hn::Zero(d));
  }
  HWY_INLINE V operator()(V v) const {
    if constexpr (kChannels == 2) {
      return hn::DupOdd(v);
    } else {
      return hn::Broadcast<3>(v);
    }
  }
  hn::Mask<D> is_alpha;
};

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
