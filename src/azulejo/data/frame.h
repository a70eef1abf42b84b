#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/data/image.h"

namespace azulejo {

/// What a renderer gives: images of one size, by name. "color" comes first where it was asked for.
///
/// color        sRGB u8 or u16, straight alpha; or linear f32, premultiplied
/// depth        f32, data: distance along the view axis in scene units; infinity where nothing is
/// normal       f32, 3 channels, data: unit vectors in world space; 0 where nothing is
/// position     f32, 3 channels, data: in world space; 0 where nothing is
/// uv           f32, 2 channels, data
/// albedo       f32, 3 channels, linear
/// object_id, material_id, face_id   f32, data: number + 1, 0 where nothing is (exact below 2²⁴)
struct Frame {
  struct Layer {
    std::string name;
    Image image;
  };
  std::vector<Layer> layers;
  Json camera;  ///< intrinsics and extrinsics, and what `depth` means

  const Image* find(std::string_view name) const {
    for (const Layer& layer : layers) {
      if (layer.name == name) return &layer.image;
    }
    return nullptr;
  }
};

}  // namespace azulejo
