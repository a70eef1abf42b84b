#include "azulejo/imaging/color_mapping.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace azulejo {
namespace {

// Colors 0xRRGGBB at equal distances.

/// Every fifth of 256 colors, a step nearer where that brings those between closer.
constexpr std::uint32_t kViridis[] = {
    0x440154, 0x46085C, 0x471063, 0x481769, 0x481D6F, 0x482475, 0x472A7A, 0x46307E, 0x453781, 0x433D84, 0x414287,
    0x3F4889, 0x3D4E8A, 0x3A538B, 0x38598C, 0x355E8D, 0x33638D, 0x31688E, 0x2E6D8E, 0x2C718E, 0x2A768E, 0x297B8E,
    0x27808E, 0x25848E, 0x23898E, 0x218E8D, 0x20928C, 0x1F978B, 0x1E9C89, 0x1FA188, 0x21A585, 0x24AA83, 0x28AE80,
    0x2EB37C, 0x35B779, 0x3DBC74, 0x46C06F, 0x50C46A, 0x5AC864, 0x65CB5E, 0x70CF57, 0x7CD250, 0x89D548, 0x95D840,
    0xA2DA37, 0xB0DD2F, 0xBDDF26, 0xCAE11F, 0xD8E219, 0xE5E418, 0xF1E51D, 0xFDE725,
};

/// The same of its 256.
constexpr std::uint32_t kMagma[] = {
    0x000003, 0x02020B, 0x050416, 0x090720, 0x0E0B2B, 0x140E36, 0x1A1042, 0x21114E, 0x29115A, 0x311165, 0x390F6E,
    0x420F75, 0x4A1079, 0x52137C, 0x5A167E, 0x621980, 0x6A1C81, 0x721F81, 0x792282, 0x812581, 0x892881, 0x912B81,
    0x992D80, 0xA1307E, 0xAA337D, 0xB2357B, 0xBA3878, 0xC23B75, 0xCA3E72, 0xD2426F, 0xD9466B, 0xE04B67, 0xE75263,
    0xEC5860, 0xF1605D, 0xF4695C, 0xF7725C, 0xF97B5D, 0xFB8560, 0xFC8E64, 0xFD9869, 0xFEA16E, 0xFEAA74, 0xFEB47B,
    0xFEBD82, 0xFEC68A, 0xFECF92, 0xFED89A, 0xFDE2A3, 0xFDEBAC, 0xFCF4B6, 0xFCFDBF,
};

/// The same of its 256.
constexpr std::uint32_t kTurbo[] = {
    0x30123B, 0x36215F, 0x3B2F80, 0x3F3E9C, 0x424BB6, 0x4559CB, 0x4666DD, 0x4773EB, 0x4680F7, 0x458CFD, 0x4099FF,
    0x38A5FB, 0x2FB2F4, 0x27BEE9, 0x1FC9DD, 0x19D4D0, 0x18DDC2, 0x1AE4B6, 0x22EBAA, 0x2FF19B, 0x3FF68A, 0x52FA7A,
    0x65FD69, 0x79FE59, 0x8BFF4B, 0x9CFE40, 0xA9FB39, 0xB7F735, 0xC3F134, 0xD0EA34, 0xDBE236, 0xE5D938, 0xEECF3A,
    0xF5C53A, 0xFABA39, 0xFDAE35, 0xFEA130, 0xFE932A, 0xFC8423, 0xF9751D, 0xF46617, 0xEF5811, 0xE84B0C, 0xE14109,
    0xD83706, 0xCE2D04, 0xC32503, 0xB71D02, 0xA91601, 0x9B0F01, 0x8B0902, 0x7A0403,
};

constexpr std::uint32_t kJet[] = {
    0x000080, 0x0000FF, 0x0080FF, 0x00FFFF, 0x80FF80, 0xFFFF00, 0xFF8000, 0xFF0000, 0x800000,
};
constexpr std::uint32_t kHot[] = {
    0x000000, 0x550000, 0xAA0000, 0xFF0000, 0xFF5500, 0xFFAA00, 0xFFFF00, 0xFFFF80, 0xFFFFFF,
};
constexpr std::uint32_t kGray[] = {0x000000, 0xFFFFFF};
/// Hues from 270° to 0° in steps of 30°.
constexpr std::uint32_t kRainbow[] = {
    0x8000FF, 0x0000FF, 0x0080FF, 0x00FFFF, 0x00FF80, 0x00FF00, 0x80FF00, 0xFFFF00, 0xFF8000, 0xFF0000,
};

/// CIELAB: L* 70, C*ab 38, hue angles from 0° to 360°.
constexpr std::uint32_t kCyclic[] = {
    0xEB90AC, 0xEE90A4, 0xEF909C, 0xEE9194, 0xED938C, 0xEB9485, 0xE9977E, 0xE59978, 0xE09C73, 0xDB9E6E, 0xD5A16A,
    0xCEA468, 0xC7A766, 0xC0AA65, 0xB8AC66, 0xAFAF68, 0xA7B16A, 0x9EB36E, 0x95B573, 0x8BB778, 0x81B97F, 0x77BA86,
    0x6DBB8D, 0x62BC95, 0x57BD9D, 0x4BBDA6, 0x3FBEAE, 0x32BEB7, 0x25BDBF, 0x19BDC7, 0x0FBCCE, 0x11BCD5, 0x1CBBDC,
    0x2AB9E1, 0x3AB8E6, 0x49B6EA, 0x58B4ED, 0x67B2EF, 0x75AFF0, 0x83ACEF, 0x90AAEE, 0x9DA7EC, 0xA9A4E9, 0xB4A1E5,
    0xBF9EE0, 0xC89BDA, 0xD198D3, 0xD896CC, 0xDF94C5, 0xE492BD, 0xE891B5, 0xEB90AC,
};

std::span<const std::uint32_t> colors_of(ColorMap map) {
  switch (map) {
    case ColorMap::Viridis: return kViridis;
    case ColorMap::Magma: return kMagma;
    case ColorMap::Turbo: return kTurbo;
    case ColorMap::Jet: return kJet;
    case ColorMap::Hot: return kHot;
    case ColorMap::Gray: return kGray;
    case ColorMap::Rainbow: return kRainbow;
    default: return kCyclic;
  }
}

}  // namespace

ColorMapping::ColorMapping(const PseudoColorOptions& options, float first, float last)
    : low(first),
      levels(options.levels.value_or(0)),
      nan{options.nan_color.r, options.nan_color.g, options.nan_color.b} {
  scale = first == last ? 0.0F : 1.0F / (last - first);
  const std::span<const std::uint32_t> colors = colors_of(options.map);
  segments = static_cast<int>(colors.size()) - 1;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = [&](std::size_t k) { return static_cast<float>(colors[k] >> (16 - 8 * c) & 255U) / 255.0F; };
    for (std::size_t k = 0; k + 1 < colors.size(); ++k) {
      start[c][k] = channel(k);
      slope[c][k] = channel(k + 1) - channel(k);
    }
  }
}

std::array<float, 3> ColorMapping::at(float value) const {
  if (value != value) return nan;
  const float share = (value - low) * scale;
  float t = share > 0.0F ? std::min(share, 1.0F) : 0.0F;
  if (levels > 0) {
    const auto bands = static_cast<float>(levels);
    t = std::min(std::floor(t * bands), bands - 1.0F) / (bands - 1.0F);
  }
  const float place = t * static_cast<float>(segments);
  const auto segment = static_cast<std::size_t>(std::min(static_cast<int>(place), segments - 1));
  const float rest = place - static_cast<float>(segment);
  std::array<float, 3> color;
  for (std::size_t c = 0; c < 3; ++c) color[c] = start[c][segment] + slope[c][segment] * rest;
  return color;
}

}  // namespace azulejo
