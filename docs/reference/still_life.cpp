#include "still_life.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "azulejo/core/error.h"
#include "azulejo/imaging/grayscale.h"
#include "azulejo/io/image_io.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/rendering/render.h"
#include "set.h"

namespace azulejo::reference {
namespace {

constexpr int kWidth = 480;
constexpr int kHeight = 320;

/// The tiles that the program azulejos paints, in light.
Image tiles(const std::string& painter, int width, int height) {
  const std::string command = "'" + painter + "' tiles.png " + std::to_string(width) + " " + std::to_string(height);
  if (std::system(command.c_str()) != 0) throw Error(Error::Io, command + ": failed");
  return in_light(read_image("tiles.png"));
}

/// Boards along x: grain, pores, gaps.
glm::vec3 wood(float x, float z) {
  constexpr float kBoard = 1.15F;
  const float across = z / kBoard + 40.3F;
  const int board = static_cast<int>(across);
  const float shift = 17.0F * static_cast<float>(board);
  const float waves = noise(0.35F * x + shift, 2.2F * z, 3);
  const float rings = 0.5F + 0.5F * std::sin(42.0F * (z + 0.45F * waves) + 1.5F * std::sin(0.6F * x + shift));
  const float pores = noise(5 * x + shift, 70 * z, 2);
  const float tone = 0.85F + 0.3F * noise(shift, 3.7F, 1);
  const float gap =
      std::min(1.0F, 28 * std::min(across - static_cast<float>(board), static_cast<float>(board) + 1 - across));
  const glm::vec3 dark{0.19F, 0.085F, 0.034F};
  const glm::vec3 light{0.42F, 0.225F, 0.105F};
  return tone * glm::mix(dark, light, 0.35F * rings + 0.4F * waves + 0.25F * pores) * (0.25F + 0.75F * gap);
}

/// Twelve colors and six grays, black between.
Image chart() {
  constexpr glm::vec3 kColors[18] = {
      {0.17F, 0.08F, 0.06F}, {0.55F, 0.30F, 0.22F}, {0.11F, 0.19F, 0.33F}, {0.10F, 0.15F, 0.05F}, {0.70F, 0.21F, 0.02F},
      {0.06F, 0.10F, 0.38F}, {0.53F, 0.08F, 0.12F}, {0.33F, 0.50F, 0.05F}, {0.77F, 0.36F, 0.03F}, {0.04F, 0.29F, 0.06F},
      {0.42F, 0.03F, 0.04F}, {0.83F, 0.57F, 0.01F}, {0.90F, 0.90F, 0.88F}, {0.59F, 0.59F, 0.59F}, {0.36F, 0.36F, 0.36F},
      {0.19F, 0.19F, 0.19F}, {0.09F, 0.09F, 0.09F}, {0.03F, 0.03F, 0.03F}};
  return painted(288, 288, [&](float u, float v) {
    const float column = 3 * u;
    const float row = 6 * v;
    const bool gap = std::abs(column - std::round(column)) < 0.03F || std::abs(row - std::round(row)) < 0.06F;
    const auto patch =
        static_cast<std::size_t>(std::min(5.0F, row)) * 3 + static_cast<std::size_t>(std::min(2.0F, column));
    return gap ? glm::vec3(0.01F) : kColors[patch];
  });
}

/// A ball with small hollows, or drawn out to two tips.
Mesh fruit(float radius, float hollows, float tips) {
  Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .radius = radius, .subdivisions = 6});
  mesh.attributes.clear();  // the hollows have other normals
  for (glm::vec3& place : mesh.positions) {
    const glm::vec3 at = 14.0F * (place / radius) + 50.0F;
    const float bumps = (noise(at.x, at.y, 1) + noise(at.y + 40, at.z, 1) + noise(at.z + 80, at.x, 1)) / 3 - 0.5F;
    const float along = std::abs(place.x) / radius;
    place *= 1 + hollows * bumps;
    place.x *= 1 + tips * (0.6F + std::pow(along, 10.0F));
  }
  return mesh;
}

glm::quat turned(float degrees, const glm::vec3& axis) { return glm::angleAxis(glm::radians(degrees), axis); }

struct Table {
  Set set;
  NodeId teapot;
};

/// Names of what stands on the table are those of its nodes.
Table table(const std::string& painter, float rolled) {
  Table table;
  Set& set = table.set;
  const glm::vec3 up{0, 1, 0};
  const MaterialId clay = set.add_material(
      surface({1, 1, 1, 1}, 0, 0.22F), recolored(tiles(painter, 768, 768), {2, 1, 0}, {1, 0.82F, 0.7F}), {0.5F, 0.5F});
  const MaterialId skin = set.add_material(surface({0.93F, 0.26F, 0.012F, 1}, 0, 0.38F));
  const MaterialId yellow = set.add_material(surface({0.88F, 0.62F, 0.03F, 1}, 0, 0.42F));
  const MaterialId green = set.add_material(surface({0.20F, 0.42F, 0.03F, 1}, 0, 0.35F));
  const MaterialId patches = set.add_material(surface({1, 1, 1, 1}, 0, 0.6F), chart(), {1, 1});
  const MaterialId red = set.add_material(surface({0.48F, 0.012F, 0.018F, 1}, 0, 0.15F));
  const MaterialId gold = set.add_material(surface({0.85F, 0.5F, 0.12F, 1}, 0.4F, 0.2F));

  table.teapot = set.stand("teapot", primitive({.kind = PrimitiveKind::Teapot, .size = 3.6F, .segments = 24}), clay,
                           {-0.75F, 0, -0.35F}, turned(24, up));
  set.stand("orange", fruit(0.62F, 0.03F, 0), skin, {1.35F + rolled, 0, 0.95F}, turned(-80 * rolled, {0, 0, 1}));
  set.stand("lime", fruit(0.42F, 0.02F, 0.06F), green, {3.1F, 0, 0.9F}, turned(60, up));
  set.stand("lemon", fruit(0.46F, 0.025F, 0.16F), yellow, {-0.25F, 0, 1.75F}, turned(-28, up));
  set.stand("cube", primitive({.kind = PrimitiveKind::Cube, .size = 1.35F}), patches, {2.0F, 0, -0.45F},
            turned(32, up));
  set.stand("ball", primitive({.kind = PrimitiveKind::UvSphere, .radius = 0.5F, .segments = 96}), red,
            {-2.75F, 0, 0.85F}, turned(0, up));
  set.stand("ring", primitive({.kind = PrimitiveKind::Torus, .radius = 0.42F, .tube_radius = 0.085F, .segments = 96}),
            gold, {0.75F, 0, 2.05F}, turned(0, up));

  set.add_light({0.66F, -0.7F, -0.3F}, {1, 0.95F, 0.86F}, 3.2F);
  set.add_light({-0.3F, -0.4F, -0.8F}, {0.8F, 0.88F, 1}, 1.1F);
  set.shadows = {0.66F, -0.7F, -0.3F};
  set.add_floor({-7.5F, -3, 7.5F, 4.5F}, [](float x, float z) { return wood(x, z); });
  const Image wall = recolored(tiles(painter, 1920, 960), {0, 1, 2}, glm::vec3(1.3F));
  set.add_wall({-7.5F, 0, 7.5F, 7.5F}, -3, wall);
  return table;
}

/// Bodies on a chessboard, at dusk.
Set chessboard() {
  Set set;
  const glm::quat upright{1, 0, 0, 0};
  const auto onto_a_face = [](float tilt_deg, float turn_deg) {
    return turned(turn_deg, {0, 1, 0}) * turned(tilt_deg, {1, 0, 0});
  };
  const auto body = [&](const char* name, const PrimitiveOptions& shape, const glm::vec4& color, float metallic,
                        float roughness, const glm::vec3& place, const glm::quat& turn) {
    const MaterialId material = set.add_material(surface(color, metallic, roughness));
    set.stand(name, primitive(shape), material, place, turn);
  };
  body("dodecahedron", {.kind = PrimitiveKind::Dodecahedron, .radius = 1.15F}, {0.50F, 0.02F, 0.05F, 1}, 0, 0.25F,
       {-1.9F, 0, -0.4F}, onto_a_face(31.717F, 20));
  body("cone", {.kind = PrimitiveKind::Cone, .radius = 0.85F, .height = 2.3F, .segments = 96}, {0.02F, 0.30F, 0.16F, 1},
       0, 0.35F, {0.6F, 0, -1.5F}, upright);
  body("torus", {.kind = PrimitiveKind::Torus, .radius = 0.75F, .tube_radius = 0.27F, .segments = 96},
       {0.85F, 0.5F, 0.12F, 1}, 0.4F, 0.2F, {1.2F, 0, 0.95F}, upright);
  body("icosahedron", {.kind = PrimitiveKind::Icosahedron, .radius = 0.8F}, {0.05F, 0.16F, 0.55F, 1}, 0, 0.2F,
       {2.9F, 0, -0.6F}, onto_a_face(20.905F, 12));
  body("ball", {.kind = PrimitiveKind::UvSphere, .radius = 0.55F, .segments = 96}, {0.8F, 0.78F, 0.74F, 1}, 0, 0.15F,
       {-0.45F, 0, 1.35F}, upright);
  set.add_light({-0.8F, -0.55F, -0.1F}, {1, 0.62F, 0.32F}, 3.0F);
  set.add_light({0.4F, -0.6F, -0.7F}, {0.5F, 0.65F, 1}, 1.4F);
  set.shadows = {-0.8F, -0.55F, -0.1F};
  set.add_floor({-12, -9, 12, 5}, [](float x, float z) {
    const bool white = (static_cast<int>(std::floor(x + 100)) + static_cast<int>(std::floor(z + 100))) % 2 == 0;
    const float veins = std::abs(noise(1.3F * x + 60, 1.3F * z + 60, 4) - 0.5F);
    return white ? glm::vec3(0.62F, 0.58F, 0.52F) * (0.7F + 0.5F * std::min(1.0F, 8 * veins))
                 : glm::vec3(0.035F, 0.03F, 0.035F) + glm::vec3(0.10F) * std::max(0.0F, 0.04F - veins) * 20.0F;
  });
  set.add_wall({-12, 0, 12, 9}, -9, painted(960, 360, [](float u, float v) {
                 const glm::vec3 sky = glm::mix(glm::vec3(0.95F, 0.42F, 0.14F), glm::vec3(0.07F, 0.13F, 0.36F),
                                                std::pow(std::min(1.0F, 1.25F * (1 - v)), 0.7F));
                 const float clouds = noise(7 * u + 11, 26 * v + 5, 5);
                 return sky + glm::vec3(0.55F, 0.25F, 0.16F) * std::max(0.0F, clouds - 0.52F) * 2.0F;
               }));
  return set;
}

RenderOptions view_of(const glm::vec3& position, const glm::vec3& target, float fov_deg) {
  RenderOptions options{.width = kWidth, .height = kHeight, .antialias = 16};
  options.camera.position = position;
  options.camera.target = target;
  options.camera.fov_deg = fov_deg;
  return options;
}

Image picture(const Set& set, const RenderOptions& options) {
  return opaque(*render(set.scene(), options).find("color"));
}

/// What of a picture a node covers, from 0 to full range.
Image cover(const Set& set, NodeId node, const RenderOptions& options) {
  return grayscale(opaque(*render(set.silhouette(node), options).find("color")));
}

/// Nodes that stand on the table are 40, 80 and so on.
Image labels(const Set& set, RenderOptions options) {
  options.layers = {FrameLayer::Object};
  options.antialias = 1;
  const Frame frame = render(set.scene(), options);
  const auto ids = frame.find("object_id")->view<float>();
  Image image({kWidth, kHeight, 1, PixelType::U8, ColorState::Srgb, AlphaState::None});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int body = set.number(static_cast<int>(ids(x, y)) - 1);
      image.view<std::uint8_t>()(x, y) = static_cast<std::uint8_t>(body > 0 && body <= 6 ? 40 * body : 0);
    }
  }
  return image;
}

}  // namespace

StillLife paint_still_life(const std::string& painter) {
  RenderOptions options = view_of({0.15F, 2.75F, 9.2F}, {0.05F, 1.15F, -0.3F}, 31);
  options.exposure = 0.25F;
  StillLife pictures;
  const Table now = table(painter, 0);
  pictures["photo.png"] = picture(now.set, options);
  pictures["mask.png"] = cover(now.set, now.teapot, options);
  pictures["labels.png"] = labels(now.set, options);
  pictures["later.png"] = picture(table(painter, 0.75F).set, options);
  pictures["other.png"] = picture(chessboard(), view_of({0.2F, 2.2F, 8.6F}, {0.25F, 1.15F, 0}, 32));
  pictures["cutout.png"] =
      render(now.set.alone(now.teapot), view_of({0.1F, 2.4F, 8.2F}, {-0.75F, 1.0F, -0.35F}, 26)).find("color")->clone();
  return pictures;
}

}  // namespace azulejo::reference
