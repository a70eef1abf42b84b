#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "azulejo/io/gltf_parts.h"

namespace azulejo {
namespace {

Skin read_skin(GltfFile& file, GltfAccessors& accessors, const GltfValue& value, std::size_t nodes) {
  Skin skin;
  skin.name = value["name"].text();
  const GltfValue joints = value.need("joints");
  file.claim(joints.size(), sizeof(NodeId) + sizeof(glm::mat4));
  for (std::size_t j = 0; j < joints.size(); ++j) skin.joints.emplace_back(joints.at(j).index(nodes));
  if (const GltfValue skeleton = value["skeleton"]) skin.skeleton = NodeId(skeleton.index(nodes));
  const GltfValue matrices = value["inverseBindMatrices"];
  if (!matrices) return skin;
  const GltfAccessor& accessor = accessors.at(matrices, 16);
  if (accessor.count < joints.size() || accessor.component != GltfAccessor::F32) {
    throw matrices.error(fmt::format("{} matrices of component type {}, expected {} of 5126", accessor.count,
                                     accessor.component, joints.size()));
  }
  file.claim(accessor.values(), sizeof(float));
  Array<float> values(accessor.values());
  accessors.read(accessor, matrices, std::span<float>(values));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    skin.inverse_bind_matrices.push_back(glm::make_mat4(values.data() + j * 16));
  }
  return skin;
}

std::optional<AnimatedProperty> property_of(const std::string& path) {
  if (path == "translation") return AnimatedProperty::Translation;
  if (path == "rotation") return AnimatedProperty::Rotation;
  if (path == "scale") return AnimatedProperty::Scale;
  if (path == "weights") return AnimatedProperty::MorphWeights;
  return std::nullopt;
}

KeyInterpolation interpolation_of(const GltfValue& value) {
  const std::string name = value ? value.text() : "LINEAR";
  if (name == "LINEAR") return KeyInterpolation::Linear;
  if (name == "STEP") return KeyInterpolation::Step;
  if (name == "CUBICSPLINE") return KeyInterpolation::Cubic;
  throw value.error(fmt::format("{}, expected LINEAR, STEP or CUBICSPLINE", printable(name)));
}

class AnimationReader {
 public:
  AnimationReader(GltfFile& file, GltfAccessors& accessors, const Scene& scene)
      : file_(file), accessors_(accessors), scene_(scene) {}

  Animation read(const GltfValue& value, std::size_t index);

 private:
  std::optional<AnimationChannel> read_channel(const GltfValue& value, std::size_t index);
  void read_times(const GltfValue& sampler, AnimationChannel& channel);
  void read_values(const GltfValue& sampler, AnimationChannel& channel);
  std::size_t elements_of(const AnimationChannel& channel, const GltfValue& place) const;

  GltfFile& file_;
  GltfAccessors& accessors_;
  const Scene& scene_;
};

Animation AnimationReader::read(const GltfValue& value, std::size_t index) {
  Animation animation;
  animation.name = value["name"].text();
  const GltfValue channels = value.need("channels");
  const GltfValue samplers = value.need("samplers");
  file_.claim(channels.size(), sizeof(AnimationChannel));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const GltfValue sampler = samplers.at(channels.at(c).need("sampler").index(samplers.size()));
    std::optional<AnimationChannel> channel = read_channel(channels.at(c), index);
    if (!channel) continue;
    channel->interpolation = interpolation_of(sampler["interpolation"]);
    read_times(sampler.need("input"), *channel);
    read_values(sampler.need("output"), *channel);
    animation.channels.push_back(std::move(*channel));
  }
  return animation;
}

std::optional<AnimationChannel> AnimationReader::read_channel(const GltfValue& value, std::size_t index) {
  const GltfValue target = value.need("target");
  const std::string path = target.need("path").text();
  const std::optional<AnimatedProperty> property = property_of(path);
  if (!property) {
    file_.warn(fmt::format("animation {}: {} can't be played and is left out", index, printable(path)));
    return std::nullopt;
  }
  if (!target["node"]) return std::nullopt;  // the specification: to be ignored
  AnimationChannel channel;
  channel.node = NodeId(target["node"].index(scene_.nodes.size()));
  channel.property = *property;
  const Node& node = scene_.nodes[channel.node.index];
  if (*property != AnimatedProperty::MorphWeights && std::holds_alternative<glm::mat4>(node.placement)) {
    file_.warn(fmt::format("animation {}: node {} has a matrix, its {} can't move", index, channel.node.index, path));
    return std::nullopt;
  }
  return channel;
}

void AnimationReader::read_times(const GltfValue& sampler, AnimationChannel& channel) {
  const GltfAccessor& accessor = accessors_.at(sampler, 1);
  if (accessor.component != GltfAccessor::F32) throw sampler.error("times that aren't floats");
  if (accessor.count == 0) throw sampler.error("no times");
  file_.claim(accessor.count, sizeof(float));
  channel.times.resize(accessor.count);
  accessors_.read(accessor, sampler, std::span<float>(channel.times));
  float last = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < channel.times.size(); ++i) {
    const float time = channel.times[i];
    if (!std::isfinite(time) || time <= last) {
      throw sampler.error(fmt::format("time {} is {}, after {}: expected to rise", i, time, last));
    }
    last = time;
  }
}

/// Elements of the accessor for one time: morph weights are scalars, as many as the mesh has targets.
std::size_t AnimationReader::elements_of(const AnimationChannel& channel, const GltfValue& place) const {
  const std::size_t tangents = channel.interpolation == KeyInterpolation::Cubic ? 3 : 1;
  if (channel.property != AnimatedProperty::MorphWeights) return tangents;
  const MeshId mesh = scene_.nodes[channel.node.index].mesh;
  const std::size_t targets = mesh ? scene_.meshes[mesh.index]->morph_targets.size() : 0;
  if (targets == 0)
    throw place.error(fmt::format("weights of node {}, which has no morph targets", channel.node.index));
  return tangents * targets;
}

void AnimationReader::read_values(const GltfValue& sampler, AnimationChannel& channel) {
  static constexpr std::array<int, 4> kComponents = {3, 4, 3, 1};
  const GltfAccessor& accessor = accessors_.at(sampler, kComponents[static_cast<std::size_t>(channel.property)]);
  const bool floats = accessor.component == GltfAccessor::F32 || accessor.normalized;
  if (!floats) throw sampler.error(fmt::format("component type {}, expected 5126 or normalized", accessor.component));
  const std::size_t wanted = channel.times.size() * elements_of(channel, sampler);
  if (accessor.count != wanted) {
    throw sampler.error(
        fmt::format("{} elements for {} times, expected {}", accessor.count, channel.times.size(), wanted));
  }
  file_.claim(accessor.values(), sizeof(float));
  channel.values.resize(accessor.values());
  accessors_.read(accessor, sampler, std::span<float>(channel.values));
}

}  // namespace

std::vector<Skin> read_gltf_skins(GltfFile& file, GltfAccessors& accessors, std::size_t nodes) {
  const GltfValue list = file.root()["skins"];
  file.claim(list.size(), sizeof(Skin));
  std::vector<Skin> skins;
  skins.reserve(list.size());
  for (std::size_t s = 0; s < list.size(); ++s) skins.push_back(read_skin(file, accessors, list.at(s), nodes));
  return skins;
}

std::vector<Animation> read_gltf_animations(GltfFile& file, GltfAccessors& accessors, const Scene& scene) {
  const GltfValue list = file.root()["animations"];
  file.claim(list.size(), sizeof(Animation));
  std::vector<Animation> animations;
  animations.reserve(list.size());
  AnimationReader reader(file, accessors, scene);
  for (std::size_t a = 0; a < list.size(); ++a) animations.push_back(reader.read(list.at(a), a));
  return animations;
}

}  // namespace azulejo
