#include "azulejo/imaging/color_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The peer's value v of one of our channels: it is its channel `index`, and stored as ours when scale · v + offset.
struct Channel {
  int index;
  double scale = 1;
  double offset = 0;
  bool hue = false;  ///< 0 and full range are the same
};

struct Conversion {
  ColorSpace from;
  ColorSpace to;
  int code;  ///< the peer's
  std::array<Channel, 3> channels;
  double tolerance;  ///< in units of full range
};

Check compare(const ConstAnyView& ours, const ConstAnyView& peer, const Conversion& what) {
  double worst = 0;
  visit(ours, [&](auto view) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data)>>;
    const auto other = peer.as<T>();
    const auto full = static_cast<double>(full_range(kPixelTypeOf<T>));
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const Channel& channel = what.channels[static_cast<std::size_t>(c)];
          const double value = static_cast<double>(other(x, y, channel.index)) / full;
          const double straight =
              std::abs(static_cast<double>(view(x, y, c)) / full - (channel.scale * value + channel.offset));
          worst = std::max(worst, channel.hue ? std::min(straight, std::abs(1 - straight)) : straight);
        }
      }
    }
  });
  return {worst <= what.tolerance, fmt::format("largest difference {:.3g} of full range", worst)};
}

void add(Bench& bench, const Conversion& what, PixelType type, Size size, double aim) {
  const auto name = [](ColorSpace space) { return enum_names(space)[static_cast<std::size_t>(space)]; };
  const ImageInfo info = photo(type, 3, size);
  bench.row(fmt::format("color_space {} {}, {}", name(what.from), name(what.to), kind(info)), [=] {
    const auto source = make_photo(info);
    const auto ours = make_result(info);
    const auto peer = make_result(info);
    Row row;
    row.work = static_cast<double>(info.rect().area());
    row.ours = [=](int threads) {
      color_space(source->any(), ours->any(), {.to = what.to, .from = what.from}, Run{.threads = threads});
    };
    row.peer = [=](int) {
      const cv::Mat result = mat(peer->any());
      cv::cvtColor(mat(source->any()), result, what.code);
    };
    row.check = [=] { return compare(ours->any(), peer->any(), what); };
    const std::size_t bytes = info.row_bytes() * static_cast<std::size_t>(info.height);
    row.limit = copy_limit(bytes, bytes);
    row.aim = aim;
    return row;
  });
}

using enum ColorSpace;

const Rows kRows([](Bench& bench) {
  constexpr std::array<Channel, 3> kSame{{{0}, {1}, {2}}};
  constexpr std::array<Channel, 3> kSwapped{{{0}, {2}, {1}}};
  constexpr Channel kHueOf256{0, 255.0 / 256, 0, true};  // a turn is 256 of the peer's steps, 255 of ours
  constexpr Conversion kHsv{Srgb, Hsv, cv::COLOR_RGB2HSV_FULL, {{kHueOf256, {1}, {2}}}, 2.1 / 255};
  constexpr Conversion kHsl{Srgb, Hsl, cv::COLOR_RGB2HLS_FULL, {{kHueOf256, {2}, {1}}}, 2.1 / 255};
  constexpr Conversion kLab{Srgb, Lab, cv::COLOR_RGB2Lab, kSame, 2.1 / 255};
  constexpr Conversion kYcbcr{Srgb, Ycbcr, cv::COLOR_RGB2YCrCb, kSwapped, 1.1 / 255};
  constexpr Conversion kFromHsv{Hsv, Srgb, cv::COLOR_HSV2RGB_FULL, kSame, 8.1 / 255};  // the hue's step is another
  constexpr Conversion kFromLab{Lab, Srgb, cv::COLOR_Lab2RGB, kSame, 4.1 / 255};
  for (const Conversion& each : {kHsv, kHsl, kLab, kYcbcr, kFromHsv, kFromLab}) {
    add(bench, each, PixelType::U8, kFullHd, 2.5);
  }
  add(bench, kHsv, PixelType::U8, k24Megapixels, 2.5);
  add(bench, kLab, PixelType::U8, k24Megapixels, 2.5);
  // Of floats, the peer's hues are degrees, and its Lab has its natural units.
  add(bench, {Srgb, Hsv, cv::COLOR_RGB2HSV_FULL, {{{0, 1.0 / 360, 0, true}, {1}, {2}}}, 1e-4}, PixelType::F32, kFullHd,
      0.9);
  constexpr std::array<Channel, 3> kNatural{{{0, 0.01}, {1, 1.0 / 255, 128.0 / 255}, {2, 1.0 / 255, 128.0 / 255}}};
  add(bench, {Srgb, Lab, cv::COLOR_RGB2Lab, kNatural, 0.01}, PixelType::F32, kFullHd, 1);
});

}  // namespace
}  // namespace azulejo::bench
