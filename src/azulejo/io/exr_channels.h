#pragma once

#include <ImfMultiPartInputFile.h>

#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/view.h"

namespace azulejo {

/// Which channels of an OpenEXR file make an image.
struct ExrChoice {
  int part = 0;
  std::string prefix = {};                 ///< "diffuse." of "diffuse.R"; empty for the main layer
  std::vector<std::string> channels = {};  ///< full names, in the order of the image's channels
  bool chroma = false;                     ///< Y, RY, BY, stored subsampled: read as R, G, B
  ColorState color = ColorState::Linear;
  AlphaState alpha = AlphaState::None;
};

/// Chooses by name: a part, a layer ("diffuse" of "diffuse.R", "part.layer"), or a single channel ("Z").
///
/// layer    empty: the unnamed layer of the first part, or its only layer, or its first one with a warning
/// Rule     R, G, B [A]; Y, RY, BY [A]; Y [A]; else all channels as data, in the order R G B X Y Z W U V …, A last
/// Throws   Error(Argument) for a layer that the file does not have, Error(Unsupported) for more than four channels
ExrChoice choose_exr_channels(const Imf::MultiPartInputFile& file, const std::string& layer, const std::string& name,
                              const Run& run);

/// Names that `choose_exr_channels` takes for more than the main image.
std::vector<std::string> exr_layers(const Imf::MultiPartInputFile& file);

}  // namespace azulejo
