#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "azulejo/data/view.h"
#include "azulejo/imaging/color_space.h"
#include "azulejo/math/arctangent.h"
#include "azulejo/math/cube_root.h"
#include "azulejo/math/sine.h"
#include "azulejo/math/transfer.h"

namespace azulejo {

/// The spaces are a tree, light at its root; a step goes between a space and its parent:
/// linear → xyz → lab → lch, linear → srgb → hsv, hsl, ycbcr.
struct ColorStep {
  ColorSpace space = ColorSpace::Linear;
  bool to_parent = false;
};

/// Values between steps are 0–1 in the light's half of the tree (linear, xyz, lab, lch), and in units of storage, up to
/// `full`, in the other half, where whole numbers give exact results.
constexpr bool is_light(ColorSpace space) { return space >= ColorSpace::Linear && space <= ColorSpace::Lch; }

/// What is done to each pixel.
struct ColorPlan {
  ColorPlan(ColorSpace source_space, ColorSpace result_space, PixelType type, AlphaState alpha);
  std::span<const ColorStep> steps() const { return {list.data(), static_cast<std::size_t>(count)}; }

  std::array<ColorStep, 8> list{};
  int count = 0;
  float full;         ///< the full range of the pixel type
  float load_scale;   ///< stored values (premultiplied: divided by alpha) times this are what the first step gets
  float store_scale;  ///< and what the last step gives, times this, is stored (premultiplied: times alpha)
  float center;       ///< where color differences are 0: 128/255 of the full range
  bool premultiplied;
  bool bytes_in = false;   ///< the first step decodes sRGB from whole numbers up to 255: by ByteCurve
  bool bytes_out = false;  ///< the last step encodes sRGB as whole numbers up to 255: by ByteCurve
};

namespace color {

/// Rows: X, Y, Z as shares of white's, of linear red, green and blue.
inline constexpr float kXyzOfRgb[3][3] = {{0.433887346F, 0.376224009F, 0.189888645F},
                                          {0.212639006F, 0.715168679F, 0.0721923154F},
                                          {0.0177500401F, 0.109447621F, 0.872802339F}};
inline constexpr float kRgbOfXyz[3][3] = {{3.08039909F, -1.53738318F, -0.543015913F},
                                          {-0.921223359F, 1.8759675F, 0.0452558574F},
                                          {0.052873939F, -0.203976959F, 1.15110302F}};

/// CIELAB's f is a cube root above (6/29)³, a line below.
inline constexpr float kLabKnee = 216.0F / 24389.0F;
inline constexpr float kLabKneeRoot = 6.0F / 29.0F;
inline constexpr float kLabSlope = 841.0F / 108.0F;
inline constexpr float kLabOffset = 4.0F / 29.0F;

/// Where a and b, Cb and Cr are 0.
inline constexpr float kCenter = 128.0F / 255.0F;
inline constexpr float kAbScale = 500.0F / 255.0F;  ///< of fx − fy
inline constexpr float kBScale = 200.0F / 255.0F;   ///< of fy − fz
/// Chroma as stored, 0–1, of a and b as stored.
inline constexpr float kChromaOfAb = 255.0F / 150.0F;
inline constexpr float kTurnOfRadian = 0.159154943F;

/// Quotients by multiplication: with a float above the reciprocal, whole numbers over it that are a half give no less.
inline constexpr float kPer1000 = 0x1.0624dep-10F;
inline constexpr float kPer1772 = 0x1.27dfa4p-11F;
inline constexpr float kPer1402 = 0x1.75f50cp-11F;

struct Pixel {
  float c0;
  float c1;
  float c2;
};

/// The definition of a step.
Pixel apply_step(const ColorStep& step, const ColorPlan& plan, const Pixel& pixel);

}  // namespace color
}  // namespace azulejo
