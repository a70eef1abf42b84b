#include "azulejo/modelling/animate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec4.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

/// Where a time lies among the keys: between one and the next, or on the first or the last.
struct Moment {
  std::size_t key = 0;
  std::size_t next = 0;
  float fraction = 0;  ///< 0 on `key`, 1 on `next`
  float span = 0;      ///< seconds from key to next
};

Moment moment_of(const Array<float>& times, float seconds) {
  const auto after = std::upper_bound(times.begin(), times.end(), seconds);
  if (after == times.begin()) return {};
  const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end()) return {key, key, 0, 0};
  const float span = times[key + 1] - times[key];
  return {key, key + 1, (seconds - times[key]) / span, span};
}

std::size_t components_of(const Scene& scene, const AnimationChannel& channel) {
  switch (channel.property) {
    case AnimatedProperty::Translation:
    case AnimatedProperty::Scale: return 3;
    case AnimatedProperty::Rotation: return 4;
    case AnimatedProperty::MorphWeights: break;
  }
  const MeshId mesh = scene.nodes[channel.node.index].mesh;
  return mesh ? scene.meshes[mesh.index]->morph_targets.size() : 0;
}

void check_channel(const AnimationChannel& channel, std::size_t components) {
  const std::size_t per_key = components * (channel.interpolation == KeyInterpolation::Cubic ? 3 : 1);
  if (channel.values.size() != channel.times.size() * per_key) {
    throw Error(Error::Data, fmt::format("animate: {} values for {} keys of node {}, expected {} a key",
                                         channel.values.size(), channel.times.size(), channel.node.index, per_key));
  }
  if (!std::is_sorted(channel.times.begin(), channel.times.end())) {
    throw Error(Error::Data, fmt::format("animate: the times of node {} don't rise", channel.node.index));
  }
}

/// Values of the channel at a moment, component by component.
std::vector<float> interpolate(const AnimationChannel& channel, const Moment& moment, std::size_t components) {
  const bool cubic = channel.interpolation == KeyInterpolation::Cubic;
  const auto at = [&](std::size_t key, std::size_t part, std::size_t component) {
    return channel.values[(cubic ? 3 * key + part : key) * components + component];
  };
  const float t = channel.interpolation == KeyInterpolation::Step ? 0 : moment.fraction;
  std::vector<float> result(components);
  for (std::size_t c = 0; c < components; ++c) {
    const float before = at(moment.key, 1, c);
    const float after = at(moment.next, 1, c);
    if (!cubic) {
      result[c] = (1 - t) * before + t * after;
      continue;
    }
    const float out_tangent = moment.span * at(moment.key, 2, c);
    const float in_tangent = moment.span * at(moment.next, 0, c);
    const float t2 = t * t;
    const float t3 = t2 * t;
    result[c] = (2 * t3 - 3 * t2 + 1) * before + (t3 - 2 * t2 + t) * out_tangent + (3 * t2 - 2 * t3) * after +
                (t3 - t2) * in_tangent;
  }
  return result;
}

glm::quat quaternion(const float* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

glm::quat rotation_at(const AnimationChannel& channel, const Moment& moment, const std::vector<float>& values) {
  if (channel.interpolation == KeyInterpolation::Linear) {
    return glm::normalize(glm::slerp(quaternion(&channel.values[4 * moment.key]),
                                     quaternion(&channel.values[4 * moment.next]), moment.fraction));
  }
  return glm::normalize(quaternion(values.data()));
}

void apply(const AnimationChannel& channel, float seconds, std::size_t components, Node& node) {
  const Moment moment = moment_of(channel.times, seconds);
  std::vector<float> values = interpolate(channel, moment, components);
  if (channel.property == AnimatedProperty::MorphWeights) {
    node.morph_weights = std::move(values);
    return;
  }
  auto* const placement = std::get_if<Placement>(&node.placement);
  if (placement == nullptr) {
    throw Error(Error::Data, fmt::format("animate: node {} is placed by a matrix", channel.node.index));
  }
  switch (channel.property) {
    case AnimatedProperty::Translation: placement->translation = {values[0], values[1], values[2]}; break;
    case AnimatedProperty::Scale: placement->scale = {values[0], values[1], values[2]}; break;
    case AnimatedProperty::Rotation: placement->rotation = rotation_at(channel, moment, values); break;
    case AnimatedProperty::MorphWeights: break;
  }
}

}  // namespace

Scene animate(const Scene& scene, std::size_t animation, float seconds) {
  if (animation >= scene.animations.size()) {
    throw Error(Error::Argument, fmt::format("animate: animation is {}, of {}", animation, scene.animations.size()));
  }
  if (!std::isfinite(seconds)) throw Error(Error::Argument, "animate: the time is not a number");
  Scene result = scene.clone();
  for (const AnimationChannel& channel : scene.animations[animation].channels) {
    if (!channel.node || channel.times.empty()) continue;
    const std::size_t components = components_of(scene, channel);
    check_channel(channel, components);
    apply(channel, seconds, components, result.nodes[channel.node.index]);
  }
  return result;
}

}  // namespace azulejo
