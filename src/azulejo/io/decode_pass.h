#pragma once

#include <cstdint>
#include <memory>

#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/io/codec.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/input.h"
#include "azulejo/io/profile.h"

namespace azulejo {

/// One pass over an image file, with what is done to all formats alike: the codec is picked by the first bytes,
/// colours become sRGB, the image is turned upright.
class DecodePass {
 public:
  /// Reads the header. Throws Error(Io | Data | Unsupported | Resource) naming the file and the place.
  DecodePass(std::shared_ptr<const Input> input, const ReadOptions& options, const Run& run);
  DecodePass(const DecodePass&) = delete;
  DecodePass& operator=(const DecodePass&) = delete;

  /// What the file says of itself; `file().info` is of the image as it is read.
  const ImageFile& file() const { return file_; }
  /// Whether rows can be read in order; else `decode_whole` is the only way.
  bool streams() const { return file_.streamed; }
  int row_group() const { return decoder_->row_group(); }

  /// The next rows, if `streams()`.
  void read(const AnyView& rows);

  /// The image, in a temporary file if it is larger than run.limits.memory_bytes. Only before anything was read.
  Image decode_whole();

 private:
  void choose_colors(const ReadOptions& options);
  void take_exif();
  Image allocate(const ImageInfo& info);
  void read_colored(const AnyView& rows);
  void read_through(const AnyView& stored, const AnyView& rows);

  std::shared_ptr<const Input> input_;
  Run run_;  ///< the decoder may keep a reference
  std::unique_ptr<Decoder> decoder_;
  ImageFile file_;
  std::unique_ptr<ColorTransform> transform_;  ///< null: none
  ImageInfo stored_;                           ///< as the decoder gives it
  ImageInfo straight_;                         ///< after the alpha state that the transform needs
  ImageInfo colored_;                          ///< after the transform, not yet upright
  std::int64_t memory_left_;
};

/// The codec whose format `input` begins like. Throws Error(Data) where only the name is an image's,
/// Error(Unsupported).
const Codec& recognized_codec(const Input& input);

/// The codec with this ending (without the dot, any case), or null.
const Codec* codec_for_ending(const std::string& ending);

/// What stands behind the last dot of a file's name, in lower case.
std::string ending_of(const std::string& path);

/// An image in memory, or in a temporary file if it is larger than `memory_bytes`.
/// Throws Error(Resource) naming `name` above run.limits.
Image allocate_image(const std::string& name, const ImageInfo& info, std::int64_t memory_bytes, const Run& run);

}  // namespace azulejo
