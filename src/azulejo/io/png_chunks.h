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

/// Adds what the chunks behind a PNG's pixels say (EXIF, XMP, text): libpng tells of them only after all rows were
/// read. Stops quietly where the file does; reading the pixels will complain.
void read_late_png_chunks(const Input& input, const Run& run, Metadata& metadata);

/// The name that XMP packets have in PNG's iTXt chunks.
inline constexpr char kXmpKeyword[] = "XML:com.adobe.xmp";

/// Takes an EXIF block into `metadata`, without the "Exif\0\0" that some writers put before it.
void set_exif(std::span<const std::uint8_t> exif, Metadata& metadata);

/// Latin-1, which PNG's plain texts are in, as UTF-8.
std::string utf8_from_latin1(std::string_view text);

}  // namespace azulejo
