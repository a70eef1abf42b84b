#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/rendering/shading_light.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

enum class LightChoice : std::uint8_t { File, Default, Headlight };
constexpr std::array<std::string_view, 3> enum_names(LightChoice) { return {"file", "default", "headlight"}; }

struct LightingOptions {
  std::optional<LightChoice> lights = {};  ///< auto: the file's if it has any, else the default three
  std::optional<float> ambient = {};  ///< light from everywhere, against a white surface: 0–1; auto: by the lights
};

/// The lights of a picture.
struct ChosenLighting {
  Lighting lighting;
  /// What the light is multiplied by, so that a white surface in the middle of the scene, turned to where the light is
  /// strongest, is just white. 1 for lights that aren't the file's.
  float exposure = 1;
  LightChoice lights = LightChoice::Default;
};

/// Lights a scene.
///
/// file       the lights of visible nodes, along their -z. What a white (Lambertian) surface sends back is 1/π of what
///            it gets: E/π of a directional light of E lux, I/π at a distance of 1 metre of I candela. Metres become
///            units by the scene's metres_per_unit, 1 where that is unknown. At most 256, the first of the file. Light
///            from everywhere, 8 % of the strongest, keeps what no light meets from being black.
/// default    three that move with the camera: a key from its upper left, a weaker fill from its right, a rim from
///            behind above; and a sky brighter than the ground
/// headlight  one from the camera straight on
/// Throws     Error(Argument): `lights` is file and the scene has none
AZULEJO_EXPORT ChosenLighting choose_lighting(const Scene& scene, const View& view, const LightingOptions& options = {},
                                              const Run& run = {});

}  // namespace azulejo
