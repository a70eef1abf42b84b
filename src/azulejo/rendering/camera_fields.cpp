#include "azulejo/rendering/camera_fields.h"

#include "azulejo/rendering/camera_choice.h"

namespace azulejo {

std::vector<Field> camera_fields() {
  using Options = CameraOptions;
  return {
      field("camera", &Options::camera, "a camera of the file, by name or number"),
      field("view", &Options::view, "the side that the scene is seen from"),
      field("azimuth_deg", &Options::azimuth_deg, {-36000, 36000}, "deg",
            "where the camera is, around the up axis; 0: in front"),
      field("elevation_deg", &Options::elevation_deg, {-90, 90}, "deg", "where the camera is, above the horizon"),
      field("position", &Options::position, {-1e30, 1e30}, "", "where the camera is"),
      field("target", &Options::target, {-1e30, 1e30}, "", "what is in the middle of the picture"),
      field("distance", &Options::distance, {1e-30, 1e30}, "", "of the camera from the target, in units"),
      field("up", &Options::up, {-1e30, 1e30}, "", "what is up in the picture"),
      field("fov_deg", &Options::fov_deg, {0.001, 179.9}, "deg", "the whole vertical angle of view"),
      field("projection", &Options::projection, "how the scene is projected"),
      field("zoom", &Options::zoom, {1e-6, 1e6}, "", "magnifies about the middle"),
      field("window", &Options::window, {-1e6, 1e6}, "", "x0,y0,x1,y1 of -1 to 1: the part of the picture to show"),
      field("viewport", &Options::viewport, {0, 65536}, "px", "x,y,width,height of the picture to draw in"),
      field("aspect", &Options::aspect, "where the window has another shape than the viewport"),
  };
}

}  // namespace azulejo
