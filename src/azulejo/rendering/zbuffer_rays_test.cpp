// What the z-buffer shows, against rays through the centres of pixels in double precision.

#include <array>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

const std::vector<std::string> kData = {"depth", "position", "normal", "uv", "face_id", "object_id", "material_id"};

float between(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

glm::vec3 direction(std::mt19937& random) {
  for (;;) {
    const glm::vec3 v(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
    const float length = glm::length(v);
    if (length > 0.1F && length < 1) return v / length;
  }
}

/// Triangles around the origin with a normal and a texture coordinate at each corner.
Mesh random_mesh(std::mt19937& random, std::size_t count, float size) {
  std::vector<glm::vec3> corners;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;
  for (std::size_t t = 0; t < count; ++t) {
    const glm::vec3 middle = direction(random) * between(random, 0.2F, 1);
    const glm::vec3 facing = direction(random);
    for (int k = 0; k < 3; ++k) {
      corners.push_back(middle + direction(random) * (size * between(random, 0.3F, 1)));
      normals.push_back(glm::normalize(facing + 0.5F * direction(random)));
      texcoords.emplace_back(between(random, -2, 2), between(random, -2, 2));
    }
  }
  Mesh mesh = soup_of(corners);
  mesh.attributes.push_back(attribute_of("NORMAL", normals));
  mesh.attributes.push_back(attribute_of("TEXCOORD_0", texcoords));
  return mesh;
}

/// Two meshes, four nodes under each other: plain, stretched, mirrored, mirrored twice; one- and two-sided materials.
Scene random_scene(std::mt19937& random, std::size_t count, float size) {
  Scene scene;
  scene.materials = {unlit({1, 0, 0, 1}, true), unlit({0, 1, 0, 1}, false), unlit({0, 0, 1, 1}, true)};
  for (int m = 0; m < 2; ++m) {
    Mesh mesh = random_mesh(random, count, size);
    for (std::size_t f = 0; m == 0 && f < count; ++f) {
      const unsigned material = random() % 4;
      mesh.material.push_back(material == 3 ? MaterialId::kNone : material);
    }
    scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  }
  const glm::vec3 scales[] = {{1, 1, 1}, {0.5F, 1.4F, 0.8F}, {-1, 0.7F, 1.2F}, {-0.8F, 1, 1}};
  for (std::size_t n = 0; n < 4; ++n) {
    Node node;
    node.mesh = MeshId(n % 2);
    const float turn = between(random, 0, 3);
    const glm::vec3 axis = direction(random) * std::sin(turn);
    node.placement = Placement{direction(random) * 0.4F, glm::quat(std::cos(turn), axis.x, axis.y, axis.z), scales[n]};
    scene.nodes.push_back(std::move(node));
  }
  scene.nodes[2].children = {NodeId(3)};
  scene.roots = {NodeId(0), NodeId(1), NodeId(2)};
  return scene;
}

/// A hidden surface, or one between the planes, may show in no pixel that is compared: the number of those that are.
struct Compared {
  int hits = 0;
  int behind = 0;  ///< seen from behind
  int nothing = 0;
  int skipped = 0;
};

/// What layers hold at a hit.
struct Expected {
  double depth = 0;
  glm::dvec3 position{0};
  glm::dvec3 normal{0};
  double normal_length = 0;  ///< of the sum of the corners' normals
  glm::dvec2 uv{0};
};

template <class V>
V blended(const RayHit& hit, const char* name) {
  const Mesh& mesh = *hit.triangle->mesh;
  const Array<float>& values = *mesh.find(name)->get<float>();
  V sum(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex = mesh.corners[std::size_t{3} * hit.triangle->face + k];
    for (int c = 0; c < V::length(); ++c) {
      sum[c] +=
          hit.weight[k] *
          static_cast<double>(values[vertex * static_cast<std::size_t>(V::length()) + static_cast<std::size_t>(c)]);
    }
  }
  return sum;
}

Expected expected(const RayHit& hit, const View& view) {
  Expected result;
  result.position = hit.place;
  result.depth = -(glm::dmat4(view.view_from_world) * glm::dvec4(hit.place, 1)).z;
  const glm::dmat3 linear(glm::dmat4(hit.triangle->world_from_object));
  const glm::dvec3 sum = blended<glm::dvec3>(hit, "NORMAL");
  result.normal = glm::normalize(glm::transpose(glm::inverse(linear)) * sum) * (hit.front ? 1.0 : -1.0);
  result.normal_length = glm::length(sum);
  result.uv = blended<glm::dvec2>(hit, "TEXCOORD_0");
  return result;
}

/// Every pixel's layers. The renderer computes in floats with places in the picture that are right to about 1/4096
/// pixel (24 bits for a size below 4096, and the sums around them): what a value changes over 1/1024 pixel is granted,
/// and 2·10⁻⁵ of the scene's size. Coverage is decided at 1/256 pixel, rounded: edges may move by half of that, those
/// that end at the guard band, where floats are 1/128 pixel apart, by 1/256.
Compared compare(const Scene& scene, const View& view, const Frame& frame) {
  constexpr double kMargin = 1.0 / 128;
  constexpr double kShift = 1.0 / 1024;
  const RayScene rays(scene, view);
  Compared result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto hit = rays.trace(x + 0.5, y + 0.5, kMargin);
      if (!hit) {
        ++result.skipped;
        continue;
      }
      const auto at = [&](const char* layer) { return pixel_at(frame, layer, x, y); };
      const std::string where = " at " + std::to_string(x) + ", " + std::to_string(y);
      if (hit->triangle == nullptr) {
        ++result.nothing;
        EXPECT_EQ(at("face_id").x, 0) << where;
        EXPECT_EQ(at("depth").x, std::numeric_limits<double>::infinity()) << where;
        continue;
      }
      ++result.hits;
      if (!hit->front) ++result.behind;
      EXPECT_EQ(at("face_id").x, hit->triangle->face + 1.0) << where;
      EXPECT_EQ(at("object_id").x, hit->triangle->node + 1.0) << where;
      EXPECT_EQ(at("material_id").x, hit->triangle->material + 1.0) << where;
      const Expected wanted = expected(*hit, view);
      const Expected beside[] = {expected(rays.meet(*hit->triangle, x + 0.5 + kShift, y + 0.5), view),
                                 expected(rays.meet(*hit->triangle, x + 0.5, y + 0.5 + kShift), view)};
      const auto slack = [&](auto change) { return 2e-5 * 4 + change(beside[0]) + change(beside[1]); };
      EXPECT_NEAR(at("depth").x, wanted.depth,
                  slack([&](const Expected& e) { return std::fabs(e.depth - wanted.depth); }))
          << where;
      EXPECT_LE(glm::distance(glm::dvec3(at("position")), wanted.position),
                slack([&](const Expected& e) { return glm::distance(e.position, wanted.position); }))
          << where;
      EXPECT_LE(glm::distance(glm::dvec2(at("uv")), wanted.uv),
                slack([&](const Expected& e) { return glm::distance(e.uv, wanted.uv); }))
          << where;
      if (wanted.normal_length < 0.3) continue;
      EXPECT_LE(glm::distance(glm::dvec3(at("normal")), wanted.normal),
                slack([&](const Expected& e) { return glm::distance(e.normal, wanted.normal); }))
          << where;
    }
  }
  return result;
}

ZBufferOptions data_options() { return {.antialias = 1, .layers = kData}; }

TEST(ZBufferRays, RandomScenesInPerspective) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const Scene scene = random_scene(random, seed % 2 == 0 ? 30 : 90, seed % 2 == 0 ? 0.8F : 0.3F);
    const View view = view_of({.eye = glm::dvec3(direction(random)) * 4.0});
    const Compared compared = compare(scene, view, ZBufferRenderer(scene, data_options()).draw(view, {}));
    EXPECT_GT(compared.hits, 1000);
    EXPECT_GT(compared.behind, 200);
    EXPECT_GT(compared.nothing, 300);
    EXPECT_LT(compared.skipped, 1500);
  }
}

TEST(ZBufferRays, RandomScenesInOrthographicProjection) {
  for (unsigned seed = 10; seed < 13; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const Scene scene = random_scene(random, 40, 0.7F);
    TestView wanted{.eye = glm::dvec3(direction(random)) * 4.0};
    wanted.lens.perspective = false;
    wanted.lens.far = 10;
    const View view = view_of(wanted);
    const Compared compared = compare(scene, view, ZBufferRenderer(scene, data_options()).draw(view, {}));
    EXPECT_GT(compared.hits, 1500);
    EXPECT_GT(compared.nothing, 300);
    EXPECT_LT(compared.skipped, 1500);
  }
}

/// The camera stands among the triangles: many are cut by the near plane, some reach far beyond the picture.
TEST(ZBufferRays, TrianglesThroughTheCamera) {
  for (unsigned seed = 20; seed < 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const Scene scene = random_scene(random, 60, seed % 2 == 0 ? 0.6F : 20);
    TestView wanted{.eye = glm::dvec3(direction(random)) * 0.1};
    wanted.lens.near = 0.01;
    wanted.lens.infinite = seed % 2 == 1;
    const View view = view_of(wanted);
    const Compared compared = compare(scene, view, ZBufferRenderer(scene, data_options()).draw(view, {}));
    EXPECT_GT(compared.hits, 1500);
    EXPECT_LT(compared.skipped, 3000);
  }
}

/// One triangle that covers everything: small beside the guard band, then far beyond it.
TEST(ZBufferRays, OneTriangleOverTheWholePicture) {
  for (const float size : {30.0F, 3000.0F, 3e6F}) {
    SCOPED_TRACE(testing::Message() << "size " << size);
    Mesh mesh = soup_of({{-size, -size, 0}, {size, -size, 0}, {0, 2 * size, 0}});
    // Tilted.
    for (glm::vec3& p : mesh.positions) p.z = 0.25F * p.x * (3 / size) + 0.1F * p.y * (3 / size) - 1;
    mesh.attributes.push_back(attribute_of<glm::vec3>("NORMAL", {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
    mesh.attributes.push_back(attribute_of<glm::vec2>("TEXCOORD_0", {{0, 0}, {9, 0}, {0, 9}}));
    const Scene scene = scene_of(std::move(mesh));
    const View view = view_of({});
    const Compared compared = compare(scene, view, ZBufferRenderer(scene, data_options()).draw(view, {}));
    EXPECT_EQ(compared.hits, view.width * view.height);
  }
}

/// A floor to the horizon: w from the near plane to far away on one triangle.
TEST(ZBufferRays, AFloorToTheHorizon) {
  Mesh mesh = soup_of({{-900, -1, 500}, {900, -1, 500}, {0, -1, -900}});
  mesh.attributes.push_back(attribute_of<glm::vec3>("NORMAL", {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}));
  mesh.attributes.push_back(attribute_of<glm::vec2>("TEXCOORD_0", {{-9, 5}, {9, 5}, {0, -9}}));
  const Scene scene = scene_of(std::move(mesh));
  TestView wanted;
  wanted.lens.infinite = true;
  wanted.lens.near = 0.1;
  const View view = view_of(wanted);
  const Compared compared = compare(scene, view, ZBufferRenderer(scene, data_options()).draw(view, {}));
  EXPECT_GT(compared.hits, view.width * view.height / 3);
  EXPECT_GT(compared.nothing, view.width * view.height / 3);
}

/// The viewport and the window move and scale the picture, nothing else.
TEST(ZBufferRays, ViewportsAndWindows) {
  std::mt19937 random(30);
  const Scene scene = random_scene(random, 40, 0.6F);
  TestView wanted{.width = 110, .height = 90, .viewport = {13, 7, 70, 60}};
  wanted.lens.window = {-0.3F, -0.5F, 0.9F, 0.7F};
  const View view = view_of(wanted);
  const Frame frame = ZBufferRenderer(scene, data_options()).draw(view, {});
  View inside = view;
  // Beyond the viewport nothing is drawn; in it everything as rays say.
  const auto faces = frame.find("face_id")->view<float>();
  int drawn = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const bool within = x >= 13 && x < 83 && y >= 7 && y < 67;
      EXPECT_TRUE(within || faces(x, y, 0) == 0) << x << ", " << y;
      if (within && faces(x, y, 0) > 0) ++drawn;
    }
  }
  EXPECT_GT(drawn, 1000);
  // The same viewport in the corner of a picture of its own: the same pixels, compared with rays.
  inside.width = 70;
  inside.height = 60;
  inside.viewport = {0, 0, 70, 60};
  const Frame own = ZBufferRenderer(scene, data_options()).draw(inside, {});
  const Compared compared = compare(scene, inside, own);
  EXPECT_GT(compared.hits, 1000);
  const auto own_faces = own.find("face_id")->view<float>();
  int other = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 70; ++x) other += faces(x + 13, y + 7, 0) != own_faces(x, y, 0) ? 1 : 0;
  }
  EXPECT_LE(other, 2) << "rounding of positions to 1/256 pixel may differ by one";
}

}  // namespace
}  // namespace azulejo
