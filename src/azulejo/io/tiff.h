#pragma once

#include <memory>

#include "azulejo/io/codec.h"

namespace azulejo {

extern const Codec kTiffCodec;

/// "lzw" for libtiff's number of a compression.
const char* tiff_compression_name(unsigned compression);

/// Tags that are kept as text, by their names in the TIFF specification.
struct TiffText {
  unsigned tag;
  const char* name;
};
std::span<const TiffText> tiff_texts();

/// Reads strips and tiles of one row group on all threads; memory does not grow with height, except where a file
/// keeps everything in one strip that has to be read at once. EXIF sub-directories are not read.
std::unique_ptr<Decoder> decode_tiff(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);

ImageInfo storable_in_tiff(const ImageInfo& info, const WriteOptions& options);

/// Compresses strips and tiles on all threads; the bytes don't depend on how many there are. EXIF is not written.
std::unique_ptr<Encoder> encode_tiff(Output& output, const ImageInfo& info, const Metadata& metadata,
                                     const WriteOptions& options, const Run& run);

}  // namespace azulejo
