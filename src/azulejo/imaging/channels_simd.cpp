#include "azulejo/imaging/channels_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/channels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <span>

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

/// Channels of one image by shuffling bytes: as many pixels as 16 bytes hold, of the source and of the result.
class Shuffle {
 public:
  Shuffle(std::span<const TakenChannel> taken, int source_channels, PixelType type)
      : from_bytes_(static_cast<std::size_t>(source_channels) * size_of(type)),
        to_bytes_(taken.size() * size_of(type)),
        pixels_(16 / std::max(from_bytes_, to_bytes_)) {
    const std::size_t value = size_of(type);
    std::fill_n(place_, 16, std::uint8_t{0x80});
    for (std::size_t at = 0; at < pixels_ * to_bytes_; ++at) {
      const TakenChannel& channel = taken[at % to_bytes_ / value];
      if (channel.source < 0) {
        // Whole steps of 0 and 1 only: all bytes are alike.
        constant_[at] = channel.constant > 0.5F ? 0xFF : 0;
      } else {
        const std::size_t byte = static_cast<std::size_t>(channel.channel) * value + at % value;
        place_[at] = static_cast<std::uint8_t>(at / to_bytes_ * from_bytes_ + byte);
      }
    }
  }

  /// Whether there is more than a pixel at once, and no constant but 0 and 1. A channel or two are taken faster from whole
  /// vectors of each channel.
  static bool fits(std::span<const TakenChannel> taken, int source_channels, PixelType type) {
    const auto most = static_cast<std::size_t>(std::max(source_channels, static_cast<int>(taken.size())));
    return type != PixelType::F32 && taken.size() > 2 && most * size_of(type) <= 8 &&
           std::ranges::all_of(taken, [](const TakenChannel& each) {
             return each.source >= 0 || each.constant == 0 || each.constant == 1;
           });
  }

  /// The first pixels of a row; how many. In place is allowed where both have as many channels.
  HWY_INLINE std::size_t Row(const std::byte* source, std::byte* result, std::size_t width) const {
    const hn::FixedTag<std::uint8_t, 16> d;
    const auto* from = reinterpret_cast<const std::uint8_t*>(source);
    auto* to = reinterpret_cast<std::uint8_t*>(result);
    const std::size_t fewest = std::min(from_bytes_, to_bytes_);
    if (width * fewest < 16) return 0;
    // Whole vectors are read and written up to here.
    const std::size_t last = (width * fewest - 16) / fewest;
    const auto place = hn::Load(d, place_);
    const auto constant = hn::Load(d, constant_);
    // A vector is stored when the next one is loaded: in place, its last bytes may be the first of that.
    std::size_t x = 0;
    auto bytes = hn::LoadU(d, from);
    for (; x + pixels_ <= last; x += pixels_) {
      const auto next = hn::LoadU(d, from + (x + pixels_) * from_bytes_);
      hn::StoreU(hn::Or(hn::TableLookupBytesOr0(bytes, place), constant), d, to + x * to_bytes_);
      bytes = next;
    }
    HWY_ALIGN std::uint8_t rest[16];
    hn::Store(hn::Or(hn::TableLookupBytesOr0(bytes, place), constant), d, rest);
    std::memcpy(to + x * to_bytes_, rest, pixels_ * to_bytes_);
    return x + pixels_;
  }

 private:
  std::size_t from_bytes_;
  std::size_t to_bytes_;
  std::size_t pixels_;
  HWY_ALIGN std::uint8_t place_[16];
  HWY_ALIGN std::uint8_t constant_[16] = {};
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
  const bool shuffled = route_count == 1 && Shuffle::fits(taken, routes[0].channels, result.info.type);
  const Shuffle shuffle(shuffled ? taken : taken.first(1), shuffled ? routes[0].channels : 1, result.info.type);
  for (int y = 0; y < result.info.height; ++y) {
    T* const to = result.as<T>().row(y);
    const std::size_t first =
        shuffled ? shuffle.Row(sources[static_cast<std::size_t>(routes[0].source)].row(y), result.row(y), width) : 0;
    for (std::size_t x = first; x < width; x += lanes) {
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
