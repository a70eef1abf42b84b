#include "azulejo/io/volume_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

/// A direction counts as an axis of the world if what it has of the others is below this part of its length: headers
/// are written with six digits.
constexpr double kParallel = 1e-4;

double length(const std::array<double, 3>& axis) { return std::hypot(axis[0], axis[1], axis[2]); }

bool parallel(const std::array<double, 3>& axis, std::size_t to) {
  const double allowed = kParallel * length(axis);
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != to && std::abs(axis[i]) > allowed) return false;
  }
  return true;
}

bool finite_float(double value) { return std::abs(value) <= std::numeric_limits<float>::max(); }

}  // namespace

void set_size(Volume& volume, const std::array<std::int64_t, 3>& size, const std::string& file, const Run& run) {
  for (const std::int64_t each : size) {
    if (each < 1 || each > std::numeric_limits<int>::max()) {
      throw Error(Error::Data, fmt::format("{}: a size of {} × {} × {}, expected 1 or more along each axis", file,
                                           size[0], size[1], size[2]));
    }
  }
  const double bytes = 4.0 * static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]);
  if (bytes > static_cast<double>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("{}: {} × {} × {} samples take {:.0f} bytes, the limit of memory is {}",
                                             file, size[0], size[1], size[2], bytes, run.limits.memory_bytes));
  }
  volume.width = static_cast<int>(size[0]);
  volume.height = static_cast<int>(size[1]);
  volume.depth = static_cast<int>(size[2]);
}

void set_placement(Volume& volume, const GridPlacement& placement, const std::string& file, const Run& run) {
  bool rotated = false;
  bool replaced = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<glm::vec3::length_type>(i);
    const double step = length(placement.axes[i]);
    const float rounded = finite_float(step) ? static_cast<float>(step) : 0.0F;
    const bool along = parallel(placement.axes[i], i);
    if (rounded > 0) {
      volume.spacing[at] = along ? std::copysign(rounded, static_cast<float>(placement.axes[i][i])) : rounded;
      rotated = rotated || !along;
    } else {
      volume.spacing[at] = 1;
      replaced = true;
    }
    const bool known = finite_float(placement.origin[i]);
    volume.origin[at] = known ? static_cast<float>(placement.origin[i]) : 0.0F;
    replaced = replaced || !known;
  }
  if (rotated) warn(run, fmt::format("{}: its axes are turned against those of space; that is left out", file));
  if (replaced) warn(run, fmt::format("{}: steps of 0 or that are no numbers are taken to be 1, origins 0", file));
}

float metres_in(const std::string& unit) {
  static constexpr std::pair<const char*, float> kUnits[] = {
      {"nm", 1e-9F},         {"um", 1e-6F},         {"µm", 1e-6F},          {"micron", 1e-6F},     {"microns", 1e-6F},
      {"mm", 1e-3F},         {"millimeter", 1e-3F}, {"millimeters", 1e-3F}, {"millimetre", 1e-3F}, {"cm", 1e-2F},
      {"centimeter", 1e-2F}, {"m", 1.0F},           {"meter", 1.0F},        {"meters", 1.0F},      {"metre", 1.0F},
      {"in", 0.0254F},       {"ft", 0.3048F},
  };
  const auto* const found =
      std::find_if(std::begin(kUnits), std::end(kUnits), [&](const auto& each) { return unit == each.first; });
  return found == std::end(kUnits) ? 0.0F : found->second;
}

}  // namespace azulejo
