#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// Walks over a PNG's chunks before libpng does, for two things that libpng doesn't do:
/// it makes room for a chunk as long as the file says, so one that is too long is refused here (Error(Data));
/// it tells of EXIF, XMP and text behind the pixels only when all rows were read, so they are taken from here.
/// Stops quietly where the chunks stop making sense: libpng will complain.
void scan_png_chunks(const Input& input, const Run& run, Metadata& metadata);

/// The longest chunk beside those of pixels, packed or not.
inline constexpr std::uint32_t kLongestPngChunk = 1U << 24;

/// The name that XMP packets have in PNG's iTXt chunks.
inline constexpr char kXmpKeyword[] = "XML:com.adobe.xmp";

/// Takes an EXIF block into `metadata`, without the "Exif\0\0" that some writers put before it.
void set_exif(std::span<const std::uint8_t> exif, Metadata& metadata);

}  // namespace azulejo
