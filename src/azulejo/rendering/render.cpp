#include "azulejo/rendering/render.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/modelling/animate.h"
#include "azulejo/modelling/pose.h"
#include "azulejo/rendering/camera_json.h"
#include "azulejo/rendering/picture_onto.h"
#include "azulejo/rendering/viewing_stages.h"

namespace azulejo {
namespace {

constexpr float kRadians = 0.0174532925F;

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

std::size_t find_animation(const Scene& scene, const std::string& wanted) {
  const std::vector<Animation>& animations = scene.animations;
  if (wanted.empty() && !animations.empty()) return 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    if (animations[i].name == wanted) return i;
    if (!animations[i].name.empty()) names.push_back(animations[i].name);
  }
  std::size_t number = 0;
  const auto [end, failure] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (failure == std::errc() && end == wanted.data() + wanted.size() && number < animations.size()) return number;
  if (animations.empty()) throw Error(Error::Argument, "animation: the scene has none");
  names.resize(std::min<std::size_t>(names.size(), 20));
  throw Error(Error::Argument,
              fmt::format("animation: \"{}\"{}; expected a number below {}{}{}", wanted, did_you_mean(wanted, names),
                          animations.size(), names.empty() ? "" : " or one of ", fmt::join(names, ", ")));
}

ZBufferOptions zbuffer_options(const RenderOptions& options, float exposure) {
  ZBufferOptions zbuffer;
  zbuffer.shading = options.shading;
  zbuffer.antialias = options.antialias;
  zbuffer.background = to_linear(options.background);
  zbuffer.exposure = exposure * std::exp2(options.exposure);
  zbuffer.output = options.output.value_or(FrameOutput::Display8);
  zbuffer.layers.clear();
  // The color comes first wherever it was named.
  const bool color = std::ranges::find(options.layers, FrameLayer::Color) != options.layers.end();
  if (color) zbuffer.layers.emplace_back(enum_names(FrameLayer{})[0]);
  for (const FrameLayer layer : options.layers) {
    const std::string name(enum_names(FrameLayer{})[static_cast<std::size_t>(layer)]);
    if (layer != FrameLayer::Color) zbuffer.layers.push_back(name);
  }
  zbuffer.crease_angle = options.crease_angle_deg * kRadians;
  zbuffer.polygon_mode = options.polygon_mode;
  zbuffer.line_width = options.line_width;
  zbuffer.point_size = options.point_size;
  return zbuffer;
}

}  // namespace

float animation_duration(const Scene& scene, const std::string& animation) {
  if (scene.animations.empty() && animation.empty()) return 0;
  float end = 0;
  for (const AnimationChannel& channel : scene.animations[find_animation(scene, animation)].channels) {
    if (!channel.times.empty() && std::isfinite(channel.times.back())) end = std::max(end, channel.times.back());
  }
  return end;
}

std::optional<Scene> posed_scene(const Scene& scene, const std::string& animation, std::optional<float> time_s,
                                 const Run& run) {
  std::optional<Scene> moved;
  if (time_s || !animation.empty()) {
    moved = animate(scene, find_animation(scene, animation), time_s.value_or(0.0F));
  }
  const Scene& now = moved ? *moved : scene;
  if (needs_pose(now)) return pose(now, run);
  return moved;
}

SceneRenderer::SceneRenderer(const Scene& scene, const RenderOptions& options, const Run& run)
    : scene_(scene), options_(options) {
  const auto begin = std::chrono::steady_clock::now();
  posed_ = posed_scene(scene, options.animation, options.time_s, run);
  // What the lights' exposure is doesn't depend on the view.
  const float exposure = choose_lighting(this->scene(), View{}, options.lighting).exposure;
  renderer_.emplace(this->scene(), zbuffer_options(options, exposure), run);
  prepare_ms_ = milliseconds_since(begin);
}

Frame SceneRenderer::draw(const CameraOptions& camera, const Image* under, const Run& run,
                          RenderStatistics* statistics) const {
  const auto begin = std::chrono::steady_clock::now();
  const ChosenCamera chosen = choose_camera(scene(), camera, options_.width, options_.height, run);
  const ChosenLighting lighting = choose_lighting(scene(), chosen.view, options_.lighting, run);
  report_viewing(this->scene(), chosen.view, "render", run);
  RenderStatistics own;
  Frame frame = renderer_->draw(chosen.view, lighting.lighting, run, &own.faces);
  if (under != nullptr) {
    Image& color = frame.layers[0].image;
    color = picture_onto(*under, color, chosen.view.viewport, run);
  }
  frame.camera = camera_json(chosen.view, scene().space);
  if (statistics != nullptr) {
    own.lights = lighting.lights;
    own.exposure = lighting.exposure * std::exp2(options_.exposure);
    own.camera = chosen.name;
    own.prepare_ms = prepare_ms_;
    own.draw_ms = milliseconds_since(begin);
    *statistics = own;
  }
  return frame;
}

Frame SceneRenderer::draw(const CameraOptions& camera, const Run& run, RenderStatistics* statistics) const {
  return draw(camera, nullptr, run, statistics);
}

Frame SceneRenderer::draw_onto(const Image& under, const CameraOptions& camera, const Run& run,
                               RenderStatistics* statistics) const {
  return draw(camera, &under, run, statistics);
}

RenderOptions options_onto(const Image& under, const RenderOptions& options) {
  if (std::ranges::find(options.layers, FrameLayer::Color) == options.layers.end()) {
    throw Error(Error::Argument, "onto: the layers are without color, expected it among them");
  }
  RenderOptions onto = options;
  onto.width = under.width();
  onto.height = under.height();
  if (under.info().color == ColorState::Linear && !onto.output) onto.output = FrameOutput::Linear;
  return onto;
}

Frame render(const Scene& scene, const RenderOptions& options, const Run& run, RenderStatistics* statistics) {
  return SceneRenderer(scene, options, run).draw(options.camera, run, statistics);
}

}  // namespace azulejo
