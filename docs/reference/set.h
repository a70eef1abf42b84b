#pragma once

#include <array>
#include <functional>
#include <glm/ext/quaternion_float.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/data/image.h"
#include "azulejo/data/scene.h"

namespace azulejo::reference {

/// Smooth values in 0–1, sums of finer and finer ones.
float noise(float x, float y, int octaves);
/// An image in light, f32, of the color at (u, v) in 0–1; 3×3 samples a pixel.
Image painted(int width, int height, const std::function<glm::vec3(float u, float v)>& color);
/// u8 sRGB in light, f32.
Image in_light(const Image& image);
/// Channels of an image in light in another order, times a color.
Image recolored(const Image& image, const std::array<int, 3>& order, const glm::vec3& tint);
/// Without alpha, all of which must be full.
Image opaque(const Image& image);

/// A material of metal-rough kind.
Material surface(const glm::vec4& color, float metallic, float roughness);

/// Things on a floor before a wall, lit from afar. The renderer knows no shadows: those on floor and wall are painted
/// onto them, as silhouettes along the light, soft.
class Set {
 public:
  glm::vec3 shadows{0, -1, 0};  ///< direction in which they fall

  MaterialId add_material(Material material);
  /// texture  in light; repeated `times` over the texture coordinates
  MaterialId add_material(Material material, const Image& texture, const glm::vec2& times);
  /// Lets a mesh stand on the floor, y = 0: its height is found.
  NodeId stand(const std::string& name, Mesh mesh, MaterialId material, glm::vec3 place, const glm::quat& turn);
  void add_light(const glm::vec3& direction, const glm::vec3& color, float lux);

  /// Both are added when all things stand. Rectangles are left, near end of y or z, right, far end of it.
  void add_floor(const std::array<float, 4>& rect, const std::function<glm::vec3(float x, float z)>& color);
  void add_wall(const std::array<float, 4>& rect, float z, const Image& texture);

  const Scene& scene() const { return scene_; }
  /// All black but a node that is white.
  Scene silhouette(NodeId node) const;
  /// A node with the lights.
  Scene alone(NodeId node) const;
  /// Of the thing whose node has this index, from 1 in the order in which they were stood; 0: none.
  int number(int node) const;

 private:
  Mesh shadow(const glm::vec3& direction, std::optional<float> wall_z) const;
  Image shadow_picture(Mesh shadow, Node camera_node, float height, int width_px, int height_px, float blur_px) const;
  NodeId add_node(Node node, Mesh mesh, MaterialId material);

  Scene scene_;
  std::vector<NodeId> things_;
};

}  // namespace azulejo::reference
