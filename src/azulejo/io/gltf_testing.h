#pragma once

// What the tests of glTF files share: a small file with something of everything, to be changed before it is read.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"

namespace azulejo {

/// A glTF file as its two parts.
struct GltfSample {
  nlohmann::json json;
  std::vector<std::byte> binary;

  /// Appends values to the binary chunk, as a view of their own; returns the view.
  template <class T>
  std::size_t add_view(const std::vector<T>& values) {
    binary.resize((binary.size() + 3) / 4 * 4);
    const auto bytes = std::as_bytes(std::span(values));
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    json["buffers"] = {{{"byteLength", binary.size()}}};
    return json["bufferViews"].size() - 1;
  }
  /// The same with an accessor; returns the accessor.
  template <class T>
  std::size_t add(const std::vector<T>& values, const char* type, std::size_t components) {
    const int component = std::is_same_v<T, float>           ? 5126
                          : std::is_same_v<T, std::uint32_t> ? 5125
                          : std::is_same_v<T, std::uint16_t> ? 5123
                          : std::is_same_v<T, std::int16_t>  ? 5122
                          : std::is_same_v<T, std::uint8_t>  ? 5121
                                                             : 5120;
    json["accessors"].push_back({{"bufferView", add_view(values)},
                                 {"componentType", component},
                                 {"count", values.size() / components},
                                 {"type", type}});
    return json["accessors"].size() - 1;
  }
};

inline std::vector<std::byte> glb_of(const std::string& text, std::vector<std::byte> binary) {
  std::vector<std::byte> file;
  const auto put = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<std::byte>(value >> shift));
  };
  std::string padded = text;
  padded.resize((padded.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  put(0x46546C67);
  put(2);
  put(12 + 8 + padded.size() + (binary.empty() ? 0 : 8 + binary.size()));
  put(padded.size());
  put(0x4E4F534A);
  const auto bytes = as_bytes(padded);
  file.insert(file.end(), bytes.begin(), bytes.end());
  if (binary.empty()) return file;
  put(binary.size());
  put(0x004E4942);
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

inline std::vector<std::byte> glb_of(const GltfSample& sample) { return glb_of(sample.json.dump(), sample.binary); }

inline Scene read_sample(const GltfSample& sample, const Run& run = {}) {
  return std::get<Scene>(read_model(glb_of(sample), "sample.glb", {}, run));
}

/// An asset, and nothing else.
inline GltfSample empty_sample() {
  GltfSample sample;
  sample.json = {{"asset", {{"version", "2.0"}}}};
  return sample;
}

/// One square of two triangles in a mesh, with `indices` as they are given.
inline GltfSample square_sample(const std::vector<std::uint16_t>& indices = {0, 1, 2, 0, 2, 3}) {
  GltfSample sample = empty_sample();
  sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  sample.add(indices, "SCALAR", 1);
  sample.json["meshes"] = nlohmann::json::parse(R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}])");
  sample.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}])");
  return sample;
}

/// The square with a skin, a morph target, an animation, a camera, a light, a material and a texture.
inline GltfSample full_sample() {
  GltfSample sample = square_sample();
  nlohmann::json& json = sample.json;
  const std::size_t joints = sample.add(std::vector<std::uint8_t>(16, 1), "VEC4", 4);
  const std::size_t weights = sample.add(std::vector<float>(16, 0.25F), "VEC4", 4);
  const std::size_t times = sample.add(std::vector<float>{0, 1}, "SCALAR", 1);
  const std::size_t moves = sample.add(std::vector<float>{0, 0, 0, 3, 0, 0}, "VEC3", 3);
  const std::size_t amounts = sample.add(std::vector<float>{0, 1}, "SCALAR", 1);
  const std::size_t binds = sample.add(std::vector<float>(32, 2), "MAT4", 16);
  const std::size_t changed = sample.add_view(std::vector<std::uint16_t>{1, 3});
  const std::size_t deltas = sample.add_view(std::vector<float>{0, 0, 5, 0, 0, 6});
  const std::size_t image = sample.add_view(
      encode_image(random_image({2, 2, 3, PixelType::U8, ColorState::Srgb, AlphaState::None}, 3), "png"));
  json["accessors"].push_back({{"componentType", 5126},
                               {"count", 4},
                               {"type", "VEC3"},
                               {"sparse",
                                {{"count", 2},
                                 {"indices", {{"bufferView", changed}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", deltas}}}}}});
  nlohmann::json& primitive = json["meshes"][0]["primitives"][0];
  primitive["attributes"]["JOINTS_0"] = joints;
  primitive["attributes"]["WEIGHTS_0"] = weights;
  primitive["targets"] = {{{"POSITION", json["accessors"].size() - 1}}};
  primitive["material"] = 0;
  json["meshes"][0]["weights"] = {0.5};
  json["meshes"][0]["extras"] = {{"targetNames", {"bulge"}}};
  json["materials"] = nlohmann::json::parse(R"([{"normalTexture": {"index": 0, "scale": 2},
      "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5}}}])");
  json["textures"] = nlohmann::json::parse(R"([{"source": 0, "sampler": 0}])");
  json["samplers"] = nlohmann::json::parse(R"([{"wrapS": 33071, "minFilter": 9984, "magFilter": 9728}])");
  json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
  json["cameras"] = nlohmann::json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5}}])");
  json["extensions"] = nlohmann::json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 9,
      "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}]}})");
  json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}, {"skeleton", 1}}};
  json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "skin": 0, "name": "a"}, {"children": [2, 3]}, {"camera": 0},
      {"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [0, 0, 1, 0], "scale": [1, 2, 3]}])");
  json["scenes"] = nlohmann::json::parse(R"([{"nodes": [1]}, {"nodes": [0, 1], "name": "all"}])");
  json["scene"] = 1;
  json["animations"] = {
      {{"channels",
        {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
       {"samplers",
        {{{"input", times}, {"output", moves}, {"interpolation", "STEP"}}, {{"input", times}, {"output", amounts}}}}}};
  return sample;
}

}  // namespace azulejo
