#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/data/scene.h"
#include "azulejo/io/io_testing.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/model_testing.h"
#include "azulejo/io/shared_models_table.h"

namespace azulejo {
namespace {

class SharedModels : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(shared_data())) GTEST_SKIP() << "skipped: " << shared_data() << " absent";
  }
  static Mesh mesh(const std::string& path, const ModelReadOptions& options = {}) {
    return std::get<Mesh>(read_model((shared_data() / path).string(), options));
  }
};

struct Counts {
  ModelOutcome outcome;
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

Counts counts(const Mesh& mesh) { return {ModelOutcome::Mesh, mesh.vertex_count(), mesh.face_count()}; }
Counts counts(const Scene& scene) {
  Counts result = {ModelOutcome::Scene};
  for (const auto& mesh : scene.meshes) {
    result.vertices += mesh->vertex_count();
    result.faces += mesh->face_count();
  }
  return result;
}
Counts counts(const Drawing& drawing) { return {ModelOutcome::Drawing, drawing.paths.size(), drawing.points.size()}; }
Counts counts(const Volume& volume) { return {ModelOutcome::Volume, volume.samples.size(), 0}; }

void expect_said(const std::vector<std::string>& lines, const std::string& wanted, const std::string& path) {
  EXPECT_EQ(lines.empty(), wanted.empty()) << (lines.empty() ? "nothing was said" : lines.front());
  const bool found = std::any_of(lines.begin(), lines.end(),
                                 [&](const std::string& line) { return line.find(wanted) != std::string::npos; });
  EXPECT_TRUE(found || wanted.empty()) << lines.front();
  for (const std::string& line : lines) {
    EXPECT_EQ(line.find(path + ": "), 0U) << "names the file: " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST_F(SharedModels, GiveWhatTheTableSays) {
  for (const SharedModel& wanted : kSharedModels) {
    SCOPED_TRACE(wanted.path);
    const std::string path = (shared_data() / wanted.path).string();
    EXPECT_TRUE(is_model_file(path));
    Warnings warnings;
    Counts found = {ModelOutcome::Refused};
    try {
      const Model model = read_model(path, {}, warnings.run());
      found = std::visit([](const auto& value) { return counts(value); }, model);
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == Error::Data || error.kind() == Error::Unsupported) << error.what();
      warnings.lines.emplace_back(error.what());
    }
    EXPECT_EQ(found.outcome, wanted.outcome);
    EXPECT_EQ(found.vertices, wanted.vertices);
    EXPECT_EQ(found.faces, wanted.faces);
    expect_said(warnings.lines, wanted.said, path);
  }
}

TEST_F(SharedModels, AreAllInTheTable) {
  std::set<std::string> listed_paths;
  for (const SharedModel& each : kSharedModels) listed_paths.insert(each.path);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_data())) {
    if (!entry.is_regular_file()) continue;
    const std::string path = std::filesystem::relative(entry.path(), shared_data()).string();
    const bool one_of_these = std::any_of(std::begin(kSharedModelEndings), std::end(kSharedModelEndings),
                                          [&](const char* ending) { return path.ends_with(ending); });
    EXPECT_TRUE(!one_of_these || listed_paths.contains(path)) << path;
  }
}

/// Edges with one face, and with more than two; V − E + F of the vertices that faces use.
struct Topology {
  std::size_t boundary = 0;
  std::size_t non_manifold = 0;
  long euler = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};

std::ostream& operator<<(std::ostream& out, const Topology& t) {
  return out << t.boundary << " boundary, " << t.non_manifold << " non-manifold, Euler " << t.euler;
}

Topology topology(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edges;
  std::set<std::uint32_t> used(mesh.corners.begin(), mesh.corners.end());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::size_t begin = mesh.face_begin(face);
    const std::size_t end = mesh.face_end(face);
    for (std::size_t corner = begin; corner < end; ++corner) {
      ++edges[std::minmax(mesh.corners[corner], mesh.corners[corner + 1 < end ? corner + 1 : begin])];
    }
  }
  Topology result;
  for (const auto& [edge, faces] : edges) {
    result.boundary += faces == 1 ? 1U : 0U;
    result.non_manifold += faces > 2 ? 1U : 0U;
  }
  result.euler =
      static_cast<long>(used.size()) - static_cast<long>(edges.size()) + static_cast<long>(mesh.face_count());
  return result;
}

TEST_F(SharedModels, HaveTheTopologyThatIsKnownOfThem) {
  // As counted by another program. STL: after welding.
  const std::vector<std::pair<const char*, Topology>> known = {
      {"meshes/cad/featuretype.stl", {576, 0, -16}},
      {"meshes/cad/tray_1002_tray_bottom.stl", {0, 0, -44}},
      {"meshes/cad/adis16480.stl", {0, 0, -46}},
      {"meshes/cad/plate_holes.stl", {0, 0, -8}},
      {"meshes/cad/cycloidal.ply", {0, 242, -58}},
      {"meshes/multishell/multibody.stl", {0, 0, 4}},
      {"meshes/broken/soup.stl", {300, 0, 100}},
      {"meshes/broken/spherewithholes.stl", {40, 0, 0}},
      {"meshes/off/P.off", {0, 0, 0}},
      {"meshes/genus/double-torus-example.off", {0, 0, -2}},
      {"meshes/off/polygon_mesh.off", {489, 0, -23}},
      {"meshes/scans/stanford_bunny_zippered.ply", {223, 0, -3}},
      {"meshes/scans/stanford_dragon_res4.ply.gz", {0, 803, 509}},
  };
  for (const auto& [path, wanted] : known) EXPECT_EQ(topology(mesh(path)), wanted) << path;
}

TEST_F(SharedModels, StripsAreWoundTheSameWay) {
  // No two triangles go along an edge in the same direction, as every other one would if it weren't turned.
  const Mesh brain = mesh("meshes/genus/brain.ply");
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (std::size_t face = 0; face < brain.face_count(); ++face) {
    for (std::size_t i = 0; i < 3; ++i) {
      directed.emplace(brain.corners[face * 3 + i], brain.corners[face * 3 + (i + 1) % 3]);
    }
  }
  EXPECT_EQ(directed.size(), brain.corner_count());
}

TEST_F(SharedModels, ThatAreTheSameShape) {
  // One was written as text with six decimals, the other as floats.
  const Mesh text = mesh("meshes/broken/ascii_HalfDonut.stl", {.weld = false});
  const Mesh binary = mesh("meshes/broken/binary_HalfDonut.stl", {.weld = false});
  ASSERT_EQ(text.vertex_count(), binary.vertex_count());
  for (std::size_t i = 0; i < text.vertex_count(); ++i) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(text.positions[i][axis], binary.positions[i][axis], 1e-5F);
  }
}

TEST_F(SharedModels, AreReadBackAsWritten) {
  for (const SharedModel& each : kSharedModels) {
    if (each.outcome != ModelOutcome::Mesh || each.faces > 50'000) continue;  // enough with the small ones
    SCOPED_TRACE(each.path);
    Mesh original = mesh(each.path);
    for (const bool ascii : {false, true}) {
      EXPECT_TRUE(same_mesh(mesh_of(text_of(encode_model(original, "ply", {.ascii = ascii})), "x.ply"), original));
    }
  }
}

}  // namespace
}  // namespace azulejo
