// Surfaces by formula: Möbius strip, Klein bottle, helicoid, Enneper's surface; the cube that is blown up to a sphere.
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

#include "azulejo/math/turns.h"
#include "azulejo/modelling/parametric_grid.h"
#include "azulejo/modelling/primitive_shapes.h"

namespace azulejo {
namespace {

constexpr double kPi = std::numbers::pi;

/// On the side where u × v turns clockwise.
glm::dvec3 normal_of(const glm::dvec3& along_u, const glm::dvec3& along_v) {
  return glm::normalize(glm::cross(along_v, along_u));
}

/// Away from the axis, and on around it, counter-clockwise seen from above.
glm::dvec3 out_of(const Turn& turn) { return {turn.cosine, 0, -turn.sine}; }
glm::dvec3 on_of(const Turn& turn) { return {-turn.sine, 0, -turn.cosine}; }

Mesh mesh_of(const ParametricGrid& grid, bool smooth, const std::function<SurfacePlace(double u, double v)>& surface) {
  SurfaceBuilder builder;
  add_grid(builder, grid, surface);
  return builder.finish(smooth);
}

/// A number and its derivative.
struct Rate {
  double value = 0;
  double slope = 0;
  friend Rate operator+(const Rate& a, const Rate& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Rate operator*(const Rate& a, const Rate& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Rate operator*(double a, const Rate& b) { return {a * b.value, a * b.slope}; }
};

/// The bottle is (x + x_out cos v, y + y_out cos v, z_out sin v).
struct Bottle {
  Rate x, x_out, y, y_out, z_out;
};

/// At half a turn × u. Source: R. Israel's parametrization, 1996.
Bottle bottle_at(double u) {
  const auto [cosine, sine] = turn_at(0.5 * u);
  const Rate c{cosine, -sine};
  const Rate s{sine, cosine};
  const Rate c2 = c * c;
  const Rate c4 = c2 * c2;
  const Rate c6 = c4 * c2;
  const Rate one{1, 0};
  const Rate opening = 3 * one + 5 * (c * s);
  Bottle at;
  at.x = (c * s) * (4 * one + -12 * c4 + 8 * c6);
  at.x_out = -2.0 / 15 * (c * opening);
  at.y = 4 * (s * s);
  at.y_out =
      -1.0 / 15 * (s * (3 * one + -3 * c2 + -48 * c4 + 48 * c6 + (c * s) * (5 * one + -5 * c2 + -80 * c4 + 80 * c6)));
  at.z_out = 2.0 / 15 * opening;
  return at;
}

/// What the bottle measures from top to bottom, and its middle.
constexpr double kBottleHeight = 4.206402;
constexpr glm::dvec3 kBottleMiddle{0.153393, 2.103201, 0};

/// A place of the cube's surface with coordinates 0 … n, on the sphere: even angles from the middle of a face.
glm::dvec3 on_sphere(const std::array<int, 3>& place, int n) {
  glm::dvec3 p;
  for (int k = 0; k < 3; ++k) {
    const int from_middle = 2 * place[static_cast<std::size_t>(k)] - n;
    const Turn turn = turn_of(from_middle, 8 * n);
    p[k] = from_middle == n ? 1 : from_middle == -n ? -1 : turn.sine / turn.cosine;
  }
  return glm::normalize(p);
}

}  // namespace

Mesh make_mobius(const PrimitiveOptions& options) {
  const ParametricGrid grid{.columns = *options.segments, .rows = *options.rings};
  return mesh_of(grid, options.smooth, [&](double u, double v) {
    const Turn around = turn_at(u);
    const Turn half = turn_at(0.5 * u);
    const double t = options.tube_radius * (1 - 2 * v);
    const glm::dvec3 out = out_of(around);
    const glm::dvec3 across = half.cosine * out + glm::dvec3(0, half.sine, 0);
    const glm::dvec3 turned = 0.5 * (-half.sine * out + glm::dvec3(0, half.cosine, 0));
    const double reach = options.radius + t * half.cosine;
    return SurfacePlace{static_cast<double>(options.radius) * out + t * across,
                        normal_of(reach * on_of(around) + t * turned, -across)};
  });
}

Mesh make_klein_bottle(const PrimitiveOptions& options) {
  const ParametricGrid grid{.columns = *options.segments, .rows = *options.rings, .wrap_v = true};
  const double scale = options.size / kBottleHeight;
  return mesh_of(grid, options.smooth, [&](double u, double v) {
    const Bottle at = bottle_at(u);
    const auto [c, s] = turn_at(v);
    const glm::dvec3 place(at.x.value + c * at.x_out.value, at.y.value + c * at.y_out.value, s * at.z_out.value);
    const glm::dvec3 along_u(at.x.slope + c * at.x_out.slope, at.y.slope + c * at.y_out.slope, s * at.z_out.slope);
    const glm::dvec3 along_v(-s * at.x_out.value, -s * at.y_out.value, c * at.z_out.value);
    return SurfacePlace{scale * (place - kBottleMiddle), normal_of(along_u, along_v)};
  });
}

Mesh make_helicoid(const PrimitiveOptions& options) {
  const ParametricGrid grid{.columns = *options.segments, .rows = *options.rings};
  return mesh_of(grid, options.smooth, [&](double u, double v) {
    const Turn around = turn_at(options.turns * u);
    const double r = options.radius * (1 - 2 * v);
    const glm::dvec3 rise(0, options.height / (2 * kPi * options.turns), 0);  // a radian
    return SurfacePlace{r * out_of(around) + glm::dvec3(0, options.height * (u - 0.5), 0),
                        normal_of(r * on_of(around) + rise, -out_of(around))};
  });
}

Mesh make_enneper(const PrimitiveOptions& options) {
  const ParametricGrid grid{.columns = *options.segments, .rows = *options.rings};
  constexpr double kReach = 5.0 / 3;  // of x at u = v = ±1
  const double scale = 0.5 * options.size / kReach;
  return mesh_of(grid, options.smooth, [&](double across, double down) {
    const double u = 2 * across - 1;
    const double v = 2 * down - 1;
    const glm::dvec3 place(u - u * u * u / 3 + u * v * v, u * u - v * v, v - v * v * v / 3 + v * u * u);
    return SurfacePlace{scale * place,
                        normal_of({1 - u * u + v * v, 2 * u, 2 * u * v}, {2 * u * v, -2 * v, 1 - v * v + u * u})};
  });
}

Mesh make_cube_sphere(const PrimitiveOptions& options) {
  const int n = *options.segments;
  SurfaceBuilder builder;
  std::map<std::array<int, 3>, std::uint32_t> vertices;
  // Directions of a face's u and v, which points down, on the cube of 0 … n: seen from outside, v × u is its normal.
  struct Side {
    std::size_t u, v, normal;
    bool u_falls, v_falls, far;
  };
  constexpr std::array<Side, 6> kSides = {{{0, 1, 2, false, true, true},
                                           {0, 1, 2, true, true, false},
                                           {2, 1, 0, true, true, true},
                                           {2, 1, 0, false, true, false},
                                           {0, 2, 1, false, false, true},
                                           {0, 2, 1, false, true, false}}};
  for (const Side& side : kSides) {
    const auto add_corner = [&](int i, int j) {
      std::array<int, 3> place{};
      place[side.u] = side.u_falls ? n - i : i;
      place[side.v] = side.v_falls ? n - j : j;
      place[side.normal] = side.far ? n : 0;
      const glm::dvec3 normal = on_sphere(place, n);
      const auto [at, is_new] = vertices.try_emplace(place, 0U);
      if (is_new) at->second = builder.add_vertex(static_cast<double>(options.radius) * normal);
      builder.add_corner(at->second, normal, {static_cast<double>(i) / n, static_cast<double>(j) / n});
    };
    add_squares(builder, n, add_corner);
  }
  return builder.finish(options.smooth);
}

}  // namespace azulejo
