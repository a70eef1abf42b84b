#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/source.h"

namespace azulejo {

class Input;

struct ReadOptions {
  int page = 0;                 ///< of a TIFF, from 0
  std::string layer = {};       ///< of an OpenEXR file; empty: the main one
  bool convert_profile = true;  ///< colours of another profile or gamma are converted to sRGB
};

struct WriteOptions {
  int quality = 90;           ///< 1–100, JPEG and WebP
  bool lossless = false;      ///< WebP
  int compression_level = 3;  ///< 0–9, PNG and deflated TIFF: 6 takes four times as long for 5 % fewer bytes
  /// TIFF: none, lzw, deflate, packbits, zstd; EXR: none, zip, piz, rle; empty: the format's usual
  std::string compression = {};
  int tile = 0;  ///< TIFF and EXR: tile width and height in pixels; 0: strips
  /// Of the file; empty: the image's where the format can hold it, else the nearest (f32 to 16 bits in a PNG)
  std::optional<PixelType> type = {};
  bool normalize = false;           ///< f32 into integers: stretch minimum–maximum to 0–1
  float background[3] = {1, 1, 1};  ///< sRGB 0–1, under transparent pixels in formats without alpha
  std::string format = {};          ///< an ending such as "png", whatever the path's; empty: the path's
};

/// What `info` tells of a file beside the image's own description.
struct ImageFile {
  std::string format;  ///< "png", "jpeg", …
  ImageInfo info;      ///< of the image as it is read
  Metadata metadata;
  int stored_width = 0;  ///< before orientation is applied
  int stored_height = 0;
  int bits = 8;          ///< a channel in the file
  std::string encoding;  ///< the format's own words: "palette, interlaced", "progressive, 4:2:0", "tiles 256×256, lzw"
  int pages = 1;
  std::vector<std::string> layers;  ///< of an OpenEXR file
  int orientation = 1;              ///< EXIF's, applied on reading
  std::string profile;              ///< description of an embedded colour profile
  bool streamed = false;            ///< read by rows, in memory that does not grow with height
};

/// Reads an image file of any known format, recognized by its bytes and not by its name. "-" is standard input.
/// Throws Error(Io | Data | Unsupported | Resource) naming the file and the place.
AZULEJO_EXPORT Image read_image(const std::string& path, const ReadOptions& options = {}, const Run& run = {});
/// The same from bytes; `name` stands in messages.
AZULEJO_EXPORT Image read_image(std::span<const std::byte> bytes, const std::string& name,
                                const ReadOptions& options = {}, const Run& run = {});
/// Opens a file to be read row by row, as the executor does.
AZULEJO_EXPORT std::unique_ptr<ImageSource> open_image(const std::string& path, const ReadOptions& options = {},
                                                       const Run& run = {});
/// The same of what is open already (see input.h).
AZULEJO_EXPORT std::unique_ptr<ImageSource> open_image(std::shared_ptr<const Input> input,
                                                       const ReadOptions& options = {}, const Run& run = {});
/// Reads what a file says of its image, not its pixels.
AZULEJO_EXPORT ImageFile image_file(const std::string& path, const ReadOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT ImageFile image_file(std::shared_ptr<const Input> input, const ReadOptions& options = {},
                                    const Run& run = {});
AZULEJO_EXPORT ImageFile image_file(std::span<const std::byte> bytes, const std::string& name,
                                    const ReadOptions& options = {}, const Run& run = {});

/// Writes beside `path` and renames. The format follows from the ending; "-" writes PNG to standard output
/// unless `options.format` says another. Throws Error(Argument) for an unknown ending, Error(Io).
/// f32 into an integer format: 0–1 scaled and clamped, a warning if anything was clipped.
AZULEJO_EXPORT void write_image(const Image& image, const std::string& path, const WriteOptions& options = {},
                                const Run& run = {});
/// The same to bytes; `format` is an ending such as "png".
AZULEJO_EXPORT std::vector<std::byte> encode_image(const Image& image, const std::string& format,
                                                   const WriteOptions& options = {}, const Run& run = {});
/// Creates a file to be written row by row, as the executor does.
AZULEJO_EXPORT std::unique_ptr<ImageSink> create_image(const std::string& path, const ImageInfo& info,
                                                       const Metadata& metadata, const WriteOptions& options = {},
                                                       const Run& run = {});

/// Endings that can be written ("png", "jpg", …) and read.
AZULEJO_EXPORT std::vector<std::string> image_endings_written();
AZULEJO_EXPORT std::vector<std::string> image_endings_read();
/// True if the ending of `path` is one that can be written.
AZULEJO_EXPORT bool is_image_path(const std::string& path);

}  // namespace azulejo
