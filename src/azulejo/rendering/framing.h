#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/rendering/camera_basis.h"

namespace azulejo {

/// The points of a scene that a picture of it must show: the vertices of the visible meshes, in world space. Of more
/// than 16 million, the corners of the box around each mesh stand for its vertices. Vertices that are not finite, or
/// beyond 1e30, are left out. The scene must outlive it.
class ScenePoints {
 public:
  ScenePoints(const Scene& scene, const Run& run);
  /// The corners of a box, and nothing else.
  ScenePoints(const Box3& box, const Run& run);

  /// True if there is nothing to see.
  bool empty() const { return pieces_.empty(); }
  /// Of all points; around the origin, from -1 to 1, where there are none.
  const Box3& box() const { return box_; }
  /// The middle of the box, in doubles: sums of floats may leave their range.
  glm::dvec3 center() const { return 0.5 * (glm::dvec3(box_.lower) + glm::dvec3(box_.upper)); }
  /// Half the box's diagonal; a visible size where the points coincide.
  double radius() const;

  /// What limits how near a camera comes. In the axes of a basis, its eye the origin.
  struct Extent {
    glm::dvec3 lower{1e300, 1e300, 1e300};
    glm::dvec3 upper{-1e300, -1e300, -1e300};
    /// The largest z + x/slope.x, z - x/slope.x, z + y/slope.y, z - y/slope.y.
    std::array<double, 4> reach{-1e300, -1e300, -1e300, -1e300};
  };
  Extent extent(const CameraBasis& basis, const glm::dvec2& slope, const Run& run) const;

  /// The largest slope to each side as the eye sees it (x, -x, y, -y over depth), and the depth at which it is met.
  struct Sides {
    std::array<double, 4> slope{-1e300, -1e300, -1e300, -1e300};
    std::array<double, 4> depth{1, 1, 1, 1};
  };
  Sides sides(const CameraBasis& basis, const Run& run) const;

 private:
  struct Piece {
    const glm::vec3* points;
    std::size_t count;
    std::uint32_t placement;
  };
  void add(const glm::vec3* points, std::size_t count, const glm::mat4& world_from_points);
  void find_box(const Run& run);
  template <class T, class Add, class Combine>
  T reduce(const Run& run, Add add, Combine combine) const;

  std::vector<glm::mat4> placements_;
  std::vector<Piece> pieces_;
  std::vector<std::unique_ptr<std::array<glm::vec3, 8>>> corners_;
  Box3 box_;
};

/// How much of a picture a framed scene fills, of its width or its height.
inline constexpr double kFilled = 0.9;

/// Moves the eye of a perspective camera so that the points fill kFilled of the picture, which sees slopes up to
/// `slope`: as near as that allows, and centred both ways. The basis keeps its axes.
void frame_perspective(CameraBasis& basis, const ScenePoints& points, const glm::dvec2& slope, const Run& run);
/// The same around a target that stays in the middle of the picture: the distance of the eye from it.
double distance_around(const CameraBasis& basis, const glm::dvec3& target, const ScenePoints& points,
                       const glm::dvec2& slope, const Run& run);
/// Moves the eye of an orthographic camera before the points, and tells the height of what it then sees.
double frame_orthographic(CameraBasis& basis, const ScenePoints& points, double aspect, const Run& run);
double height_around(const CameraBasis& basis, const glm::dvec3& target, const ScenePoints& points, double aspect,
                     const Run& run);

}  // namespace azulejo
