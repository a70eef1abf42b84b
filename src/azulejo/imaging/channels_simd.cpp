#include "azulejo/imaging/channels_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/channels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Channels of a vector of pixels, each in a row of `planes`.
template <class D, class T>
HWY_INLINE void Split(D d, const T* pixels, int channels, T* planes) {
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<D> c0, c1, c2, c3;
  switch (channels) {
    case 1: hn::Store(hn::LoadU(d, pixels), d, planes); return;
    case 2:
      hn::LoadInterleaved2(d, pixels, c0, c1);
      hn::Store(c0, d, planes);
      hn::Store(c1, d, planes + lanes);
      return;
    case 3:
      hn::LoadInterleaved3(d, pixels, c0, c1, c2);
      hn::Store(c0, d, planes);
      hn::Store(c1, d, planes + lanes);
      hn::Store(c2, d, planes + 2 * lanes);
      return;
    default:
      hn::LoadInterleaved4(d, pixels, c0, c1, c2, c3);
      hn::Store(c0, d, planes);
      hn::Store(c1, d, planes + lanes);
      hn::Store(c2, d, planes + 2 * lanes);
      hn::Store(c3, d, planes + 3 * lanes);
  }
}

template <class D, class T>
HWY_INLINE void Merge(D d, const T* const* planes, int channels, T* pixels) {
  const auto plane = [&](int c) HWY_ATTR { return hn::Load(d, planes[c]); };
  switch (channels) {
    case 1: return hn::StoreU(plane(0), d, pixels);
    case 2: return hn::StoreInterleaved2(plane(0), plane(1), d, pixels);
    case 3: return hn::StoreInterleaved3(plane(0), plane(1), plane(2), d, pixels);
    default: return hn::StoreInterleaved4(plane(0), plane(1), plane(2), plane(3), d, pixels);
  }
}

/// One image's channels and where they go.
struct Route {
  int source;
  int channels;
};

template <class T>
void TakeTile(std::span<const ConstAnyView> sources, std::span<const TakenChannel> taken, const AnyView& result) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN T split[4][4 * HWY_MAX_BYTES / sizeof(T)];  // of up to four images
  HWY_ALIGN T constant[4][HWY_MAX_BYTES / sizeof(T)];
  HWY_ALIGN T buffer[4 * HWY_MAX_BYTES / sizeof(T)] = {};
  Route routes[4];
  int route_count = 0;
  const T* planes[4];
  for (std::size_t k = 0; k < taken.size(); ++k) {
    if (taken[k].source < 0) {
      hn::Store(hn::Set(d, static_cast<T>(taken[k].constant * full_range(kPixelTypeOf<T>))), d, constant[k]);
      planes[k] = constant[k];
      continue;
    }
    int r = 0;
    while (r < route_count && routes[r].source != taken[k].source) ++r;
    if (r == route_count) {
      routes[route_count++] = {taken[k].source, sources[static_cast<std::size_t>(taken[k].source)].info.channels};
    }
    planes[k] = split[r] + static_cast<std::size_t>(taken[k].channel) * lanes;
  }
  const int to_channels = result.info.channels;
  const auto to_step = static_cast<std::size_t>(to_channels);
  const auto width = static_cast<std::size_t>(result.info.width);
  for (int y = 0; y < result.info.height; ++y) {
    T* const to = result.as<T>().row(y);
    for (std::size_t x = 0; x < width; x += lanes) {
      const std::size_t pixels = std::min(lanes, width - x);
      for (int r = 0; r < route_count; ++r) {
        const auto step = static_cast<std::size_t>(routes[r].channels);
        const T* from = sources[static_cast<std::size_t>(routes[r].source)].as<T>().row(y) + x * step;
        if (pixels < lanes) {
          std::memcpy(buffer, from, pixels * step * sizeof(T));
          from = buffer;
        }
        Split(d, from, routes[r].channels, split[r]);
      }
      if (pixels == lanes) {
        Merge(d, planes, to_channels, to + x * to_step);
      } else {
        Merge(d, planes, to_channels, buffer);
        std::memcpy(to + x * to_step, buffer, pixels * to_step * sizeof(T));
      }
    }
  }
}

void TakeChannels(std::span<const ConstAnyView> sources, std::span<const TakenChannel> taken, const AnyView& result) {
  visit_type(result.info.type, [&](auto zero) HWY_ATTR { TakeTile<decltype(zero)>(sources, taken, result); });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(TakeChannels);

void take_channels(std::span<const ConstAnyView> sources, std::span<const TakenChannel> taken, const AnyView& result) {
  HWY_DYNAMIC_DISPATCH(TakeChannels)(sources, taken, result);
}

}  // namespace azulejo::kernels
#endif
