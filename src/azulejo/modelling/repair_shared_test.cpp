// What becomes of files that are broken on purpose, and of scans. Skipped where they are absent.

#include <filesystem>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "azulejo/io/model_testing.h"
#include "azulejo/modelling/flatten.h"
#include "azulejo/modelling/repair.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {
namespace {

struct File {
  const char* name;
  bool solid;              ///< there is one in it
  std::size_t shells = 1;  ///< of that
  std::size_t genus = 0;
  const char* why = "";  ///< there is none
};

void PrintTo(const File& file, std::ostream* out) { *out << file.name; }

Mesh read(const std::filesystem::path& path) {
  Model model = read_model(path.string());
  if (Scene* const scene = std::get_if<Scene>(&model)) return flatten(*scene);
  return std::get<Mesh>(std::move(model));
}

class RepairShared : public testing::TestWithParam<File> {};

TEST_P(RepairShared, BecomesASolidIfOneIsInIt) {
  const File& file = GetParam();
  const std::filesystem::path path = shared_data() / "meshes" / file.name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const Mesh mesh = read(path);
  const RepairedMesh repaired = repair(mesh);
  repaired.mesh.check(file.name);
  EXPECT_EQ(repaired.solid, file.solid) << file.why;
  const Topology found = topology(repaired.mesh);
  EXPECT_EQ(found.printable(), file.solid);
  EXPECT_TRUE(same_mesh(repair(repaired.mesh).mesh, repaired.mesh));
  if (!file.solid) return;
  EXPECT_EQ(found.shells.size(), file.shells);
  EXPECT_EQ(found.genus(), file.genus);
}

INSTANTIATE_TEST_SUITE_P(
    Broken, RepairShared,
    testing::Values(File{"broken/ascii_HalfDonut.stl", true, 1, 1}, File{"broken/ascii_Moon.stl", true},
                    File{"broken/bad-stl-tardis.stl", true, 1, 12}, File{"broken/bad-stl-wing.stl", true},
                    File{"broken/binary_HalfDonut.stl", true, 1, 1},
                    File{"broken/binary_StarWithEmptyHeader.stl", true}, File{"broken/busted.stl", true},
                    File{"broken/sphereWithHole.stl", true}, File{"broken/spherewithholes.stl", true},
                    File{"broken/box_UTF16BE.obj", true}, File{"broken/box_longline.obj", true},
                    File{"broken/box_without_lineending.obj", true}, File{"broken/cube-vertexcol.obj", true},
                    File{"broken/deg_faces.obj", true}, File{"broken/issue-295-trianguation-failure.obj", true},
                    File{"broken/negative_indices.obj", true}, File{"broken/non_manifold_wrap.obj", true, 2},
                    File{"broken/polygonfaces.obj", true}, File{"broken/cube_binary_header_with_RN_newline.ply", true},
                    File{"broken/cube_binary_starts_with_nl.ply", true}, File{"broken/many_small_holes.ply", true},
                    File{"broken/non_manif_hole.ply", true}, File{"broken/elephant-with-holes.off", true, 1, 3},
                    File{"broken/mech-holes-shark.off", true}, File{"broken/missing_material_file.obj", true, 3},
                    File{"broken/test-nan.obj", true, 3}));

INSTANTIATE_TEST_SUITE_P(
    WithoutASolid, RepairShared,
    testing::Values(File{"broken/empty.stl", false, 0, 0, "empty"},
                    File{"broken/stl_empty_ascii.stl", false, 0, 0, "empty"},
                    File{"broken/ply_empty_header.ply", false, 0, 0, "empty"},
                    File{"broken/invalid-face-definition.obj", false, 0, 0, "faces of one and two corners"},
                    File{"broken/obj_points.obj", false, 0, 0, "points"},
                    File{"broken/points_ascii_with_lists.ply", false, 0, 0, "points"},
                    File{"broken/float_inf_point_cloud.ply", false, 0, 0, "points"},
                    File{"broken/obj_wireframe.obj", false, 0, 0, "lines"},
                    File{"broken/soup.stl", false, 0, 0, "a hundred triangles that have nothing in common"},
                    File{"broken/triangle_with_empty_solid.stl", false, 0, 0, "a triangle"},
                    File{"broken/triangle_with_two_solids.stl", false, 0, 0, "two triangles"},
                    File{"broken/eof_test.obj", false, 0, 0, "a triangle"},
                    File{"broken/notenoughindices.obj", false, 0, 0, "a triangle"},
                    File{"broken/number_formats.obj", false, 0, 0, "a triangle on a line"},
                    File{"broken/degenerate_mesh.obj", false, 0, 0, "a triangle with one place"},
                    File{"broken/inf_nan.obj", false, 0, 0, "a triangle that is not finite"},
                    File{"broken/concave_polygon.obj", false, 0, 0, "one flat polygon"},
                    File{"broken/degtri_sliding.off", false, 0, 0, "triangles in a plane"}));

INSTANTIATE_TEST_SUITE_P(Others, RepairShared,
                         testing::Values(File{"scans/stanford_bunny_zippered.ply", true},
                                         File{"off/lion-head.off", true}, File{"classic/cow.obj", true},
                                         File{"classic/utah_teapot.obj", true, 4}, File{"classic/suzanne.obj", true, 3},
                                         File{"multishell/multibody.stl", true, 2},
                                         File{"multishell/joined_tetrahedra.obj", true, 2},
                                         File{"multishell/multiple_tetrahedrons.obj", true, 5},
                                         File{"genus/brain.ply", true, 4, 2}, File{"cad/featuretype.stl", true, 1, 1},
                                         File{"cad/cycloidal.ply", true, 112, 176}));

TEST(RepairScan, CountsWhatItDidToADecimatedScan) {
  const std::filesystem::path path = shared_data() / "meshes" / "scans" / "stanford_dragon_res4.ply.gz";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const RepairedMesh repaired = repair(read(path));
  EXPECT_TRUE(topology(repaired.mesh).printable());
  EXPECT_GT(repaired.count(RepairAction::DuplicateFace), 100U);
  EXPECT_GT(repaired.count(RepairAction::SplitEdge), 10U);
}

}  // namespace
}  // namespace azulejo
