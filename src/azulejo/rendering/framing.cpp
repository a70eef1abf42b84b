#include "azulejo/rendering/framing.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostVertices = std::size_t{16} << 20;
constexpr std::size_t kPiece = std::size_t{1} << 15;
constexpr float kFarthest = 1e30F;
constexpr glm::dvec2 kAnySlope{1, 1};

bool usable(const glm::vec3& point) {
  return std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest && std::abs(point.z) <= kFarthest;
}

/// Row by row, as floats: what stays of a point in front of a camera is a few parts in 10⁷ of the scene.
struct Axes {
  glm::vec3 right, up, back;
  glm::vec3 shift;
};

/// The axes as seen by the points of a piece.
Axes axes_of(const CameraBasis& basis, const glm::mat4& world_from_points) {
  const glm::dmat4 placement(world_from_points);
  Axes axes{};
  for (int column = 0; column < 3; ++column) {
    const glm::dvec3 along(placement[column]);
    axes.right[column] = static_cast<float>(glm::dot(basis.right, along));
    axes.up[column] = static_cast<float>(glm::dot(basis.up, along));
    axes.back[column] = static_cast<float>(glm::dot(basis.back, along));
  }
  axes.shift = glm::vec3(basis.camera_from_world(glm::dvec3(placement[3])));
  return axes;
}

glm::vec3 seen(const Axes& axes, const glm::vec3& point) {
  return {axes.right.x * point.x + axes.right.y * point.y + axes.right.z * point.z + axes.shift.x,
          axes.up.x * point.x + axes.up.y * point.y + axes.up.z * point.z + axes.shift.y,
          axes.back.x * point.x + axes.back.y * point.y + axes.back.z * point.z + axes.shift.z};
}

ScenePoints::Extent united(ScenePoints::Extent a, const ScenePoints::Extent& b) {
  a.lower = glm::min(a.lower, b.lower);
  a.upper = glm::max(a.upper, b.upper);
  for (std::size_t i = 0; i < 4; ++i) a.reach[i] = std::max(a.reach[i], b.reach[i]);
  return a;
}

ScenePoints::Sides united(ScenePoints::Sides a, const ScenePoints::Sides& b) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(b.slope[i] > a.slope[i])) continue;
    a.slope[i] = b.slope[i];
    a.depth[i] = b.depth[i];
  }
  return a;
}

/// How far a perspective eye stays before the nearest point at least, against the size of the scene.
constexpr double kLeastDistance = 1e-3;

}  // namespace

template <class T, class Add, class Combine>
T ScenePoints::reduce(const Run& run, Add add, Combine combine) const {
  // Whole pieces, many at once where they are small; the chunks depend on the scene only.
  const std::size_t chunk = std::max<std::size_t>(1, pieces_.size() / 512);
  return parallel_reduce(
      pieces_.size(), chunk, run, T{},
      [&](std::size_t begin, std::size_t end) {
        T partial{};
        for (std::size_t i = begin; i < end; ++i) add(partial, pieces_[i]);
        return partial;
      },
      combine);
}

void ScenePoints::add(const glm::vec3* points, std::size_t count, const glm::mat4& world_from_points) {
  if (count == 0) return;
  const auto placement = static_cast<std::uint32_t>(placements_.size());
  placements_.push_back(world_from_points);
  for (std::size_t at = 0; at < count; at += kPiece)
    pieces_.push_back({points + at, std::min(kPiece, count - at), placement});
}

ScenePoints::ScenePoints(const Scene& scene, const Run& run) {
  const std::vector<PlacedNode> placed = walk(scene);
  const auto each_mesh = [&](auto&& use) {
    for (const PlacedNode& each : placed) {
      const MeshId mesh = scene.nodes[each.node.index].mesh;
      if (each.visible && mesh) use(mesh.index, each.world_from_node);
    }
  };
  std::size_t vertices = 0;
  each_mesh([&](std::size_t mesh, const glm::mat4&) { vertices += scene.meshes[mesh]->vertex_count(); });
  if (vertices > kMostVertices) corners_.resize(scene.meshes.size());
  each_mesh([&](std::size_t index, const glm::mat4& world_from_node) {
    const Mesh& mesh = *scene.meshes[index];
    if (corners_.empty() || mesh.vertex_count() <= 8) {
      add(mesh.positions.data(), mesh.positions.size(), world_from_node);
      return;
    }
    if (corners_[index] == nullptr) {
      const Box3 box = bounds(mesh);
      if (box.empty()) return;
      corners_[index] = std::make_unique<std::array<glm::vec3, 8>>();
      for (std::size_t c = 0; c < 8; ++c) {
        (*corners_[index])[c] = {(c & 1U) != 0 ? box.upper.x : box.lower.x, (c & 2U) != 0 ? box.upper.y : box.lower.y,
                                 (c & 4U) != 0 ? box.upper.z : box.lower.z};
      }
    }
    add(corners_[index]->data(), 8, world_from_node);
  });
  find_box(run);
}

ScenePoints::ScenePoints(const Box3& box, const Run& run) {
  if (!box.empty()) {
    corners_.push_back(std::make_unique<std::array<glm::vec3, 8>>());
    for (std::size_t c = 0; c < 8; ++c) {
      (*corners_[0])[c] = {(c & 1U) != 0 ? box.upper.x : box.lower.x, (c & 2U) != 0 ? box.upper.y : box.lower.y,
                           (c & 4U) != 0 ? box.upper.z : box.lower.z};
    }
    add(corners_[0]->data(), 8, glm::mat4(1.0F));
  }
  find_box(run);
}

void ScenePoints::find_box(const Run& run) {
  box_ = reduce<Box3>(
      run,
      [&](Box3& box, const Piece& piece) {
        const Axes axes = axes_of({}, placements_[piece.placement]);
        for (std::size_t i = 0; i < piece.count; ++i) {
          const glm::vec3 world = seen(axes, piece.points[i]);
          if (usable(world)) box = azulejo::united(box, world);
        }
      },
      [](const Box3& a, const Box3& b) { return azulejo::united(a, b); });
  if (box_.empty()) {
    box_ = {{-1, -1, -1}, {1, 1, 1}};
    pieces_.clear();
  }
}

double ScenePoints::radius() const {
  const double half = 0.5 * glm::length(glm::dvec3(box_.upper) - glm::dvec3(box_.lower));
  const double away = glm::length(center());
  // Below what floats can tell apart at this place the points coincide.
  if (half > away * 1e-6) return half;
  return away > 0 ? away * 1e-3 : 1.0;
}

ScenePoints::Extent ScenePoints::extent(const CameraBasis& basis, const glm::dvec2& slope, const Run& run) const {
  const glm::vec2 inverse = glm::vec2(1.0 / slope);
  Extent extent = reduce<Extent>(
      run,
      [&](Extent& total, const Piece& piece) {
        const Axes axes = axes_of(basis, placements_[piece.placement]);
        glm::vec3 lower(3e38F);
        glm::vec3 upper(-3e38F);
        std::array<float, 4> reach{-3e38F, -3e38F, -3e38F, -3e38F};
        for (std::size_t i = 0; i < piece.count; ++i) {
          const glm::vec3 p = seen(axes, piece.points[i]);
          if (!usable(p)) continue;
          lower = glm::min(lower, p);
          upper = glm::max(upper, p);
          reach[0] = std::max(reach[0], p.z + p.x * inverse.x);
          reach[1] = std::max(reach[1], p.z - p.x * inverse.x);
          reach[2] = std::max(reach[2], p.z + p.y * inverse.y);
          reach[3] = std::max(reach[3], p.z - p.y * inverse.y);
        }
        if (lower.x > upper.x) return;
        total = united(total, {lower, upper, {reach[0], reach[1], reach[2], reach[3]}});
      },
      [](const Extent& a, const Extent& b) { return united(a, b); });
  if (extent.lower.x > extent.upper.x) {
    // Nothing to see: a ball of the box's size.
    const glm::dvec3 middle = basis.camera_from_world(center());
    const double r = radius();
    extent = {middle - r, middle + r, {}};
    extent.reach = {middle.z + (r + middle.x) / slope.x, middle.z + (r - middle.x) / slope.x,
                    middle.z + (r + middle.y) / slope.y, middle.z + (r - middle.y) / slope.y};
  }
  return extent;
}

ScenePoints::Sides ScenePoints::sides(const CameraBasis& basis, const Run& run) const {
  return reduce<Sides>(
      run,
      [&](Sides& total, const Piece& piece) {
        const Axes axes = axes_of(basis, placements_[piece.placement]);
        Sides own;
        for (std::size_t i = 0; i < piece.count; ++i) {
          const glm::vec3 p = seen(axes, piece.points[i]);
          if (!usable(p) || !(p.z < 0)) continue;
          const float inverse = -1.0F / p.z;
          const float slopes[] = {p.x * inverse, -p.x * inverse, p.y * inverse, -p.y * inverse};
          for (std::size_t s = 0; s < 4; ++s) {
            if (!(slopes[s] > own.slope[s])) continue;
            own.slope[s] = slopes[s];
            own.depth[s] = -p.z;
          }
        }
        total = united(total, own);
      },
      [](const Sides& a, const Sides& b) { return united(a, b); });
}

void frame_perspective(CameraBasis& basis, const ScenePoints& points, const glm::dvec2& slope, const Run& run) {
  basis.eye = points.center();
  const glm::dvec2 fill = kFilled * slope;
  const ScenePoints::Extent extent = points.extent(basis, fill, run);
  // |x - eye.x| <= slope · (eye.z - z) for all points, likewise y: each pair of sides meets at an eye of least z.
  const auto& reach = extent.reach;
  glm::dvec3 eye(0.5 * fill.x * (reach[0] - reach[1]), 0.5 * fill.y * (reach[2] - reach[3]),
                 0.5 * std::max(reach[0] + reach[1], reach[2] + reach[3]));
  eye.z = std::max(eye.z, extent.upper.z + kLeastDistance * points.radius());
  basis.eye = basis.world_from_camera(eye);
  // The direction that has room to spare is centred: Newton's method on the difference of its two sides, which is
  // monotone and made of few smooth pieces.
  for (int i = 0; i < 12; ++i) {
    const ScenePoints::Sides sides = points.sides(basis, run);
    glm::dvec2 move(0, 0);
    double off = 0;
    for (int axis = 0; axis < 2; ++axis) {
      const auto plus = static_cast<std::size_t>(2 * axis);
      const double difference = sides.slope[plus] - sides.slope[plus + 1];
      if (!(std::abs(difference) < 1e6)) continue;
      move[axis] = difference / (1 / sides.depth[plus] + 1 / sides.depth[plus + 1]);
      off = std::max(off, std::abs(difference) / slope[axis]);
    }
    if (off < 1e-5) break;
    basis.eye += basis.right * move.x + basis.up * move.y;
  }
}

double distance_around(const CameraBasis& basis, const glm::dvec3& target, const ScenePoints& points,
                       const glm::dvec2& slope, const Run& run) {
  CameraBasis around = basis;
  around.eye = target;
  const ScenePoints::Extent extent = points.extent(around, kFilled * slope, run);
  return std::max(*std::max_element(extent.reach.begin(), extent.reach.end()),
                  extent.upper.z + kLeastDistance * points.radius());
}

double frame_orthographic(CameraBasis& basis, const ScenePoints& points, double aspect, const Run& run) {
  basis.eye = points.center();
  const ScenePoints::Extent extent = points.extent(basis, kAnySlope, run);
  const glm::dvec3 size = extent.upper - extent.lower;
  const glm::dvec3 middle = 0.5 * (extent.upper + extent.lower);
  basis.eye = basis.world_from_camera({middle.x, middle.y, extent.upper.z + points.radius()});
  const double height = std::max(size.y, size.x / aspect) / kFilled;
  return height > 1e-6 * points.radius() ? height : 2 * points.radius();
}

double height_around(const CameraBasis& basis, const glm::dvec3& target, const ScenePoints& points, double aspect,
                     const Run& run) {
  CameraBasis around = basis;
  around.eye = target;
  const ScenePoints::Extent extent = points.extent(around, kAnySlope, run);
  const glm::dvec3 half = glm::max(extent.upper, -extent.lower);
  const double height = 2 * std::max(half.y, half.x / aspect) / kFilled;
  return height > 1e-6 * points.radius() ? height : 2 * points.radius();
}

}  // namespace azulejo
