#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "azulejo/core/export.h"
#include "azulejo/data/array.h"

namespace azulejo {

/// A regular grid of samples. Moved, not copied: `clone()` says a copy aloud.
struct AZULEJO_EXPORT Volume {
  std::string name;
  int width = 0;               ///< samples along x, which change fastest
  int height = 0;              ///< along y
  int depth = 0;               ///< along z
  glm::vec3 spacing{1, 1, 1};  ///< distance of neighbouring samples, in units; may be negative
  glm::vec3 origin{0, 0, 0};   ///< position of sample (0, 0, 0)
  float metres_per_unit = 0;   ///< 0: unknown
  Array<float> samples;        ///< width · height · depth

  Volume() = default;
  Volume(Volume&&) noexcept = default;
  Volume& operator=(Volume&&) noexcept = default;
  ~Volume() = default;
  Volume clone() const { return Volume(*this); }

  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(width) *
               (static_cast<std::size_t>(y) + static_cast<std::size_t>(height) * static_cast<std::size_t>(z));
  }
  float at(int x, int y, int z) const { return samples[index(x, y, z)]; }

 private:
  Volume(const Volume&) = default;
  Volume& operator=(const Volume&) = default;
};

}  // namespace azulejo
