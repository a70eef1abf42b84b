#pragma once

#include <string>

#include "azulejo/data/view.h"

namespace azulejo {

/// What a color channel is called in reports: gray; red, green, blue; channel 0, channel 1.
inline std::string channel_name(const ImageInfo& info, int channel) {
  constexpr const char* kColors[] = {"red", "green", "blue"};
  if (info.color != ColorState::Data && info.color_channels() == 3) return kColors[channel];
  if (info.color_channels() == 1) return "gray";
  return "channel " + std::to_string(channel);
}

}  // namespace azulejo
