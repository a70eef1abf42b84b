#include "set.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "azulejo/core/parallel.h"
#include "azulejo/imaging/gaussian.h"
#include "azulejo/imaging/grayscale.h"
#include "azulejo/io/image_io.h"
#include "azulejo/modelling/flatten.h"
#include "azulejo/rendering/render.h"

namespace azulejo::reference {
namespace {

constexpr float kPixelsPerUnit = 110;  // of painted floors

float lattice(int x, int y) {
  unsigned hash = static_cast<unsigned>(x) * 0x9E3779B1U ^ static_cast<unsigned>(y) * 0x85EBCA77U;
  hash = (hash ^ (hash >> 15)) * 0x2C1B3C6DU;
  hash = (hash ^ (hash >> 13)) * 0x297A2D39U;
  return static_cast<float>((hash ^ (hash >> 16)) & 0xFFFFU) / 65535.0F;
}

float smooth_noise(float x, float y) {
  const float column = std::floor(x);
  const float row = std::floor(y);
  const glm::vec2 part{x - column, y - row};
  const glm::vec2 weight = part * part * (3.0F - 2.0F * part);
  const int i = static_cast<int>(column);
  const int j = static_cast<int>(row);
  return glm::mix(glm::mix(lattice(i, j), lattice(i + 1, j), weight.x),
                  glm::mix(lattice(i, j + 1), lattice(i + 1, j + 1), weight.x), weight.y);
}

Image light_image(int width, int height) {
  return Image({width, height, 3, PixelType::F32, ColorState::Linear, AlphaState::None});
}

/// As files of 8 bits have it, for textures.
Image stored(const Image& light) { return read_image(encode_image(light, "png", {.type = PixelType::U8}), "texture"); }

/// A rectangle from (0, 0) to `size`, with texture coordinates, facing +z.
Mesh panel(const glm::vec2& size) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {size.x, 0, 0}, {size.x, size.y, 0}, {0, size.y, 0}};
  mesh.corners = {0, 1, 2, 0, 2, 3};
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Vertex, 2, Array<float>{0, 1, 1, 1, 1, 0, 0, 0}});
  return mesh;
}

/// Light that is left: 1 − strength · shadow.
void darken(const Image& light, const Image& shadow, float strength) {
  const auto color = light.any();
  const auto dark = shadow.view<std::uint8_t>();
  for (int y = 0; y < light.height(); ++y) {
    auto* row = const_cast<float*>(color.as<float>().row(y));
    for (int x = 0; x < light.width(); ++x) {
      const float left = 1 - strength * (1 - static_cast<float>(dark(x, y)) / 255);
      for (int channel = 0; channel < 3; ++channel) row[3 * x + channel] *= left;
    }
  }
}

}  // namespace

float noise(float x, float y, int octaves) {
  float sum = 0;
  float weights = 0;
  float weight = 1;
  for (int octave = 0; octave < octaves; ++octave, weight *= 0.5F) {
    sum += weight * smooth_noise(x, y);
    weights += weight;
    x = 2 * x + 19.1F;
    y = 2 * y + 7.7F;
  }
  return sum / weights;
}

Image painted(int width, int height, const std::function<glm::vec3(float u, float v)>& color) {
  constexpr int kSamples = 3;
  Image image = light_image(width, height);
  const auto view = image.view<float>();
  parallel_for(static_cast<std::size_t>(height), 8, {}, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        glm::vec3 sum{0};
        for (int sample = 0; sample < kSamples * kSamples; ++sample) {
          const float dx = (static_cast<float>(sample % kSamples) + 0.5F) / kSamples;
          const float dy = (static_cast<float>(sample / kSamples) + 0.5F) / kSamples;
          sum += color((static_cast<float>(x) + dx) / static_cast<float>(width),
                       (static_cast<float>(y) + dy) / static_cast<float>(height));
        }
        for (int channel = 0; channel < 3; ++channel) view(x, y, channel) = sum[channel] / (kSamples * kSamples);
      }
    }
  });
  return image;
}

Image in_light(const Image& image) {
  Image light = light_image(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* const source = image.view<std::uint8_t>().row(y);
    float* const result = light.view<float>().row(y);
    for (int i = 0; i < 3 * image.width(); ++i) {
      const float value = static_cast<float>(source[i]) / 255;
      result[i] = value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
    }
  }
  return light;
}

Image recolored(const Image& image, const std::array<int, 3>& order, const glm::vec3& tint) {
  Image result = image.clone();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int channel = 0; channel < 3; ++channel)
        result.view<float>()(x, y, channel) =
            image.view<float>()(x, y, order[static_cast<std::size_t>(channel)]) * tint[channel];
    }
  }
  return result;
}

Image opaque(const Image& image) {
  if (image.channels() != 4) return image.clone();
  Image result({image.width(), image.height(), 3, PixelType::U8, ColorState::Srgb, AlphaState::None});
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      std::copy_n(&image.view<std::uint8_t>()(x, y), 3, &result.view<std::uint8_t>()(x, y));
  }
  return result;
}

Material surface(const glm::vec4& color, float metallic, float roughness) {
  Material material;
  material.base_color = color;
  material.metallic = metallic;
  material.roughness = roughness;
  return material;
}

MaterialId Set::add_material(Material material) {
  scene_.materials.push_back(std::move(material));
  return MaterialId(scene_.materials.size() - 1);
}

MaterialId Set::add_material(Material material, const Image& texture, const glm::vec2& times) {
  Texture described;
  described.image = std::make_shared<const Image>(stored(texture));
  described.wrap_u = described.wrap_v = TextureWrap::Mirror;
  scene_.textures.push_back(std::move(described));
  material.base_color_texture.texture = TextureId(scene_.textures.size() - 1);
  material.base_color_texture.scale = times;
  return add_material(std::move(material));
}

NodeId Set::add_node(Node node, Mesh mesh, MaterialId material) {
  mesh.material.assign(mesh.face_count(), material.index);
  scene_.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  node.mesh = MeshId(scene_.meshes.size() - 1);
  scene_.nodes.push_back(std::move(node));
  const NodeId id(scene_.nodes.size() - 1);
  scene_.roots.push_back(id);
  return id;
}

NodeId Set::stand(const std::string& name, Mesh mesh, MaterialId material, glm::vec3 place, const glm::quat& turn) {
  float lowest = 1e30F;
  for (const glm::vec3& position : mesh.positions) lowest = std::min(lowest, (turn * position).y);
  place.y -= lowest;
  Node node;
  node.name = name;
  node.placement = Placement{place, turn, {1, 1, 1}};
  things_.push_back(add_node(std::move(node), std::move(mesh), material));
  return things_.back();
}

void Set::add_light(const glm::vec3& direction, const glm::vec3& color, float lux) {
  LightSource light;
  light.color = color;
  light.intensity = lux;
  scene_.lights.push_back(light);
  Node node;
  node.light = LightId(scene_.lights.size() - 1);
  const glm::vec3 forward = glm::normalize(direction);
  node.placement = Placement{{0, 0, 0}, glm::quatLookAt(forward, {0, 1, 0}), {1, 1, 1}};
  scene_.nodes.push_back(std::move(node));
  scene_.roots.push_back(NodeId(scene_.nodes.size() - 1));
}

/// What stands, pressed along a direction onto the floor, or onto a wall: thin, not quite flat.
Mesh Set::shadow(const glm::vec3& direction, std::optional<float> wall_z) const {
  Scene things = scene_.clone();
  things.roots = things_;
  Mesh mesh = flatten(things);
  for (glm::vec3& at : mesh.positions) {
    const float steps = wall_z ? (*wall_z - at.z) / direction.z : -at.y / direction.y;
    const float depth = wall_z ? at.z : at.y;
    at += steps * direction;
    (wall_z ? at.z : at.y) += 0.001F * depth;
  }
  return mesh;
}

Image Set::shadow_picture(Mesh shadow, Node camera_node, float height, int width_px, int height_px,
                          float blur_px) const {
  shadow.material.clear();
  shadow.attributes.clear();
  Scene scene = scene_of(std::move(shadow));
  Material black;
  black.model = MaterialModel::Unlit;
  black.base_color = {0, 0, 0, 1};
  black.double_sided = true;
  scene.materials = {black};
  Mesh mesh = scene.meshes[0]->clone();
  mesh.material.assign(mesh.face_count(), 0);
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  Camera camera;
  camera.perspective = false;
  camera.height = height;
  scene.cameras = {camera};
  camera_node.camera = CameraId(0);
  scene.nodes.push_back(std::move(camera_node));
  scene.roots.push_back(NodeId(scene.nodes.size() - 1));
  const Frame frame = render(scene, {.width = width_px, .height = height_px, .background = {1, 1, 1, 1}});
  return gaussian(grayscale(opaque(*frame.find("color"))), {.sigma = blur_px, .border = Border::Clamp});
}

void Set::add_floor(const std::array<float, 4>& rect, const std::function<glm::vec3(float x, float z)>& color) {
  const glm::vec2 size{rect[2] - rect[0], rect[3] - rect[1]};
  const int width = static_cast<int>(size.x * kPixelsPerUnit);
  const int height = static_cast<int>(size.y * kPixelsPerUnit);
  const Image floor =
      painted(width, height, [&](float u, float v) { return color(rect[0] + u * size.x, rect[1] + v * size.y); });
  Node above;
  const glm::quat down = glm::angleAxis(-std::numbers::pi_v<float> / 2, glm::vec3{1, 0, 0});
  above.placement = Placement{{rect[0] + size.x / 2, 20, rect[1] + size.y / 2}, down, {1, 1, 1}};
  darken(floor, shadow_picture(shadow(shadows, std::nullopt), above, size.y, width, height, 7), 0.66F);
  darken(floor, shadow_picture(shadow({0, -1, 0}, std::nullopt), above, size.y, width, height, 12), 0.55F);
  Node node;
  node.placement = Placement{{rect[0], 0, rect[3]}, down, {1, 1, 1}};
  add_node(std::move(node), panel(size), add_material(surface({1, 1, 1, 1}, 0, 0.5F), floor, {1, 1}));
}

void Set::add_wall(const std::array<float, 4>& rect, float z, const Image& texture) {
  const glm::vec2 size{rect[2] - rect[0], rect[3] - rect[1]};
  Image wall = texture.clone();
  Node before;
  before.placement = Placement{{rect[0] + size.x / 2, rect[1] + size.y / 2, 20}, {1, 0, 0, 0}, {1, 1, 1}};
  darken(wall, shadow_picture(shadow(shadows, z), before, size.y, wall.width(), wall.height(), 10), 0.5F);
  Node node;
  node.placement = Placement{{rect[0], rect[1], z}, {1, 0, 0, 0}, {1, 1, 1}};
  add_node(std::move(node), panel(size), add_material(surface({1, 1, 1, 1}, 0, 0.35F), wall, {1, 1}));
}

Scene Set::silhouette(NodeId node) const {
  Scene scene = scene_.clone();
  const std::uint32_t white = scene.meshes[scene.nodes[node.index].mesh.index]->material[0];
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Material flat;
    flat.model = MaterialModel::Unlit;
    const float shade = i == white ? 1.0F : 0.0F;
    flat.base_color = {shade, shade, shade, 1};
    scene.materials[i] = flat;
  }
  return scene;
}

Scene Set::alone(NodeId node) const {
  Scene scene = scene_.clone();
  std::erase_if(scene.roots, [&](NodeId root) { return root != node && !scene.nodes[root.index].light; });
  return scene;
}

int Set::number(int node) const {
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (static_cast<int>(things_[i].index) == node) return static_cast<int>(i) + 1;
  }
  return 0;
}

}  // namespace azulejo::reference
