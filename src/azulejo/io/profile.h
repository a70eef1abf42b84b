#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/view.h"

namespace azulejo {

/// Turns rows of stored colours into sRGB: from an embedded profile, CMYK or a file's gamma. Thread-safe.
class ColorTransform {
 public:
  virtual ~ColorTransform() = default;
  /// Views of the same size. `result` has the infos' type and as many channels, CMYK excepted: 3 for 4. They may be
  /// the same rows where the channels are as many.
  virtual void apply(const ConstAnyView& source, const AnyView& result) const = 0;
};

/// How an embedded ICC profile describes itself, in one line; empty if it can't be read.
std::string profile_description(std::span<const std::uint8_t> icc);

/// What an embedded profile asks for.
struct ProfileConversion {
  std::unique_ptr<ColorTransform> transform;  ///< null: the colours stay
  bool understood = false;                    ///< false: damaged, or for other channels than the file has
};

/// From an embedded profile to sRGB, relative colorimetric with black point compensation. Alpha is copied.
///
/// source   u8, u16 or f32 of 1–4 channels, not premultiplied; with `cmyk` 4 channels of ink
/// Result   no transform where the profile is sRGB in all but name; a warning where it isn't understood
ProfileConversion profile_to_srgb(std::span<const std::uint8_t> icc, const ImageInfo& source, bool cmyk,
                                  const std::string& name, const Run& run);

/// From CMYK without a profile: each ink takes away its share of light, R = (1 − C)(1 − K).
std::unique_ptr<ColorTransform> cmyk_to_srgb();

/// From a file whose samples are light to the power of `exponent` (PNG's gAMA) to sRGB.
/// Null where that is sRGB to the precision at which files say it (1 / 2.2).
std::unique_ptr<ColorTransform> gamma_to_srgb(float exponent, const ImageInfo& source);

}  // namespace azulejo
