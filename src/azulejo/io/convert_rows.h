#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "azulejo/data/view.h"

namespace azulejo {

/// Turns rows of one kind into rows of another: pixel type, channels, colour state and alpha state.
///
/// Values     scaled between full ranges (u8 255 = u16 65535 = 1.0), rounded once, clamped; NaN becomes 0 in integers
/// Colour     linear ↔ srgb by the sRGB curve; data is left as it is
/// Alpha      premultiplied ↔ straight; where the result has none, pixels are laid over the background on the
///            result's values; where only the result has it, it is full
/// Channels   gray → the same in all three; RGB → gray by Rec. 601 on the result's values; without alpha on either
///            side the channels that both have are kept, others are 0
class RowConverter {
 public:
  /// `background` is sRGB, 0–1. Widths and heights of the infos don't matter.
  RowConverter(const ImageInfo& source, const ImageInfo& result, const std::array<float, 3>& background = {1, 1, 1});

  /// Makes `low`–`high` of the source's colours 0–1 before all else.
  void stretch(float low, float high);

  /// Converts all rows; the views are of the same size and must not overlap.
  void convert(const ConstAnyView& source, const AnyView& result);

  /// Values of f32 that didn't fit the integers of the result, so far.
  std::int64_t clipped() const { return clipped_; }

 private:
  void load(const ConstAnyView& source, int y);
  void straighten();
  void transfer();
  void change_channels();
  void premultiply();
  void store(const AnyView& result, int y);
  template <class T>
  void store_integers(T* row);

  ImageInfo source_;
  ImageInfo result_;
  std::array<float, 3> background_ = {};  ///< in the result's colour state; gray in [0] where the result is gray
  std::vector<float> decode_;             ///< intensity of each integer value of the source; empty for f32
  bool same_ = false;                     ///< nothing changes
  bool stretched_ = false;
  float low_ = 0;
  float scale_ = 1;
  int width_ = 0;
  std::vector<float> row_;       ///< a row of the source's channels, 0–1
  std::vector<float> narrowed_;  ///< the row in the result's channels
  std::int64_t clipped_ = 0;
};

}  // namespace azulejo
