#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace azulejo {

/// What the reader of an image needs of its EXIF block.
struct ExifSummary {
  int orientation = 1;  ///< 1–8, as stored; 1 where there is none or it is out of range
  float density_x = 0;  ///< pixels per metre; 0: not said
  float density_y = 0;  ///< pixels per metre; 0: not said
};

/// Reads orientation and density from an EXIF block: a TIFF structure, without the "Exif\0\0" of JPEG.
/// Any bytes are allowed: what can't be read is as if it weren't there.
/// Source: CIPA DC-008 (Exif 2.3), 4.6; TIFF 6.0, section 2
ExifSummary parse_exif(std::span<const std::uint8_t> exif);

/// Sets a stored orientation to 1, for pixels that were turned already.
void reset_exif_orientation(std::span<std::uint8_t> exif);

}  // namespace azulejo
