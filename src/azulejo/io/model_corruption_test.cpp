// Every reader of models against cut and flipped files: any bytes give a model or an Error, within the limits given, and
// what is missing is said.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/data/scene.h"
#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_testing.h"

namespace azulejo {
namespace {

struct Sample {
  std::string name;  ///< its ending tells the format
  std::string bytes;
};

constexpr std::size_t kPlaces = 500;  ///< of flips, and of cuts in files too large for all
constexpr std::int64_t kMemory = std::int64_t{1} << 26;

Mesh rich_mesh(bool triangles) {
  Mesh mesh = random_mesh(9, 7, triangles, 1);
  mesh.attributes.push_back(random_attribute<float>(mesh, "NORMAL", Domain::Vertex, 3, 1));
  mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Vertex, 3, 2));
  mesh.attributes.push_back(random_attribute<float>(mesh, "TEXCOORD_0", Domain::Corner, 2, 3));
  mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Face, 3, 4));
  return mesh;
}

Sample written(const std::string& name, const Mesh& mesh, bool ascii = false) {
  return {name, text_of(encode_model(mesh, name.substr(name.find_last_of('.') + 1), {.ascii = ascii}))};
}

/// A tiny file of each format, in the forms whose reading differs: one line each.
std::vector<Sample> small_samples() {
  return {
      written("binary.stl", random_mesh(9, 7, true, 1)),
      written("text.stl", random_mesh(9, 4, true, 1), true),
      written("binary.ply", rich_mesh(false)),
      written("triangles.ply", rich_mesh(true)),
      written("text.ply", rich_mesh(false), true),
      written("mixed.off", rich_mesh(false)),
      written("scene.glb", rich_mesh(false)),
      {"drawing.svg",
       "<svg width='9mm' viewBox='0 0 80 60'><style>.a,#q{fill:red;stroke:#00f}</style><g id='g' opacity='.5' "
       "transform='translate(1,2) rotate(9)' clip-path='url(#c)'><path class='a' d='M0 0h9v9zm1.5.5-3-2a1 1 0 0110 9S1 "
       "2 "
       "3 4'/></g><clipPath id='c'><circle r='5'/></clipPath><linearGradient id='l'><stop "
       "offset='50%'/></linearGradient>"
       "<use href='#g' x='5'/><polygon points='1 2 3 4 9 2' fill='url(#l)' stroke-dasharray='1 2'/></svg>"},
      {"big_endian.ply",
       "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty short x\nproperty short y\nproperty short z\n"
       "element tristrips 1\nproperty list uchar char vertex_indices\nelement edge 1\nproperty uchar vertex1\n"
       "property uchar vertex2\nend_header\n" +
           std::string("\0\1\0\2\0\3\0\4\0\5\0\6\4\0\1\0\1\0\1", 19)},
      {"comments.off",
       "# one\nSTCOFF # two\n3 2\n0 0 0 1 0 0 0.5 0.5\n# three\n1 0 0 .5 0 0 0 0\n1 1 0\n3 0 1 2 9\n3 0 2 1 1 2 3\n"},
      {"bytes.off",
       "OFF BINARY\n" + std::string("\0\0\0\1\0\0\0\1\0\0\0\0?\200\0\0?\200\0\0?\200\0\0\0\0\0\1\0\0\0\0\0\0\0\0", 36)},
  };
}

/// Files that azulejo doesn't write, from the shared set: one line each.
std::vector<Sample> shared_samples() {
  std::vector<Sample> samples;
  for (const char* name :
       {"meshes/broken/binary_StarWithEmptyHeader.stl", "meshes/broken/spherewithholes.stl",
        "meshes/multishell/multibody.stl", "meshes/off/mesh_with_colors.off", "meshes/off/P.off",
        "meshes/broken/points_ascii_with_lists.ply", "meshes/broken/cube_binary_header_with_RN_newline.ply",
        "meshes/broken/many_small_holes.ply", "meshes/scans/stanford_dragon_res4.ply.gz",
        "scenes/gltf/BoxTextured/glTF-Binary/BoxTextured.glb", "scenes/gltf/Triangle/glTF-Embedded/Triangle.gltf"}) {
    std::ifstream file(shared_data() / name, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), {});
    if (file) samples.push_back({name, std::move(bytes)});
  }
  return samples;
}

/// What came of reading damaged bytes.
struct Attempt {
  std::optional<Model> model;  ///< nothing: an Error
  bool warned = false;
};

void check(const Mesh& mesh) { mesh.check("sample"); }
void check(const Scene& scene) {
  for (const auto& mesh : scene.meshes) mesh->check("sample");
  scene.check("sample");
}
void check(const Drawing& drawing) { drawing.check("sample"); }
void check(const Volume& volume) { EXPECT_EQ(volume.samples.size(), volume.index(0, 0, volume.depth)); }

Attempt attempt(const std::string& bytes, const std::string& name) {
  Attempt result;
  azulejo::Run run;
  run.threads = 1;
  run.limits.pixels = std::int64_t{1} << 22;
  run.limits.memory_bytes = kMemory;
  run.limits.temporary_bytes = 0;
  run.warn = [&](const std::string& line) {
    result.warned = true;
    EXPECT_EQ(line.find('\n'), std::string::npos) << name << ": " << line;
  };
  try {
    result.model = read_model(bytes_of(bytes), name, {}, run);
    std::visit([](const auto& value) { check(value); }, *result.model);
  } catch (const Error& error) {
    EXPECT_NE(error.kind(), Error::Cancelled) << name;
    EXPECT_NE(error.kind(), Error::Argument) << name << ": the caller did nothing wrong: " << error.what();
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.find(name), 0U) << "names the file: " << line;
  } catch (const std::exception& other) {
    ADD_FAILURE() << name << ": not an Error: " << other.what();
  }
  return result;
}

/// How much there is in a model: what a cut file must not be silent about.
std::vector<std::size_t> amounts(const Mesh& mesh) {
  return {mesh.vertex_count(), mesh.face_count(), mesh.corner_count(), mesh.lines.size(), mesh.attributes.size()};
}
std::vector<std::size_t> amounts(const Scene& scene) {
  std::vector<std::size_t> result = {scene.nodes.size(),  scene.materials.size(), scene.textures.size(),
                                     scene.lights.size(), scene.cameras.size(),   scene.animations.size()};
  for (const auto& mesh : scene.meshes) {
    const std::vector<std::size_t> more = amounts(*mesh);
    result.insert(result.end(), more.begin(), more.end());
  }
  return result;
}
std::vector<std::size_t> amounts(const Volume& volume) { return {volume.samples.size()}; }
std::vector<std::size_t> amounts(const Drawing& drawing) {
  return {drawing.paths.size(), drawing.points.size(), drawing.groups.size()};
}
std::vector<std::size_t> amounts(const Model& model) {
  return std::visit([](const auto& value) { return amounts(value); }, model);
}

/// A cut file gives the whole model, or says that it doesn't. In text a number may be cut in its last digits: what the
/// file still says is read then.
void expect_honest_cuts(const Sample& sample) {
  SCOPED_TRACE(sample.name);
  const Attempt whole = attempt(sample.bytes, sample.name);
  ASSERT_TRUE(whole.model) << "the sample itself";
  const std::size_t size = sample.bytes.size();
  const std::size_t cuts = std::min(size, size < 4096 ? size : kPlaces);
  for (std::size_t i = 0; i < cuts; ++i) {
    const std::size_t length = size * i / cuts;
    const Attempt cut = attempt(sample.bytes.substr(0, length), sample.name);
    if (!cut.model || cut.warned) continue;
    ASSERT_EQ(amounts(*cut.model), amounts(*whole.model)) << "silently, after " << length << " of " << size << " bytes";
  }
}

void survive_flips(const Sample& sample, unsigned seed) {
  SCOPED_TRACE(sample.name + ", seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    std::string bytes = sample.bytes;
    // Half of the flips go to the first bytes, where headers are.
    const std::size_t reach = i % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 256);
    for (std::size_t flips = 1 + random() % 3; flips > 0; --flips) {
      bytes[random() % reach] ^= static_cast<char>(1U << (random() % 8));
    }
    attempt(bytes, sample.name);
  }
}

TEST(ModelCorruption, CutFilesAreNeverASilentSuccess) {
  for (const Sample& sample : small_samples()) expect_honest_cuts(sample);
}

TEST(ModelCorruption, FlippedBitsGiveAModelOrAnError) {
  unsigned seed = 1;
  for (const Sample& sample : small_samples()) survive_flips(sample, seed++);
}

TEST(ModelCorruption, CutSharedSamples) {
  const std::vector<Sample> samples = shared_samples();
  if (samples.empty()) GTEST_SKIP() << "skipped: " << shared_data() << " absent";
  for (const Sample& sample : samples) expect_honest_cuts(sample);
}

TEST(ModelCorruption, FlippedSharedSamples) {
  const std::vector<Sample> samples = shared_samples();
  if (samples.empty()) GTEST_SKIP() << "skipped: " << shared_data() << " absent";
  unsigned seed = 1000;
  for (const Sample& sample : samples) survive_flips(sample, seed++);
}

}  // namespace
}  // namespace azulejo
