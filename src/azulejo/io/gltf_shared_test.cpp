// What each glTF file of the shared set of samples is expected to give.

#include <filesystem>
#include <set>

#include "azulejo/io/gltf_testing.h"

namespace azulejo {
namespace {

struct Sample {
  const char* path;
  std::size_t nodes;
  std::size_t meshes;
  std::size_t vertices;
  std::size_t triangles;
  std::size_t materials;
  std::size_t images;  ///< that textures show
  std::size_t warnings = 0;
};

struct Refused {
  const char* path;
  Error::Kind kind;
  const char* message;
};

// clang-format off
constexpr Sample kSamples[] = {
    {"gltf/AlphaBlendModeTest/AlphaBlendModeTest.gltf", 9, 9, 137, 61, 6, 4},
    {"gltf/AnimatedTriangle/AnimatedTriangle.gltf", 1, 1, 3, 1, 0, 0},
    {"gltf/Avocado/Avocado.gltf", 1, 1, 406, 682, 1, 3},
    {"gltf/Box/glTF/Box.gltf", 2, 1, 24, 12, 1, 0},
    {"gltf/Box/glTF-Binary/Box.glb", 2, 1, 24, 12, 1, 0},
    {"gltf/Box/glTF-Embedded/Box.gltf", 2, 1, 24, 12, 1, 0},
    {"gltf/BoxAnimated/BoxAnimated.gltf", 4, 2, 320, 254, 2, 0},
    {"gltf/BoxInterleaved/BoxInterleaved.glb", 2, 1, 24, 12, 1, 0},
    {"gltf/BoxTextured/glTF/BoxTextured.gltf", 2, 1, 24, 12, 1, 1},
    {"gltf/BoxTextured/glTF-Binary/BoxTextured.glb", 2, 1, 24, 12, 1, 1},
    {"gltf/BoxVertexColors/BoxVertexColors.gltf", 1, 1, 24, 12, 0, 0},
    {"gltf/Cameras/Cameras.gltf", 3, 1, 4, 2, 0, 0},
    {"gltf/CesiumMan/CesiumMan.gltf", 22, 1, 3273, 4672, 1, 1},
    {"gltf/DamagedHelmet/DamagedHelmet.glb", 1, 1, 14556, 15452, 1, 5},
    {"gltf/Duck/glTF/Duck.gltf", 3, 1, 2399, 4212, 1, 1},
    {"gltf/Duck/glTF-Quantized/Duck.gltf", 3, 1, 2399, 4212, 1, 1},
    {"gltf/EmissiveStrengthTest/EmissiveStrengthTest.gltf", 6, 6, 188, 90, 6, 1},
    {"gltf/InterpolationTest/InterpolationTest.glb", 12, 10, 220, 110, 10, 1},
    {"gltf/MeshPrimitiveModes/MeshPrimitiveModes.gltf", 7, 7, 49, 16, 0, 0},  // 6, and those of a strip and a fan
    {"gltf/MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.gltf", 119, 102, 528291, 1040409, 98, 0},
    {"gltf/MultipleScenes/MultipleScenes.gltf", 2, 2, 7, 3, 0, 0},
    {"gltf/NegativeScaleTest/NegativeScaleTest.glb", 14, 8, 2032, 3884, 6, 2},
    {"gltf/NormalTangentTest/NormalTangentTest.gltf", 2, 1, 3983, 7774, 1, 3},
    {"gltf/OrientationTest/OrientationTest.gltf", 13, 13, 1048, 524, 7, 0},
    {"gltf/RiggedSimple/RiggedSimple.gltf", 5, 1, 160, 188, 1, 0},
    {"gltf/SimpleMeshes/SimpleMeshes.gltf", 2, 1, 3, 1, 0, 0},
    {"gltf/SimpleMorph/SimpleMorph.gltf", 1, 1, 3, 1, 0, 0},
    {"gltf/SimpleSkin/SimpleSkin.gltf", 3, 1, 10, 8, 0, 0},
    {"gltf/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 1, 1, 14, 12, 0, 0},
    {"gltf/Suzanne/Suzanne.gltf", 1, 1, 11808, 3936, 1, 2},
    {"gltf/TextureCoordinateTest/TextureCoordinateTest.glb", 5, 5, 20, 10, 5, 1},
    {"gltf/TextureSettingsTest/TextureSettingsTest.gltf", 11, 10, 144, 72, 10, 3},
    {"gltf/TextureTransformTest/TextureTransformTest.gltf", 12, 9, 36, 18, 9, 5},
    {"gltf/TransmissionTest/TransmissionTest.gltf", 25, 22, 66902, 128775, 14, 9},
    {"gltf/Triangle/glTF-Embedded/Triangle.gltf", 1, 1, 3, 1, 0, 0},
    {"gltf/TriangleWithoutIndices/TriangleWithoutIndices.gltf", 1, 1, 3, 1, 0, 0},
    {"gltf/TwoSidedPlane/TwoSidedPlane.gltf", 1, 1, 6, 2, 1, 3},
    {"gltf/UnlitTest/UnlitTest.glb", 2, 2, 192, 88, 2, 0},
    {"gltf/VertexColorTest/VertexColorTest.gltf", 2, 2, 72, 36, 2, 2},
    {"gltf_invalid/misc/BoxWithInfinites.glb", 2, 1, 24, 12, 1, 0},  // coordinates may be any floats
};

constexpr Refused kRefused[] = {
    {"gltf/Box/glTF-Draco/Box.gltf", Error::Unsupported, "KHR_draco_mesh_compression isn't read"},
    {"gltf_invalid/bounds/integer-out-of-bounds.gltf", Error::Data, "bufferViews[0].byteLength: 1e+300"},
    {"gltf_invalid/bounds/invalid-buffer-index.gltf", Error::Data, "bufferViews[1].buffer: 1, of 1"},
    {"gltf_invalid/bounds/invalid-buffer-view-index.gltf", Error::Data, "bufferViews[0].buffer: 0, of 0"},
    {"gltf_invalid/bounds/invalid-primitive-indices.gltf", Error::Data, "bufferViews[0].buffer: 0, of 0"},
    {"gltf_invalid/index_out_of_range/AllIndicesOutOfRange.gltf", Error::Data, "index 0 is 65535, of 24 vertices"},
    {"gltf_invalid/index_out_of_range/IndexOutOfRange.gltf", Error::Data, "index 0 is 255, of 24 vertices"},
    {"gltf_invalid/misc/BoxTextured.gltf", Error::Data, "no file BoxTextured0.bin"},
    {"gltf_invalid/misc/RecursiveNodes.gltf", Error::Data, "their own ancestors"},
};
// clang-format on

class GltfSamples : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "skipped: " << folder_ << " absent";
  }
  Scene read(const char* path, const azulejo::Run& run = {}, const ModelReadOptions& options = {}) const {
    return std::get<Scene>(read_model((folder_ / path).string(), options, run));
  }
  std::filesystem::path folder_ = shared_images().parent_path() / "scenes";
};

TEST_F(GltfSamples, GiveWhatTheTableSays) {
  for (const Sample& wanted : kSamples) {
    SCOPED_TRACE(wanted.path);
    Warnings warnings;
    const Scene scene = read(wanted.path, warnings.run());
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (const auto& mesh : scene.meshes) {
      vertices += mesh->vertex_count();
      triangles += mesh->triangle_count();
    }
    std::set<const Image*> images;
    for (const Texture& texture : scene.textures) {
      EXPECT_NE(texture.image, nullptr);
      images.insert(texture.image.get());
    }
    EXPECT_EQ(scene.nodes.size(), wanted.nodes);
    EXPECT_EQ(scene.meshes.size(), wanted.meshes);
    EXPECT_EQ(vertices, wanted.vertices);
    EXPECT_EQ(triangles, wanted.triangles);
    EXPECT_EQ(scene.materials.size(), wanted.materials);
    EXPECT_EQ(images.size(), wanted.images);
    EXPECT_EQ(warnings.lines.size(), wanted.warnings);
    EXPECT_FALSE(scene.roots.empty());
    EXPECT_NO_THROW(scene.check("scene"));
  }
}

TEST_F(GltfSamples, AreRefusedForTheirReason) {
  for (const Refused& wanted : kRefused) {
    SCOPED_TRACE(wanted.path);
    try {
      read(wanted.path);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), wanted.kind) << error.what();
      EXPECT_NE(std::string(error.what()).find(wanted.message), std::string::npos) << error.what();
    }
  }
}

TEST_F(GltfSamples, NoneIsMissingFromTheTables) {
  std::set<std::string> known;
  for (const Sample& each : kSamples) known.insert(each.path);
  for (const Refused& each : kRefused) known.insert(each.path);
  for (const char* part : {"gltf", "gltf_invalid"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / part)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".gltf" && ending != ".glb") continue;
      EXPECT_TRUE(known.contains(std::filesystem::relative(entry.path(), folder_).string())) << entry.path();
    }
  }
}

/// The forms of one model: text, embedded, binary, interleaved.
TEST_F(GltfSamples, OneModelInSeveralFormsIsTheSame) {
  const Scene plain = read("gltf/Box/glTF/Box.gltf");
  for (const char* path :
       {"gltf/Box/glTF-Binary/Box.glb", "gltf/Box/glTF-Embedded/Box.gltf", "gltf/BoxInterleaved/BoxInterleaved.glb"}) {
    SCOPED_TRACE(path);
    const Scene other = read(path);
    EXPECT_EQ(other.meshes[0]->positions, plain.meshes[0]->positions);
    EXPECT_EQ(other.meshes[0]->find("NORMAL")->values, plain.meshes[0]->find("NORMAL")->values);
    EXPECT_EQ(other.meshes[0]->corners, plain.meshes[0]->corners);
  }
  // Quantized to 16 bits over the duck's size, turned back by the node above.
  const Box3 duck = bounds(read("gltf/Duck/glTF/Duck.gltf"));
  const Box3 quantized = bounds(read("gltf/Duck/glTF-Quantized/Duck.gltf"));
  const glm::vec3 size = duck.size();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(quantized.lower[axis], duck.lower[axis], size[axis] / 1000) << axis;
    EXPECT_NEAR(quantized.upper[axis], duck.upper[axis], size[axis] / 1000) << axis;
  }
}

/// Without their images, which take long to pack.
TEST_F(GltfSamples, AreTheSameFileAfterASecondTrip) {
  ModelReadOptions names_only;
  names_only.textures = false;
  for (const Sample& sample : kSamples) {
    SCOPED_TRACE(sample.path);
    const std::vector<std::byte> once = encode_model(read(sample.path, {}, names_only), "glb");
    EXPECT_EQ(encode_model(std::get<Scene>(read_model(once, "once.glb", names_only)), "glb"), once);
  }
}

/// The order of threads must not show.
TEST_F(GltfSamples, ThreadsDoNotMatter) {
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 7;
  const char* path = "gltf/TransmissionTest/TransmissionTest.gltf";
  EXPECT_EQ(encode_model(read(path, one), "glb", {}, many), encode_model(read(path, many), "glb", {}, one));
}

}  // namespace
}  // namespace azulejo
