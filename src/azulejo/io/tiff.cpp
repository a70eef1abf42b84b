#include "azulejo/io/tiff.h"

#include <tiffio.h>

#include <array>
#include <cstring>

namespace azulejo {
namespace {

bool matches_tiff(std::span<const std::byte> head, std::string_view) {
  static constexpr const char* kStarts[] = {"II*\0", "MM\0*", "II+\0", "MM\0+"};
  for (const char* start : kStarts) {
    if (head.size() >= 4 && std::memcmp(head.data(), start, 4) == 0) return true;
  }
  return false;
}

}  // namespace

const char* tiff_compression_name(unsigned compression) {
  switch (compression) {
    case COMPRESSION_NONE: return "not compressed";
    case COMPRESSION_CCITTRLE:
    case COMPRESSION_CCITTRLEW: return "ccitt rle";
    case COMPRESSION_CCITTFAX3: return "ccitt group 3";
    case COMPRESSION_CCITTFAX4: return "ccitt group 4";
    case COMPRESSION_LZW: return "lzw";
    case COMPRESSION_OJPEG: return "old-style jpeg";
    case COMPRESSION_JPEG: return "jpeg";
    case COMPRESSION_ADOBE_DEFLATE:
    case COMPRESSION_DEFLATE: return "deflate";
    case COMPRESSION_PACKBITS: return "packbits";
    case COMPRESSION_THUNDERSCAN: return "thunderscan";
    case COMPRESSION_NEXT: return "next";
    case COMPRESSION_SGILOG:
    case COMPRESSION_SGILOG24: return "sgilog";
    case COMPRESSION_PIXARLOG: return "pixarlog";
    case COMPRESSION_LZMA: return "lzma";
    case COMPRESSION_ZSTD: return "zstd";
    case COMPRESSION_WEBP: return "webp";
    case COMPRESSION_LERC: return "lerc";
    default: return "unknown compression";
  }
}

std::span<const TiffText> tiff_texts() {
  static constexpr std::array<TiffText, 5> kTexts = {{{TIFFTAG_IMAGEDESCRIPTION, "ImageDescription"},
                                                      {TIFFTAG_SOFTWARE, "Software"},
                                                      {TIFFTAG_DATETIME, "DateTime"},
                                                      {TIFFTAG_ARTIST, "Artist"},
                                                      {TIFFTAG_COPYRIGHT, "Copyright"}}};
  return kTexts;
}

const Codec kTiffCodec = {"tiff", {"tif", "tiff"}, matches_tiff, decode_tiff, storable_in_tiff, encode_tiff};

}  // namespace azulejo
