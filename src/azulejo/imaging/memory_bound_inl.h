// Compiled once for every vector target: included by *_simd.cpp after <hwy/highway.h>.
#if defined(AZULEJO_IMAGING_MEMORY_BOUND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AZULEJO_IMAGING_MEMORY_BOUND_INL_H
#undef AZULEJO_IMAGING_MEMORY_BOUND_INL_H
#else
#define AZULEJO_IMAGING_MEMORY_BOUND_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

/// For loops that wait for memory: vectors of at most 32 bytes. On a Zen 4 with AVX-512, accesses of 64 bytes to what is
/// in no cache are slower: differences of 24 megapixels of bytes 2.9 ms instead of 2.2, threshold 2.0 instead of 1.4.
template <class T>
using MemoryBoundTag = hwy::HWY_NAMESPACE::CappedTag<T, 32 / sizeof(T)>;

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
