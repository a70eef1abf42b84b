#include "azulejo/rendering/camera_basis.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace azulejo {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Unit length, or zero where there is no direction. Scaled first: squares of 1e-200 or 1e200 are not numbers.
glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double scale = largest(v);
  if (!(scale > 0) || !std::isfinite(scale)) return {0, 0, 0};
  return glm::normalize(v / scale);
}

/// The rotation that takes one unit vector the shortest way to another, applied to a vector (Rodrigues).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& half_turn_axis) {
  const double cosine = glm::dot(from, to);
  if (cosine < -1 + 1e-12) return 2.0 * glm::dot(v, half_turn_axis) * half_turn_axis - v;
  const glm::dvec3 axis = glm::cross(from, to);
  return v * cosine + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + cosine));
}

/// Sine and cosine of degrees, exact at the multiples of 90.
glm::dvec2 cosine_and_sine(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  if (std::fmod(turn, 90.0) == 0) {
    const int quarter = (static_cast<int>(turn / 90) + 4) % 4;
    return {quarter == 0 ? 1 : quarter == 2 ? -1 : 0, quarter == 1 ? 1 : quarter == 3 ? -1 : 0};
  }
  return {std::cos(turn * kRadians), std::sin(turn * kRadians)};
}

}  // namespace

glm::dvec3 CameraBasis::camera_from_world(const glm::dvec3& point) const {
  const glm::dvec3 from_eye = point - eye;
  return {glm::dot(right, from_eye), glm::dot(up, from_eye), glm::dot(back, from_eye)};
}

glm::dvec3 CameraBasis::world_from_camera(const glm::dvec3& point) const {
  return eye + right * point.x + up * point.y + back * point.z;
}

glm::mat4 CameraBasis::view_from_world() const {
  glm::mat4 view(1.0F);
  for (int axis = 0; axis < 3; ++axis) {
    view[axis][0] = static_cast<float>(right[axis]);
    view[axis][1] = static_cast<float>(up[axis]);
    view[axis][2] = static_cast<float>(back[axis]);
  }
  const glm::dvec3 shift = camera_from_world({0, 0, 0});
  for (int row = 0; row < 3; ++row) view[3][row] = static_cast<float>(shift[row]);
  return view;
}

glm::dvec3 up_vector(UpAxis axis) { return axis == UpAxis::Z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0); }

CameraBasis basis_looking(const glm::dvec3& back, const glm::dvec3& up) {
  CameraBasis basis;
  basis.back = unit_or_zero(back);
  if (basis.back == glm::dvec3(0, 0, 0)) basis.back = {0, 0, 1};
  glm::dvec3 right(0, 0, 0);
  const glm::dvec3 hints[] = {unit_or_zero(up), {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  for (const glm::dvec3& hint : hints) {
    right = glm::cross(hint, basis.back);
    // The sine of the angle between them; below this, rounding decides which way is up.
    if (glm::length(right) > 1e-6) break;
  }
  basis.right = glm::normalize(right);
  basis.up = glm::cross(basis.back, basis.right);
  return basis;
}

CameraBasis basis_from_angles(double azimuth_deg, double elevation_deg, UpAxis axis, const glm::dvec3& up) {
  const glm::dvec3 own_up = up_vector(axis);
  const glm::dvec3 side(1, 0, 0);
  const glm::dvec3 front = axis == UpAxis::Z ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec2 azimuth = cosine_and_sine(azimuth_deg);
  const glm::dvec2 elevation = cosine_and_sine(elevation_deg);
  const glm::dvec3 around = front * azimuth.x + side * azimuth.y;
  CameraBasis basis;
  basis.right = side * azimuth.x - front * azimuth.y;
  basis.back = around * elevation.x + own_up * elevation.y;
  basis.up = own_up * elevation.x - around * elevation.y;
  const glm::dvec3 wanted = unit_or_zero(up);
  if (wanted != glm::dvec3(0, 0, 0) && wanted != own_up) {
    for (glm::dvec3* each : {&basis.right, &basis.up, &basis.back}) *each = turned(*each, own_up, wanted, side);
  }
  return basis;
}

CameraBasis basis_of(const glm::mat4& world_from_camera) {
  CameraBasis basis = basis_looking(glm::dvec3(world_from_camera[2]), glm::dvec3(world_from_camera[1]));
  const glm::dvec3 eye(world_from_camera[3]);
  if (std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z)) basis.eye = eye;
  return basis;
}

}  // namespace azulejo
