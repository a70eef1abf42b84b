// How surfaces are lit, against the definitions in double precision.

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

/// A directional, a point and a spot light, and light from everywhere.
Lighting all_lights() {
  Lighting lighting;
  lighting.lights.push_back({.direction = glm::normalize(glm::vec3(1, -1, -2)), .color = {0.5F, 0.4F, 0.3F}});
  lighting.lights.push_back({.kind = LightKind::Point, .position = {-1.5F, 1, 2}, .color = {0.5F, 1, 2}, .range = 3});
  lighting.lights.push_back({.kind = LightKind::Spot,
                             .position = {0.5F, -2, 2},
                             .direction = glm::normalize(glm::vec3(-0.2F, 1, -1)),
                             .color = {3, 1, 2},
                             .cos_inner = 0.97F,
                             .cos_outer = 0.85F});
  lighting.sky = {0.1F, 0.15F, 0.2F};
  lighting.ground = {0.08F, 0.05F, 0.02F};
  return lighting;
}

Material phong_material() {
  Material material;
  material.model = MaterialModel::Phong;
  material.base_color = {0.7F, 0.5F, 0.3F, 1};
  material.ambient = {0.9F, 1, 0.5F};
  material.specular = {0.4F, 0.6F, 0.5F};
  material.shininess = 40;
  material.emissive = {0.01F, 0.02F, 0.03F};
  return material;
}

struct Arriving {
  glm::dvec3 direction;
  glm::dvec3 amount;
};

/// glTF's lights: 1/d², a window 1 − (d/range)⁴, and the square of where the angle's cosine is between the cones'.
Arriving arriving(const ShadingLight& light, const glm::dvec3& place) {
  const glm::dvec3 color(light.color);
  if (light.kind == LightKind::Directional) return {-glm::dvec3(light.direction), color};
  const glm::dvec3 way = glm::dvec3(light.position) - place;
  const double distance = glm::length(way);
  double amount = 1 / (distance * distance);
  if (light.range > 0) amount *= std::clamp(1 - std::pow(distance / light.range, 4), 0.0, 1.0);
  if (light.kind == LightKind::Spot) {
    const double cosine = glm::dot(-way / distance, glm::dvec3(light.direction));
    const double inside =
        (cosine - light.cos_outer) / (static_cast<double>(light.cos_inner) - static_cast<double>(light.cos_outer));
    amount *= std::pow(std::clamp(inside, 0.0, 1.0), 2);
  }
  return {way / distance, color * amount};
}

/// I = k_a I_a + Σ I (k_d N·L + k_s (V·R)ⁿ), and what the surface itself sends.
glm::dvec3 phong(const Material& m, const Lighting& lighting, const glm::dvec3& place, const glm::dvec3& n,
                 const glm::dvec3& v) {
  const glm::dvec3 base(m.base_color);
  const double up = glm::dot(n, glm::dvec3(lighting.up)) * 0.5 + 0.5;
  glm::dvec3 sum = glm::dvec3(m.emissive) +
                   glm::dvec3(m.ambient) * base * glm::mix(glm::dvec3(lighting.ground), glm::dvec3(lighting.sky), up);
  for (const ShadingLight& light : lighting.lights) {
    const Arriving in = arriving(light, place);
    const double nl = glm::dot(n, in.direction);
    if (nl <= 0) continue;
    const double vr = std::max(0.0, glm::dot(v, 2 * nl * n - in.direction));
    sum += in.amount * (base * nl + glm::dvec3(m.specular) * std::pow(vr, static_cast<double>(m.shininess)));
  }
  return sum;
}

ZBufferOptions shaded(Shading shading, std::vector<std::string> layers = {"color"}) {
  return {.shading = shading, .antialias = 1, .output = FrameOutput::Linear, .layers = std::move(layers)};
}

/// Calls f(x, y) for the pixels that see something.
template <class F>
int for_seen(const Frame& frame, F f) {
  int count = 0;
  const Image& color = *frame.find("color");
  for (int y = 0; y < color.height(); ++y) {
    for (int x = 0; x < color.width(); ++x) {
      if (pixel_at(frame, "color", x, y).w == 0) continue;
      ++count;
      f(x, y);
    }
  }
  return count;
}

/// From the place and the normal that the data layers give (tested with rays) to the colour: floats, a power of 40
/// whose base is right to about 5·10⁻⁷.
TEST(Shading, PhongIsItsFormulaAtTheHitPoint) {
  const Lighting lighting = all_lights();
  const Material material = phong_material();
  for (const bool perspective : {true, false}) {
    TestView wanted;
    wanted.lens.perspective = perspective;
    const View view = view_of(wanted);
    const ZBufferRenderer renderer(scene_with(sphere_mesh(14), material),
                                   shaded(Shading::Phong, {"color", "position", "normal"}));
    const Frame frame = renderer.draw(view, lighting);
    const int seen = for_seen(frame, [&](int x, int y) {
      const glm::dvec3 place(pixel_at(frame, "position", x, y));
      const glm::dvec3 normal(pixel_at(frame, "normal", x, y));
      const glm::dvec3 v = perspective ? glm::normalize(wanted.eye - place) : glm::dvec3(0, 0, 1);
      const glm::dvec3 color(pixel_at(frame, "color", x, y));
      EXPECT_LE(glm::distance(color, phong(material, lighting, place, normal, v)), 1e-4) << x << ", " << y;
    });
    EXPECT_GT(seen, 1500);
  }
}

/// The sphere itself: its places and normals differ from those of 200 rings of triangles by about (π/400)² / 2 = 3·10⁻⁵
/// and a power of 40 makes 40 times that of it, under lights of up to 3 and with two directions that differ.
TEST(Shading, PhongOfAFineSphereIsTheSpheres) {
  const Lighting lighting = all_lights();
  const Material material = phong_material();
  const View view = view_of({});
  const Frame frame =
      ZBufferRenderer(scene_with(sphere_mesh(200), material), shaded(Shading::Phong)).draw(view, lighting);
  const double height = std::tan(0.35);
  int seen = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const glm::dvec3 eye(0, 0, 4);
      const glm::dvec3 way = glm::normalize(glm::dvec3((x + 0.5 - 48) / 40 * height, (40 - y - 0.5) / 40 * height, -1));
      const double middle = -glm::dot(eye, way);
      const double under = middle * middle - 15;
      if (under < 0.02) continue;
      const glm::dvec3 place = eye + way * (middle - std::sqrt(under));
      ++seen;
      EXPECT_LE(
          glm::distance(glm::dvec3(pixel_at(frame, "color", x, y)), phong(material, lighting, place, place, -way)),
          5e-3)
          << x << ", " << y;
    }
  }
  EXPECT_GT(seen, 1500);
}

TEST(Shading, FlatIsTheLightAtTheFacesCentre) {
  const Lighting lighting = all_lights();
  const Material material = phong_material();
  // Quads, which are two triangles each, and triangles at the poles.
  Mesh mesh = sphere_mesh(9, false);
  const Mesh copy = mesh.clone();
  const ZBufferRenderer renderer(scene_with(std::move(mesh), material), shaded(Shading::Flat, {"color", "face_id"}));
  const Frame frame = renderer.draw(view_of({}), lighting);
  std::map<int, glm::dvec4> colors;
  for_seen(frame, [&](int x, int y) {
    const int face = static_cast<int>(pixel_at(frame, "face_id", x, y).x) - 1;
    const glm::dvec4 color = pixel_at(frame, "color", x, y);
    const auto [known, added] = colors.try_emplace(face, color);
    EXPECT_EQ(known->second, color) << "face " << face;
    if (!added) return;
    glm::dvec3 center(0);
    glm::dvec3 normal(0);
    const std::size_t begin = copy.face_begin(static_cast<std::size_t>(face));
    const std::size_t end = copy.face_end(static_cast<std::size_t>(face));
    for (std::size_t c = begin; c < end; ++c) {
      const glm::dvec3 a(copy.positions[copy.corners[c]]);
      const glm::dvec3 b(copy.positions[copy.corners[c + 1 < end ? c + 1 : begin]]);
      center += a / static_cast<double>(end - begin);
      normal += glm::cross(a, b);
    }
    const glm::dvec3 v = glm::normalize(glm::dvec3(0, 0, 4) - center);
    EXPECT_LE(glm::distance(glm::dvec3(color), phong(material, lighting, center, glm::normalize(normal), v)), 1e-4);
  });
  EXPECT_GT(colors.size(), 40U);
}

/// Perspective-correct: weights in the world, not in the picture.
TEST(Shading, GouraudBlendsTheLightOfTheCorners) {
  const Lighting lighting = all_lights();
  const Material material = phong_material();
  Mesh mesh = soup_of({{-1.2F, -1, 1.5F}, {1.3F, -0.8F, -3}, {-0.1F, 1.2F, 0}});
  const std::vector<glm::vec3> normals = {glm::normalize(glm::vec3(-0.5F, 0, 1)), glm::normalize(glm::vec3(1, 0, 1)),
                                          glm::normalize(glm::vec3(0, 0.6F, 1))};
  mesh.attributes.push_back(attribute_of("NORMAL", normals));
  const Scene scene = scene_with(std::move(mesh), material);
  const View view = view_of({});
  const RayScene rays(scene, view);
  const Frame frame = ZBufferRenderer(scene, shaded(Shading::Gouraud)).draw(view, lighting);
  glm::dvec3 corners[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 place = rays.triangles()[0].corner[k];
    corners[k] = phong(material, lighting, place, glm::dvec3(normals[k]), glm::normalize(glm::dvec3(0, 0, 4) - place));
  }
  const int seen = for_seen(frame, [&](int x, int y) {
    const RayHit hit = rays.meet(rays.triangles()[0], x + 0.5, y + 0.5);
    const glm::dvec3 wanted = hit.weight[0] * corners[0] + hit.weight[1] * corners[1] + hit.weight[2] * corners[2];
    EXPECT_LE(glm::distance(glm::dvec3(pixel_at(frame, "color", x, y)), wanted), 1e-3) << x << ", " << y;
  });
  EXPECT_GT(seen, 700);
}

TEST(Shading, UnlitIsItsColorUnderAnyLight) {
  const Scene scene = scene_with(sphere_mesh(8), unlit({0.3F, 1.5F, 0, 1}));
  for (const Shading shading : {Shading::Flat, Shading::Gouraud, Shading::Phong}) {
    const Frame frame = ZBufferRenderer(scene, shaded(shading)).draw(view_of({}), all_lights());
    for_seen(frame, [&](int x, int y) {
      EXPECT_LE(glm::distance(pixel_at(frame, "color", x, y), glm::dvec4(0.3, 1.5, 0, 1)), 1e-6);
    });
  }
}

TEST(Shading, WithoutLightOnlyWhatTheSurfaceSendsItselfIsSeen) {
  for (const MaterialModel model : {MaterialModel::Phong, MaterialModel::MetalRough}) {
    Material material = phong_material();
    material.model = model;
    material.emissive = {0.5F, 2, 0};
    const Frame frame =
        ZBufferRenderer(scene_with(sphere_mesh(8), material), shaded(Shading::Phong)).draw(view_of({}), {});
    for_seen(frame, [&](int x, int y) {
      EXPECT_LE(glm::distance(pixel_at(frame, "color", x, y), glm::dvec4(0.5, 2, 0, 1)), 1e-6);
    });
  }
}

/// Colours of vertices times the material's, blended as light; bytes are sRGB.
TEST(Shading, VertexColors) {
  Mesh floats = soup_of({{-1.2F, -1, 1.5F}, {1.3F, -0.8F, -3}, {-0.1F, 1.2F, 0}});
  floats.attributes.push_back(attribute_of<glm::vec3>("COLOR_0", {{1, 0, 0.5F}, {0, 1, 0.5F}, {0.2F, 0.3F, 1}}));
  Mesh bytes = soup_of({{-1.2F, -1, 1.5F}, {1.3F, -0.8F, -3}, {-0.1F, 1.2F, 0}});
  bytes.attributes.push_back(
      {"COLOR_0", Domain::Corner, 4, Array<std::uint8_t>{255, 0, 128, 255, 0, 200, 128, 255, 50, 77, 255, 255}});
  const glm::dvec3 colors[2][3] = {{{1, 0, 0.5}, {0, 1, 0.5}, {0.2, 0.3, 1}},
                                   {{255, 0, 128}, {0, 200, 128}, {50, 77, 255}}};
  const glm::dvec3 factor(0.5, 0.6, 0.7);
  for (int b = 0; b < 2; ++b) {
    const Scene scene = scene_with((b == 0 ? floats : bytes).clone(), unlit({0.5F, 0.6F, 0.7F, 1}));
    const View view = view_of({});
    const RayScene rays(scene, view);
    const Frame frame = ZBufferRenderer(scene, shaded(Shading::Phong, {"color", "albedo"})).draw(view, {});
    const int seen = for_seen(frame, [&](int x, int y) {
      const RayHit hit = rays.meet(rays.triangles()[0], x + 0.5, y + 0.5);
      glm::dvec3 wanted(0);
      for (int k = 0; k < 3; ++k) {
        glm::dvec3 color = colors[b][k];
        for (int c = 0; b == 1 && c < 3; ++c) {
          const double e = color[c] / 255;
          color[c] = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
        }
        wanted += hit.weight[k] * color * factor;
      }
      EXPECT_LE(glm::distance(glm::dvec3(pixel_at(frame, "color", x, y)), wanted), 1e-4) << x << ", " << y;
      EXPECT_LE(glm::distance(glm::dvec3(pixel_at(frame, "albedo", x, y)), wanted), 1e-4) << x << ", " << y;
    });
    EXPECT_GT(seen, 700);
  }
}

}  // namespace
}  // namespace azulejo
