#pragma once

#include <array>
#include <span>

#include "azulejo/data/view.h"

namespace azulejo {

/// Where a channel of a result comes from.
struct TakenChannel {
  int source = 0;  ///< index of the image; -1: a constant
  int channel = 0;
  float constant = 0;  ///< intensity
};

namespace kernels {

/// result's channels are those of `taken`, as many as it has.
void take_channels(std::span<const ConstAnyView> sources, std::span<const TakenChannel> taken, const AnyView& result);

}  // namespace kernels
}  // namespace azulejo
