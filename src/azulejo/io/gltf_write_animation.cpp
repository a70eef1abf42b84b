#include <array>

#include <fmt/format.h>

#include "azulejo/io/gltf_output.h"

namespace azulejo {
namespace {

GltfObject skin_object(GltfOutput& output, const Skin& skin) {
  GltfObject result;
  if (!skin.name.empty()) result["name"] = skin.name;
  GltfObject joints = GltfObject::array();
  for (const NodeId joint : skin.joints) joints.push_back(joint.index);
  result["joints"] = std::move(joints);
  if (skin.skeleton) result["skeleton"] = skin.skeleton.index;
  if (!skin.inverse_bind_matrices.empty()) {
    static_assert(sizeof(glm::mat4) == 16 * sizeof(float));
    result["inverseBindMatrices"] = output.add_floats(
        {reinterpret_cast<const float*>(skin.inverse_bind_matrices.data()), skin.inverse_bind_matrices.size() * 16}, 16,
        false);
  }
  return result;
}

GltfObject sampler_object(GltfOutput& output, const AnimationChannel& channel) {
  static constexpr std::array<std::size_t, 4> kComponents = {3, 4, 3, 1};
  GltfObject result = {{"input", output.add_shared_floats(channel.times, 1, true)},
                       {"output", output.add_shared_floats(
                                      channel.values, kComponents[static_cast<std::size_t>(channel.property)], false)}};
  if (channel.interpolation == KeyInterpolation::Step) result["interpolation"] = "STEP";
  if (channel.interpolation == KeyInterpolation::Cubic) result["interpolation"] = "CUBICSPLINE";
  return result;
}

GltfObject animation_object(GltfOutput& output, const Animation& animation) {
  static constexpr std::array<const char*, 4> kPaths = {"translation", "rotation", "scale", "weights"};
  GltfObject result;
  if (!animation.name.empty()) result["name"] = animation.name;
  GltfObject channels = GltfObject::array();
  GltfObject samplers = GltfObject::array();
  for (const AnimationChannel& channel : animation.channels) {
    channels.push_back(
        {{"sampler", samplers.size()},
         {"target", {{"node", channel.node.index}, {"path", kPaths[static_cast<std::size_t>(channel.property)]}}}});
    samplers.push_back(sampler_object(output, channel));
  }
  result["channels"] = std::move(channels);
  result["samplers"] = std::move(samplers);
  return result;
}

}  // namespace

void write_gltf_animations(GltfOutput& output, const Scene& scene) {
  GltfObject skins = GltfObject::array();
  for (const Skin& skin : scene.skins) skins.push_back(skin_object(output, skin));
  output.set("skins", std::move(skins));
  GltfObject animations = GltfObject::array();
  for (const Animation& animation : scene.animations) animations.push_back(animation_object(output, animation));
  output.set("animations", std::move(animations));
}

}  // namespace azulejo
