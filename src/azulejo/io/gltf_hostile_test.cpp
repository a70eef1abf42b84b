// glTF files that are wrong: each is refused for its reason, or read with a warning; none does harm.

#include <cstring>
#include <limits>
#include <random>

#include "azulejo/io/gltf_testing.h"

namespace azulejo {
namespace {

using Json = nlohmann::json;

struct Wrong {
  const char* place;  ///< a JSON pointer into full_sample()
  const char* value;  ///< JSON; empty: erased
  const char* message;
  Error::Kind kind = Error::Data;
};

// clang-format off
const Wrong kWrong[] = {
    {"/asset", "", "no asset"},
    {"/asset/version", "\"1.0\"", "glTF 1.0", Error::Unsupported},
    {"/asset/minVersion", "\"2.1\"", "glTF 2.1", Error::Unsupported},
    {"/extensionsRequired", "[\"KHR_draco_mesh_compression\"]", "KHR_draco_mesh_compression isn't read", Error::Unsupported},
    {"/extensionsRequired", "[\"KHR_texture_basisu\"]", "KHR_texture_basisu", Error::Unsupported},
    {"/extensionsRequired", "[\"KHR\\nevil\"]", "KHR?evil", Error::Unsupported},
    {"/nodes", "5", "nodes: number, expected an array"},
    {"/nodes/0", "[]", "nodes[0]: array, expected an object"},
    {"/nodes/0/name", "5", "nodes[0].name: number, expected a string"},
    {"/nodes/0/mesh", "1", "nodes[0].mesh: 1, of 1"},
    {"/nodes/0/mesh", "-1", "nodes[0].mesh: -1, expected a whole number"},
    {"/nodes/0/mesh", "0.5", "nodes[0].mesh: 0.5, expected a whole number"},
    {"/nodes/0/mesh", "1e300", "nodes[0].mesh"},
    {"/nodes/0/skin", "1", "nodes[0].skin"},
    {"/nodes/2/camera", "1", "nodes[2].camera"},
    {"/nodes/3/extensions/KHR_lights_punctual/light", "1", "nodes[3].extensions.KHR_lights_punctual.light"},
    {"/nodes/1/children/0", "4", "nodes[1].children[0]: 4, of 4"},
    {"/nodes/1/children", "[2, 2]", "two parents"},
    {"/nodes/1/children", "[1]", "their own ancestors"},
    {"/nodes/2/children", "[3]", "two parents"},
    {"/nodes/0/translation", "[1, 2]", "2 numbers, expected 3"},
    {"/nodes/0/translation", "[1, 2, 1e39]", "out of range"},
    {"/nodes/0/matrix", "[1]", "1 numbers, expected 16"},
    {"/scenes/1/nodes", "[0, 2]", "scenes[1].nodes[1]: node 2 has a parent"},
    {"/scenes/1/nodes", "[0, 0]", "named twice"},
    {"/scenes/1/nodes/0", "4", "scenes[1].nodes[0]"},
    {"/scene", "2", "scene: 2, of 2"},
    {"/buffers/0/byteLength", "100000", "byteLength 100000"},
    {"/buffers/0/byteLength", "", "buffers[0]: no byteLength"},
    {"/buffers/0/uri", "\"data:;base64,AA*A\"", "malformed"},
    {"/buffers/0/uri", "\"data:;base64\"", "malformed"},
    {"/buffers/0/uri", "\"data:,%4\"", "malformed"},
    {"/buffers/0/uri", "\"none\\nwhere.bin\"", "control characters"},
    {"/buffers/0/uri", "\"nowhere.bin\"", "no file nowhere.bin"},
    {"/bufferViews/0/buffer", "1", "bufferViews[0].buffer: 1, of 1"},
    {"/bufferViews/0/byteOffset", "100000", "bufferViews[0]: bytes 100000"},
    {"/bufferViews/0/byteLength", "9007199254740992", "bufferViews[0]"},
    {"/bufferViews/0/byteLength", "1e300", "whole number"},
    {"/bufferViews/0/byteLength", "47", "accessors[0]: 4 elements, 12 bytes apart"},
    {"/bufferViews/0/byteStride", "8", "elements of 12 bytes, byteStride 8"},
    {"/bufferViews/0/byteStride", "16", "accessors[0]: 4 elements, 16 bytes apart"},
    {"/bufferViews/0/byteStride", "256", "byteStride 256"},
    {"/accessors/0/bufferView", "99", "accessors[0].bufferView"},
    {"/accessors/0/byteOffset", "1", "accessors[0]: 4 elements"},
    {"/accessors/0/byteOffset", "9007199254740992", "accessors[0]: 4 elements"},
    {"/accessors/0/count", "5", "accessors[0]: 5 elements"},
    {"/accessors/0/count", "9007199254740992", "fewer than 2^32"},
    {"/accessors/0/count", "4294967294", "accessors[0]: 4294967294 elements"},
    {"/accessors/0/componentType", "5124", "5124, expected 5120"},
    {"/accessors/0/componentType", "5125", "componentType 5125 for POSITION"},
    {"/accessors/0/type", "\"VEC5\"", "VEC5, expected SCALAR"},
    {"/accessors/0/type", "\"VEC2\"", "2 components, expected 3"},
    {"/accessors/0/normalized", "true", "normalized"},
    {"/accessors/1/componentType", "5122", "expected an unsigned integer"},
    {"/accessors/2/count", "3", "3 elements, POSITION has 4"},
    {"/accessors/2/componentType", "5120", "JOINTS_0"},
    {"/accessors/3/type", "\"VEC3\"", "3 components, expected 4"},
    {"/accessors/8/sparse/count", "5", "5 elements, of 4"},
    {"/accessors/8/sparse/count", "3", "3 elements"},
    {"/accessors/8/sparse/indices/componentType", "5126", "isn't an unsigned integer"},
    {"/accessors/8/sparse/indices/bufferView", "99", "sparse.indices.bufferView"},
    {"/accessors/8/sparse/indices/byteOffset", "2", "sparse.indices"},
    {"/accessors/8/sparse/values/byteOffset", "4", "sparse.values"},
    {"/accessors/8/sparse/values", "", "no values"},
    {"/meshes/0/primitives", "", "no primitives"},
    {"/meshes/0/primitives/0/attributes", "", "no attributes"},
    {"/meshes/0/primitives/0/attributes/POSITION", "99", "attributes.POSITION: 99"},
    {"/meshes/0/primitives/0/attributes/NORMAL", "1", "attributes.NORMAL"},
    {"/meshes/0/primitives/0/attributes/TEXCOORD_0", "0", "3 components, expected 2"},
    {"/meshes/0/primitives/0/indices", "0", "indices"},
    {"/meshes/0/primitives/0/material", "1", "material: 1, of 1"},
    {"/meshes/0/primitives/0/mode", "7", "mode: 7, expected 0 to 6"},
    {"/meshes/0/primitives/0/targets/0/POSITION", "5", "targets[0].POSITION: 2 elements, POSITION has 4"},
    {"/materials/0/alphaMode", "\"GLASS\"", "GLASS, expected OPAQUE"},
    {"/materials/0/emissiveFactor", "[1]", "1 numbers, expected 3"},
    {"/materials/0/normalTexture/index", "1", "normalTexture.index: 1, of 1"},
    {"/materials/0/normalTexture/index", "", "no index"},
    {"/materials/0/normalTexture/texCoord", "1e9", "texCoord"},
    {"/textures/0/source", "1", "textures[0].source: 1, of 1"},
    {"/textures/0/sampler", "1", "textures[0].sampler: 1, of 1"},
    {"/samplers/0/wrapS", "5", "samplers[0].wrapS: 5, expected 10497"},
    {"/samplers/0/minFilter", "9730", "samplers[0].minFilter"},
    {"/samplers/0/magFilter", "9984", "samplers[0].magFilter"},
    {"/images/0/bufferView", "99", "images[0].bufferView"},
    {"/cameras/0/type", "\"fish\"", "fish, expected perspective"},
    {"/cameras/0/perspective", "", "no perspective"},
    {"/cameras/0/perspective/yfov", "0", "yfov 0"},
    {"/cameras/0/perspective/zfar", "0.25", "zfar 0.25"},
    {"/extensions/KHR_lights_punctual/lights/0/type", "\"neon\"", "neon, expected directional"},
    {"/skins/0/joints", "[1]", "its mesh names joint 1, of 1"},
    {"/skins/0/joints/0", "4", "skins[0].joints[0]"},
    {"/skins/0/joints", "[1, 2, 3]", "2 matrices"},
    {"/skins/0/skeleton", "9", "skins[0].skeleton"},
    {"/skins/0/inverseBindMatrices", "0", "3 components, expected 16"},
    {"/animations/0/channels/0/sampler", "2", "channels[0].sampler: 2, of 2"},
    {"/animations/0/channels/0/target/node", "4", "target.node: 4, of 4"},
    {"/animations/0/channels/1/target/node", "1", "which has no morph targets"},
    {"/animations/0/samplers/0/input", "6", ""},
    {"/animations/0/samplers/0/input", "0", "3 components, expected 1"},
    {"/animations/0/samplers/0/output", "4", "1 components, expected 3"},
    {"/animations/0/samplers/0/output", "0", "4 elements for 2 times, expected 2"},
    {"/animations/0/samplers/0/interpolation", "\"CUBICSPLINE\"", "2 elements for 2 times, expected 6"},
    {"/animations/0/samplers/0/interpolation", "\"HOP\"", "HOP, expected LINEAR"},
};
// clang-format on

GltfSample changed(const char* place, const char* value) {
  GltfSample sample = full_sample();
  const Json::json_pointer pointer(place);
  if (*value != '\0') {
    sample.json[pointer] = Json::parse(value);
  } else {
    sample.json[pointer.parent_pointer()].erase(pointer.back());
  }
  return sample;
}

/// Reads bytes that may be damaged; true if a scene came of it. Whatever is thrown must be a proper Error.
bool survives(std::span<const std::byte> bytes, std::int64_t memory = std::int64_t{1} << 28) {
  azulejo::Run run;
  run.limits.memory_bytes = memory;
  run.limits.pixels = 1 << 20;
  run.warn = [](const std::string& line) { EXPECT_EQ(line.find('\n'), std::string::npos) << line; };
  try {
    read_model(bytes, "damaged.glb", {}, run);
    return true;
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find("damaged.glb"), 0U) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_NE(error.kind(), Error::Argument) << line;
    return false;
  }
}

TEST(GltfHostile, EachMistakeIsNamed) {
  EXPECT_NO_THROW(read_sample(full_sample()));
  for (const Wrong& wrong : kWrong) {
    SCOPED_TRACE(std::string(wrong.place) + " = " + wrong.value);
    if (*wrong.message == '\0') {
      EXPECT_NO_THROW(read_sample(changed(wrong.place, wrong.value)));
      continue;
    }
    try {
      read_sample(changed(wrong.place, wrong.value));
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), wrong.kind) << error.what();
      EXPECT_NE(std::string(error.what()).find(wrong.message), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find("sample.glb: "), 0U) << error.what();
    }
  }
}

TEST(GltfHostile, IndicesBeyondTheVertices) {
  EXPECT_EQ(kind_of_error([] { read_sample(square_sample({0, 1, 4})); }), Error::Data);
  EXPECT_EQ(kind_of_error([] { read_sample(square_sample({0, 1, 0xFFFF})); }), Error::Data);
}

TEST(GltfHostile, SparseIndicesMustRiseAndFit) {
  for (const std::vector<std::uint16_t>& indices : std::vector<std::vector<std::uint16_t>>{{1, 1}, {3, 1}, {1, 4}}) {
    GltfSample sample = full_sample();
    sample.json["accessors"][8]["sparse"]["indices"]["bufferView"] = sample.add_view(indices);
    EXPECT_EQ(kind_of_error([&] { read_sample(sample); }), Error::Data) << indices[0] << ' ' << indices[1];
  }
}

TEST(GltfHostile, TimesMustRise) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& times : std::vector<std::vector<float>>{{1, 1}, {1, 0}, {0, nan}}) {
    GltfSample sample = full_sample();
    sample.json["animations"][0]["samplers"][0]["input"] = sample.add(times, "SCALAR", 1);
    EXPECT_EQ(kind_of_error([&] { read_sample(sample); }), Error::Data) << times[0] << ' ' << times[1];
  }
}

TEST(GltfHostile, WhatCannotBeUsedIsAWarning) {
  const auto warnings_of = [](const char* place, const char* value) {
    Warnings warnings;
    read_sample(changed(place, value), warnings.run());
    return warnings.lines.size();
  };
  EXPECT_EQ(warnings_of("/nodes/0/weights", "[1, 2]"), 1U) << "for one target";
  EXPECT_EQ(warnings_of("/nodes/2/matrix", "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"), 1U) << "is animated";
  EXPECT_EQ(warnings_of("/animations/0/channels/0/target/path", "\"pointer\""), 1U);
  EXPECT_EQ(warnings_of("/animations/0/channels/0/target/node", ""), 0U) << "ignored, says the specification";
  EXPECT_EQ(warnings_of("/textures/0", "{\"extensions\": {\"KHR_texture_basisu\": {\"source\": 0}}}"), 1U);
  EXPECT_EQ(warnings_of("/extensionsUsed", "[\"X_UNKNOWN\"]"), 0U);
  EXPECT_EQ(warnings_of("/accessors/1/count", "5"), 1U) << "two corners of a triangle";
}

TEST(GltfHostile, AttributesOfMatrices) {
  GltfSample sample = square_sample();
  const std::size_t matrices = sample.add(std::vector<float>(16, 1), "MAT2", 4);
  sample.json["meshes"][0]["primitives"][0]["attributes"]["_M"] = matrices;
  Warnings warnings;
  EXPECT_TRUE(read_sample(sample, warnings.run()).meshes[0]->attributes.empty());
  EXPECT_EQ(warnings.lines.size(), 1U);
  sample.json["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", 0}, {"COLOR_0", matrices}};
  EXPECT_EQ(read_sample(sample, warnings.run()).meshes[0]->attributes.size(), 0U);
}

TEST(GltfHostile, PackedGeometryNeedsAFallback) {
  GltfSample sample = square_sample();
  sample.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  EXPECT_NO_THROW(read_sample(sample)) << "the accessors have the plain values";
  sample.json["accessors"][0].erase("bufferView");
  EXPECT_EQ(kind_of_error([&] { read_sample(sample); }), Error::Unsupported);

  GltfSample packed = square_sample();
  packed.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
  EXPECT_NO_THROW(read_sample(packed));
  packed.json["buffers"].push_back({{"byteLength", 48}});
  packed.json["bufferViews"][0]["buffer"] = 1;
  EXPECT_EQ(kind_of_error([&] { read_sample(packed); }), Error::Unsupported);
}

TEST(GltfHostile, ChunksOfWrongLengths) {
  const std::vector<std::byte> good = glb_of(square_sample());
  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::vector<std::byte> file = good;
    std::memcpy(file.data() + at, &value, sizeof value);
    return file;
  };
  const auto size = static_cast<std::uint32_t>(good.size());
  ASSERT_TRUE(survives(good));
  EXPECT_FALSE(survives(with(4, 1))) << "version";
  EXPECT_FALSE(survives(with(8, size + 4)));
  EXPECT_FALSE(survives(with(8, 8)));
  EXPECT_FALSE(survives(with(12, 0xFFFFFFFF)));
  EXPECT_FALSE(survives(with(12, size)));
  EXPECT_FALSE(survives(with(12, 0)));
  EXPECT_FALSE(survives(with(16, 0x004E4942))) << "binary before JSON";
  std::vector<std::byte> longer = good;
  longer.resize(good.size() + 5);
  EXPECT_TRUE(survives(longer)) << "with a warning";
}

TEST(GltfHostile, DeepAndHugeJson) {
  const auto text = [](const std::string& value) {
    return R"({"asset": {"version": "2.0"}, "extras": )" + value + "}";
  };
  EXPECT_TRUE(survives(glb_of(text(std::string(100, '[') + std::string(100, ']')), {})));
  EXPECT_TRUE(survives(glb_of(text("\"" + std::string(1000, '[') + "\\\"[[\""), {}))) << "in a string they are letters";
  EXPECT_FALSE(survives(glb_of(text(std::string(1000000, '[') + std::string(1000000, ']')), {})));
  EXPECT_FALSE(survives(glb_of(text(std::string(1000000, '[')), {})));
  EXPECT_FALSE(survives(glb_of(text("1e999"), {})));
  EXPECT_FALSE(survives(glb_of(text("[1"), {})));
  EXPECT_FALSE(survives(glb_of("[]", {})));
  EXPECT_FALSE(survives(glb_of("", {})));
  EXPECT_FALSE(survives(glb_of(text("[" + std::string(9000000, ' ') + "]"), {}))) << "more than the memory allows";
}

TEST(GltfHostile, CountsThatWereMadeUpTakeNoMemory) {
  GltfSample sample = square_sample();
  sample.json["accessors"][0] = {{"componentType", 5126}, {"count", 4000000000U}, {"type", "VEC3"}};
  EXPECT_EQ(kind_of_error([&] { read_sample(sample); }), Error::Resource);

  GltfSample repeated = square_sample();
  const std::size_t points = repeated.add(std::vector<float>(300000, 1), "VEC3", 3);
  for (int m = 0; m < 1000; ++m) {
    repeated.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", points}}}, {"mode", 0}}}}});
  }
  EXPECT_EQ(kind_of_error([&] { read_sample(repeated); }), Error::Resource);
}

TEST(GltfHostile, LargeObjectsAreLeftOutOfMaterials) {
  GltfSample sample = full_sample();
  Json large;
  for (int i = 0; i < 2000; ++i) large["member" + std::to_string(i)] = i;
  sample.json["materials"][0]["extensions"]["X_LARGE"] = large;
  Warnings warnings;
  const Scene scene = read_sample(sample, warnings.run());
  EXPECT_EQ(warnings.lines.size(), 1U);
  EXPECT_FALSE(scene.materials[0].extensions.has("X_LARGE"));
  EXPECT_TRUE(scene.materials[0].extensions.has("KHR_materials_clearcoat"));
}

TEST(GltfHostile, NamesWithZeroBytesAreTheirOwn) {
  GltfSample sample = square_sample();
  const std::size_t four = sample.add(std::vector<float>(16, 4), "VEC4", 4);
  const std::size_t one = sample.add(std::vector<float>(4, 1), "SCALAR", 1);
  Json& attributes = sample.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["_A"] = four;
  attributes[std::string("_A\0B", 4)] = one;
  const Scene scene = read_sample(sample);
  EXPECT_EQ(*scene.meshes[0]->find("_A")->get<float>(), Array<float>(16, 4));
  EXPECT_EQ(*scene.meshes[0]->find(std::string_view("_A\0B", 4))->get<float>(), Array<float>(4, 1));
}

TEST(GltfHostile, EveryCutIsNoticed) {
  const std::vector<std::byte> file = glb_of(full_sample());
  ASSERT_TRUE(survives(file));
  for (std::size_t length = 0; length < file.size(); ++length) {
    EXPECT_FALSE(survives(std::span(file).first(length))) << length;
  }
}

TEST(GltfHostile, FlipsGiveASceneOrAnError) {
  const std::vector<std::byte> file = glb_of(full_sample());
  for (unsigned seed = 1; seed <= 4000; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::byte> flipped = file;
    for (std::size_t flips = 1 + random() % 3; flips > 0; --flips) {
      flipped[random() % flipped.size()] ^= static_cast<std::byte>(1U << (random() % 8));
    }
    SCOPED_TRACE(seed);
    survives(flipped);
  }
}

/// Numbers in the JSON exchanged for others: what flips seldom reach.
TEST(GltfHostile, StrangeNumbersGiveASceneOrAnError) {
  const GltfSample sample = full_sample();
  const Json flat = sample.json.flatten();
  const std::vector<Json> strange = {
      -1,          0,    1,     2,   3,       7,    255, 65535,         2147483648U,   4294967295U,
      4294967294U, 1e15, 1e300, 0.5, nullptr, true, "x", Json::array(), Json::object()};
  for (const auto& [place, value] : flat.items()) {
    for (const Json& each : strange) {
      GltfSample other = sample;
      other.json[Json::json_pointer(place)] = each;
      SCOPED_TRACE(place + " = " + each.dump());
      survives(glb_of(other));
    }
  }
}

}  // namespace
}  // namespace azulejo
