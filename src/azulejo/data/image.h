#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/pool.h"
#include "azulejo/data/view.h"

namespace azulejo {

/// What a file says about an image beside its pixels. Kept through a chain and written where the format can.
struct Metadata {
  float density_x = 0;                      ///< pixels per metre; 0: unknown
  float density_y = 0;                      ///< pixels per metre; 0: unknown
  std::vector<std::uint8_t> exif;           ///< TIFF structure, without the "Exif\0\0" of JPEG; orientation set to 1
  std::vector<std::uint8_t> xmp;            ///< the packet
  std::map<std::string, std::string> text;  ///< comments and such, by their name in the file
  friend bool operator==(const Metadata&, const Metadata&) = default;
};

/// Pixels with what they mean. Moved, not copied: `clone()` says a copy aloud.
/// Rows start at 64-byte boundaries; storage comes from a recycling pool, contents are undefined at first.
class AZULEJO_EXPORT Image {
 public:
  Image() = default;
  /// Throws Error(Argument) for sizes below 1, channels outside 1–4 or alpha with other than 2 or 4 channels,
  /// Error(Resource) for more pixels than `limits.pixels`.
  explicit Image(const ImageInfo& info, const Limits& limits = {});
  Image(int width, int height, int channels, PixelType type = PixelType::U8);
  /// As above, kept in an unlinked temporary file instead of memory.
  static Image in_temporary_file(const ImageInfo& info, const Limits& limits = {});

  Image clone() const;

  const ImageInfo& info() const { return info_; }
  int width() const { return info_.width; }
  int height() const { return info_.height; }
  int channels() const { return info_.channels; }
  PixelType type() const { return info_.type; }
  bool empty() const { return buffer_.data() == nullptr; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(buffer_.size()); }

  const Metadata& metadata() const { return *metadata_; }
  void set_metadata(Metadata metadata) { metadata_ = std::make_shared<const Metadata>(std::move(metadata)); }
  void share_metadata(const Image& other) { metadata_ = other.metadata_; }
  /// Says what the pixels mean, without touching them.
  void set_states(ColorState color, AlphaState alpha);

  /// The pixels as T, which must be the image's type: Error(Argument) if not.
  template <class T>
  ImageView<T> view() {
    check_type(kPixelTypeOf<T>);
    return any().as<T>();
  }
  template <class T>
  ImageView<const T> view() const {
    check_type(kPixelTypeOf<T>);
    return any().as<T>();
  }
  AnyView any() { return {buffer_.data(), stride_, info_}; }
  ConstAnyView any() const { return {buffer_.data(), stride_, info_}; }

 private:
  Image(const ImageInfo& info, const Limits& limits, bool temporary);
  void check_type(PixelType wanted) const;

  ImageInfo info_;
  std::ptrdiff_t stride_ = 0;
  Buffer buffer_;
  std::shared_ptr<const Metadata> metadata_ = no_metadata();
  static const std::shared_ptr<const Metadata>& no_metadata();
};

/// Bytes that an image of this kind takes, rows aligned.
AZULEJO_EXPORT std::int64_t image_bytes(const ImageInfo& info);

/// Throws Error(Argument) or Error(Resource) as the constructor of Image does.
AZULEJO_EXPORT void check_image_info(const ImageInfo& info, const Limits& limits);

AZULEJO_EXPORT const char* to_string(PixelType type);    ///< "u8", "u16", "f32"
AZULEJO_EXPORT const char* to_string(ColorState state);  ///< "srgb", "linear", "data"
AZULEJO_EXPORT const char* to_string(AlphaState state);  ///< "none", "straight", "premultiplied"
/// "640×480, 3 channels, u8, srgb, alpha none"
AZULEJO_EXPORT std::string describe(const ImageInfo& info);

}  // namespace azulejo
