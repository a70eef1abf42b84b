#include "azulejo/lifting.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/united_report.h"
#include "azulejo/modelling/pose.h"

namespace azulejo {
namespace {

using Results = std::vector<Value>;

/// Weights and their animation go where a mesh has lost the shapes that they are for.
void drop_stale_morphs(Scene& scene) {
  const auto fits = [&](const Node& node) {
    return node.mesh && scene.meshes[node.mesh.index]->morph_targets.size() == node.morph_weights.size();
  };
  std::vector<bool> stale(scene.nodes.size());
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    Node& node = scene.nodes[n];
    const bool shapes = node.mesh && !scene.meshes[node.mesh.index]->morph_targets.empty();
    stale[n] = !shapes || (!node.morph_weights.empty() && !fits(node));
    if (stale[n]) node.morph_weights.clear();
  }
  for (Animation& animation : scene.animations) {
    std::erase_if(animation.channels, [&](const AnimationChannel& channel) {
      return channel.property == AnimatedProperty::MorphWeights && channel.node && stale[channel.node.index];
    });
  }
}

Scene with_meshes(const Scene& scene, const std::vector<Results>& results, std::size_t output) {
  Scene changed = scene.clone();
  for (std::size_t i = 0; i < results.size(); ++i) changed.meshes[i] = results[i][output].shared<Mesh>();
  drop_stale_morphs(changed);
  return changed;
}

/// The options of each mesh, where a count is to be divided among them; the same address: the same mesh.
class SharedOptions {
 public:
  SharedOptions(const Operation& operation, const void* options, const Scene& scene)
      : operation_(operation), options_(options) {
    const bool any = std::ranges::any_of(operation.fields, [&](const Field& field) { return is_shared(field); });
    if (!any || scene.meshes.size() < 2) return;
    std::unordered_set<const Mesh*> seen;
    for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
      if (!seen.insert(mesh.get()).second) continue;
      before_.emplace(mesh.get(), triangles_);
      triangles_ += mesh->triangle_count();
    }
  }

  std::shared_ptr<const void> of(const Mesh& mesh) const {
    if (triangles_ == 0) return {options_, [](const void*) {}};
    const std::shared_ptr<void> mine = operation_.make_options();
    for (const Field& field : operation_.fields) {
      std::string text = field.print(options_);
      if (is_shared(field)) text = std::to_string(share(fields::parse_int(field, text), mesh));
      field.parse(mine.get(), text);
    }
    return mine;
  }

 private:
  bool is_shared(const Field& field) const { return field.shared && field.print(options_) != "auto"; }
  /// Rounded so that the sum of all is the whole.
  std::int64_t share(std::int64_t whole, const Mesh& mesh) const {
    const auto up_to = [&](std::size_t triangles) {
      return static_cast<std::int64_t>(static_cast<double>(whole) * static_cast<double>(triangles) /
                                       static_cast<double>(triangles_));
    };
    const std::size_t begin = before_.at(&mesh);
    return up_to(begin + mesh.triangle_count()) - up_to(begin);
  }

  const Operation& operation_;
  const void* options_;
  std::unordered_map<const Mesh*, std::size_t> before_;  ///< triangles of the meshes in front of it
  std::size_t triangles_ = 0;                            ///< of all; 0: nothing is divided
};

/// The operation's results for each mesh of the scene, once for those that are one and the same.
std::vector<Results> each_mesh(const Operation& operation, const void* options, const Scene& scene,
                               std::vector<Value> inputs, const Run& run, const std::string& step) {
  const SharedOptions options_of(operation, options, scene);
  std::unordered_map<const Mesh*, std::size_t> done;
  std::vector<Results> results;
  for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
    check_cancelled(run);
    const auto [same, added] = done.emplace(mesh.get(), results.size());
    if (!added) {
      results.push_back(results[same->second]);
      continue;
    }
    inputs[0] = Value(mesh);
    const std::string name = scene.meshes.size() == 1 ? step : fmt::format("{}-{}", step, results.size());
    results.push_back(invoke(operation, options_of.of(*mesh).get(), inputs, run, name));
  }
  return results;
}

}  // namespace

bool is_liftable(const Operation& operation) {
  const auto meshes = std::ranges::count(operation.inputs, ValueKind::Mesh, &Port::kind);
  const bool only_first = meshes == 1 && operation.inputs[0].kind == ValueKind::Mesh;
  return only_first && std::ranges::all_of(operation.outputs, [](const Port& port) {
           return port.kind == ValueKind::Mesh || port.kind == ValueKind::Report;
         });
}

ValueKind lifted_kind(ValueKind output) { return output == ValueKind::Mesh ? ValueKind::Scene : output; }

std::vector<Value> invoke_lifted(const Operation& operation, const void* options, std::span<const Value> inputs,
                                 const Run& run, const std::string& step) {
  operation.check(options);
  const Scene* scene = inputs[0].scene();
  std::optional<Scene> posed;
  if (needs_pose(*scene)) {
    warn(run, fmt::format("{}: skinned and morphed meshes are taken as they are posed", operation.name));
    posed = pose(*scene, run);
    scene = &*posed;
  }
  const std::vector<Results> results = each_mesh(operation, options, *scene, {inputs.begin(), inputs.end()}, run, step);
  std::vector<Value> values;
  for (std::size_t o = 0; o < operation.outputs.size(); ++o) {
    if (operation.outputs[o].kind == ValueKind::Mesh) {
      values.emplace_back(with_meshes(*scene, results, o));
      continue;
    }
    std::vector<NamedReport> reports;
    for (std::size_t m = 0; m < results.size(); ++m)
      reports.push_back({scene->meshes[m]->name, results[m][o].report()});
    values.emplace_back(united(reports));
  }
  return values;
}

}  // namespace azulejo
