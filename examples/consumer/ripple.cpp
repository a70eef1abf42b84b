// A programmable pipeline: a flat grid becomes a ripple in the vertex function, height lines in the fragment function.
//   ripple PICTURE.png
#include <azulejo/data/scene.h>
#include <azulejo/io/image_io.h>
#include <azulejo/rendering/camera_choice.h>
#include <azulejo/rendering/lighting.h>
#include <azulejo/rendering/zbuffer.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <utility>

namespace {

/// n × n squares over [-1, 1]².
azulejo::Mesh grid(int n) {
  azulejo::Mesh mesh;
  for (int z = 0; z <= n; ++z) {
    for (int x = 0; x <= n; ++x) {
      mesh.positions.emplace_back(2.0F * static_cast<float>(x) / static_cast<float>(n) - 1, 0,
                                  2.0F * static_cast<float>(z) / static_cast<float>(n) - 1);
    }
  }
  const auto vertex = [n](int x, int z) { return static_cast<std::uint32_t>(z * (n + 1) + x); };
  for (int z = 0; z < n; ++z) {
    for (int x = 0; x < n; ++x) {
      mesh.corners.insert(mesh.corners.end(), {vertex(x, z), vertex(x, z + 1), vertex(x + 1, z + 1)});
      mesh.corners.insert(mesh.corners.end(), {vertex(x, z), vertex(x + 1, z + 1), vertex(x + 1, z)});
    }
  }
  return mesh;
}

float height_at(float distance) { return 0.18F * std::cos(12 * distance) * std::exp(-1.5F * distance); }

/// Lifts every vertex, and hands on the height and its slope away from the middle.
void lift(const azulejo::VertexBatch& batch) {
  for (std::size_t i = 0; i < batch.positions.size(); ++i) {
    const glm::vec3 flat = batch.positions[i];
    const float distance = std::sqrt(flat.x * flat.x + flat.z * flat.z);
    const float height = height_at(distance);
    batch.clip[i] = batch.clip_from_world * batch.world_from_object * glm::vec4(flat.x, height, flat.z, 1);
    batch.varyings[2 * i] = height;
    batch.varyings[2 * i + 1] = (height_at(distance + 0.001F) - height) / 0.001F;
  }
}

/// Blue in the hollows, white on the crests, a line every 0.03; lit by its own slope.
void paint(const azulejo::FragmentView& view) {
  for (std::size_t i = 0; i < view.count; ++i) {
    const float height = view.varyings[0][i];
    const float slope = view.varyings[1][i];
    const glm::vec3 place(view.position[0][i], 0, view.position[2][i]);
    const float distance = glm::length(place) + 1e-6F;
    const glm::vec3 normal = glm::normalize(glm::vec3(-slope * place.x / distance, 1, -slope * place.z / distance));
    const float light = 0.25F + 0.75F * std::fmax(0.0F, glm::dot(normal, glm::normalize(glm::vec3(-0.4F, 0.7F, 0.5F))));
    const float t = 0.5F + height / 0.36F;
    const float steps = height / 0.03F;
    const float line = std::fabs(steps - std::nearbyint(steps)) < 0.06F ? 0.35F : 1.0F;
    view.color[0][i] = light * line * (0.02F + 0.9F * t * t);
    view.color[1][i] = light * line * (0.10F + 0.85F * t);
    view.color[2][i] = light * line * (0.45F + 0.5F * t);
  }
}

}  // namespace

int main(int count, char** words) {
  const azulejo::Scene scene = azulejo::scene_of(grid(200));
  azulejo::CameraOptions camera;
  camera.elevation_deg = 40.0F;
  const azulejo::View view = azulejo::choose_camera(scene, camera, 640, 480).view;

  azulejo::ZBufferOptions options;
  options.program.varyings = 2;
  options.program.vertex = lift;
  options.program.fragment = paint;
  const azulejo::ZBufferRenderer renderer(scene, options);
  const azulejo::Frame frame = renderer.draw(view, {});
  const azulejo::Image& picture = *frame.find("color");
  if (count > 1) azulejo::write_image(picture, words[1]);

  // The middle of the picture is water; a corner is background.
  const azulejo::ImageView<const std::uint8_t> pixels = picture.view<std::uint8_t>();
  const bool right = pixels(320, 240, 3) == 255 && pixels(320, 240, 2) > pixels(320, 240, 0) && pixels(0, 0, 3) == 0;
  std::printf("a ripple of %zu triangles: %s\n", scene.meshes[0]->face_count(), right ? "drawn" : "wrong");
  return right ? 0 : 1;
}
