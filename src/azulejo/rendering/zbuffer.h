#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/frame.h"
#include "azulejo/data/scene.h"
#include "azulejo/rendering/shading_light.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

enum class Shading : std::uint8_t { Flat, Gouraud, Phong };
constexpr std::array<std::string_view, 3> enum_names(Shading) { return {"flat", "gouraud", "phong"}; }

enum class FrameOutput : std::uint8_t {
  Display8,   ///< sRGB, u8
  Display16,  ///< sRGB, u16
  Linear,     ///< f32, linear, premultiplied
};
constexpr std::array<std::string_view, 3> enum_names(FrameOutput) { return {"display8", "display16", "linear"}; }

struct ZBufferOptions {
  Shading shading = Shading::Phong;
  int antialias = 4;                               ///< samples a pixel: 1, 4, 8 or 16
  std::array<float, 4> background = {0, 0, 0, 0};  ///< linear, straight alpha
  float exposure = 1;                              ///< factor of the light in display output
  FrameOutput output = FrameOutput::Display8;
  std::vector<std::string> layers = {"color"};  ///< see Frame
};

/// What happened to the faces of a picture.
struct ZBufferStatistics {
  std::uint64_t faces_in = 0;          ///< triangles, over all instances
  std::uint64_t faces_outside = 0;     ///< outside the view volume
  std::uint64_t faces_culled = 0;      ///< seen from behind, single-sided
  std::uint64_t faces_empty = 0;       ///< no area, not finite, or between all samples
  std::uint64_t faces_clipped = 0;     ///< cut by a plane of the view volume
  std::uint64_t faces_drawn = 0;       ///< rasterized
  std::uint64_t fragments_tested = 0;  ///< samples compared with the depth buffer
  std::uint64_t fragments_passed = 0;
  std::uint64_t fragments_shaded = 0;
};

/// Draws a scene with a z-buffer.
AZULEJO_EXPORT Frame render_zbuffer(const Scene& scene, const View& view, const Lighting& lighting,
                                    const ZBufferOptions& options, const Run& run,
                                    ZBufferStatistics* statistics = nullptr);

}  // namespace azulejo
