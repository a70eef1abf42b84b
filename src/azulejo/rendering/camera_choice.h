#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/math/viewport.h"
#include "azulejo/rendering/camera_moves.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

enum class ViewDirection : std::uint8_t { Front, Back, Left, Right, Top, Bottom, Isometric };
constexpr std::array<std::string_view, 7> enum_names(ViewDirection) {
  return {"front", "back", "left", "right", "top", "bottom", "isometric"};
}

enum class Projection : std::uint8_t { Perspective, Orthographic };
constexpr std::array<std::string_view, 2> enum_names(Projection) { return {"perspective", "orthographic"}; }

/// Where a picture is taken from. Of several ways to say it the first of these holds, and a warning tells of others:
/// - `camera`: one of the scene's;
/// - `view`, `azimuth_deg`, `elevation_deg`, `position`, `target`, `distance`, `up`;
/// - the first camera in the file;
/// - framed: the whole scene from azimuth 30°, elevation 20°.
///
/// Angles are around the scene's up axis (y, or z where the file says so): azimuth counter-clockwise as seen from
/// above, 0 from the front (+z; -y where z is up), elevation above the horizon. A direction without a position or a
/// distance is framed: the vertices fill 90 % of the picture, centred, or around `target` if that is given.
struct CameraOptions {
  std::string camera = {};                 ///< name of a camera or its node, else its number from 0; empty: none
  std::optional<ViewDirection> view = {};  ///< sets the angles that are not given
  std::optional<float> azimuth_deg = {};
  std::optional<float> elevation_deg = {};
  std::optional<glm::vec3> position = {};
  std::optional<glm::vec3> target = {};  ///< what is in the middle; without it the middle of the scene's box
  std::optional<float> distance = {};    ///< of the camera from the target, units
  std::optional<glm::vec3> up = {};      ///< what is up in the picture
  /// The whole vertical angle; 35 where no camera of the file says another.
  std::optional<float> fov_deg = {};
  std::optional<Projection> projection = {};
  float zoom = 1;                                ///< magnifies about the middle of the picture
  std::array<float, 4> window = {-1, -1, 1, 1};  ///< x0, y0, x1, y1: the part of the picture's −1…1 that is shown
  std::optional<std::array<float, 4>> viewport =
      {};  ///< x, y, width, height: the part of the picture that is drawn, from its top left; pixels
  AspectPolicy aspect = AspectPolicy::Fit;  ///< where the window has another shape than the viewport
};

/// A camera for a picture, and how it came about.
struct ChosenCamera {
  View view;
  CameraPose pose;
  std::string name;    ///< of the file's camera; empty: placed or framed
  float distance = 0;  ///< from the target
  bool from_file = false;
};

/// Chooses the camera of a picture of `width`×`height` pixels.
///
/// Aspect   a camera of the file keeps its vertical angle where the picture has another aspect than it was made for
/// Window   Fit draws it in the middle of the viewport, Fill its middle in all of it; Stretch makes it as wide and high
///          as the viewport, with a warning
/// Depth    near and far enclose what is in front of the camera, where the file gives none: near is at least far/10000,
///          so that a camera may stand inside the scene
/// Empty    scenes without vertices are looked at as if they had a box from -1 to 1
/// Cost     a few passes over the vertices, in parallel; beyond 16 million the boxes of meshes stand for them
/// Throws   Error(Argument): an unknown camera (with a suggestion), position and target that coincide, a window without
///          area, a viewport outside the picture; coordinates beyond 1e30
AZULEJO_EXPORT ChosenCamera choose_camera(const Scene& scene, const CameraOptions& options, int width, int height,
                                          const Run& run = {});

/// Direction and distance of a camera from its target.
struct Orbit {
  float azimuth_deg = 0;
  float elevation_deg = 0;
  glm::vec3 target{0, 0, 0};
  float distance = 0;
};

/// `frames` cameras all around the middle of the scene, counter-clockwise from the options' direction, at one distance
/// from which every one of them sees all of it. Given targets and distances are kept.
AZULEJO_EXPORT std::vector<Orbit> turntable(const Scene& scene, const CameraOptions& options, int frames, int width,
                                            int height, const Run& run = {});

/// The direction of the options, and a target and distance from which all of a box is seen: for pictures of something
/// that moves in it. Given targets and distances are kept.
AZULEJO_EXPORT Orbit framed_orbit(const Box3& box, const Space& space, const CameraOptions& options, int width,
                                  int height, const Run& run = {});

}  // namespace azulejo
