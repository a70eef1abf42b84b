// User code in place of the vertex and the fragment stage.

#include "azulejo/rendering/program.h"

#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

/// A textured triangle under two nodes, one of them mirrored.
Scene two_triangles() {
  Mesh mesh = soup_of({{-1.2F, -1, 1.5F}, {1.3F, -0.8F, -3}, {-0.1F, 1.2F, 0}});
  mesh.attributes.push_back(attribute_of<glm::vec2>("TEXCOORD_0", {{0, 0}, {3, 1}, {-1, 2}}));
  mesh.attributes.push_back(attribute_of<glm::vec3>("NORMAL", {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
  Scene scene = scene_with(std::move(mesh), unlit({0.5F, 0.25F, 0.125F, 1}));
  scene.nodes.push_back(scene.nodes[0]);
  scene.nodes[1].placement = Placement{{0.6F, 0.2F, -1}, {1, 0, 0, 0}, {-1, 1, 1}};
  scene.roots.emplace_back(1);
  return scene;
}

/// A floor that passes under the camera, to the horizon.
Scene floor_scene() {
  return scene_with(soup_of({{-900, -1, 500}, {900, -1, 500}, {0, -1, -900}}), unlit({1, 1, 1, 1}));
}

View horizon_view() {
  TestView wanted;
  wanted.lens.infinite = true;
  wanted.lens.near = 0.1;
  return view_of(wanted);
}

ZBufferOptions programmed(Program program) {
  ZBufferOptions options{.antialias = 1, .output = FrameOutput::Linear};
  options.layers = {"color", "face_id", "position"};
  options.program = std::move(program);
  return options;
}

/// Moves every vertex by `shift` in the mesh's space.
Program moving(const glm::vec3& shift) {
  Program program;
  program.vertex = [shift](const VertexBatch& batch) {
    const glm::mat4 clip_from_object = batch.clip_from_world * batch.world_from_object;
    for (std::size_t i = 0; i < batch.positions.size(); ++i) {
      batch.clip[i] = clip_from_object * glm::vec4(batch.positions[i] + shift, 1);
    }
  };
  return program;
}

/// Pixels where two layers differ by more than 10⁻⁴.
int differences(const Frame& a, const Frame& b, const char* layer, int& seen) {
  int count = 0;
  for (int y = 0; y < a.find(layer)->height(); ++y) {
    for (int x = 0; x < a.find(layer)->width(); ++x) {
      const glm::dvec4 one = pixel_at(a, layer, x, y);
      seen += glm::length(one) > 0 ? 1 : 0;
      count += glm::distance(one, pixel_at(b, layer, x, y)) > 1e-4 * (1 + glm::length(one)) ? 1 : 0;
    }
  }
  return count;
}

TEST(Program, AVertexFunctionDisplaces) {
  const glm::vec3 shift(0.3F, -0.2F, 0.4F);
  for (const bool clipped : {false, true}) {
    const Scene scene = clipped ? floor_scene() : two_triangles();
    Scene moved = scene.clone();
    Mesh mesh = moved.meshes[0]->clone();
    for (glm::vec3& p : mesh.positions) p += shift;
    moved.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
    const View view = clipped ? horizon_view() : view_of({});
    const Frame frame = ZBufferRenderer(scene, programmed(moving(shift))).draw(view, {});
    const Frame wanted = ZBufferRenderer(moved, programmed({})).draw(view, {});
    for (const char* layer : {"color", "face_id", "position"}) {
      int seen = 0;
      // Another order of roundings: an edge's pixel may change.
      EXPECT_LE(differences(frame, wanted, layer, seen), 3) << layer;
      EXPECT_GT(seen, 1000);
    }
    const Frame plain = ZBufferRenderer(scene, programmed({})).draw(view, {});
    int seen = 0;
    EXPECT_GT(differences(frame, plain, "position", seen), 1000);
  }
}

/// What comes in as clip coordinates is what the fixed pipeline computes: the same bytes.
TEST(Program, AVertexFunctionThatDoesNothingChangesNothing) {
  Program idle;
  idle.vertex = [](const VertexBatch&) {};
  for (const bool clipped : {false, true}) {
    const Scene scene = clipped ? floor_scene() : two_triangles();
    const View view = clipped ? horizon_view() : view_of({});
    EXPECT_TRUE(same_pixels(ZBufferRenderer(scene, programmed(idle)).draw(view, {}),
                            ZBufferRenderer(scene, programmed({})).draw(view, {})));
  }
}

TEST(Program, EveryVertexIsGivenOnceForEachInstance) {
  Scene scene = scene_of(sphere_mesh(40));  // more than a batch
  scene.nodes.push_back(scene.nodes[0]);
  scene.roots.emplace_back(1);
  const std::size_t vertices = scene.meshes[0]->vertex_count();
  std::vector<std::atomic<int>> calls(2 * vertices);
  Program program;
  program.vertex = [&](const VertexBatch& batch) {
    for (std::size_t i = 0; i < batch.positions.size(); ++i) {
      const std::size_t vertex = batch.first_vertex + i;
      if (batch.positions[i] == scene.meshes[0]->positions[vertex]) ++calls[batch.object * vertices + vertex];
    }
    EXPECT_EQ(batch.normals.size(), batch.positions.size());
    EXPECT_EQ(batch.clip.size(), batch.positions.size());
    EXPECT_TRUE(batch.texcoords.empty());
  };
  ZBufferRenderer(scene, programmed(program)).draw(view_of({}), {});
  for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
}

/// Places as varyings: they are linear in the world, so the ray says what each pixel must get.
TEST(Program, VaryingsAreRightInPerspective) {
  Program program;
  program.varyings = 4;
  program.vertex = [](const VertexBatch& batch) {
    for (std::size_t i = 0; i < batch.positions.size(); ++i) {
      const glm::vec4 place = batch.world_from_object * glm::vec4(batch.positions[i], 1);
      for (int c = 0; c < 3; ++c) batch.varyings[i * 4 + static_cast<std::size_t>(c)] = place[c];
      batch.varyings[i * 4 + 3] = static_cast<float>(batch.object);
    }
  };
  program.fragment = [](const FragmentView& view) {
    for (std::size_t i = 0; i < view.count; ++i) {
      for (std::size_t c = 0; c < 3; ++c) view.color[c][i] = view.varyings[c][i];
      if (std::fabs(view.varyings[3][i] - static_cast<float>(view.object)) > 1e-4F) view.color[0][i] = -1e9F;
    }
  };
  for (const bool clipped : {false, true}) {
    const Scene scene = clipped ? floor_scene() : two_triangles();
    const View view = clipped ? horizon_view() : view_of({});
    const RayScene rays(scene, view);
    const Frame frame = ZBufferRenderer(scene, programmed(program)).draw(view, {});
    int compared = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const auto hit = rays.trace(x + 0.5, y + 0.5, 1.0 / 128);
        if (!hit || hit->triangle == nullptr) continue;
        ++compared;
        // As in the tests with rays: what 1/1024 pixel changes, and the sum of corners of up to 900 in 24 bits.
        const double slack =
            2e-4 + 3 * glm::distance(rays.meet(*hit->triangle, x + 0.5, y + 0.5 + 1.0 / 1024).place, hit->place);
        EXPECT_LE(glm::distance(glm::dvec3(pixel_at(frame, "color", x, y)), hit->place), slack) << x << ", " << y;
      }
    }
    EXPECT_GT(compared, 1500);
  }
}

TEST(Program, TheFragmentFunctionGetsWhatTheLayersHoldAndItsColorArrives) {
  Program program;
  program.fragment = [](const FragmentView& view) {
    for (std::size_t i = 0; i < view.count; ++i) {
      // The material's colour comes in; everything else is mixed into what goes out.
      const bool base = view.color[0][i] == 0.5F && view.color[1][i] == 0.25F && view.color[3][i] == 1;
      view.color[0][i] = base ? view.x[i] + 1000 * view.y[i] : -1;
      view.color[1][i] =
          view.position[0][i] + 10 * view.normal[2][i] + 100 * static_cast<float>(view.face[i] + view.object);
      view.color[2][i] = view.texcoord[0][i] + 100 * view.texcoord[1][i] + 1000 * static_cast<float>(view.material);
    }
  };
  ZBufferOptions options = programmed(program);
  options.layers = {"color", "position", "normal", "uv", "object_id", "face_id"};
  const View view = view_of({});
  const Frame frame = ZBufferRenderer(two_triangles(), options).draw(view, {});
  int seen = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const glm::dvec4 color = pixel_at(frame, "color", x, y);
      if (color.w == 0) continue;
      ++seen;
      EXPECT_NEAR(color.x, x + 0.5 + 1000 * (y + 0.5), 0.01);
      const double numbers = pixel_at(frame, "object_id", x, y).x - 1 + pixel_at(frame, "face_id", x, y).x - 1;
      EXPECT_NEAR(color.y, pixel_at(frame, "position", x, y).x + 10 * pixel_at(frame, "normal", x, y).z + 100 * numbers,
                  1e-3);
      const glm::dvec4 uv = pixel_at(frame, "uv", x, y);
      EXPECT_NEAR(color.z, uv.x + 100 * uv.y, 1e-3);
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(Program, AFragmentFunctionsOpacityBlends) {
  Scene scene = scene_with(square_mesh(9), unlit({1, 1, 1, 1}));
  scene.materials[0].alpha_mode = AlphaMode::Blend;
  Program program;
  program.fragment = [](const FragmentView& view) {
    for (std::size_t i = 0; i < view.count; ++i) {
      view.color[0][i] = 2;
      view.color[3][i] = 0.25F;
    }
  };
  ZBufferOptions options = programmed(program);
  options.background = {0, 0, 1, 1};
  const Frame frame = ZBufferRenderer(scene, options).draw(view_of({}), {});
  EXPECT_LE(glm::distance(pixel_at(frame, "color", 40, 40), glm::dvec4(0.5, 0.25, 1, 1)), 1e-6);
}

}  // namespace
}  // namespace azulejo
