#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "azulejo/data/mesh.h"

namespace azulejo {

/// Where a camera stands and how it is turned, in double precision: its unit axes in world space. It looks along -back.
struct CameraBasis {
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 back{0, 0, 1};
  glm::dvec3 eye{0, 0, 0};

  /// `point` in the camera's axes, seen from the eye.
  glm::dvec3 camera_from_world(const glm::dvec3& point) const;
  glm::dvec3 world_from_camera(const glm::dvec3& point) const;
  glm::mat4 view_from_world() const;
};

/// The unit vector that points up in the pictures of a scene.
glm::dvec3 up_vector(UpAxis axis);

/// Turned to look along -back, `up` upwards in the picture as far as that goes; both need not be unit or
/// perpendicular. Where `up` says nothing (parallel to back, zero, not finite), a coordinate axis takes its place; a
/// zero `back` is +z.
CameraBasis basis_looking(const glm::dvec3& back, const glm::dvec3& up);

/// Turned to see what lies at the centre from a direction: the azimuth goes counter-clockwise as seen from above, from
/// the front (+z; -y of scenes whose z is up), the elevation from the horizon up. `up` is the axis; another than the
/// scene's own turns the whole arrangement with it. Degrees; at the poles the front is at the bottom of the picture
/// seen from above, at its top seen from below.
CameraBasis basis_from_angles(double azimuth_deg, double elevation_deg, UpAxis axis, const glm::dvec3& up);

/// The turn of a matrix whose columns may be scaled, sheared or mirrored: its z axis is kept, then its y axis.
CameraBasis basis_of(const glm::mat4& world_from_camera);

}  // namespace azulejo
