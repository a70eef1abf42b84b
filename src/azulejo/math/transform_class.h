#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace azulejo {

/// What a transformation keeps; each class holds those before it.
enum class TransformClass : std::uint8_t {
  Identity,     ///< everything
  Translation,  ///< directions
  Rigid,        ///< lengths; it may mirror
  Similarity,   ///< angles: lengths grow by one factor
  Affine,       ///< parallels
  Projective,   ///< straight lines
};

constexpr auto enum_names(TransformClass) {
  return std::array<std::string_view, 6>{"identity", "translation", "rigid", "similarity", "affine", "projective"};
}

}  // namespace azulejo
