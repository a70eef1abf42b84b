#include "azulejo/rendering/camera_choice.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/rendering/camera_basis.h"
#include "azulejo/rendering/file_camera.h"
#include "azulejo/rendering/framing.h"
#include "azulejo/rendering/lens.h"
#include "azulejo/rendering/spread_directions.h"
#include "azulejo/rendering/viewport_rect.h"

namespace azulejo {
namespace {

constexpr float kAzimuthDeg = 30;
constexpr float kElevationDeg = 20;
constexpr double kFovDeg = 35;
constexpr double kRadians = 3.14159265358979323846 / 180;

/// Beyond this, products of coordinates leave the range of floats.
constexpr float kFarthest = 1e30F;

bool usable(const glm::vec3& v) {
  return std::abs(v.x) <= kFarthest && std::abs(v.y) <= kFarthest && std::abs(v.z) <= kFarthest;
}

void check(const CameraOptions& options) {
  const auto refuse = [](const char* name, const std::string& got, const char* wanted) {
    throw Error(Error::Argument, fmt::format("{}: {}, expected {}", name, got, wanted));
  };
  const std::pair<const char*, const std::optional<glm::vec3>*> points[] = {
      {"position", &options.position}, {"target", &options.target}, {"up", &options.up}};
  for (const auto& [name, point] : points) {
    if (*point && !usable(**point))
      refuse(name, fmt::format("{},{},{}", (*point)->x, (*point)->y, (*point)->z), "coordinates up to 1e30");
  }
  const std::pair<const char*, const std::optional<float>*> numbers[] = {{"azimuth_deg", &options.azimuth_deg},
                                                                         {"elevation_deg", &options.elevation_deg}};
  for (const auto& [name, number] : numbers) {
    if (*number && !std::isfinite(**number)) refuse(name, "not finite", "an angle");
  }
  if (options.position && options.target && *options.position == *options.target) {
    refuse("position", "the target's own", "a place away from it");
  }
  if (options.up && *options.up == glm::vec3(0)) refuse("up", "0,0,0", "a direction");
  if (options.distance && !(*options.distance > 0 && *options.distance <= kFarthest)) {
    refuse("distance", fmt::format("{}", *options.distance), "a positive number");
  }
  if (options.fov_deg && !(*options.fov_deg > 0 && *options.fov_deg < 180)) {
    refuse("fov_deg", fmt::format("{}", *options.fov_deg), "an angle between 0 and 180");
  }
  if (!(options.zoom > 0 && std::isfinite(options.zoom))) {
    refuse("zoom", fmt::format("{}", options.zoom), "a positive number");
  }
}

bool is_placed(const CameraOptions& options) {
  return options.view || options.azimuth_deg || options.elevation_deg || options.position || options.target ||
         options.distance || options.up;
}

/// The angles that the options ask for.
Direction direction(const CameraOptions& options) {
  Direction angles{kAzimuthDeg, kElevationDeg};
  if (options.view) {
    switch (*options.view) {
      case ViewDirection::Front: angles = {0, 0}; break;
      case ViewDirection::Back: angles = {180, 0}; break;
      case ViewDirection::Left: angles = {270, 0}; break;
      case ViewDirection::Right: angles = {90, 0}; break;
      case ViewDirection::Top: angles = {0, 90}; break;
      case ViewDirection::Bottom: angles = {0, -90}; break;
      case ViewDirection::Isometric: angles = {45, 35.2643897F}; break;  // atan(1/√2): all three axes alike
    }
  }
  if (options.azimuth_deg) angles.azimuth_deg = *options.azimuth_deg;
  if (options.elevation_deg) angles.elevation_deg = *options.elevation_deg;
  return angles;
}

CameraBasis turned_to(UpAxis axis, const CameraOptions& options, const Direction& angles) {
  const glm::dvec3 up = options.up ? glm::dvec3(*options.up) : up_vector(axis);
  return basis_from_angles(angles.azimuth_deg, angles.elevation_deg, axis, up);
}

Lens lens_of(const CameraOptions& options, double aspect) {
  Lens lens;
  lens.perspective = options.projection.value_or(Projection::Perspective) == Projection::Perspective;
  lens.fov_y = options.fov_deg.value_or(static_cast<float>(kFovDeg)) * kRadians;
  lens.aspect = aspect;
  return lens;
}

struct Placed {
  CameraBasis basis;
  Lens lens;
  glm::dvec3 target{0, 0, 0};
};

Placed from_file(const FileCamera& file, const CameraOptions& options, const ScenePoints& points, double aspect,
                 const Run& run) {
  Placed placed;
  placed.basis = basis_of(file.world_from_node);
  placed.lens = lens_of(options, aspect);
  const Camera& camera = *file.camera;
  if (!options.projection) placed.lens.perspective = camera.perspective;
  if (!options.fov_deg && camera.perspective) {
    if (camera.fov_y > 0 && camera.fov_y < 3.14159F) {
      placed.lens.fov_y = camera.fov_y;
    } else {
      warn(run, fmt::format("camera {}: its vertical angle is {} radians; {} degrees are taken", file.name,
                            camera.fov_y, kFovDeg));
    }
  }
  // What a perspective camera turned orthographic shows of the middle of the scene, and the other way round nothing.
  const double depth = std::abs(placed.basis.camera_from_world(points.center()).z);
  placed.lens.height = camera.perspective
                           ? 2 * std::max(depth, points.radius() * 1e-3) * std::tan(placed.lens.fov_y / 2)
                           : static_cast<double>(camera.height);
  if (!(placed.lens.height > 0) || !std::isfinite(placed.lens.height)) placed.lens.height = 2 * points.radius();
  if (camera.near > 0 && std::isfinite(camera.near)) placed.lens.near = camera.near;
  if (camera.far > 0 && std::isfinite(camera.far)) placed.lens.far = camera.far;
  placed.lens.infinite = camera.perspective && camera.near > 0 && camera.far == 0;
  placed.target = placed.basis.eye - placed.basis.back * std::max(depth, points.radius() * 1e-3);
  return placed;
}

/// At a position that was given, looking at the target.
Placed at_position(const Scene& scene, const CameraOptions& options, const ScenePoints& points, double aspect) {
  Placed placed;
  placed.lens = lens_of(options, aspect);
  const glm::dvec3 eye(*options.position);
  const glm::dvec3 up = options.up ? glm::dvec3(*options.up) : up_vector(scene.space.up);
  placed.target = options.target ? glm::dvec3(*options.target) : points.center();
  glm::dvec3 back = eye - placed.target;
  if (back == glm::dvec3(0, 0, 0)) {
    // In the middle of the scene: looks as a camera in front of it would.
    back = turned_to(scene.space.up, options, {0, 0}).back;
    placed.target = eye - back * points.radius();
  }
  placed.basis = basis_looking(back, up);
  placed.basis.eye = eye;
  placed.lens.height = 2 * glm::length(eye - placed.target) * std::tan(placed.lens.fov_y / 2);
  return placed;
}

Placed framed(const Scene& scene, const CameraOptions& options, const ScenePoints& points, double aspect,
              const Run& run) {
  Placed placed;
  placed.lens = lens_of(options, aspect);
  CameraBasis& basis = placed.basis = turned_to(scene.space.up, options, direction(options));
  const double slope_y = std::tan(placed.lens.fov_y / 2);
  const glm::dvec2 slope(slope_y * aspect, slope_y);
  const bool around = options.target || options.distance;
  placed.target = options.target ? glm::dvec3(*options.target) : points.center();
  if (placed.lens.perspective && !around) {
    frame_perspective(basis, points, slope, run);
    placed.target = basis.eye + basis.back * glm::dot(basis.back, placed.target - basis.eye);
    return placed;
  }
  if (placed.lens.perspective) {
    const double distance = options.distance ? static_cast<double>(*options.distance)
                                             : distance_around(basis, placed.target, points, slope, run);
    basis.eye = placed.target + basis.back * distance;
    return placed;
  }
  if (!around) {
    placed.lens.height = frame_orthographic(basis, points, aspect, run);
    placed.target = basis.eye + basis.back * glm::dot(basis.back, placed.target - basis.eye);
    return placed;
  }
  // A distance sets the scale of an orthographic picture as if it were a perspective one in the target's plane.
  basis.eye = placed.target + basis.back * (2 * points.radius() + glm::length(placed.target - points.center()));
  placed.lens.height = options.distance ? 2 * static_cast<double>(*options.distance) * slope_y
                                        : height_around(basis, placed.target, points, aspect, run);
  return placed;
}

/// What of the camera's picture is shown, and in which pixels.
FittedPixels shown_part(const CameraOptions& options, const Rect& viewport, const Run& run) {
  const auto [x0, y0, x1, y1] = options.window;
  const Window window{x0, y0, x1, y1};
  const double mismatch = aspect_mismatch(window, Window{});
  constexpr double kSame = 1e-6;  // floats of a window that is meant to be square
  if (std::abs(mismatch - 1) < kSame) return {window, viewport};
  if (options.aspect == AspectPolicy::Stretch) {
    warn(run, fmt::format("window: not of the viewport's shape; lengths across are drawn {:.3g} times as long as "
                          "lengths up, aspect=fit keeps the shape",
                          mismatch));
    return {window, viewport};
  }
  // The camera's −1…1 is as wide as the viewport's shape says.
  const double aspect = static_cast<double>(viewport.width) / viewport.height;
  FittedPixels shown = fitted(Window{x0 * aspect, y0, x1 * aspect, y1}, viewport, options.aspect);
  shown.window.x0 /= aspect;
  shown.window.x1 /= aspect;
  return shown;
}

void warn_of_unused(const CameraOptions& options, const Run& run) {
  if (is_placed(options)) {
    warn(run, fmt::format("camera: \"{}\" of the file is used; view, azimuth, elevation, position, target, distance "
                          "and up are not",
                          options.camera));
  }
}

}  // namespace

ChosenCamera choose_camera(const Scene& scene, const CameraOptions& options, int width, int height, const Run& run) {
  if (width < 1 || height < 1) {
    throw Error(Error::Argument, fmt::format("size: {}×{} pixels, expected at least 1×1", width, height));
  }
  check(options);
  ChosenCamera chosen;
  const Rect viewport = viewport_rect(options.viewport, width, height);
  const double aspect = static_cast<double>(viewport.width) / viewport.height;
  const ScenePoints points(scene, run);
  if (points.empty()) warn(run, "the scene has nothing to show: no vertex that is visible, finite and within 1e30");

  std::optional<FileCamera> file;
  if (!options.camera.empty()) {
    file = find_camera(scene, options.camera);
    warn_of_unused(options, run);
  } else if (!is_placed(options)) {
    file = first_camera(scene);
  }
  Placed placed;
  if (file) {
    placed = from_file(*file, options, points, aspect, run);
    chosen.name = file->name;
    chosen.from_file = true;
  } else if (options.position) {
    placed = at_position(scene, options, points, aspect);
  } else {
    placed = framed(scene, options, points, aspect, run);
  }
  placed.lens.zoom = options.zoom;
  const FittedPixels shown = shown_part(options, viewport, run);
  placed.lens.window = shown.window;
  choose_depth_range(placed.lens, points, placed.basis, run);
  chosen.view = view_through(placed.lens, placed.basis, {width, height}, shown.viewport);
  chosen.pose = {glm::vec3(placed.basis.eye), glm::vec3(placed.target), glm::vec3(placed.basis.up)};
  chosen.distance = static_cast<float>(glm::length(placed.basis.eye - placed.target));
  return chosen;
}

namespace {

/// Sees points around a target from several directions.
struct Surroundings {
  const ScenePoints& points;
  const CameraOptions& options;
  UpAxis axis;
  Lens lens;
  glm::dvec3 target;

  Surroundings(const ScenePoints& all, const CameraOptions& camera, UpAxis up, int width, int height)
      : points(all), options(camera), axis(up) {
    check(options);
    const Rect viewport = viewport_rect(options.viewport, width, height);
    lens = lens_of(options, static_cast<double>(viewport.width) / viewport.height);
    target = options.target ? glm::dvec3(*options.target) : points.center();
  }

  double distance(const Orbit& orbit, const Run& run) const {
    if (options.distance) return static_cast<double>(*options.distance);
    const CameraBasis basis = turned_to(axis, options, {orbit.azimuth_deg, orbit.elevation_deg});
    const double slope = std::tan(lens.fov_y / 2);
    if (lens.perspective) return distance_around(basis, target, points, {slope * lens.aspect, slope}, run);
    return height_around(basis, target, points, lens.aspect, run) / (2 * slope);
  }
};

}  // namespace

std::vector<Orbit> turntable(const Scene& scene, const CameraOptions& options, int frames, int width, int height,
                             const Run& run) {
  if (frames < 1) throw Error(Error::Argument, fmt::format("frames: {}, expected at least 1", frames));
  const ScenePoints points(scene, run);
  const Surroundings around(points, options, scene.space.up, width, height);
  const Direction start = direction(options);
  std::vector<Orbit> orbits;
  for (int frame = 0; frame < frames; ++frame) {
    const double azimuth = start.azimuth_deg + 360.0 * frame / frames;
    orbits.push_back({static_cast<float>(azimuth), start.elevation_deg, glm::vec3(around.target), 0});
  }
  // As many directions as make a difference that can be seen.
  const std::size_t step = std::max<std::size_t>(1, orbits.size() / 64);
  double distance = 0;
  for (std::size_t i = 0; i < orbits.size(); i += step) distance = std::max(distance, around.distance(orbits[i], run));
  for (Orbit& orbit : orbits) orbit.distance = static_cast<float>(distance);
  return orbits;
}

Orbit framed_orbit(const Box3& box, const Space& space, const CameraOptions& options, int width, int height,
                   const Run& run) {
  const ScenePoints points(box, run);
  const Surroundings around(points, options, space.up, width, height);
  const Direction start = direction(options);
  Orbit orbit{start.azimuth_deg, start.elevation_deg, glm::vec3(around.target), 0};
  orbit.distance = static_cast<float>(around.distance(orbit, run));
  return orbit;
}

}  // namespace azulejo
