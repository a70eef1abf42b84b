#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "azulejo/io/codec.h"
#include "azulejo/io/tiff_file.h"
#include "azulejo/io/tiff_samples.h"

namespace azulejo {

/// How a page of a TIFF is stored. Its units are tiles, or strips as wide as the image.
struct TiffLayout {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t unit_width = 0;
  std::uint32_t unit_height = 0;
  std::uint64_t unit_row_bytes = 0;  ///< of a plane, as libtiff unpacks it
  int planes = 1;                    ///< kept apart in the file and needed for the image
  bool tiled = false;
  bool by_libtiff = false;  ///< 8-bit RGB made by libtiff: subsampled YCbCr, CIELAB, old-style JPEG
  unsigned compression = 1;
  TiffSamples samples;

  std::uint32_t across() const { return (width - 1) / unit_width + 1; }
  std::uint32_t unit_rows(std::uint32_t y) const { return tiled ? unit_height : std::min(unit_height, height - y); }
};

/// Sets how libtiff is to decode this page: every handle that reads it needs it.
void prepare_tiff(TIFF* tiff);

/// Reads the directory of the page that `file` is at; fills what `header` says of the image. Warnings go to `run`.
TiffLayout read_tiff_layout(TiffFile& file, const std::string& name, DecodedHeader& header, const Run& run);

}  // namespace azulejo
