#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "azulejo/data/view.h"

namespace azulejo {

/// What the samples of a TIFF are, and what an image makes of them.
///
/// Unsigned  1–8 bits become u8, 9–16 u16, scaled so that the largest value becomes the largest; more become f32,
///           the largest value 1
/// Signed    f32, as they are: they are quantities rather than intensities
/// Float     16, 32, 64 bits; f32, as they are
struct TiffSamples {
  enum class Kind : std::uint8_t { Unsigned, Signed, Float };
  Kind kind = Kind::Unsigned;
  unsigned bits = 8;
  unsigned stored = 1;                 ///< samples of a pixel in a row of the file
  bool invert = false;                 ///< 0 is white
  bool xyz = false;                    ///< f32 CIE XYZ (LogLuv): becomes linear RGB
  std::vector<std::uint16_t> palette;  ///< RGB triples of the result's type; empty: none
};

/// The type that the samples become; of a palette: that of its colours.
PixelType tiff_pixel_type(const TiffSamples& samples);

/// Whether these samples can be read.
bool tiff_samples_readable(const TiffSamples& samples);

/// Turns rows as libtiff unpacks them into rows of an image. One a thread.
class TiffRows {
 public:
  TiffRows(const TiffSamples& samples, const ImageInfo& info) : samples_(samples), info_(info) {}

  /// Puts `pixels` pixels at `result`. Interleaved files: first = 0, count = all of the image's channels.
  /// Planes: count = 1, and `first` is the channel.
  void convert(const std::uint8_t* packed, std::size_t pixels, int first, int count, std::byte* result);

  /// Whether a value lost digits on becoming f32, so far.
  bool inexact() const { return inexact_; }

 private:
  template <class T>
  void unpack(const std::uint8_t* packed, std::size_t samples, T* result);
  template <class T>
  void convert_to(const std::uint8_t* packed, std::size_t pixels, int first, int count, T* result);
  void unpack_floats(const std::uint8_t* packed, std::size_t samples, float* result);
  void unpack_indices(const std::uint8_t* packed, std::size_t samples, std::uint16_t* result) const;

  const TiffSamples& samples_;
  ImageInfo info_;
  bool inexact_ = false;
  std::vector<std::byte> row_;
};

}  // namespace azulejo
