#pragma once

#include <span>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct ChannelsOptions {
  /// Channels of the result, 1–4: `r`, `g`, `b` are the first, second and third color channel, `a` is alpha, `1`–`4`
  /// is the place in the pixel; `2.r` is of the second image. `zero` and `one` are constants. Empty: all channels of all
  /// images.
  std::vector<std::string> take = {};
  bool alpha = false;  ///< the last channel is alpha, whatever it was
};

/// Makes an image of channels of others: extracts one, changes their order, adds or drops alpha, merges several images.
///
/// sources  1 or more of one size and pixel type; any channels
/// result   a channel for each that is taken; same size and type. The last is alpha with `alpha`, or where there are 2
///          or 4 and it was alpha where it comes from
/// States   color state of the first image; data for 2 or 4 channels beside alpha, and for alpha alone. Alpha is
///          straight, or premultiplied if it and all others come from one premultiplied image
/// Values   are those stored: premultiplied color without its alpha is the picture over black
/// NaN      is copied
/// Cost     O(pixels), bound by memory
/// Throws   Error(Argument) for a channel that is not there, more than 4, images of different size or type, alpha with 1
///          or 3 channels
AZULEJO_EXPORT void channels(std::span<const ConstAnyView> sources, const AnyView& result,
                             const ChannelsOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image channels(std::span<const Image* const> sources, const ChannelsOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image channels(const Image& source, const ChannelsOptions& options = {}, const Run& run = {});

}  // namespace azulejo
