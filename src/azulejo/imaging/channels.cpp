#include "azulejo/imaging/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/channels_kernels.h"

namespace azulejo {
namespace {

[[noreturn]] void refuse_name(std::string_view name, const std::string& wanted) {
  throw Error(Error::Argument, fmt::format("take: {}, expected {}", name, wanted));
}

/// The channel of an image by its letter or its place.
int channel_of(std::string_view name, std::string_view letter, const ImageInfo& info) {
  if (letter == "a") {
    if (info.alpha == AlphaState::None) refuse_name(name, fmt::format("an image with alpha, not {}", describe(info)));
    return info.channels - 1;
  }
  const std::size_t color = std::string_view("rgb").find(letter);
  const bool is_color = letter.size() == 1 && color != std::string_view::npos;
  const bool is_place = letter.size() == 1 && letter[0] >= '1' && letter[0] <= '4';
  if (!is_color && !is_place)
    refuse_name(name, "r, g, b, a or 1 to 4, with 2. before it for the second image; or zero, one");
  const int channel = is_color ? static_cast<int>(color) : letter[0] - '1';
  if (channel >= (is_color ? info.color_channels() : info.channels)) {
    refuse_name(name, fmt::format("a channel of {}", describe(info)));
  }
  return channel;
}

TakenChannel taken_by_name(std::string_view name, std::span<const ImageInfo> sources) {
  if (name == "zero" || name == "one") return {.source = -1, .constant = name == "one" ? 1.0F : 0.0F};
  std::size_t number = 1;
  std::string_view letter = name;
  if (const std::size_t dot = name.find('.'); dot != std::string_view::npos) {
    const auto [rest, failure] = std::from_chars(name.data(), name.data() + dot, number);
    if (failure != std::errc() || rest != name.data() + dot || number < 1 || number > sources.size()) {
      refuse_name(name, fmt::format("the number of an image, 1 to {}, before the dot", sources.size()));
    }
    letter = name.substr(dot + 1);
  }
  const auto source = number - 1;
  return {.source = static_cast<int>(source), .channel = channel_of(name, letter, sources[source])};
}

std::vector<TakenChannel> taken_channels(const ChannelsOptions& options, std::span<const ImageInfo> sources) {
  std::vector<TakenChannel> taken;
  for (const std::string& name : options.take) taken.push_back(taken_by_name(name, sources));
  if (options.take.empty()) {
    for (std::size_t s = 0; s < sources.size(); ++s) {
      for (int c = 0; c < sources[s].channels; ++c) taken.push_back({static_cast<int>(s), c});
    }
  }
  if (taken.size() > 4) {
    throw Error(Error::Argument, fmt::format("take: {} channels, expected 1 to 4", taken.size()));
  }
  return taken;
}

bool is_alpha(const TakenChannel& channel, std::span<const ImageInfo> sources) {
  if (channel.source < 0) return false;
  const ImageInfo& info = sources[static_cast<std::size_t>(channel.source)];
  return info.alpha != AlphaState::None && channel.channel == info.channels - 1;
}

ImageInfo info_of(const ChannelsOptions& options, std::span<const TakenChannel> taken,
                  std::span<const ImageInfo> sources) {
  ImageInfo info = sources[0];
  info.channels = static_cast<int>(taken.size());
  const bool even = info.channels % 2 == 0;
  if (options.alpha && !even) {
    throw Error(Error::Argument, fmt::format("alpha: with {} channels, expected 2 or 4", info.channels));
  }
  info.alpha = AlphaState::None;
  if (even && (options.alpha || is_alpha(taken.back(), sources))) {
    const int source = taken.back().source;
    const bool together =
        std::all_of(taken.begin(), taken.end(), [&](const TakenChannel& each) { return each.source == source; });
    const bool premultiplied = together && is_alpha(taken.back(), sources) &&
                               sources[static_cast<std::size_t>(source)].alpha == AlphaState::Premultiplied;
    info.alpha = premultiplied ? AlphaState::Premultiplied : AlphaState::Straight;
  }
  const bool only_alpha = info.channels == 1 && is_alpha(taken[0], sources);
  if (info.color_channels() % 2 == 0 || only_alpha) info.color = ColorState::Data;
  return info;
}

class Channels final : public TileNode {
 public:
  Channels(const ChannelsOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), taken_(taken_channels(options, sources)) {
    for (const ImageInfo& each : sources) {
      if (each.rect() != sources[0].rect() || each.type != sources[0].type) {
        throw Error(Error::Argument,
                    fmt::format("sources: {}, expected size and type of {}", describe(each), describe(sources[0])));
      }
    }
    set_results({info_of(options, taken_, sources)});
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext&) const override {
    std::vector<ConstAnyView> views;
    views.reserve(from.size());
    for (const ConstTile& each : from) views.push_back(each.pixels);
    kernels::take_channels(views, taken_, results[0].pixels);
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext&) const override {
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      // In place is allowed: a pixel is read before it is written.
      std::array<T, 4> pixel{};
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          for (std::size_t k = 0; k < taken_.size(); ++k) {
            const TakenChannel& each = taken_[k];
            pixel[k] = each.source < 0
                           ? static_cast<T>(each.constant * full_range(kPixelTypeOf<T>))
                           : from[static_cast<std::size_t>(each.source)].pixels.template as<T>()(x, y, each.channel);
          }
          std::copy_n(pixel.begin(), taken_.size(), &result(x, y));
        }
      }
    });
  }

 private:
  std::vector<TakenChannel> taken_;
};

}  // namespace

extern const Operation kChannels = with_examples(
    image_operation<ChannelsOptions, Channels>(
        "channels", "Makes an image of channels of others.",
        {{.name = "sources", .help = "one image or several, of one size and pixel type", .repeated = true}},
        {{"channels", "those that were taken"}},
        {field("take", &ChannelsOptions::take,
               "r, g, b, a, a place 1 to 4, zero or one; 2.r is of the second image; none: all of all images"),
         field("alpha", &ChannelsOptions::alpha, "the last channel is alpha")}),
    {{"photo.png channels:take=r", "The red channel alone, as gray."},
     {"photo.png channels:take=b,g,r", "Red and blue have changed places."},
     {"photo.png mask.png channels:take=1.r,1.g,1.b,2.r,alpha=true", "A mask becomes the alpha of a photo."}});

void channels(std::span<const ConstAnyView> sources, const AnyView& result, const ChannelsOptions& options,
              const Run& run) {
  apply_into(kChannels, &options, sources, {result}, run);
}

Image channels(std::span<const Image* const> sources, const ChannelsOptions& options, const Run& run) {
  return std::move(apply(kChannels, &options, sources, run)[0]);
}

Image channels(const Image& source, const ChannelsOptions& options, const Run& run) {
  return std::move(apply(kChannels, &options, {&source}, run)[0]);
}

}  // namespace azulejo
