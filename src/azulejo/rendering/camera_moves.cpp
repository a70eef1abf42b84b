#include "azulejo/rendering/camera_moves.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/rendering/camera_basis.h"

namespace azulejo {
namespace {

/// Radians between the view and the poles at least: `up` still says which way the picture stands.
constexpr double kPole = 1e-3;
constexpr double kQuarter = 1.57079632679489661923;

struct Place {
  CameraBasis basis;
  glm::dvec3 up;  ///< unit
  double distance = 0;
};

Place place_of(const CameraPose& pose) {
  const glm::dvec3 away = glm::dvec3(pose.position) - glm::dvec3(pose.target);
  Place place;
  place.basis = basis_looking(away, glm::dvec3(pose.up));
  place.basis.eye = pose.position;
  place.distance = glm::length(away);
  const double length = glm::length(glm::dvec3(pose.up));
  place.up = length > 0 && std::isfinite(length) ? glm::dvec3(pose.up) / length : place.basis.up;
  if (std::abs(glm::dot(place.up, place.basis.right)) > 1e-3) place.up = place.basis.up;
  return place;
}

/// Unit vector `back` turned about `up`, and then towards it, not over it.
glm::dvec3 turned(const Place& place, double around, double over) {
  const glm::dvec3& up = place.up;
  const glm::dvec3& back = place.basis.back;
  const double height = glm::dot(back, up);
  const glm::dvec3 level = glm::normalize(glm::cross(place.basis.right, up));
  const glm::dvec3 side = glm::cross(up, level);
  const double low = -kQuarter + kPole;
  const double now = std::asin(std::clamp(height, -1.0, 1.0));
  // A camera that is beyond the stop already stays there.
  const double next = std::clamp(now + over, std::min(low, now), std::max(-low, now));
  return std::cos(next) * (std::cos(around) * level + std::sin(around) * side) + std::sin(next) * up;
}

}  // namespace

CameraPose orbit(const CameraPose& pose, double azimuth, double elevation) {
  const Place place = place_of(pose);
  CameraPose moved = pose;
  moved.position = glm::vec3(glm::dvec3(pose.target) + place.distance * turned(place, azimuth, elevation));
  return moved;
}

CameraPose pan(const CameraPose& pose, double right, double up) {
  const CameraBasis basis = place_of(pose).basis;
  const glm::vec3 shift(basis.right * right + basis.up * up);
  return {pose.position + shift, pose.target + shift, pose.up};
}

CameraPose dolly(const CameraPose& pose, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) {
    throw Error(Error::Argument, fmt::format("dolly: factor {}, expected a positive number", factor));
  }
  CameraPose moved = pose;
  moved.position = glm::vec3(glm::dvec3(pose.target) + (glm::dvec3(pose.position) - glm::dvec3(pose.target)) / factor);
  return moved;
}

CameraPose look_around(const CameraPose& pose, double yaw, double pitch) {
  const Place place = place_of(pose);
  CameraPose moved = pose;
  moved.target = glm::vec3(glm::dvec3(pose.position) - place.distance * turned(place, yaw, -pitch));
  return moved;
}

}  // namespace azulejo
