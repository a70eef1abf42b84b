#include "azulejo/rendering/file_camera.h"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"

namespace azulejo {
namespace {

/// The cameras that stand somewhere, in the order of the file, each where it is met first.
std::vector<std::pair<std::size_t, PlacedNode>> standing_cameras(const Scene& scene) {
  std::vector<std::pair<std::size_t, PlacedNode>> standing;
  if (scene.cameras.empty()) return standing;
  for (const PlacedNode& placed : walk(scene)) {
    if (const CameraId camera = scene.nodes[placed.node.index].camera) standing.emplace_back(camera.index, placed);
  }
  std::stable_sort(standing.begin(), standing.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return standing;
}

FileCamera file_camera(const Scene& scene, const std::pair<std::size_t, PlacedNode>& standing) {
  const Camera& camera = scene.cameras[standing.first];
  const std::string& node = scene.nodes[standing.second.node.index].name;
  const std::string& name = camera.name.empty() ? node : camera.name;
  return {&camera, standing.second.world_from_node, name.empty() ? std::to_string(standing.first) : name};
}

}  // namespace

std::optional<FileCamera> first_camera(const Scene& scene) {
  const auto standing = standing_cameras(scene);
  if (standing.empty()) return std::nullopt;
  return file_camera(scene, standing.front());
}

FileCamera find_camera(const Scene& scene, const std::string& wanted) {
  const auto standing = standing_cameras(scene);
  std::vector<std::string> names;
  for (const auto& each : standing) {
    if (scene.cameras[each.first].name == wanted) return file_camera(scene, each);
    names.push_back(scene.cameras[each.first].name);
  }
  for (const auto& each : standing) {
    const std::string& node = scene.nodes[each.second.node.index].name;
    if (node == wanted) return file_camera(scene, each);
    names.push_back(node);
  }
  std::size_t number = 0;
  const auto [end, failure] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (failure == std::errc() && end == wanted.data() + wanted.size()) {
    for (const auto& each : standing) {
      if (each.first == number) return file_camera(scene, each);
    }
  }
  std::erase(names, "");
  std::string expected = "the scene has no camera";
  if (!standing.empty()) {
    expected = fmt::format("expected a number below {}{}", scene.cameras.size(), names.empty() ? "" : ", or one of ");
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    if (names.size() > 20) {
      names.resize(20);
      names.emplace_back("…");
    }
    expected += fmt::format("{}", fmt::join(names, ", "));
  }
  throw Error(Error::Argument, fmt::format("camera: \"{}\"{}; {}", wanted, did_you_mean(wanted, names), expected));
}

}  // namespace azulejo
