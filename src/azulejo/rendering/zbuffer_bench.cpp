// The z-buffer renderer beside Mesa's llvmpipe: the same triangles, normals, camera, material and lights, culling,
// 8-bit colour and float depth, Phong in each pixel. Ours encodes its colours as sRGB, which the peer is spared.
#include "azulejo/rendering/zbuffer.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/rendering/camera_choice.h"
#include "azulejo/rendering/wireframe.h"
#include "bench/llvmpipe.h"
#include "bench/models.h"

namespace azulejo::bench {
namespace {

constexpr Size k4K{3840, 2160};

Material shiny() {
  Material material;
  material.model = MaterialModel::Phong;
  material.base_color = {0.8F, 0.8F, 0.8F, 1};
  material.specular = {0.3F, 0.3F, 0.3F};
  material.shininess = 32;
  return material;
}

/// A key, a fill and a rim light that come with the camera, and a little light from everywhere.
Lighting lighting_of(const View& view) {
  const glm::mat3 world_from_view = glm::transpose(glm::mat3(view.view_from_world));
  const auto light = [&](const glm::vec3& toward, float amount) {
    return ShadingLight{.direction = -(world_from_view * glm::normalize(toward)), .color = glm::vec3(amount)};
  };
  Lighting lighting;
  lighting.lights = {light({-0.5F, 0.7F, 0.6F}, 0.7F), light({0.8F, 0.1F, 0.5F}, 0.2F), light({0, 0.4F, -1}, 0.2F)};
  lighting.sky = lighting.ground = glm::vec3(0.1F);
  return lighting;
}

/// A mesh under a camera, ready for both.
struct Stage {
  Scene scene;
  View view;
  Lighting lighting;

  Stage(Mesh mesh, Size size) {
    mesh.attributes.clear();
    mesh.attributes.push_back(vertex_normals(mesh));
    // Vertices without faces have no normal; one that is 0 would have ours make all of them anew, split at creases.
    auto& normals = std::get<Array<float>>(mesh.attributes[0].values);
    for (std::size_t i = 0; i < normals.size(); i += 3) {
      if (normals[i] == 0 && normals[i + 1] == 0 && normals[i + 2] == 0) normals[i + 2] = 1;
    }
    scene = scene_of(std::move(mesh));
    Mesh painted = scene.meshes[0]->clone();
    painted.material.assign(painted.face_count(), 0);
    scene.meshes[0] = std::make_shared<const Mesh>(std::move(painted));
    scene.materials = {shiny()};
    view = choose_camera(scene, {}, size.width, size.height).view;
    lighting = lighting_of(view);
  }

  const Mesh& mesh() const { return *scene.meshes[0]; }
};

LlvmpipeShading shading_of(const Stage& stage) {
  const Material& material = stage.scene.materials[0];
  LlvmpipeShading shading{.ambient = stage.lighting.sky,
                          .diffuse = glm::vec3(material.base_color),
                          .specular = material.specular,
                          .shininess = material.shininess,
                          .lights = {}};
  for (const ShadingLight& light : stage.lighting.lights) shading.lights.push_back({-light.direction, light.color});
  return shading;
}

/// llvmpipe with one thread and with two, ready to draw.
class Peers {
 public:
  Peers(const Stage& stage, int samples, bool lines = false) {
    const auto& normals = *stage.mesh().find("NORMAL")->get<float>();
    for (Llvmpipe& peer : peers_) {
      peer.load({.positions = stage.mesh().positions,
                 .normals = {reinterpret_cast<const glm::vec3*>(normals.data()), normals.size() / 3},
                 .corners = stage.mesh().corners});
      peer.resize({stage.view.width, stage.view.height, samples, lines});
      peer.shade(shading_of(stage));
    }
    clip_from_world_ = stage.view.clip_from_world();
    eye_ = glm::vec3(glm::inverse(stage.view.view_from_world)[3]);
  }

  void draw(int threads) {
    last_ = &peers_[threads == 1 ? 0 : 1];
    last_->render(clip_from_world_, eye_);
  }
  /// The picture that was drawn last.
  void read(std::span<std::byte> rgba) { last_->read(rgba); }

 private:
  std::array<Llvmpipe, 2> peers_{Llvmpipe(1), Llvmpipe(2)};
  Llvmpipe* last_ = nullptr;
  glm::mat4 clip_from_world_{1.0F};
  glm::vec3 eye_{0, 0, 0};
};

std::uint8_t encoded(std::uint8_t linear) {
  const double value = linear / 255.0;
  const double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(srgb * 255 + 0.5);
}

/// Right if the pictures differ visibly in few pixels: where an edge passes a sample, and where two surfaces are at the
/// same depth, each decides for itself.
Check same_picture(const Image& ours, Peers& peer) {
  const ImageView<const std::uint8_t> view = ours.view<std::uint8_t>();
  std::vector<std::byte> rgba(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height) * 4);
  peer.read(rgba);
  std::array<std::uint8_t, 256> srgb{};
  for (std::size_t i = 0; i < srgb.size(); ++i) srgb[i] = encoded(static_cast<std::uint8_t>(i));
  constexpr int kVisible = 6;  // rounding before encoding moves a value by up to 2 where ambient light is all there is
  std::int64_t covered = 0;
  std::int64_t different = 0;
  for (int y = 0; y < view.height; ++y) {
    const std::byte* const row = rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) * 4;
    for (int x = 0; x < view.width; ++x) {
      const std::uint8_t* const a = view.row(y) + 4 * x;
      const std::byte* const b = row + 4 * x;
      if (a[3] == 0 && b[3] == std::byte{0}) continue;
      ++covered;
      if (a[3] < 255 && b[3] != std::byte{0} && b[3] != std::byte{255}) continue;  // an edge, resolved in another light
      const int peer_red = srgb[static_cast<std::uint8_t>(b[0])];
      different += a[3] != static_cast<std::uint8_t>(b[3]) || std::abs(a[0] - peer_red) > kVisible ? 1 : 0;
    }
  }
  const double part = covered > 0 ? static_cast<double>(different) / static_cast<double>(covered) : 1;
  return {part <= 0.005, std::to_string(part * 100) + " % of the covered pixels"};
}

/// Right if nearly every pixel that one covers has one beside it that the other covers: their lines have other ends,
/// and other sides where they pass a pixel's corner.
Check same_lines(const Image& ours, Peers& peer) {
  const ImageView<const std::uint8_t> view = ours.view<std::uint8_t>();
  const auto width = static_cast<std::size_t>(view.width);
  std::vector<std::byte> rgba(width * static_cast<std::size_t>(view.height) * 4);
  peer.read(rgba);
  const auto covered = [&](bool mine, int x, int y) {
    if (x < 0 || y < 0 || x >= view.width || y >= view.height) return false;
    return mine ? view(x, y, 3) > 0
                : rgba[(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) * 4 + 3] != std::byte{0};
  };
  std::int64_t all = 0;
  std::int64_t alone = 0;
  for (const bool mine : {true, false}) {
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        if (!covered(mine, x, y)) continue;
        ++all;
        bool near = false;
        for (int i = 0; i < 9 && !near; ++i) near = covered(!mine, x + i % 3 - 1, y + i / 3 - 1);
        alone += near ? 0 : 1;
      }
    }
  }
  const double part = all > 0 ? static_cast<double>(alone) / static_cast<double>(all) : 1;
  return {part <= 0.01, std::to_string(part * 100) + " % of the covered pixels alone"};
}

struct RenderRow {
  std::string name;
  std::function<Mesh()> mesh;
  Size size = kFullHd;
  int samples = 1;
  double aim = 10;
};

Row render_row(const RenderRow& what) {
  const auto stage = std::make_shared<Stage>(what.mesh(), what.size);
  const auto renderer = std::make_shared<ZBufferRenderer>(stage->scene, ZBufferOptions{.antialias = what.samples});
  const auto frame = std::make_shared<Frame>(renderer->draw(stage->view, stage->lighting));
  const auto peers = std::make_shared<Peers>(*stage, what.samples);

  Row row;
  row.work = static_cast<double>(stage->mesh().triangle_count());
  row.unit = "Mtri/s";
  row.ours = [=](int threads) { renderer->draw_into(*frame, stage->view, stage->lighting, Run{.threads = threads}); };
  row.peer_name = "llvmpipe";
  row.peer = [=](int threads) { peers->draw(threads); };
  row.check = [=] { return same_picture(frame->layers[0].image, *peers); };
  row.aim = what.aim;
  return row;
}

/// Four samples beside one: at most twice the time.
Row samples_row(const RenderRow& what) {
  Row row = render_row(what);
  const auto stage = std::make_shared<Stage>(what.mesh(), what.size);
  const auto renderer = std::make_shared<ZBufferRenderer>(stage->scene, ZBufferOptions{.antialias = 1});
  const auto frame = std::make_shared<Frame>(renderer->draw(stage->view, stage->lighting));
  row.peer_name = "1 sample";
  row.peer = [=](int threads) { renderer->draw_into(*frame, stage->view, stage->lighting, Run{.threads = threads}); };
  row.check = {};
  row.aim = 0.5;
  return row;
}

/// The edges of all faces, one pixel wide, with depth.
Row edges_row(const RenderRow& what) {
  const auto stage = std::make_shared<Stage>(what.mesh(), what.size);
  const ZBufferOptions options{.antialias = 1, .polygon_mode = PolygonMode::Edges, .line_width = 1};
  const auto renderer = std::make_shared<ZBufferRenderer>(stage->scene, options);
  const auto frame = std::make_shared<Frame>(renderer->draw(stage->view, stage->lighting));
  const auto peers = std::make_shared<Peers>(*stage, 1, true);
  ZBufferStatistics statistics;
  renderer->draw(stage->view, stage->lighting, {}, &statistics);
  Row row;
  row.work = static_cast<double>(statistics.faces_in);
  row.unit = "Medge/s";
  row.ours = [=](int threads) { renderer->draw_into(*frame, stage->view, stage->lighting, Run{.threads = threads}); };
  row.peer_name = "llvmpipe, GL_LINE";
  row.peer = [=](int threads) { peers->draw(threads); };
  row.check = [=] { return same_lines(frame->layers[0].image, *peers); };
  row.aim = what.aim;
  return row;
}

/// From the mesh to a drawing of its edges, beside a picture of them.
Row wireframe_row(const RenderRow& what) {
  const auto stage = std::make_shared<Stage>(what.mesh(), what.size);
  const auto peers = std::make_shared<Peers>(*stage, 1, true);
  WireframeOptions options;
  options.width = what.size.width;
  options.height = what.size.height;
  Row row;
  row.work = 1.5 * static_cast<double>(stage->mesh().triangle_count());
  row.unit = "Medge/s";
  row.ours = [=](int threads) { wireframe(stage->scene, options, Run{.threads = threads}); };
  row.peer_name = "llvmpipe, GL_LINE";
  row.peer = [=](int threads) { peers->draw(threads); };
  row.aim = what.aim;
  return row;
}

void add_lines(Bench& bench, const RenderRow& what) {
  const std::string size = std::to_string(what.size.width) + "×" + std::to_string(what.size.height);
  bench.row("render edges of " + what.name + ", " + size, [what] { return edges_row(what); });
  bench.row("wireframe of " + what.name + ", " + size, [what] { return wireframe_row(what); });
}

void add(Bench& bench, const RenderRow& what) {
  const std::string size = std::to_string(what.size.width) + "×" + std::to_string(what.size.height);
  const std::string name = "render " + what.name + ", " + size;
  if (what.samples == 1) return bench.row(name, [what] { return render_row(what); });
  bench.row(name + ", 4 samples", [what] { return render_row(what); });
  bench.row(name + ", 4 samples beside one", [what] { return samples_row(what); });
}

void add_shared(Bench& bench, RenderRow what, const std::string& path, void (*add_rows)(Bench&, const RenderRow&)) {
  const std::optional<std::string> file = shared_model(path);
  if (!file) return;
  what.mesh = [file] { return std::get<Mesh>(read_model(*file)); };
  add_rows(bench, what);
}

const Rows kRows([](Bench& bench) {
  const std::string dragon = "meshes/scans/stanford_dragon_full.ply.gz";
  const std::string bunny = "meshes/scans/stanford_bunny_zippered.ply";
  const std::string dragon_name = "Stanford dragon (871,414 triangles)";
  const std::string bunny_name = "Stanford bunny (69,451 triangles)";
  for (const int samples : {1, 4}) {
    add_shared(bench, {.name = dragon_name, .mesh = {}, .samples = samples, .aim = 10}, dragon, add);
    add_shared(bench, {.name = bunny_name, .mesh = {}, .samples = samples, .aim = 8}, bunny, add);
    add_shared(bench, {.name = bunny_name, .mesh = {}, .size = k4K, .samples = samples, .aim = 8}, bunny, add);
  }
  add_shared(bench, {.name = dragon_name, .mesh = {}, .aim = 2}, dragon, add_lines);
  add_shared(bench, {.name = bunny_name, .mesh = {}, .aim = 2}, bunny, add_lines);
  for (const auto& [text, triangles] : {std::pair("10⁴", 10'000U), std::pair("10⁵", 100'000U),
                                        std::pair("10⁶", 1'000'000U), std::pair("10⁷", 10'000'000U)}) {
    const std::size_t count = triangles;
    add(bench, {.name = std::string("a sphere of ") + text + " triangles", .mesh = [count] { return sphere(count); }});
  }
});

}  // namespace
}  // namespace azulejo::bench
