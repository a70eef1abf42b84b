// Surfaces of revolution around y: sphere, cylinder, cone, torus, capsule, disk, catenoid.
#include <cmath>
#include <numbers>
#include <vector>

#include "azulejo/modelling/primitive_shapes.h"
#include "azulejo/modelling/surface_builder.h"

namespace azulejo {
namespace {

constexpr double kPi = std::numbers::pi;

/// A point of the outline, from the top down on the outside.
struct Outline {
  double radius = 0;  ///< 0: on the axis
  double y = 0;
  double normal_out = 0;
  double normal_up = 0;
};

class Revolution {
 public:
  Revolution(std::vector<Outline> outline, int segments, bool closed)
      : outline_(std::move(outline)), segments_(static_cast<std::size_t>(segments)), closed_(closed) {
    directions_.resize(segments_);
    for (std::size_t i = 0; i < segments_; ++i) directions_[i] = direction(static_cast<double>(i));
    const std::size_t rows = outline_.size() - (closed ? 1 : 0);  // a closed outline ends in its first point
    for (std::size_t j = 0; j < rows; ++j) add_row(outline_[j]);
    for (std::size_t j = 0; j + 1 < outline_.size(); ++j) add_band(j);
  }

  /// The disk below the last row or above the first.
  void add_disk(bool top) {
    const std::vector<std::uint32_t>& row = rows_[top ? 0 : rows_.size() - 1];
    for (std::size_t k = 0; k < segments_; ++k) {
      const std::size_t i = top ? k : segments_ - 1 - k;
      const glm::dvec3 d = directions_[i];
      builder_.add_corner(row[i], {0, top ? 1 : -1, 0}, {0.5 + 0.5 * d.x, 0.5 + (top ? 0.5 : -0.5) * d.z});
    }
    builder_.end_face();
  }

  Mesh finish(bool smooth) { return builder_.finish(smooth); }

 private:
  /// Away from the axis; counter-clockwise seen from above.
  glm::dvec3 direction(double segment) const {
    const double angle = 2 * kPi * segment / static_cast<double>(segments_);
    return {std::cos(angle), 0, -std::sin(angle)};
  }

  void add_row(const Outline& at) {
    std::vector<std::uint32_t> row(segments_);
    if (at.radius == 0) {
      row.assign(segments_, builder_.add_vertex({0, at.y, 0}));
    } else {
      for (std::size_t i = 0; i < segments_; ++i) {
        row[i] = builder_.add_vertex(at.radius * directions_[i] + glm::dvec3(0, at.y, 0));
      }
    }
    rows_.push_back(std::move(row));
  }

  void add_band(std::size_t j) {
    for (std::size_t i = 0; i < segments_; ++i) {
      const bool from_axis = outline_[j].radius == 0;
      const bool to_axis = outline_[j + 1].radius == 0;
      add_corner(i, 0, j, from_axis);
      add_corner(i, 0, j + 1, to_axis);
      if (!to_axis) add_corner(i, 1, j + 1, false);
      if (!from_axis) add_corner(i, 1, j, false);
      builder_.end_face();
    }
  }

  /// A corner on the axis looks the way of its segment's middle.
  void add_corner(std::size_t segment, std::size_t next, std::size_t j, bool on_axis) {
    const Outline& at = outline_[j];
    const std::size_t i = (segment + next) % segments_;
    const double along = static_cast<double>(segment + next) + (on_axis ? 0.5 : 0);
    const glm::dvec3 out = on_axis ? direction(along) : directions_[i];
    const std::size_t row = closed_ && j + 1 == outline_.size() ? 0 : j;
    builder_.add_corner(
        rows_[row][i], at.normal_out * out + glm::dvec3(0, at.normal_up, 0),
        {along / static_cast<double>(segments_), static_cast<double>(j) / static_cast<double>(outline_.size() - 1)});
  }

  std::vector<Outline> outline_;
  std::size_t segments_;
  bool closed_;
  std::vector<glm::dvec3> directions_;
  std::vector<std::vector<std::uint32_t>> rows_;
  SurfaceBuilder builder_;
};

/// A straight side from the top down.
std::vector<Outline> side(double top_radius, double bottom_radius, double height, int rings) {
  const double length = std::hypot(height, bottom_radius - top_radius);
  std::vector<Outline> outline;
  for (int j = 0; j <= rings; ++j) {
    const double t = static_cast<double>(j) / rings;
    outline.push_back({(1 - t) * top_radius + t * bottom_radius, (0.5 - t) * height, height / length,
                       (bottom_radius - top_radius) / length});
  }
  return outline;
}

}  // namespace

Mesh make_uv_sphere(const PrimitiveOptions& options) {
  const int rings = *options.rings;
  std::vector<Outline> outline;
  for (int j = 0; j <= rings; ++j) {
    const double angle = kPi * j / rings;
    const double out = j == 0 || j == rings ? 0 : std::sin(angle);
    const double up = std::cos(angle);
    outline.push_back({out * options.radius, up * options.radius, out, up});
  }
  return Revolution(std::move(outline), *options.segments, false).finish(options.smooth);
}

Mesh make_cylinder(const PrimitiveOptions& options) {
  Revolution body(side(options.radius, options.radius, options.height, *options.rings), *options.segments, false);
  body.add_disk(true);
  body.add_disk(false);
  return body.finish(options.smooth);
}

Mesh make_cone(const PrimitiveOptions& options) {
  Revolution body(side(0, options.radius, options.height, *options.rings), *options.segments, false);
  body.add_disk(false);
  return body.finish(options.smooth);
}

Mesh make_torus(const PrimitiveOptions& options) {
  const int rings = *options.rings;
  std::vector<Outline> outline;
  for (int j = 0; j <= rings; ++j) {
    // Begins and ends at the hole, where the seam is least seen.
    const double angle = kPi - 2 * kPi * j / rings;
    const double out = std::cos(angle);
    const double up = std::sin(angle);
    outline.push_back({options.radius + out * options.tube_radius, up * options.tube_radius, out, up});
  }
  return Revolution(std::move(outline), *options.segments, true).finish(options.smooth);
}

Mesh make_capsule(const PrimitiveOptions& options) {
  const int rings = *options.rings;
  const double half = 0.5 * options.height;
  std::vector<Outline> outline;
  for (const double side : {1.0, -1.0}) {
    for (int j = 0; j <= rings; ++j) {
      const double angle = 0.5 * kPi * (side > 0 ? j : rings - j) / rings;  // from the pole
      const double out = angle == 0 ? 0 : std::sin(angle);
      const double up = side * std::cos(angle);
      outline.push_back({out * options.radius, side * half + up * options.radius, out, up});
    }
  }
  return Revolution(std::move(outline), *options.segments, false).finish(options.smooth);
}

Mesh make_disk(const PrimitiveOptions& options) {
  std::vector<Outline> outline;
  for (int j = 0; j <= *options.rings; ++j) {
    outline.push_back({static_cast<double>(options.radius) * j / *options.rings, 0, 0, 1});
  }
  return Revolution(std::move(outline), *options.segments, false).finish(options.smooth);
}

Mesh make_catenoid(const PrimitiveOptions& options) {
  const double waist = options.tube_radius;
  std::vector<Outline> outline;
  for (int j = 0; j <= *options.rings; ++j) {
    const double y = options.height * (0.5 - static_cast<double>(j) / *options.rings);
    const double grown = std::cosh(y / waist);  // the meridian's slope is sinh, so its normal is (1, −sinh) ÷ cosh
    outline.push_back({waist * grown, y, 1 / grown, -std::tanh(y / waist)});
  }
  return Revolution(std::move(outline), *options.segments, false).finish(options.smooth);
}

}  // namespace azulejo
